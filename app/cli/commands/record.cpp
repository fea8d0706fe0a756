// record: the warm-up run into a job; goes on with one that was broken off. A new job gets its machine check and its
// camera calibration first, as the run cannot do without.

#include <fmt/format.h>

#include "app/cli/access.h"
#include "app/cli/job_file.h"
#include "app/cli/operator.h"
#include "core/acquisition/plan.h"
#include "core/base/json.h"
#include "core/commissioning/job.h"
#include "core/controller/profile.h"
#include "core/flow/flow.h"
#include "core/flow/steps/calibrate_step.h"
#include "core/flow/steps/machine_step.h"
#include "core/flow/steps/warmup_step.h"

namespace zerodrift::cli {
namespace record_command {

using commissioning::Job;
using commissioning::NewArtefact;
using nlohmann::json;

struct Options {
  std::string profile;
  std::string plan;
  std::string job;
  std::string person;
};

/// Does the step unless the job has what it makes.
Status ensure(Job& job, const std::string& id, const TaskContext& context,
              const std::function<Result<NewArtefact>(const TaskContext&)>& work) {
  const flow::StepStatus status = flow::status_of(job, id);
  if (status.artefact != 0) return {};
  const auto run = [&](const Job&, const TaskContext& inner) { return work(inner); };
  ZD_CHECK(flow::Flow().perform(job, id, run, context));
  return {};
}

Result<CommandOutput> run(const Options& options, const PinOption& pin, const TaskContext& context) {
  CommandOutput output;
  ZD_TRY(const json profile_document, read_json_file(options.profile));
  ZD_TRY(const auto profile, controller::profile_from_json(profile_document, options.profile, &output.warnings));
  flow::RunOptions run_options;
  ZD_TRY(const auto plan, acquisition::read_plan(options.plan, &output.warnings));
  ZD_TRY(run_options.plan, acquisition::with_measuring_position(plan, profile.measure_position_mm));
  ZD_TRY(auto person, operator_of(profile, options.person));
  ZD_TRY(const auto permit, engineer(pin, "A recorded run"));
  ZD_TRY(JobFile file, JobFile::open_or_create(options.job));
  Job& job = file.job();
  ZD_TRY(flow::Devices devices, flow::Devices::open(profile, true, permit, std::move(person)));
  ZD_CHECK(ensure(job, "machine", context,
                  [&](const TaskContext& inner) { return flow::check_machine(devices, profile_document, inner); }));
  ZD_CHECK(ensure(job, "calibrate", context,
                  [&](const TaskContext& inner) { return flow::calibrate(job, devices, {}, inner); }));
  const auto record = [&](const Job&, const TaskContext& inner) {
    return flow::record_warmup(job, devices, run_options, inner);
  };
  ZD_TRY(const auto made, flow::Flow().perform(job, "warmup", record, context));
  ZD_TRY(output.json, made.document());
  output.json["job"] = options.job;
  output.text = fmt::format("{}: {} rows in {:.0f} s, {} measurements ({} refused), {} samples lost, {} gaps",
                            options.job, output.json.value("rows", 0), output.json.value("duration_s", 0.0),
                            output.json.value("measurements", 0), output.json.value("refused", 0),
                            output.json.value("lost_samples", 0), output.json.value("gaps", 0));
  for (const json& problem : output.json.value("problems", json::array())) {
    if (problem.is_string()) output.warnings.push_back(problem.get<std::string>());
  }
  // Faults of the link and of the devices are among the problems.
  if (devices.link != nullptr) {
    const auto& remarks = devices.link->health().remarks;
    output.warnings.insert(output.warnings.end(), remarks.begin(), remarks.end());
  }
  return output;
}

}  // namespace record_command

void add_record(Cli& cli) {
  using namespace record_command;
  auto options = std::make_shared<Options>();
  auto pin = std::make_shared<std::shared_ptr<PinOption>>();
  CLI::App* app = cli.add("record", "Record the warm-up run into a job, or go on with one that was broken off",
                          [options, pin](const TaskContext& context) { return run(*options, **pin, context); });
  *pin = add_pin_option(*app);
  app->add_option("--profile", options->profile, "Connection profile of the machine")->required();
  app->add_option("--plan", options->plan, "Warm-up plan; an interrupted run keeps the plan it was begun with")
      ->required();
  app->add_option("--job", options->job, "Job file (.zdj), made if it is not there")->required();
  add_operator_option(*app, options->person);
}

}  // namespace zerodrift::cli
