#include "core/analysis/fit.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "core/analysis/budget.h"
#include "core/analysis/checked.h"
#include "core/analysis/clustering.h"
#include "core/analysis/evaluate.h"
#include "core/analysis/sensor_choice.h"
#include "core/analysis/training.h"

namespace zerodrift::analysis {
namespace {

/// A simpler model wins unless its error on left-out cycles is worse by more than this.
constexpr double margin = 1.10;

struct Trial {
  Recipe recipe;
  Evaluation evaluation;
  Candidate summary;
};

/// The sensitive points of the first run, as published; none when it cannot be clustered.
std::vector<std::string> sensitive_points(const std::vector<recording::Recording>& recordings, const TrainingSet& set) {
  constexpr std::size_t published = 5;
  ClusterOptions options;
  options.clusters = static_cast<int>(std::min(published, set.sensors.size()));
  options.errors = set.errors;
  options.suggest = options.stability = false;
  auto clusters = cluster(recordings.front(), options);
  return clusters ? std::move(clusters->sensitive_points) : std::vector<std::string>{};
}

/// On more sensors than this the textbook's regression fits noise.
constexpr std::size_t most_for_mlr = 8;

/// What to try, from simple to complex: the order in which ties are broken.
struct Plan {
  std::vector<Recipe> recipes;
  SensorChoice sensors;  // how those of static models were chosen; without sets: by the caller
};

Result<Plan> plan_for(const FitOptions& options, const std::vector<recording::Recording>& recordings,
                      const TrainingSet& set, const TaskContext& context) {
  const bool any = options.method == Method::automatic;
  // One cycle cannot tell the answer to speed from the answer to time.
  const bool dynamic = any ? set.folds.cycles >= 2 : !is_static(options.method);
  Plan plan;
  std::vector<std::string> few = set.sensors;
  std::vector<std::string> many = set.sensors;
  if (options.sensors.empty()) {
    if (options.max_sensors > 0) {
      const auto order = spread_order(set, Method::dynamic);
      const auto most = std::min(static_cast<std::size_t>(options.max_sensors), order.size());
      many.assign(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(most));
    }
    if (any || is_static(options.method)) {
      ChoiceOptions choice;
      choice.most = static_cast<std::size_t>(options.max_sensors);
      choice.sensitive_points = sensitive_points(recordings, set);
      ZD_TRY(plan.sensors, choose_sensor_set(set, choice, context));
      few = plan.sensors.sets[plan.sensors.chosen].sensors;
    }
  }
  // Ridge first: on the controller it is as simple as the plain regression, and never worse for correlated sensors.
  // The other ways of shrinking answer the same question and are there to be asked for: with a few cycles the best of
  // many candidates is the luckiest (winner's curse).
  if (any) {
    std::vector<std::size_t> nested = plan.sensors.nested();
    if (!options.sensors.empty() && set.folds.cycles < 2) {  // chosen by hand or by the step before
      ZD_TRY(few, nearest_order(set));
      nested = averaged_counts(few.size());
    }
    plan.recipes.push_back(make_recipe(Method::ridge, few, set));
    plan.recipes.back().nested = std::move(nested);
    if (few.size() <= most_for_mlr) plan.recipes.push_back(make_recipe(Method::mlr, few, set));
  } else if (is_static(options.method)) {
    plan.recipes.push_back(make_recipe(options.method, few, set));
    if (options.method == Method::ridge) plan.recipes.back().nested = plan.sensors.nested();
  }
  if (dynamic) {
    if (!any) plan.recipes.push_back(make_recipe(Method::ridge, many, set));  // for the table
    plan.recipes.push_back(make_recipe(any ? Method::dynamic : options.method, many, set));
  }
  return plan;
}

Result<Trial> try_out(const TrainingSet& set, const Recipe& recipe, double coverage, const TaskContext& context) {
  Trial trial;
  trial.recipe = recipe;
  ZD_TRY(trial.evaluation, evaluate(set, recipe, coverage, context));
  Candidate& c = trial.summary;
  c.method = recipe.method;
  c.sensors = recipe.sensors;
  c.label = fmt::format("{} on {} sensors{}", name_of(recipe.method), recipe.sensors.size(),
                        is_static(recipe.method)           ? ""
                        : recipe.method == Method::physics ? " and the simulation"
                                                           : " and the inputs");
  c.held_out_rms_um = trial.evaluation.rms_um;
  c.held_out_peak_um = trial.evaluation.peak_um;
  c.noise_um = trial.evaluation.mean_noise_um;
  c.runs_on_controller = is_static(recipe.method);
  return trial;
}

/// `rank` false: one cycle, whose end says nothing about other speeds; then the first one allowed is taken.
const Trial* choose(const std::vector<Trial>& trials, Method method, bool static_only, bool rank) {
  const auto allowed = [&](const Trial& t) {
    if (static_only) return t.summary.runs_on_controller;
    return method == Method::automatic || t.recipe.method == method;
  };
  double best = std::numeric_limits<double>::infinity();
  for (const auto& t : trials) {
    if (allowed(t)) best = std::min(best, t.evaluation.expected_um);
  }
  for (const auto& t : trials) {
    if (allowed(t) && (!rank || t.evaluation.expected_um <= margin * best)) return &t;
  }
  return nullptr;
}

/// Among those that could have been taken.
std::string reason_for(const Trial& chosen, const std::vector<Trial>& trials, const FitOptions& options,
                       const TrainingSet& set) {
  const auto left = fmt::format("leaves {:.2f} um rms with {} left out", chosen.evaluation.rms_um, set.folds.in_words);
  if (options.method != Method::automatic) return fmt::format("{} as asked for; {}", chosen.summary.label, left);
  if (set.folds.cycles < 2) {
    return fmt::format("{} {}; one cycle cannot rank methods, so the one that shrinks what it cannot tell is taken",
                       chosen.summary.label, left);
  }
  const Trial* best = &chosen;
  for (const auto& t : trials) {
    const bool allowed = !options.on_controller || t.summary.runs_on_controller;
    if (allowed && t.evaluation.expected_um < best->evaluation.expected_um) best = &t;
  }
  const double expected_um = chosen.evaluation.expected_um;
  if (best == &chosen) {
    return fmt::format("{} {}; with the noise of its sensors {:.2f} um are to be expected, the least of all",
                       chosen.summary.label, left, expected_um);
  }
  const bool both_static = best->summary.runs_on_controller && chosen.summary.runs_on_controller;
  return fmt::format("{} {}; with the noise of their sensors {} is to leave {:.2f} um and this one {:.2f} um: {}",
                     chosen.summary.label, left, best->summary.label, best->evaluation.expected_um, expected_um,
                     both_static ? "not clearly worse, and steadier where the sensors rise together"
                                 : "not clearly worse, and simpler");
}

/// The final regression of one recipe on everything.
struct Fitted {
  std::vector<RidgeFit> regressions;
  std::vector<ResidualFigures> fit;
  std::vector<double> remembered_um;
};

Result<Fitted> fit_all(const TrainingSet& set, const Recipe& recipe) {
  ZD_TRY(const Eigen::MatrixXd x, design(set, recipe.features));
  Fitted out;
  const std::size_t errors = set.errors.size();
  out.regressions.resize(errors);
  out.fit.resize(errors);
  out.remembered_um.resize(errors);
  const int last_run = static_cast<int>(set.runs.size()) - 1;
  for (const auto& group : error_groups(set)) {
    Rows rows = rows_of(set, x, group.samples, group.errors.front());
    ZD_TRY(std::vector<RidgeFit> fits, fit_rows(rows, errors_at(set, group, group.samples), recipe, set));
    for (std::size_t g = 0; g < fits.size(); ++g) {
      const auto e = static_cast<std::size_t>(group.errors[g]);
      rows.y = rows_of(set, x, group.samples, group.errors[g]).y;
      out.fit[e] = residual_figures(rows.y, fits[g].predict(rows.x));
      if (!is_static(recipe.method)) {
        out.remembered_um[e] = remembered_um(fits[g], rows, set.runs.back().time_s.back(), last_run);
      }
      out.regressions[e] = std::move(fits[g]);
    }
  }
  return out;
}

Result<std::vector<TableTerms>> table_of(const TrainingSet& set, const Trial& trial) {
  ZD_TRY(const Fitted fitted, fit_all(set, trial.recipe));
  const std::vector<double> reference_C = start_references(set.runs.front(), trial.recipe.features);
  std::vector<TableTerms> out;
  for (std::size_t e = 0; e < set.errors.size(); ++e) {
    TableTerms terms;
    terms.error = set.errors[e];
    terms.offset_um = fitted.regressions[e].raw_intercept();
    const Eigen::VectorXd coefficients = fitted.regressions[e].raw_coefficients();
    for (std::size_t s = 0; s < trial.recipe.sensors.size(); ++s) {
      terms.terms.push_back({trial.recipe.sensors[s], coefficients(static_cast<Eigen::Index>(s)), reference_C[s]});
    }
    terms.fit = fitted.fit[e];
    terms.held_out = trial.evaluation.held_out[e];
    out.push_back(std::move(terms));
  }
  return out;
}

Domain domain_of(const TrainingSet& set, const std::vector<std::string>& sensors, bool with_inputs) {
  Domain domain;
  Eigen::Index total = 0;
  for (const auto& s : set.samples) total += static_cast<Eigen::Index>(s.time_s.size());
  Eigen::MatrixXd rise(total, static_cast<Eigen::Index>(sensors.size()));
  const auto specs = static_features(sensors);
  for (std::size_t c = 0; c < sensors.size(); ++c) {
    Eigen::Index at = 0;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (std::size_t r = 0; r < set.runs.size(); ++r) {
      const int column = set.runs[r].sensor(sensors[c]);
      const auto& t = set.samples[r].temperature_C;
      const double start_C = start_references(set.runs[r], {specs[c]})[0];
      rise.block(at, static_cast<Eigen::Index>(c), t.rows(), 1) = t.col(column).array() - start_C;
      low = std::min(low, set.smoothed_C[r].col(column).minCoeff());
      high = std::max(high, set.smoothed_C[r].col(column).maxCoeff());
      at += t.rows();
    }
    domain.channels.push_back(sensors[c]);
    domain.low.push_back(low);
    domain.high.push_back(high);
  }
  domain.mean = rise.colwise().mean().transpose();
  const Eigen::MatrixXd centred = rise.rowwise() - domain.mean.transpose();
  Eigen::MatrixXd covariance = centred.transpose() * centred / static_cast<double>(total);
  constexpr double noise_floor_K = 0.3;  // directions in which sensors differ by less than that carry no alarm
  covariance.diagonal().array() += noise_floor_K * noise_floor_K;
  domain.inverse = covariance.inverse();
  domain.limit = 1.2 * (centred * domain.inverse).cwiseProduct(centred).rowwise().sum().maxCoeff();
  if (!with_inputs) return domain;
  for (const auto& name : set.runs.front().inputs) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const auto& run : set.runs) {
      const int column = run.input_index(name);
      if (column < 0) continue;
      low = std::min(low, run.input.col(column).minCoeff());
      high = std::max(high, run.input.col(column).maxCoeff());
    }
    domain.channels.push_back(name);
    domain.low.push_back(low);
    domain.high.push_back(high);
  }
  return domain;
}

RunQuality quality_of(const TrainingSet& set, const std::vector<std::string>& sensors, const Domain& domain) {
  RunQuality q;
  q.cycles = set.folds.cycles;
  Eigen::MatrixXd columns(static_cast<Eigen::Index>(set.samples.front().time_s.size()),
                          static_cast<Eigen::Index>(sensors.size()));
  for (std::size_t c = 0; c < sensors.size(); ++c) {
    q.rise_K = std::max(q.rise_K, domain.high[c] - domain.low[c]);
    columns.col(static_cast<Eigen::Index>(c)) =
        set.samples.front().temperature_C.col(set.runs.front().sensor(sensors[c]));
  }
  q.condition_number = condition_number(columns);
  for (Eigen::Index e = 0; e < set.error_um.cols(); ++e) {
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    for (const double v : set.error_um.col(e)) {
      if (!std::isfinite(v)) continue;
      low = std::min(low, v);
      high = std::max(high, v);
    }
    q.error_range_um = std::max(q.error_range_um, high - low);
  }
  if (q.rise_K < 3.0) {
    q.advice.push_back(fmt::format("The warmest sensor rose by only {:.1f} K: run longer or faster.", q.rise_K));
  }
  if (q.cycles < 2) {
    q.advice.push_back("One speed only: a second stretch at another speed would allow a guaranteed band.");
  }
  if (q.condition_number > 100.0) {
    // Without the figure: the condition people are shown is the fitted model's, which the ridge has tamed.
    q.advice.push_back("The sensors rose nearly together: a stretch with the spindle at rest separates them.");
  }
  return q;
}

void add_findings(Model& model, const TrainingSet& set) {
  model.findings = set.findings;
  if (model.quality.rise_K < 1.0) {
    model.findings.push_back({FindingKind::weak_excitation, FindingAction::noted, "the machine",
                              fmt::format("largest rise {:.2f} K", model.quality.rise_K)});
  }
  if (model.quality.condition_number > 1000.0) {
    model.findings.push_back({FindingKind::ill_conditioned, FindingAction::noted, "the set of sensors",
                              fmt::format("condition number {:.0f}", model.quality.condition_number)});
  }
  const auto rows = static_cast<std::size_t>(set.error_um.rows());
  if (rows < 3 * model.sensors.size()) {
    model.findings.push_back({FindingKind::few_rows, FindingAction::noted, "the fit",
                              fmt::format("{} blocks for {} sensors", rows, model.sensors.size())});
  }
  if (set.folds.cycles < 2) {
    model.findings.push_back(
        {FindingKind::not_guaranteed, FindingAction::noted, "the coverage of the band", "one cycle only"});
  }
}

Result<Model> assemble(const TrainingSet& set, const FitOptions& options, const Trial& chosen,
                       const Trial& table_trial) {
  Model model;
  model.method = chosen.recipe.method;
  model.asked = options.method;
  model.held_out = set.folds.in_words;
  for (const auto& run : set.runs) model.recordings.push_back(run.name);
  model.sensors = chosen.recipe.sensors;
  model.features = chosen.recipe.features;
  model.averaged = chosen.recipe.nested;
  model.reference_C = start_references(set.runs.front(), model.features);
  const Eigen::VectorXd noise_C = set.feature_noise_C(model.features);
  model.noise_C.assign(noise_C.begin(), noise_C.end());
  ZD_TRY(Fitted fitted, fit_all(set, chosen.recipe));
  for (std::size_t e = 0; e < set.errors.size(); ++e) {
    ErrorModel error;
    error.error = set.errors[e];
    error.regression = std::move(fitted.regressions[e]);
    error.fit = fitted.fit[e];
    error.held_out = chosen.evaluation.held_out[e];
    error.band = chosen.evaluation.bands[e];
    error.remembered_um = fitted.remembered_um[e];
    model.errors.push_back(std::move(error));
  }
  ZD_TRY(model.table, table_of(set, table_trial));
  model.table_lost_percent = 100.0 * (table_trial.evaluation.rms_um / std::max(chosen.evaluation.rms_um, 1e-9) - 1.0);
  ZD_TRY(const Eigen::MatrixXd last, features(set.runs.back(), model.features,
                                              start_references(set.runs.back(), model.features), nullptr, &model.end));
  model.start_time_s = set.runs.back().time_s.front();
  const auto specs = static_features(model.sensors);
  model.start_C = start_references(set.runs.back(), specs);
  for (const auto& sensor : model.sensors) {
    model.end_C.push_back(set.smoothed_C.back()(set.smoothed_C.back().rows() - 1, set.runs.back().sensor(sensor)));
  }
  model.domain = domain_of(set, model.sensors, !model.is_static());
  model.quality = quality_of(set, model.sensors, model.domain);
  add_findings(model, set);
  return model;
}

/// The sets of sensors that were not taken, beside the methods that were tried.
void add_sets(const SensorChoice& choice, Model& model) {
  for (std::size_t i = 0; i < choice.sets.size(); ++i) {
    const SensorSet& s = choice.sets[i];
    if (i == choice.chosen) continue;
    Candidate c;
    c.method = Method::ridge;
    c.sensors = s.sensors;
    c.label = fmt::format("ridge on {} sensors ({})", s.sensors.size(), in_words(s.kind));
    c.held_out_rms_um = s.held_out_rms_um;
    c.held_out_peak_um = s.held_out_peak_um;
    c.noise_um = s.noise_um;
    c.runs_on_controller = true;
    model.candidates.push_back(std::move(c));
  }
}

}  // namespace

Result<Model> fit(const std::vector<recording::Recording>& recordings, const FitOptions& options,
                  const TaskContext& context) {
  PrepareOptions prepare_options;
  prepare_options.sensors = options.sensors;
  prepare_options.errors = options.errors;
  ZD_CHECK(check_distinct(recordings));
  for (const auto& recording : recordings) ZD_CHECK(check_error_unit(recording));
  ZD_TRY(TrainingSet set, make_training(recordings, prepare_options));
  for (const auto& recording : recordings) {
    if (auto doubt = doubtful_times(recording)) set.findings.push_back(std::move(*doubt));
  }
  if (options.method == Method::physics && !has_simulation(set.runs.front())) {
    return fail(ErrorCode::bad_argument, {{"what", "the method"},
                                          {"found", "physics without a machine description"},
                                          {"expected",
                                           "one: --machine M.json (diagnose --machine M.json --recording R.csv "
                                           "--refined M2.json makes a better one from a recording)"}});
  }
  std::vector<Trial> trials;
  ZD_TRY(const Plan plan, plan_for(options, recordings, set, context));
  const std::vector<Recipe>& list = plan.recipes;
  for (const auto& recipe : list) {
    context.progress(0.9 * static_cast<double>(trials.size()) / static_cast<double>(list.size()), "fitting");
    auto trial = try_out(set, recipe, options.coverage, context);
    if (trial) {
      trials.push_back(std::move(*trial));
    } else if (options.method == recipe.method || trial.error().code != ErrorCode::not_enough_data) {
      return fail(std::move(trial).error());
    }
  }
  const bool rank = set.folds.cycles >= 2;
  const Trial* chosen = choose(trials, options.method, options.on_controller, rank);
  const Trial* table_trial = choose(trials, options.method, true, rank);
  if (chosen == nullptr || table_trial == nullptr) {
    return fail(ErrorCode::not_enough_data, {{"what", "the run"},
                                             {"found", fmt::format("{} blocks of measurements", set.error_um.rows())},
                                             {"needed", "at least 12"}});
  }
  if (chosen->summary.runs_on_controller) table_trial = chosen;
  ZD_TRY(Model model, assemble(set, options, *chosen, *table_trial));
  model.reason = reason_for(*chosen, trials, options, set);
  if (!plan.sensors.sets.empty() && chosen->summary.runs_on_controller) model.reason += ". " + plan.sensors.reason;
  for (const auto& t : trials) {
    model.candidates.push_back(t.summary);
    model.candidates.back().chosen = &t == chosen;
  }
  add_sets(plan.sensors, model);
  context.progress(1.0, "fitting");
  return model;
}

}  // namespace zerodrift::analysis
