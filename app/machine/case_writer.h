#pragma once
// A case for a blind trial of the diagnosis, without any server: run.csv, second.csv (the same machine, another plan),
// machine.json (what its maker would state, without the hidden effect), commitment.json and answer.json.
// The displacements are those of a nest of probes on the headstock: the spindle against its seat.

#include <filesystem>
#include <vector>

#include "app/machine/hidden_effect.h"
#include "core/base/result.h"
#include "core/recording/recording.h"

namespace zerodrift::machine {

struct CaseStep {
  double minutes = 0.0;
  double speed_rpm = 0.0;
  bool coolant_on = false;
  double cutting_W = 0.0;
};

struct CaseOptions {
  bool second = false;     // another plan and another day
  bool one_speed = false;  // poor excitation: one speed from start to end, neither coolant nor cutting
  bool noisy = true;       // false: what perfect sensors would show, for floors and strengths
  /// A further run of the same machine after a night of rest, of which only the room is recorded.
  std::vector<CaseStep> after_rest = {};
  /// ln of further factors on `ordinary_numbers`, in their order: the same machine built a little differently.
  std::vector<double> built_otherwise = {};
};

recording::Recording record_case(const HiddenEffects& hidden, std::uint64_t seed, const CaseOptions& options = {});
Status write_case(const std::filesystem::path& folder, const HiddenEffects& hidden, std::uint64_t seed);

}  // namespace zerodrift::machine
