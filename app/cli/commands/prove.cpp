// prove [--cases N] [--seed N] --out DIR: the blind trial on concealed physics, with its report.

#include <fmt/format.h>

#include <QApplication>
#include <random>

#include "app/cli/command.h"
#include "app/machine/hidden_effect.h"
#include "app/proof/proof_report.h"
#include "app/proof/trial.h"
#include "app/reporting/writers.h"

namespace zerodrift::cli {
namespace prove_command {

struct ProveArguments {
  int cases = 300;
  std::optional<std::uint64_t> seed;
  std::string out;
  std::string kind;
  std::string strength = std::string(proof::name_of(proof::StrengthRule::shown));
  int experiments = 0;
};

std::vector<std::string> hideable() {
  std::vector<std::string> names = {"none", "single", "pair", "unlisted"};
  for (const auto& effect : machine::concealable_effects()) names.emplace_back(effect.id);
  for (const auto& effect : machine::unlisted_effects()) names.emplace_back(effect.id);
  return names;
}

Result<CommandOutput> run_prove(const ProveArguments& arguments, const TaskContext& context) {
  proof::TrialOptions options;
  options.cases = arguments.cases;
  // Without a seed nobody, not even who tunes the diagnosis, has seen these cases before.
  options.seed = arguments.seed ? *arguments.seed : std::random_device{}();
  options.folder = arguments.out;
  options.kind = arguments.kind;
  options.strength = *proof::strength_rule_from(arguments.strength);
  ZD_TRY(const proof::Trial trial, proof::run_trial(options, context));
  context.progress(0.99, "report");
  std::optional<proof::ExperimentTrial> experiments;
  if (arguments.experiments > 0) {
    ZD_TRY(experiments, proof::run_experiments({arguments.experiments, options.seed, options.folder}, context));
  }
  CommandOutput output;
  if (qobject_cast<QApplication*>(QCoreApplication::instance()) != nullptr) {
    const report::Report report = proof::report_of(trial, experiments);
    ZD_CHECK(reporting::write_report(report, options.folder / "report.html"));
    ZD_CHECK(reporting::write_report(report, options.folder / "report.pdf"));
  } else {
    output.warnings.emplace_back("this program was started without fonts: the report is result.json alone");
  }
  output.json = trial.to_json();
  if (experiments) output.json["experiments"] = experiments->to_json();
  output.text = trial.score.text() + (experiments ? experiments->text() : "") +
                fmt::format("seed {}, promises kept {} of {}, in {}", options.seed, trial.seals_kept, options.cases,
                            options.folder.string());
  return output;
}

}  // namespace prove_command

void add_prove(Cli& cli) {
  using namespace prove_command;
  auto arguments = std::make_shared<ProveArguments>();
  CLI::App* command = cli.add("prove", "Blind trial: concealed physics, sealed answers, diagnosis, score and report",
                              [arguments](const TaskContext& context) { return run_prove(*arguments, context); });
  command->add_option("--cases", arguments->cases, "How many cases")->check(CLI::Range(1, 100000));
  command->add_option("--seed", arguments->seed, "Seed of the cases; without it nobody knows them")
      ->check(CLI::NonNegativeNumber);
  command
      ->add_option("--hide", arguments->kind,
                   "What every case hides: an effect's id, none, pair or unlisted; without it a mixture")
      ->check(CLI::IsMember(hideable()));
  command
      ->add_option(
          "--strength", arguments->strength,
          "How strong hidden effects are: a change of 2.5 noise widths at least (raw), of which half a width is "
          "left after a re-fit without them (shown), or all of it (left)")
      ->capture_default_str()
      ->check(CLI::IsMember({"raw", "shown", "left"}));
  command
      ->add_option("--experiments", arguments->experiments,
                   "Ambiguous cases on which the proposed run is tried against a random one")
      ->check(CLI::NonNegativeNumber);
  command->add_option("--out", arguments->out, "Folder for cases, seals, answers and report")->required();
}

}  // namespace zerodrift::cli
