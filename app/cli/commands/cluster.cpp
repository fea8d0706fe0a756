// cluster: groups the sensors of a recording and names the thermally sensitive point of each group.

#include <fmt/format.h>

#include <charconv>

#include "app/cli/recording_input.h"
#include "core/analysis/clustering.h"
#include "core/base/json.h"
#include "core/commissioning/job.h"
#include "core/flow/flow.h"
#include "core/flow/steps/sensors_step.h"

namespace zerodrift::cli {
namespace cluster_command {

struct Options {
  std::string recording;
  std::string map;
  std::string job;
  std::string clusters = "5";
  std::string errors;
  std::string distance = "raw";
  std::string sum = "auto";
  std::uint64_t seed = 1;
  std::string out;
};

/// 0 stands for auto. The default of five is lowered by the analysis's caller when there are fewer sensors.
Result<int> cluster_count(const std::string& text) {
  if (text == "auto") return 0;
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc{} || end != text.data() + text.size() || count < 1) {
    return fail(ErrorCode::bad_argument,
                {{"what", "--clusters"}, {"found", text}, {"expected", "a number from 1 up, or auto"}});
  }
  return count;
}

std::string text_of(const analysis::ClusterAnalysis& result) {
  std::string text =
      fmt::format("{} sensors, {} clusters ({} distance), seeded at {}\n", result.sensors.size(),
                  result.sensitive_points.size(), analysis::name_of(result.distance), result.seed_sensor);
  for (std::size_t k = 0; k < result.sensitive_points.size(); ++k) {
    text += fmt::format("cluster {}: sensitive point {}, sensors", k + 1, result.sensitive_points[k]);
    for (const auto& facts : result.sensors) {
      if (facts.cluster == static_cast<int>(k)) text += " " + facts.sensor;
    }
    text += "\n";
  }
  text += fmt::format("sum of correlations: {} ({})\n", result.absolute_criterion ? "absolute" : "signed",
                      result.criterion_reason);
  text += fmt::format("suggested number of clusters: {} by silhouette, {} by gap; stability {:.2f}",
                      result.suggestion.by_silhouette, result.suggestion.by_gap, result.stability);
  return text;
}

/// Keeps the choice of sensors in the job, with the same number of clusters.
Status keep_in_job(const Options& options, int clusters, const TaskContext& context) {
  ZD_TRY(auto job, commissioning::Job::open(options.job));
  const auto choose = [clusters](commissioning::Job& in, const TaskContext& inner) {
    return flow::choose_sensors(in, {clusters, {}}, inner);
  };
  return flow::Flow().perform(job, "sensors", choose, context).map([](const auto&) {});
}

Result<recording::Recording> recording_of(const Options& options, std::vector<std::string>& warnings) {
  if (options.job.empty()) return recording_from(options.recording, options.map, warnings);
  ZD_TRY(const auto job, commissioning::Job::open_read_only(options.job));
  return run_in_job(job);
}

Result<CommandOutput> run(const Options& options, bool clusters_given, const TaskContext& context) {
  analysis::ClusterOptions how;
  ZD_TRY(how.clusters, cluster_count(options.clusters));
  how.errors = names_from(options.errors);
  how.seed = options.seed;
  how.distance = options.distance == "raw"    ? analysis::Distance::raw
                 : options.distance == "rise" ? analysis::Distance::rise
                                              : analysis::Distance::standardised;
  how.criterion = options.sum == "auto"     ? analysis::SumCriterion::automatic
                  : options.sum == "signed" ? analysis::SumCriterion::signed_sum
                                            : analysis::SumCriterion::absolute_sum;
  CommandOutput output;
  ZD_TRY(const recording::Recording recording, recording_of(options, output.warnings));
  auto result = analysis::cluster(recording, how, context);
  if (!result && !clusters_given && result.error().code == ErrorCode::bad_argument) {
    how.clusters = 0;  // fewer sensors than the default of five
    result = analysis::cluster(recording, how, context);
  }
  if (!result) return fail(std::move(result).error().with("file", recording.name));
  output.json = analysis::to_json(*result);
  output.text = text_of(*result);
  for (const auto& finding : result->findings) output.warnings.push_back(analysis::describe(finding));
  ZD_CHECK(write_json_file(options.out, output.json));
  if (!options.job.empty()) ZD_CHECK(keep_in_job(options, how.clusters, context));
  return output;
}

}  // namespace cluster_command

void add_cluster(Cli& cli) {
  using namespace cluster_command;
  auto options = std::make_shared<Options>();
  auto command = std::make_shared<CLI::App*>(nullptr);
  *command = cli.add("cluster", "Group the sensors of a recording and name the thermally sensitive points",
                     [options, command](const TaskContext& context) {
                       return run(*options, (*command)->count("--clusters") > 0, context);
                     });
  CLI::App& app = **command;
  app.add_option("--recording", options->recording, "Recording (CSV) with temperatures and errors");
  app.add_option("--job", options->job, "Job whose run is taken instead; the choice of sensors is kept in it");
  app.parse_complete_callback([options] {
    if (options->recording.empty() == options->job.empty()) {
      throw CLI::RequiredError("--recording or --job: one of them");
    }
  });
  add_map_option(app, options->map);
  app.add_option("--clusters", options->clusters, "Number of clusters, or auto")
      ->check([](const std::string& text) {
        return cluster_count(text) ? std::string() : text + " is no number from 1 up, nor auto";
      })
      ->capture_default_str();
  app.add_option("--errors", options->errors, "Errors to correlate with, for example dX_um,dY_um,dZ_um (default: all)")
      ->check(names_with_commas());
  app.add_option("--distance", options->distance, "raw (as published), rise over the first sample, or standardised")
      ->check(CLI::IsMember({"raw", "rise", "standardised"}))
      ->capture_default_str();
  app.add_option("--sum", options->sum, "Sum of correlations: signed (as published), absolute, or auto")
      ->check(CLI::IsMember({"auto", "signed", "absolute"}))
      ->capture_default_str();
  app.add_option("--seed", options->seed, "Seed of the roulette")->check(CLI::NonNegativeNumber)->capture_default_str();
  app.add_option("--out", options->out, "clusters.json to write")->required();
}

}  // namespace zerodrift::cli
