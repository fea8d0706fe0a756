#pragma once
// Proof of the proposed run (P7): over cases whose first recording leaves rivals, the proposed plan is run on the same
// concealed machine after a night of rest, and both runs together are diagnosed; beside it a random plan of the same
// length. Resolved: the effect hidden is named first and none of the former rivals is left.

#include <filesystem>

#include "core/base/result.h"
#include "core/base/task_context.h"
#include "core/report/report.h"

namespace zerodrift::proof {

struct ExperimentOptions {
  int cases = 30;  // ambiguous ones; at most eight times as many are drawn to find them
  std::uint64_t seed = 1;
  std::filesystem::path folder;
};

struct ExperimentCase {
  std::string name, truth, first_answer, plan;
  std::vector<std::string> rivals;
  double hours = 0.0;
  std::string after_plan, after_random;  // answers with rivals left in brackets
  bool first_right = false;
  bool plan_resolves = false;
  bool random_resolves = false;
};

struct ExperimentTrial {
  ExperimentOptions options;
  int drawn = 0;
  std::vector<ExperimentCase> cases;

  int resolved_by_plan() const;
  int resolved_by_random() const;
  nlohmann::json to_json() const;
  std::string text() const;
};

Result<ExperimentTrial> run_experiments(const ExperimentOptions& options, const TaskContext& context);
report::Section experiments_section(const ExperimentTrial& trial);

}  // namespace zerodrift::proof
