#pragma once
// One concealed case: a machine of its own built by the virtual machine tool, with what it hides, the recordings a user
// would have, and the answer under seal. Its physics (app/machine) shares nothing with core/physics.

#include <cstdint>
#include <filesystem>
#include <string>

#include "app/machine/case_writer.h"
#include "app/machine/hidden_effect.h"
#include "app/proof/score.h"
#include "app/proof/strength.h"
#include "core/base/result.h"

namespace zerodrift::proof {

struct ConcealedCase {
  std::string name;
  std::uint64_t machine_seed = 1;
  machine::HiddenEffects hidden;
  machine::CaseOptions run;  // of the first recording
  OpenedAnswer truth;
  machine::Commitment seal;  // over hidden effects, truth and salt
};

/// Case number `index` of a trial: nothing hidden (15 %), two effects (12 %), one that no library lists (9 %), else one
/// of the list. How strong the hidden effects are in the first recording: StrengthRule. What is not is drawn anew on
/// another machine, of a mixed kind also with other effects. Trials up to seed 2813789501 and tests that repeat their
/// cases are `raw`; a film that radiation raises by a third counts there, though every description is re-fitted first.
ConcealedCase draw_case(std::uint64_t seed, int index, StrengthRule rule = StrengthRule::raw);
/// The same with what is hidden given: an effect's id, "none", "pair" or "unlisted"; `one_speed`: poor excitation.
ConcealedCase draw_case(std::uint64_t seed, int index, const std::string& kind, bool one_speed,
                        StrengthRule rule = StrengthRule::raw);

/// machine.json, recording.csv and second.csv: all that the diagnosis sees.
Status write_case_files(const ConcealedCase& one, const std::filesystem::path& folder);
/// The recording that this machine gives, with the faults its sensors have.
recording::Recording recording_of(const ConcealedCase& one, const machine::CaseOptions& run);

/// OpenedAnswer from the text under a seal.
Result<OpenedAnswer> truth_from(const std::string& sealed_text, const std::string& file);

}  // namespace zerodrift::proof
