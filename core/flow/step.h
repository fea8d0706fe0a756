#pragma once
// A step of a commissioning: which artefacts it needs and which one it makes. Its work is a function of the job; what a
// person has chosen for it is bound into the function.

#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/base/result.h"
#include "core/base/task_context.h"
#include "core/commissioning/artefact.h"

namespace zerodrift::commissioning {
class Job;
}

namespace zerodrift::flow {

struct StepInfo {
  std::string id;                  // "fit"
  std::string title_key;           // for app/text
  std::vector<std::string> needs;  // kinds without which it is blocked
  std::vector<std::string> uses;   // kinds it takes in when they are there
  std::string makes;               // kind
  bool branch = false;             // beside the main line: the job is complete without it
  bool controller = false;         // reads from a controller or writes to one: not needed in a job from files only
  bool errors = false;             // is about the errors of the warm-up run: not needed where the run holds none
};

/// machine, calibrate, warmup, sensors, fit, physics, upload, verify, report; recordings, describe and axis as
/// branches. Every step stands after those it needs.
std::span<const StepInfo> standard_steps();
/// Null when there is no such step.
const StepInfo* find_step(std::string_view id);

using StepRun = std::function<Result<commissioning::NewArtefact>(commissioning::Job&, const TaskContext&)>;

}  // namespace zerodrift::flow
