#include "core/diagnosis/description/machine_errors.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/diagnosis/description/corrected_value.h"
#include "core/diagnosis/inference/parallel.h"

namespace zerodrift::diagnosis::description {
namespace {

using Eigen::Index;
using inference::Fit;
using physics::Component;
using physics::Machine;

constexpr double wide = 2.3;  // standard deviation of the logarithm of a number that may be anything: a factor of ten

/// Who misreads a drawing is off by far; by less a size is not misstated, and a heat is within its tolerance.
constexpr double least_factor = 1.25;
constexpr double least_too_long = 0.07;  // of a length

/// The farthest place of a rod on which the description has anything.
double last_known_mm(const Machine& machine, const Component& rod) {
  double last_mm = 0.0;
  const auto take = [&](double at_mm) { last_mm = std::max(last_mm, at_mm); };
  for (const auto& source : rod.sources) take(source.to_mm);
  for (const auto& sensor : machine.sensors) {
    if (sensor.component == rod.id) take(sensor.position_mm);
  }
  for (const auto& coupling : machine.couplings) {
    for (const auto* end : {&coupling.first, &coupling.second}) {
      if (end->component == rod.id) take(end->position_mm);
    }
  }
  for (const auto& spec : machine.effects) {
    if (spec.word_or("component", rod.id) != rod.id) continue;
    for (const char* place : {"position_mm", "to_mm"}) take(spec.number_or(place, 0.0));
  }
  return last_mm;
}

void add_lengths(const Machine& machine, const Component& rod, std::vector<DescriptionError>& list) {
  const double last_mm = last_known_mm(machine, rod);
  const double bare_mm = rod.length_mm - last_mm;
  constexpr double shares[] = {0.05, 0.2, 0.35, 0.5};  // of the bare end
  if (last_mm <= 0.0 || bare_mm < 2.0 * least_too_long * rod.length_mm) return;
  for (const double share : shares) {
    DescriptionError error{ErrorKind::length, rod.id};
    error.described = rod.length_mm;
    error.value = last_mm + share * bare_mm;
    error.low = last_mm;
    error.high = (1.0 - least_too_long) * rod.length_mm;
    error.spread = 0.4 * bare_mm;  // as dense as uniform
    error.value_log_prior = -std::log(static_cast<double>(std::size(shares)));
    list.push_back(std::move(error));
  }
}

void add_factors(ErrorKind kind, const std::string& of, double described, std::initializer_list<double> factors,
                 double spread, std::vector<DescriptionError>& list) {
  for (const double factor : factors) {
    DescriptionError error{kind, of};
    error.described = described;
    error.value = factor * described;
    error.low = (factor < 1.0 ? 1e-3 : least_factor) * described;
    error.high = (factor < 1.0 ? 1.0 / least_factor : 1e3) * described;
    error.spread = spread * error.value;
    error.value_log_prior = -std::log(static_cast<double>(factors.size()));
    list.push_back(std::move(error));
  }
}

void add_clocks(const Fit& fit, std::vector<DescriptionError>& list) {
  double row_s = 0.0;
  for (const auto& run : fit.model().evidence().runs()) {
    const auto& time_s = run.recording.time_s;
    row_s = std::max(row_s, (time_s.back() - time_s.front()) / static_cast<double>(time_s.size()));
  }
  for (const double rows : {2.0, 4.0, 8.0, 16.0, 32.0, 64.0}) {
    for (const double before : {-1.0, 0.0, 1.0}) {
      DescriptionError error{ErrorKind::clock, {}};
      error.value = before < 0.0 ? rows * row_s : -rows * row_s;
      error.before = std::max(0.0, before);
      error.value_log_prior = -std::log(18.0);
      list.push_back(std::move(error));
    }
  }
}

std::vector<DescriptionError> errors_of(const Fit& fit) {
  const inference::Hypothesis& hypothesis = fit.model().hypothesis();
  const Machine& machine = hypothesis.machine;
  std::vector<DescriptionError> list;
  for (const Component& part : machine.components) {
    if (part.prescribed) continue;
    if (!part.lump) {
      add_lengths(machine, part, list);
      add_factors(ErrorKind::diameter, part.id, part.outer_diameter_mm, {0.5, 0.7, 1.4, 2.0}, 0.5, list);
    }
    const auto known =
        std::count_if(part.sources.begin(), part.sources.end(), [](const auto& one) { return !one.power_unknown; });
    if (known > 1) add_factors(ErrorKind::heat, part.id, 1.0, {0.1, 0.3, 3.0, 10.0}, wide, list);
  }
  for (const auto& displacement : machine.displacements) {
    if (machine.find(displacement.component) != nullptr && !physics::is_across(machine, displacement))
      list.push_back({ErrorKind::sign, displacement.channel});
  }
  for (const auto& spec : machine.effects) {
    list.push_back({ErrorKind::absent_effect, spec.id, spec.word_or("component", "")});
  }
  add_clocks(fit, list);
  return list;
}

void spread_priors(std::vector<PossibleError>& list, double error_log_prior) {
  std::map<ErrorKind, std::map<std::string, int>> forms;
  for (const PossibleError& one : list) ++forms[one.error.kind][name_of(one.error)];
  for (PossibleError& one : list) {
    one.error.form_log_prior = error_log_prior - std::log(static_cast<double>(forms[one.error.kind].size()));
  }
}

/// Log odds of a prior of standard deviation `sigma` instead of 1 for an unknown at `mean` with `variance` under 1, and
/// where it then would be.
std::pair<double, double> given_up(double mean, double variance, double sigma) {
  const double information = 1.0 / variance - 1.0;
  if (!(information > 1e-9)) return {0.0, mean};
  const double centre = mean * (information + 1.0) / information;
  const auto log_density = [&](double prior) {
    const double total = 1.0 / information + prior * prior;
    return -0.5 * centre * centre / total - 0.5 * std::log(total);
  };
  return {log_density(sigma) - log_density(1.0), centre * sigma * sigma / (sigma * sigma + 1.0 / information)};
}

}  // namespace

std::vector<PossibleError> machine_errors(const Fit& fit) {
  const inference::Evidence& evidence = fit.model().evidence();
  std::vector<PossibleError> trials;
  for (DescriptionError& error : errors_of(fit)) {
    const auto& had = fit.model().hypothesis().errors;
    const bool taken = std::any_of(had.begin(), had.end(), [&](const auto& one) { return one.kind == error.kind; });
    if (!taken) trials.push_back({std::move(error), 0.0});
  }
  spread_priors(trials, evidence.settings().error_log_prior);
  const double before = fit.log_evidence_at(fit.sizes());
  in_parallel(trials.size(), [&](std::size_t i) {
    inference::Hypothesis hypothesis = with_error(evidence.machine(), fit.model().hypothesis(), trials[i].error);
    Fit there(std::make_shared<inference::JointModel>(std::move(hypothesis), fit.model().shared_evidence()),
              fit.sizes());
    there.start_from(fit, false);
    there.fit({0, true});
    trials[i].log_odds = there.log_evidence_at(there.sizes()) - before + trials[i].error.log_prior();
  });
  std::map<std::string, const PossibleError*> best;
  for (const PossibleError& one : trials) {
    const PossibleError*& kept = best[name_of(one.error)];
    if (kept == nullptr || kept->log_odds < one.log_odds) kept = &one;
  }
  std::vector<PossibleError> list;
  for (const auto& [name, kept] : best) list.push_back(*kept);
  return list;
}

std::vector<PossibleError> number_errors(const Fit& fit) {
  const inference::JointModel& model = fit.model();
  const Eigen::MatrixXd covariance = fit.quadratic().curvature.ldlt().solve(
      Eigen::MatrixXd::Identity(static_cast<Index>(model.unknowns()), static_cast<Index>(model.unknowns())));
  std::vector<PossibleError> list;
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    const inference::Unknown& unknown = model.unknown(i);
    const physics::Parameter& parameter = unknown.parameter;
    const bool described = unknown.effect < 0 && unknown.run < 0 && parameter.logarithmic && parameter.sigma < wide;
    if (!described || quantity_of_number(parameter.key).empty()) continue;
    DescriptionError error{ErrorKind::number, parameter.component, parameter.key, parameter.channel};
    const auto at = static_cast<Index>(i);
    const auto [gain, z] = given_up(fit.z()[at], covariance(at, at), wide / parameter.sigma);
    error.described = 1.0;
    error.value = std::exp(std::clamp(parameter.sigma * z, -2.0 * wide, 2.0 * wide));
    error.tolerance = parameter.sigma;
    error.spread = wide;
    list.push_back({std::move(error), gain});
  }
  spread_priors(list, model.evidence().settings().error_log_prior);
  for (PossibleError& one : list) one.log_odds += one.error.log_prior();
  return list;
}

}  // namespace zerodrift::diagnosis::description
