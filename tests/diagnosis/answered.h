#pragma once
// What a concealed case is answered, and whether an answer says a thing.

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "core/diagnosis/diagnosis.h"
#include "core/physics/machine.h"
#include "tests/diagnosis/simulated.h"
#include "tests/proof/case_generator.h"

namespace zerodrift::diagnosis {

inline Result<Diagnosis> answer_with_details(const proof::Case& one) {
  const auto machine = physics::machine_from_json(one.machine, one.name);
  EXPECT_TRUE(machine.has_value());
  return diagnosed_and_simulated(*machine, one.recordings);
}

inline bool notes(const Diagnosis& d, const std::string& beginning) {
  return std::any_of(d.notes.begin(), d.notes.end(), [&](const auto& note) { return note.starts_with(beginning); });
}

inline bool says(const Diagnosis& d, const std::string& id) {
  return std::any_of(d.sentences.begin(), d.sentences.end(), [&](const auto& sentence) { return sentence.id == id; });
}

}  // namespace zerodrift::diagnosis
