// zerodrift-cli commission: the whole job, start to end, without a display.

#include "core/flow/commission.h"

#include <fmt/format.h>
#include <unistd.h>

#include "app/cli/access.h"
#include "app/cli/consent.h"
#include "app/cli/job_file.h"
#include "app/cli/operator.h"
#include "app/cli/report_files.h"
#include "app/cli/typed.h"
#include "core/acquisition/plan.h"
#include "core/base/json.h"
#include "core/commissioning/job.h"
#include "core/controller/profile.h"

namespace zerodrift::cli {
namespace commission_command {

struct Options {
  std::string profile;
  std::string plan;
  std::string job;
  std::string report;
  double limit_um = 5.0;
  bool yes = false;
  bool small = false;
  std::string engineer;
  std::string customer;
  std::string language = "en";
  std::string person;
};

/// Who did it stands in every entry of the job: given, asked for at a terminal, or missing, which the report says.
Status name_people(commissioning::Job& job, const Options& options) {
  ZD_TRY(auto header, job.header());
  if (!options.customer.empty()) header.customer = options.customer;
  if (!options.engineer.empty()) header.engineer = options.engineer;
  if (header.engineer.empty() && ::isatty(STDIN_FILENO) != 0) {
    ZD_TRY(const auto name, typed_line("Engineer (your name, for the report): "));
    header.engineer = name.value_or("");
  }
  return job.set_header(header);
}

nlohmann::json answer_of(const flow::CommissionResult& result) {
  const auto& v = result.verification;
  return {{"peak_error_before_um", v.at("peak_error_before_um")}, {"peak_error_after_um", v.at("peak_error_after_um")},
          {"rms_error_after_um", v.at("rms_error_after_um")},     {"sensors", result.sensors.at("chosen")},
          {"table_version", result.upload.at("version")},         {"verdict", v.at("verdict")},
          {"verification_machine_time_s", v.at("machine_time_s")}};
}

std::string text_of(const nlohmann::json& answer) {
  std::string text;
  for (const auto& [direction, after] : answer.at("peak_error_after_um").items()) {
    const auto& before = answer.at("peak_error_before_um");
    text += fmt::format("{}: largest error {:.1f} um before, {:.1f} um after\n", direction,
                        before.value(direction, 0.0), after.get<double>());
  }
  return text + "verdict: " + answer.at("verdict").get<std::string>();
}

Result<CommandOutput> run(const Options& options, const PinOption& pin, const TaskContext& context) {
  CommandOutput output;
  ZD_CHECK(check_report_name(options.report));
  ZD_TRY(const auto language, report::language_from(options.language));
  ZD_TRY(const auto profile, controller::read_profile(options.profile, &output.warnings));
  ZD_TRY(const auto document, read_json_file(options.profile));
  flow::CommissionOptions commission_options;
  ZD_TRY(commission_options.plan, acquisition::read_plan(options.plan, &output.warnings));
  commission_options.limit_um = options.limit_um;
  commission_options.keep_views = !options.small;
  commission_options.consent = consent_of(options.yes);
  ZD_TRY(commission_options.permit, engineer(pin, "A commissioning"));
  ZD_CHECK(commission_options.consent.possible("A commissioning"));
  ZD_TRY(commission_options.person, operator_of(profile, options.person));
  ZD_TRY(JobFile file, JobFile::open_or_create(options.job));
  auto& job = file.job();
  ZD_CHECK(name_people(job, options));
  ZD_TRY(const auto result, flow::commission(job, profile, document, commission_options, context));
  context.progress(0.99, "report");
  ZD_CHECK(write_job_report(job, options.report, language));
  if (auto warning = nobody_named(job); !warning.empty()) output.warnings.push_back(std::move(warning));
  output.json = answer_of(result);
  output.text = text_of(output.json) + "\nreport: " + options.report;
  return output;
}

}  // namespace commission_command

void add_commission(Cli& cli) {
  using namespace commission_command;
  auto options = std::make_shared<Options>();
  auto pin = std::make_shared<std::shared_ptr<PinOption>>();
  auto* command = cli.add("commission", "Everything, start to end: calibrate, record, fit, upload, verify, report",
                          [options, pin](const TaskContext& context) { return run(*options, **pin, context); });
  *pin = add_pin_option(*command);
  command->add_option("--profile", options->profile, "Connection profile of the machine")->required();
  command->add_option("--plan", options->plan, "Warm-up plan")->required();
  command->add_option("--job", options->job, "Job file; a commissioning that was broken off goes on")->required();
  command->add_option("--report", options->report, "Report to write: .pdf, .html or .csv")->required();
  command->add_option("--limit-um", options->limit_um, "Largest error that may be left")->check(CLI::PositiveNumber);
  command->add_flag("--small", options->small,
                    "Keep no pictures of the calibration's positions: the job is a fifth as large");
  command->add_option("--engineer", options->engineer, "Who does the work; stands in the job and the report");
  command->add_option("--customer", options->customer, "For whom; stands in the report");
  command->add_option("--language", options->language, "Language of the report: en or zh");
  command->add_flag("--yes", options->yes,
                    "Do not ask before something is written; without a terminal nothing is without it");
  add_operator_option(*command, options->person);
}

}  // namespace zerodrift::cli
