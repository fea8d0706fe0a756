#include "core/diagnosis/search/intervals.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <functional>

#include "core/diagnosis/inference/parallel.h"
#include "core/physics/builder.h"
#include "core/physics/hat.h"

namespace zerodrift::diagnosis::search {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using inference::Evidence;
using inference::Fit;
using inference::RowMatrix;
using physics::EffectSpec;

constexpr std::size_t most_hats = 48;     // of a recording: an event of a fiftieth of it is resolved; edges are fitted
constexpr std::size_t most_boxes = 300;   // of a reading: its edges are not fitted
constexpr std::size_t rows_of_a_hat = 3;  // at least: one sample is noise, two are a spike
constexpr int most_stretches = 12;

/// A kind of thing that may act for a time, as a candidate without intervals.
struct Timed {
  EffectSpec spec;
  double sigma = 1.0;  // prior of its strength
  bool only_positive = true;
  MakeTerm make_term;  // none: the response is a constant on `series`
  std::size_t series = 0;
};

double largest_W(const physics::HeatSource& source, const recording::Recording& recording) {
  const recording::Channel* input = recording.find(source.channel);
  double largest = 0.0;
  for (const double v : input == nullptr ? std::vector<double>{} : input->values) {
    if (std::isfinite(v)) largest = std::max(largest, std::abs(physics::nominal_heat_W(source, v, 1.0)));
  }
  return largest;
}

void add_heats(const physics::Machine& machine, const physics::RunFacts& facts, const recording::Recording& recording,
               std::vector<Timed>& list) {
  constexpr int places = 3;  // along a rod; the fit moves them
  for (const auto& part : machine.components) {
    if (part.prescribed) continue;
    // A lump's own sources say how much heat moves it; without any, 20 K in an hour is much.
    double own_W = 0.0;
    for (const auto& source : part.sources) own_W += largest_W(source, recording);
    const double watts =
        part.lump
            ? std::max(part.heat_capacity_J_K.value_or(physics::stand_in_capacity_J_K) * 20.0 / 3600.0, 0.3 * own_W)
            : std::max(5.0, 0.3 * facts.typical_heat_W);
    for (int i = 0; i < (part.lump ? 1 : places); ++i) {
      Timed heat;
      heat.spec = {std::string(physics::effect_of_event(physics::Event::heat).id),
                   true,
                   {{"power_W", 0.0}, {"power_W_prior_sigma", watts}},
                   {{"component", part.id}}};
      const double at_mm = (i + 0.5) / places * part.length_mm;
      if (!part.lump) {
        heat.spec.numbers["position_mm"] = at_mm;
        heat.spec.numbers["position_mm_prior_sigma"] = 0.5 / places * part.length_mm;
      }
      heat.sigma = watts;
      heat.only_positive = false;
      heat.make_term = [id = part.id, at_mm, lump = part.lump, width_mm = 0.02 * part.length_mm](auto& builder) {
        return lump ? builder.source_over(id, 0.0, 0.0) : builder.source_over(id, at_mm - width_mm, at_mm + width_mm);
      };
      list.push_back(std::move(heat));
    }
  }
}

void add_films(const physics::Machine& machine, std::vector<Timed>& list) {
  for (const auto& part : machine.components) {
    if (part.prescribed) continue;
    const bool surface = !part.lump || part.area_mm2.has_value();
    const char* key = surface ? "h_W_m2K" : "conductance_W_K";
    const physics::Effect& effect = physics::effect_of_event(physics::Event::film);
    Timed film;
    film.spec = {std::string(effect.id), true, {{key, 0.0}}, {{"component", part.id}}};
    if (lacks_required(machine, film.spec)) continue;
    film.sigma = effect.parameter(key).sigma;
    film.make_term = [id = part.id, length_mm = part.length_mm, surface](auto& builder) {
      physics::Term term = builder.film_over(id, 0.0, length_mm);
      if (!surface)
        for (double& weight : term.weights) weight = 1.0 / static_cast<double>(term.weights.size());
      term.environment = builder.room();
      return term;
    };
    list.push_back(std::move(film));
  }
}

void add_sensors(const Evidence& evidence, const physics::Machine& machine, std::vector<Timed>& list) {
  for (std::size_t c = 0; c < evidence.series(); ++c) {
    const auto& series = evidence.runs().front().series[c];
    const physics::Sensor* sensor = machine.sensor(series.channel);
    if (sensor == nullptr || evidence.samples(c) == 0) continue;
    Timed fault;
    fault.sigma = std::max(1.2, 3.0 * sensor->accuracy_C);
    fault.spec = {std::string(physics::effect_of_event(physics::Event::reading).id),
                  true,
                  {{"offset_K", 0.0}, {"offset_K_prior_sigma", fault.sigma}},
                  {{"channel", series.channel}}};
    fault.only_positive = false;
    fault.series = c;
    list.push_back(std::move(fault));
  }
}

/// A sensor's reading alone, in each hat.
RowMatrix reading_alone(const inference::Run& run, std::size_t series, const std::vector<double>& centres) {
  const double apart_s = centres[1] - centres[0];
  RowMatrix out =
      RowMatrix::Zero(static_cast<Index>(run.rows() * run.series.size()), static_cast<Index>(centres.size()));
  for (std::size_t k = 0; k < run.rows(); ++k) {
    for (std::size_t i = 0; i < centres.size(); ++i) {
      out(static_cast<Index>(series * run.rows() + k), static_cast<Index>(i)) =
          physics::hat((run.recording.time_s[k] - centres[i]) / apart_s);
    }
  }
  return out;
}

struct Sum {
  double slope = 0.0, information = 0.0;
  double gain(double sigma, bool only_positive) const {
    if (only_positive && slope <= 0.0) return 0.0;
    const double total = information + 1.0 / (sigma * sigma);
    return 0.5 * slope * slope / total - 0.5 * std::log(total * sigma * sigma);
  }
};

}  // namespace

std::vector<std::pair<int, int>> best_stretches(const HatScores& scores, double sigma, bool only_positive,
                                                double stretch_cost) {
  const auto hats = static_cast<int>(scores.slope.size());
  // Sums over the first i hats, and over the first i by the first j.
  VectorXd slope = VectorXd::Zero(hats + 1);
  MatrixXd information = MatrixXd::Zero(hats + 1, hats + 1);
  for (int i = 0; i < hats; ++i) {
    slope[i + 1] = slope[i] + scores.slope[i];
    for (int j = 0; j < hats; ++j) {
      information(i + 1, j + 1) =
          scores.information(i, j) + information(i, j + 1) + information(i + 1, j) - information(i, j);
    }
  }
  std::vector<std::pair<int, int>> taken;
  std::vector<bool> used(static_cast<std::size_t>(hats), false);
  VectorXd with_taken = VectorXd::Zero(hats + 1);  // information with what is taken, summed over the first i hats
  Sum now;
  double before = 0.0;
  while (static_cast<int>(taken.size()) < most_stretches) {
    double best = before + (taken.empty() ? 0.0 : stretch_cost);
    std::pair<int, int> found{-1, -1};
    Sum found_sum;
    for (int first = 0; first < hats; ++first) {
      for (int last = first; last < hats && !used[static_cast<std::size_t>(last)]; ++last) {
        if (last - first + 1 >= hats) break;  // all the time is no stretch of it
        const int end = last + 1;
        const Sum sum{now.slope + slope[end] - slope[first],
                      now.information + information(end, end) - information(first, end) - information(end, first) +
                          information(first, first) + 2.0 * (with_taken[end] - with_taken[first])};
        const double gain = sum.gain(sigma, only_positive);
        if (gain > best) best = gain, found = {first, last}, found_sum = sum;
      }
    }
    if (found.first < 0) break;
    taken.push_back(found);
    for (int i = std::max(0, found.first - 1); i <= std::min(hats - 1, found.second + 1); ++i)
      used[static_cast<std::size_t>(i)] = true;  // neighbouring stretches are one
    for (int i = 0; i <= hats; ++i) with_taken[i] += information(i, found.second + 1) - information(i, found.first);
    now = found_sum;
    before = best;
  }
  return taken;
}

std::vector<Candidate> interval_candidates(const Fit& fit, const std::vector<physics::RunFacts>& facts) {
  const Evidence& evidence = fit.model().evidence();
  const DiagnosisSettings& settings = evidence.settings();
  struct Job {
    std::size_t run;
    Timed timed;
  };
  std::vector<Job> jobs;
  for (std::size_t r = 0; r < evidence.runs().size(); ++r) {
    const physics::Machine machine = fit.model().hypothesis().machine_in(static_cast<int>(r));
    std::vector<Timed> list;
    add_heats(machine, facts[r], evidence.runs()[r].recording, list);
    add_films(machine, list);
    add_sensors(evidence, machine, list);
    for (Timed& one : list) jobs.push_back({r, std::move(one)});
  }
  const WhitenedFit whole = whitened(fit);
  std::vector<std::vector<Candidate>> found(jobs.size());
  in_parallel(jobs.size(), [&](std::size_t i) {
    const auto& [r, timed] = jobs[i];
    const bool fitted = static_cast<bool>(timed.make_term);  // its edges
    const std::vector<double> centres =
        hat_centres(evidence.runs()[r], fitted ? most_hats : most_boxes, fitted ? rows_of_a_hat : 1);
    if (centres.size() < 4) return;
    const double apart_s = centres[1] - centres[0];
    const RowMatrix response = timed.make_term ? hat_responses(fit, r, centres, timed.make_term)
                                               : reading_alone(evidence.runs()[r], timed.series, centres);
    const HatScores scores = hat_scores(fit, whole, r, centres, response);
    // Each edge may be anywhere: its prior is spread over the recording, in units of how well a hat tells it.
    const double edge_cost = std::log(static_cast<double>(centres.size()));
    const auto stretches = best_stretches(scores, timed.sigma, timed.only_positive, 2.0 * edge_cost);
    const auto candidate_of = [&](std::size_t count) {
      Candidate candidate{{timed.spec, static_cast<int>(r)}, 0.0};
      EffectSpec& spec = candidate.effect.spec;
      const auto& time_s = evidence.runs()[r].recording.time_s;
      for (std::size_t s = 0; s < count; ++s) {
        const auto [first, last] = stretches[s];
        const double from_s = centres[static_cast<std::size_t>(first)] - 0.5 * apart_s;
        const double to_s = centres[static_cast<std::size_t>(last)] + 0.5 * apart_s;
        // What still acts at the end has no end, and what acts at the start had begun.
        spec.intervals_s.emplace_back(first == 0 ? time_s.front() - apart_s : from_s,
                                      last + 1 == static_cast<int>(centres.size()) ? time_s.back() + apart_s : to_s);
      }
      std::sort(spec.intervals_s.begin(), spec.intervals_s.end());
      spec.numbers["edge_prior_sigma"] = 0.5 * apart_s;
      const double row_s = (time_s.back() - time_s.front()) / static_cast<double>(time_s.size());
      spec.numbers["edge_s"] = std::max(0.1 * apart_s, row_s);
      candidate.log_prior = settings.effect_log_prior + physics::find_effect(spec.id)->traits.log_rarity -
                            2.0 * edge_cost * static_cast<double>(count);
      spec.log_prior = candidate.log_prior;
      return candidate;
    };
    if (stretches.empty()) return;
    found[i].push_back(candidate_of(1));
    if (stretches.size() > 1) found[i].push_back(candidate_of(stretches.size()));
  });
  std::vector<Candidate> all;
  for (auto& list : found) std::move(list.begin(), list.end(), std::back_inserter(all));
  return all;
}

}  // namespace zerodrift::diagnosis::search
