// zerodrift-cli verify: the compensated run, what is left, and the correction it asks for.

#include <fmt/format.h>

#include "app/cli/access.h"
#include "app/cli/consent.h"
#include "app/cli/operator.h"
#include "core/acquisition/plan.h"
#include "core/commissioning/job.h"
#include "core/controller/profile.h"
#include "core/flow/flow.h"
#include "core/flow/steps/upload_step.h"
#include "core/flow/steps/verify_step.h"

namespace zerodrift::cli {
namespace verify_command {

struct Options {
  std::string profile;
  std::string job;
  std::string plan;
  std::string person;
  double limit_um = 5.0;
  bool correct = false;
  bool yes = false;
};

Status apply_correction(commissioning::Job& job, flow::Devices& devices, const commissioning::Artefact& verification,
                        const flow::Consent& consent, const TaskContext& context) {
  ZD_TRY(const auto table, flow::corrected_table(verification));
  if (!table) return {};
  const auto write = [&](commissioning::Job& in, const TaskContext& inner) {
    flow::UploadStepOptions options;
    options.table = table;
    options.sign_check = false;
    options.consent = consent;
    return flow::upload(in, devices, options, inner);
  };
  return flow::Flow().perform(job, "upload", write, context).map([](const auto&) {});
}

Result<CommandOutput> run(const Options& options, const PinOption& pin, const TaskContext& context) {
  CommandOutput output;
  ZD_TRY(const auto profile, controller::read_profile(options.profile, &output.warnings));
  ZD_TRY(auto job, commissioning::Job::open(options.job));
  flow::VerifyOptions verify_options;
  verify_options.limit_um = options.limit_um;
  if (!options.plan.empty()) {
    ZD_TRY(verify_options.run.plan, acquisition::read_plan(options.plan, &output.warnings));
  }
  ZD_TRY(const auto permit, engineer(pin, "A verification"));
  const flow::Consent consent = consent_of(options.yes);
  if (options.correct) ZD_CHECK(consent.possible("Writing the corrected table"));  // not after an hour of measuring
  ZD_TRY(auto person, operator_of(profile, options.person));
  ZD_TRY(auto devices, flow::Devices::open(profile, true, permit, std::move(person)));
  const auto verify = [&](commissioning::Job& in, const TaskContext& inner) {
    return flow::verify(in, devices, verify_options, inner);
  };
  ZD_TRY(const auto artefact, flow::Flow().perform(job, "verify", verify, context));
  ZD_TRY(output.json, artefact.document());
  output.json.erase("plan");
  const auto peaks = output.json.value("peak_error_after_um", nlohmann::json::object());
  for (const auto& [direction, peak] : peaks.items()) {
    output.text += fmt::format("{}: largest error left {:.2f} um, rms {:.2f} um\n", direction, peak.get<double>(),
                               output.json["rms_error_after_um"].value(direction, 0.0));
  }
  output.text += "verdict: " + output.json.at("verdict").get<std::string>();
  for (const auto& axis : output.json.value("correction", nlohmann::json::array())) {
    output.text += fmt::format("\n{}: kappa {:.3f}, {}", axis.value("axis", ""), axis.value("kappa", 1.0),
                               axis.value("reason", ""));
  }
  if (options.correct) ZD_CHECK(apply_correction(job, devices, artefact, consent, context));
  return output;
}

}  // namespace verify_command

void add_verify(Cli& cli) {
  using namespace verify_command;
  auto options = std::make_shared<Options>();
  auto pin = std::make_shared<std::shared_ptr<PinOption>>();
  auto* command = cli.add("verify", "Run with the compensation on and measure what is left",
                          [options, pin](const TaskContext& context) { return run(*options, **pin, context); });
  *pin = add_pin_option(*command);
  command->add_option("--profile", options->profile, "Connection profile of the machine")->required();
  command->add_option("--job", options->job, "Job file")->required();
  command->add_option("--plan", options->plan, "Plan of the run; else the warm-up's speeds in another order");
  command->add_option("--limit-um", options->limit_um, "Largest error that may be left")->check(CLI::PositiveNumber);
  command->add_flag("--correct", options->correct,
                    "Upload the corrected table when too much is left, after a question or with --yes");
  command->add_flag("--yes", options->yes, "Confirm the upload of a corrected table");
  add_operator_option(*command, options->person);
}

}  // namespace zerodrift::cli
