#include "app/proof/experiments.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/proof/concealed_case.h"
#include "app/proof/diagnose_files.h"
#include "core/base/json.h"
#include "core/base/noise.h"
#include "core/recording/csv.h"

namespace zerodrift::proof {
namespace {

using machine::CaseStep;
using nlohmann::json;
namespace fs = std::filesystem;

constexpr int most_draws_per_case = 8;
constexpr double top_speed_rpm = 8000.0;

std::vector<CaseStep> steps_of(const json& plan) {
  std::vector<CaseStep> steps;
  for (const auto& step : plan.at("steps")) {
    steps.push_back({step.at("duration_s").get<double>() / 60.0, step.value("spindle_rpm", 0.0),
                     step.value("coolant_on", false), step.value("spindle_load_W", 0.0)});
  }
  return steps;
}

double minutes_of(const std::vector<CaseStep>& steps) {
  double sum = 0.0;
  for (const auto& step : steps) sum += step.minutes;
  return sum;
}

/// What somebody without advice would run for as long: two to six parts at some speeds, coolant now and then.
std::vector<CaseStep> random_steps(double minutes, Noise& noise) {
  const double whole = minutes;
  std::vector<CaseStep> steps;
  while (minutes > 0.5) {
    const double part = std::min(minutes, std::round(noise.uniform(whole / 6.0, whole / 2.0)));
    const double speed = std::round(noise.uniform(0.0, 1.0) * top_speed_rpm / 50.0) * 50.0;
    steps.push_back({part, speed, noise.uniform() < 0.3, 0.0});
    minutes -= part;
  }
  return steps;
}

bool is_named(const json& list, const std::string& id) {
  return std::any_of(list.begin(), list.end(), [&](const json& one) { return one.at("id") == id; });
}

/// A heat that is always there goes by two names.
bool is_right(const std::string& id, const std::string& truth) {
  return id == truth || (truth == "standing_heat" && id == "extra_heat_source");
}

std::string words_of(const json& diagnosis) {
  std::string text = diagnosis.at("verdict").get<std::string>() == "missing_effect" ? "" : diagnosis.at("verdict");
  if (text.empty()) {
    for (const auto& effect : diagnosis.at("effects")) {
      text += (text.empty() ? "" : "+") + effect.at("id").get<std::string>();
    }
  }
  std::string rivals;
  for (const auto& rival : diagnosis.at("ambiguous_with")) {
    rivals += (rivals.empty() ? "" : ", ") + rival.at("id").get<std::string>();
  }
  return rivals.empty() ? text : text + " (" + rivals + ")";
}

class Experimenter {
 public:
  Experimenter(const ExperimentOptions& options, const TaskContext& context) : m_options(options), m_context(context) {}

  Result<ExperimentTrial> run() {
    const auto start = std::chrono::steady_clock::now();
    m_trial.options = m_options;
    const int most = m_options.cases * most_draws_per_case;
    for (; m_trial.drawn < most && static_cast<int>(m_trial.cases.size()) < m_options.cases; ++m_trial.drawn) {
      if (m_context.cancelled()) return fail(ErrorCode::cancelled);
      ZD_CHECK(try_case(m_trial.drawn));
      const double share = static_cast<double>(m_trial.cases.size()) / m_options.cases;
      const double used_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
      m_context.progress(share, "experiments",
                         share > 0 ? std::optional<double>(used_s * (1.0 - share) / share) : std::nullopt);
    }
    ZD_CHECK(write_json_file(m_options.folder / "experiments.json", m_trial.to_json()));
    return std::move(m_trial);
  }

 private:
  /// A warm-up at one speed, as shops run it: where rivals are left, an experiment is asked for.
  Status try_case(int index) {
    ConcealedCase one = draw_case(m_options.seed + 500000, index, "single", true);
    const fs::path folder = m_options.folder / "experiments" / one.name;
    ZD_CHECK(write_case_files(one, folder));
    const auto first = diagnose_files(folder, {"recording.csv"}, "diagnosis.json", m_context);
    if (!first) return {};  // refused: nothing to decide
    const json experiment = first->at("suggested_experiment");
    if (!experiment.is_object() || !experiment.at("plan").is_object() || first->at("ambiguous_with").empty()) return {};
    ExperimentCase made;
    made.name = one.name;
    made.truth = one.truth.words();
    made.first_answer = words_of(*first);
    made.plan = experiment.at("plan").value("name", "");
    for (const auto& rival : first->at("ambiguous_with")) made.rivals.push_back(rival.at("id"));
    for (const auto& effect : first->at("effects")) made.rivals.push_back(effect.at("id"));
    std::erase_if(made.rivals, [&](const std::string& id) { return is_right(id, made.truth); });
    made.first_right = !first->at("effects").empty() && is_right(first->at("effects").front().at("id"), made.truth);
    const auto proposed = steps_of(experiment.at("plan"));
    made.hours = minutes_of(proposed) / 60.0;
    Noise noise(m_options.seed * 77ULL + static_cast<std::uint64_t>(index));
    ZD_CHECK(again(one, folder, "with-plan", proposed, made, made.after_plan, made.plan_resolves));
    ZD_CHECK(again(one, folder, "with-random", random_steps(minutes_of(proposed), noise), made, made.after_random,
                   made.random_resolves));
    m_trial.cases.push_back(std::move(made));
    return {};
  }

  Status again(const ConcealedCase& one, const fs::path& folder, const std::string& name,
               const std::vector<CaseStep>& steps, const ExperimentCase& made, std::string& words, bool& resolved) {
    machine::CaseOptions run = one.run;
    run.after_rest = steps;
    ZD_CHECK(recording::write_recording(folder / (name + ".csv"), recording_of(one, run)));
    const auto both = diagnose_files(folder, {name + ".csv"}, name + ".json", m_context);
    if (!both) {
      if (both.error().code == ErrorCode::cancelled) return fail(both.error());
      words = "refused: " + describe(both.error());
      return {};
    }
    words = words_of(*both);
    const json& effects = both->at("effects");
    resolved =
        both->at("verdict") == "missing_effect" && !effects.empty() && is_right(effects.front().at("id"), made.truth);
    for (const auto& rival : made.rivals) {
      resolved = resolved && !is_named(both->at("ambiguous_with"), rival) && !is_named(effects, rival);
    }
    return {};
  }

  const ExperimentOptions& m_options;
  const TaskContext& m_context;
  ExperimentTrial m_trial;
};

}  // namespace

Result<ExperimentTrial> run_experiments(const ExperimentOptions& options, const TaskContext& context) {
  return Experimenter(options, context).run();
}

int ExperimentTrial::resolved_by_plan() const {
  return static_cast<int>(std::count_if(cases.begin(), cases.end(), [](const auto& c) { return c.plan_resolves; }));
}

int ExperimentTrial::resolved_by_random() const {
  return static_cast<int>(std::count_if(cases.begin(), cases.end(), [](const auto& c) { return c.random_resolves; }));
}

json ExperimentTrial::to_json() const {
  json list = json::array();
  for (const auto& one : cases) {
    list.push_back({{"case", one.name},
                    {"hidden", one.truth},
                    {"first_answer", one.first_answer},
                    {"plan", one.plan},
                    {"hours", one.hours},
                    {"with_plan", one.after_plan},
                    {"plan_resolves", one.plan_resolves},
                    {"with_random", one.after_random},
                    {"random_resolves", one.random_resolves}});
  }
  return {{"drawn", drawn},
          {"ambiguous", cases.size()},
          {"resolved_by_plan", resolved_by_plan()},
          {"resolved_by_random", resolved_by_random()},
          {"cases", list}};
}

std::string ExperimentTrial::text() const {
  std::string out = fmt::format(
      "experiments: {} ambiguous of {} drawn; rivals resolved by the proposed run {}/{} (must: 90 %), by a random run "
      "of "
      "the same length {}/{}\n",
      cases.size(), drawn, resolved_by_plan(), cases.size(), resolved_by_random(), cases.size());
  for (const auto& one : cases) {
    out +=
        fmt::format("  {:<20} {:<44} {:<16} {} {:<40} | random {} {}\n", one.truth, one.first_answer, one.plan,
                    one.plan_resolves ? "+" : "-", one.after_plan, one.random_resolves ? "+" : "-", one.after_random);
  }
  return out;
}

report::Section experiments_section(const ExperimentTrial& trial) {
  report::Section section{"experiments", "Does the proposed run decide between rivals?", {}};
  section.blocks.emplace_back(report::Text{fmt::format(
      "{} machines with one hidden effect were warmed up at one speed; in {} of them rivals were left and a run was "
      "proposed. It was run on the same machine after a night of rest, and both runs together were diagnosed. The "
      "hidden effect was then named first without any of its rivals in {} of {} cases (must: 90 %); after a random run "
      "of the same length in {}.",
      trial.drawn, trial.cases.size(), trial.resolved_by_plan(), trial.cases.size(), trial.resolved_by_random())});
  report::Table table;
  table.id = "experiments_table";
  table.header = {"hidden", "first answer (rivals)", "proposed run", "with it", "", "with a random run", ""};
  for (const auto& one : trial.cases) {
    table.rows.push_back({one.truth, one.first_answer, one.plan, one.after_plan,
                          one.plan_resolves ? "resolved" : "open", one.after_random,
                          one.random_resolves ? "resolved" : "open"});
  }
  section.blocks.emplace_back(std::move(table));
  return section;
}

}  // namespace zerodrift::proof
