#include "core/controller/register_names.h"

#include <algorithm>

namespace zerodrift::controller {

const std::vector<RegisterName>& register_names() {
  static const std::vector<RegisterName> names = {
      {"magic", "identity: fixed number"},
      {"map_version", "version of the map"},
      {"capabilities", "bits: what the controller can do"},
      {"table_capacity", "registers a table may have"},
      {"serial", "serial number"},
      {"sensor_count", "temperature sensors"},
      {"axis_count", "axes"},
      {"clock_s", "controller's clock, s"},
      {"time_factor", "clock against real time"},
      {"heartbeat", "controller's heartbeat"},
      {"host_heartbeat", "our heartbeat", true},
      {"state", "bits: 0 cycle, 1 moving, 2 referenced, 3 alarm"},
      {"compensation_state", "compensation switch, 0 or 1"},
      {"coolant_state", "coolant, 0 or 1"},
      {"position_X_mm", "position X, mm"},
      {"position_Y_mm", "position Y, mm"},
      {"position_Z_mm", "position Z, mm"},
      {"position_A_deg", "position A, degrees"},
      {"position_C_deg", "position C, degrees"},
      {"spindle_rpm", "spindle speed, rpm"},
      {"spindle_load_W", "spindle load, W"},
      {"feed_X_mm_min", "feed X, mm/min"},
      {"feed_Y_mm_min", "feed Y, mm/min"},
      {"feed_Z_mm_min", "feed Z, mm/min"},
      {"applied_um", "compensation applied now, X Y Z, um"},
      {"target_mm", "wanted position X Y Z, mm", true},
      {"move", "1 starts the move", true},
      {"command_spindle_rpm", "wanted speed, rpm", true},
      {"command_coolant", "wanted coolant", true},
      {"command_cycle", "warm-up cycle on", true},
      {"command_compensation", "wanted switch", true},
      {"ambient_C", "room temperature, C"},
      {"temperature_C", "temperatures, C, in the profile's order"},
      {"probes_valid", "probes measure, 0 or 1"},
      {"probe_um", "probes X1 X2 Y1 Y2 Z, um"},
      {"host_offset_um", "host offset X Y Z (-error), um", true},
      {"host_watchdog_s", "watchdog of the offset, s", true},
      {"host_offset_state", "state of the host offset"},
      {"table_count", "registers of the staged table", true},
      {"table_scale", "scale of the staged table", true},
      {"table_crc", "CRC-32 of the staged table", true},
      {"table_sequence", "number of the staged table", true},
      {"table_commit", "commits that number", true},
      {"table_status", "status of the commit"},
      {"table_status_sequence", "number the status is of"},
      {"table_active_crc", "CRC-32 of the active table"},
      {"table_active_count", "registers of the active table"},
      {"table_active_sequence", "number of the active table"},
      {"table_reject_reason", "why it was refused"},
      {"table_ramp_percent", "ramp, %"},
      {"table_staging", "area a table is staged in", true},
      {"table_active", "area of the active table"},
  };
  return names;
}

const RegisterName* find_register_name(std::string_view name) {
  const auto& names = register_names();
  const auto at = std::find_if(names.begin(), names.end(), [&](const RegisterName& one) { return one.name == name; });
  return at == names.end() ? nullptr : &*at;
}

std::vector<MapUse> uses_of(const RegisterMap& map) {
  const std::vector<std::pair<std::string_view, std::vector<const char*>>> needs = {
      {"temperatures", {"temperature_C"}},
      {"interlock", {"compensation_state", "command_compensation"}},
      {"host offset", {"host_offset_um", "host_heartbeat"}},
      {"table",
       {"table_staging", "table_active", "table_count", "table_scale", "table_crc", "table_sequence", "table_commit",
        "table_status", "table_status_sequence", "table_active_crc", "table_active_count", "table_active_sequence"}}};
  std::vector<MapUse> uses;
  for (const auto& [use, names] : needs) {
    MapUse one{use, {}};
    for (const char* name : names) {
      if (map.find(name) == nullptr) one.missing.emplace_back(name);
    }
    uses.push_back(std::move(one));
  }
  return uses;
}

}  // namespace zerodrift::controller
