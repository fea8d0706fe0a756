#pragma once
// What a concealed case is answered, and whether an answer says a thing.

#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/input/checked_runs.h"
#include "core/physics/machine.h"
#include "tests/diagnosis/simulated.h"
#include "tests/proof/case_generator.h"

namespace zerodrift::diagnosis {

inline Result<Diagnosis> answer_with_details(const proof::Case& one) {
  const auto machine = physics::machine_from_json(one.machine, one.name);
  EXPECT_TRUE(machine.has_value());
  return diagnosed_and_simulated(*machine, one.recordings);
}

/// "code" or "code:value:value": is there a note with that beginning of a code, and facts that begin with those values?
inline bool notes(const std::vector<Note>& list, const std::string& wanted) {
  std::vector<std::string> parts;
  std::istringstream in(wanted);
  for (std::string part; std::getline(in, part, ':');) parts.push_back(part);
  return std::any_of(list.begin(), list.end(), [&](const Note& note) {
    return name_of(note.code).starts_with(parts.front()) &&
           std::all_of(parts.begin() + 1, parts.end(), [&](const std::string& value) {
             return std::any_of(note.facts.begin(), note.facts.end(),
                                [&](const auto& fact) { return fact.second.starts_with(value); });
           });
  });
}

inline bool notes(const Diagnosis& d, const std::string& wanted) {
  return notes(d.notes, wanted);
}

inline std::vector<std::string> ids_of(const Diagnosis& d) {
  std::vector<std::string> ids;
  for (const FoundEffect& found : d.effects) ids.push_back(found.id);
  std::sort(ids.begin(), ids.end());
  return ids;
}

/// The recordings of a case as a diagnosis would use them.
inline Result<CheckedRuns> checked(const proof::Case& one) {
  const auto machine = physics::machine_from_json(one.machine, one.name);
  EXPECT_TRUE(machine.has_value());
  return checked_runs(*machine, one.recordings);
}

inline bool says(const Diagnosis& d, const std::string& id) {
  return std::any_of(d.sentences.begin(), d.sentences.end(), [&](const auto& sentence) { return sentence.id == id; });
}

}  // namespace zerodrift::diagnosis
