// How an upload is told: names of its states, its record as JSON.

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "core/base/time_text.h"
#include "core/controller/upload.h"

namespace zerodrift::controller {

std::string_view name_of(UploadState state) {
  constexpr std::array<std::string_view, 15> names = {
      "checking",  "saving_old",   "switching_off", "staging", "reading_back", "announcing", "committing",    "waiting",
      "comparing", "switching_on", "ramping",       "done",    "restoring",    "restored",   "restore_failed"};
  return names.at(static_cast<std::size_t>(state));
}
nlohmann::json to_json(const UploadRecord& record) {
  nlohmann::json steps = nlohmann::json::array();
  for (const auto& step : record.steps) {
    steps.push_back({{"state", name_of(step.state)}, {"time", to_text(step.time)}, {"detail", step.detail}});
  }
  nlohmann::json axes = nlohmann::json::array();
  for (const auto& axis : record.difference) {
    nlohmann::json curve = nlohmann::json::array();
    for (const auto& row : axis.curve) {
      curve.push_back({{"position_mm", row.position_mm},
                       {"old_up_um", row.old_up_um},
                       {"old_down_um", row.old_down_um},
                       {"new_up_um", row.new_up_um},
                       {"new_down_um", row.new_down_um}});
    }
    axes.push_back({{"axis", axis.axis},
                    {"largest_um", axis.largest_um},
                    {"largest_at_mm", axis.largest_at_mm},
                    {"compensation", curve}});
  }
  nlohmann::json out = {{"started", to_text(record.started)},
                        {"machine", record.machine},
                        {"serial", record.serial},
                        {"dry_run", record.dry_run},
                        {"state", name_of(record.reached)},
                        {"old_sequence", record.old_sequence},
                        {"sequence", record.sequence},
                        {"crc32", fmt::format("{:08x}", record.crc)},
                        {"old_words", record.old_words},
                        {"new_words", record.new_words},
                        {"difference", axes},
                        {"warnings", record.warnings},
                        {"steps", steps}};
  if (!record.result) out["error"] = describe(record.result.error());
  return out;
}
}  // namespace zerodrift::controller
