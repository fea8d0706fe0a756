#pragma once
// The blind trial (P8): draws concealed cases, promises the answers (SHA-256 over salt and answer) in
// DIR/commitments.json, diagnoses each case from its files alone, then opens the seals, checks them and scores.
//   DIR/commitments.json            before anything is diagnosed
//   DIR/cases/case-001/machine.json, recording.csv, second.csv, diagnosis.json
//   DIR/cases/case-001/answer.json  after the diagnosis: salt, sealed text, whether the promise was kept
//   DIR/result.json                 figures, confusion, every answer

#include <cstdint>
#include <filesystem>

#include "app/proof/score.h"
#include "app/proof/strength.h"
#include "core/base/result.h"
#include "core/base/task_context.h"

namespace zerodrift::proof {

struct TrialOptions {
  int cases = 300;
  std::uint64_t seed = 1;
  std::filesystem::path folder;
  StrengthRule strength = StrengthRule::shown;
  std::string kind = {};  // "" the mixture, or what every case hides: an effect's id, "none", "pair", "unlisted"
};

struct Trial {
  TrialOptions options;
  Score score;
  std::string digest;  // SHA-256 of commitments.json as it was before the first diagnosis
  int seals_kept = 0;
  double seconds = 0.0;

  nlohmann::json to_json() const;
};

Result<Trial> run_trial(const TrialOptions& options, const TaskContext& context);

}  // namespace zerodrift::proof
