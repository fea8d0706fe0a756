// machine map and machine registers: a register map from a list, and what the registers hold now.

#include "app/cli/commands/machine_map.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/text/error_text.h"
#include "core/base/json.h"
#include "core/controller/modbus_machine.h"
#include "core/controller/register_names.h"
#include "core/controller/register_view.h"

namespace zerodrift::cli {

using controller::RegisterMap;
using nlohmann::json;

Result<CommandOutput> make_map(const MapOptions& options) {
  CommandOutput output;
  ZD_TRY(RegisterMap map, controller::read_register_list(options.list, options.base, &output.warnings));
  if (!options.name.empty()) map.name = options.name;
  ZD_CHECK(write_json_file(options.out, controller::to_json(map)));
  output.text = fmt::format("{}: {} registers\n", map.name, map.registers.size());
  json uses = json::object();
  for (const auto& use : controller::uses_of(map)) {
    uses[std::string(use.use)] = use.missing;
    output.text += use.missing.empty() ? fmt::format("{}: yes\n", use.use)
                                       : fmt::format("{}: no, it lacks {}\n", use.use, fmt::join(use.missing, ", "));
  }
  output.text += "written: " + options.out;
  output.json = {{"name", map.name}, {"registers", map.registers.size()}, {"missing", uses}, {"file", options.out}};
  return output;
}

Result<CommandOutput> list_registers(const MapOptions& options) {
  CommandOutput output;
  ZD_TRY(const controller::Profile profile, controller::read_profile(options.profile, &output.warnings));
  ZD_TRY(const RegisterMap map, options.list.empty()
                                    ? controller::map_of(profile, &output.warnings)
                                    : controller::read_register_list(options.list, options.base, &output.warnings));
  controller::ControllerSettings settings = profile.controller;
  if (map.unit) settings.unit = *map.unit;
  controller::Link link(settings);
  json rows = json::array();
  std::size_t failed = 0;
  std::optional<Error> last;
  for (const auto& value : controller::read_all(link, map)) {
    const auto& entry = map.registers.at(value.name);
    const auto* known = controller::find_register_name(value.name);
    const std::string said =
        value.result ? controller::text_of(value, entry) : zerodrift::lineOf(value.result.error()).toStdString();
    if (!value.result) {
      ++failed;
      last = value.result.error();
    }
    rows.push_back({{"name", value.name}, {"address", entry.address}, {"values", value.values}, {"raw", value.raw}});
    if (!value.result) rows.back()["error"] = said;
    output.text += fmt::format("{:>6}  {:<24} {}{}\n", entry.address, value.name, said,
                               known == nullptr ? "   (no use known)" : fmt::format("   {}", known->meaning));
  }
  if (last && failed == map.registers.size()) return fail(*last);
  if (!output.text.empty()) output.text.pop_back();
  output.json = {{"map", map.name}, {"registers", rows}};
  return output;
}

}  // namespace zerodrift::cli
