#include "app/proof/oracle.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/diagnosis/bodies.h"
#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/elsewhere.h"
#include "core/diagnosis/place.h"
#include "core/diagnosis/refine.h"
#include "core/diagnosis/refined.h"
#include "core/diagnosis/screening.h"

namespace zerodrift::proof {
namespace {

using diagnosis::Candidate;
using diagnosis::Dataset;
using diagnosis::Model;
using diagnosis::ModelPtr;

bool is_form_of(const Candidate& candidate, const TrueEffect& hidden) {
  const auto& spec = candidate.spec;
  // On a rod a heat that is always there is a source with a constant law.
  if (hidden.id == "standing_heat" && spec.id == "extra_heat_source") return spec.word_or("law", "") == "constant";
  if (spec.id != hidden.id) return false;
  if (!hidden.channel.empty() && spec.word_or("channel", "") != hidden.channel) return false;
  return hidden.law.empty() || spec.word_or("law", hidden.law) == hidden.law;
}

/// The best form of one hidden effect added to a model; places start where the truth is.
ModelPtr with_effect(const ModelPtr& base, const TrueEffect& hidden, const physics::RunFacts& facts) {
  auto screened = diagnosis::screen(*base, facts);
  std::erase_if(screened, [&](const auto& candidate) { return !is_form_of(candidate, hidden); });
  if (hidden.position_mm) {
    std::stable_sort(screened.begin(), screened.end(), [&](const auto& a, const auto& b) {
      const auto off = [&](const Candidate& c) {
        return std::abs(c.spec.number_or("position_mm", *hidden.position_mm) - *hidden.position_mm);
      };
      return off(a) < off(b);
    });
  }
  constexpr std::size_t forms = 12;
  if (screened.size() > forms) screened.resize(forms);
  ModelPtr best;
  for (auto& candidate : screened) {
    if (hidden.position_mm && candidate.spec.numbers.count("position_mm") != 0) {
      candidate.spec.numbers["position_mm"] = *hidden.position_mm;
    }
    const ModelPtr fit = diagnosis::extended(*base, candidate);
    fit->fit({20, 0.02, true});
    if (best == nullptr || fit->log_evidence() > best->log_evidence()) best = fit;
  }
  return best;
}

/// Under the misfit that suits the model, as every answer of the diagnosis is.
ModelPtr at_its_own_misfit(const ModelPtr& model, const Dataset& usual) {
  auto data = std::make_shared<Dataset>(
      diagnosis::with_discrepancy(usual, diagnosis::ordinary_discrepancy(usual, model->prediction())));
  auto result = std::make_shared<Model>(model->machine(), std::move(data));
  result->continue_from(*model);
  result->fit({20, 0.02, true});
  return result;
}

/// The other recordings with default widths. They refer to `recordings`.
diagnosis::OtherRecordings others_of(const physics::Machine& machine,
                                     const std::vector<recording::Recording>& recordings) {
  diagnosis::OtherRecordings others;
  for (std::size_t i = 1; i < recordings.size(); ++i) {
    const physics::Network network = physics::build_network(machine, recordings[i]);
    auto usual = std::make_shared<Dataset>(diagnosis::make_dataset(recordings[i], network));
    diagnosis::set_timing_noise(*usual, network, physics::make_inputs(network, recordings[i]));
    others.push_back(std::move(usual));
  }
  return others;
}

/// How well the places of the effects from `first` on are known.
std::map<std::string, double> places_of(const Model& model, std::size_t first,
                                        const diagnosis::OtherRecordings& others) {
  std::map<std::string, double> sigma_mm;
  std::optional<diagnosis::SeenByAll> seen;
  for (std::size_t i = first; i < model.machine().effects.size(); ++i) {
    if (model.machine().effects[i].numbers.count("position_mm") == 0) continue;
    if (!seen) seen = diagnosis::seen_by_all(model, others);
    const auto place = diagnosis::place_of_effect(model, *seen, i);
    if (place) sigma_mm[model.machine().effects[i].id] = place->sigma_mm;
  }
  return sigma_mm;
}

std::map<std::string, double> reached_in(const Model& model, const recording::Recording& other) {
  const double hold = model.values()[static_cast<std::size_t>(model.network().hold_parameter)];
  std::map<std::string, double> reached;
  for (const auto& channel : diagnosis::predict_other(diagnosis::refined_machine(model), other, hold).channels) {
    const double rms = diagnosis::rms_between(other, channel.channel, channel.values);
    if (std::isfinite(rms)) reached[channel.channel] = rms;
  }
  return reached;
}

}  // namespace

OracleAnswer told_the_truth(const physics::Machine& described, const std::vector<recording::Recording>& recordings,
                            const std::vector<TrueEffect>& hidden) {
  const physics::Machine machine = diagnosis::with_inner_bodies(described);
  const auto& recording = recordings.front();
  const physics::Network network = physics::build_network(machine, recording);
  auto usual = std::make_shared<Dataset>(diagnosis::make_dataset(recording, network));
  diagnosis::set_timing_noise(*usual, network, physics::make_inputs(network, recording));
  const physics::RunFacts facts = diagnosis::facts_of(machine, recording);
  auto base = std::make_shared<Model>(machine, usual);
  base->fit({20, 0.02, true});
  base = at_its_own_misfit(base, *usual);
  OracleAnswer answer;
  ModelPtr best;
  std::vector<TrueEffect> in_turn = hidden;
  for (std::size_t order = 0; order < std::max<std::size_t>(1, hidden.size()); ++order) {
    ModelPtr model = base;
    for (const auto& effect : in_turn) {
      if (model != nullptr) model = with_effect(model, effect, facts);
    }
    if (model == nullptr) return answer;
    if (best == nullptr || model->log_evidence() > best->log_evidence()) best = model;
    std::reverse(in_turn.begin(), in_turn.end());
  }
  if (best != base) {
    best = at_its_own_misfit(best, *usual);
    // One who is told starts from the description as well, not only from what it became without the effects.
    if (const ModelPtr anew = diagnosis::restarted(*best, facts)) {
      const ModelPtr other = at_its_own_misfit(anew, *usual);
      if (other->log_evidence_total() > best->log_evidence_total()) best = other;
    }
  }
  const diagnosis::OtherRecordings others = others_of(machine, recordings);
  answer.found = true;
  answer.evidence = best->log_evidence_total() - base->log_evidence_total();
  for (std::size_t i = machine.effects.size(); i < best->machine().effects.size(); ++i) {
    auto less = diagnosis::reduced(*best, i);
    less->fit({20, 0.02, true});
    less = at_its_own_misfit(less, *usual);
    double& shown = answer.beside[best->machine().effects[i].id];
    shown = best->log_evidence_total() - less->log_evidence_total();
    if (others.empty() || diagnosis::happened_once(*best)) continue;
    std::vector<ModelPtr> asked = {best};
    diagnosis::ask_elsewhere(asked, *less, others);
    shown += best->elsewhere;
  }
  answer.place_sigma_mm = places_of(*best, machine.effects.size(), others);
  if (recordings.size() > 1) answer.reached = reached_in(*best, recordings[1]);
  return answer;
}

}  // namespace zerodrift::proof
