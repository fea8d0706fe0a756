#include "core/diagnosis/checked_runs.h"

#include <set>

#include "core/analysis/checked.h"
#include "core/diagnosis/explain.h"
#include "core/diagnosis/long_gaps.h"
#include "core/diagnosis/plausible.h"
#include "core/physics/simulate.h"

namespace zerodrift::diagnosis {
Result<CheckedRuns> checked_runs(const physics::Machine& machine, const std::vector<recording::Recording>& given) {
  CheckedRuns out;
  const std::set<std::string> boundaries = physics::measured_boundaries(machine);
  for (const auto& one : given) {
    analysis::Checked sound = analysis::checked(one, boundaries);
    for (auto& finding : sound.findings) {
      const bool needed = boundaries.count(finding.channel) != 0 && finding.channel != machine.room.channel;
      if (needed && finding.action == analysis::FindingAction::dropped) {
        return fail(ErrorCode::data_does_not_fit, {{"what", one.name + ", channel " + finding.channel},
                                                   {"found", analysis::describe(finding)},
                                                   {"expected", "a temperature that the simulation can follow"}});
      }
      out.findings.push_back({one.name, std::move(finding)});
    }
    if (auto part = longest_part(sound.recording)) {
      out.left_out.push_back(std::move(part->note));
      sound.recording = std::move(part->recording);
    }
    ZD_TRY(auto more, physics::check_recording(machine, sound.recording));
    out.warnings.insert(out.warnings.end(), more.begin(), more.end());
    ZD_CHECK(check_times(machine, sound.recording));
    out.recordings.push_back(std::move(sound.recording));
  }
  return out;
}

std::vector<Sentence> told_of(const CheckedRuns& runs) {
  const std::vector<RunFinding>& findings = runs.findings;
  std::vector<Sentence> told;
  for (const std::string& note : runs.left_out) told.push_back(explain_note("run_left_out", {{"what", note}}));
  std::set<std::string> units_told;
  for (const auto& [recording, finding] : findings) {
    const bool unit =
        finding.kind == analysis::FindingKind::fahrenheit || finding.kind == analysis::FindingKind::kelvin;
    const auto alike = std::count_if(findings.begin(), findings.end(), [&](const RunFinding& other) {
      return other.recording == recording && other.finding.kind == finding.kind;
    });
    if (!unit || alike == 1) {
      told.push_back(explain_note("run_finding", {{"recording", recording}, {"what", analysis::describe(finding)}}));
    } else if (units_told.insert(recording + std::string(analysis::name_of(finding.kind))).second) {
      told.push_back(explain_note("run_" + std::string(analysis::name_of(finding.kind)), {{"recording", recording}}));
    }
  }
  return told;
}

}  // namespace zerodrift::diagnosis
