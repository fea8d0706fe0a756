#include "core/diagnosis/refine.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "core/diagnosis/parallel.h"

namespace zerodrift::diagnosis {
namespace {

bool many_forms(const std::string& id) {
  return id == "extra_heat_source" || id == "contact_resistance" || id == "bearing_preload" || id == "coolant" ||
         id == "structure_bending" || id == "structure_ambient" || id == "convection" || id == "sensor_lag" ||
         id == "sensor_offset" || id == "sensor_gain";
}

/// The best-scored forms, at most a few a family, and not two neighbouring places of one law.
std::vector<Candidate> leaders(const Model& base, const std::vector<Candidate>& screened,
                               const RefineOptions& options) {
  // A fit finds up to seven times what the score promised: what stays far behind even so is not refitted.
  constexpr double far_behind = 0.03;
  const double best = screened.empty() ? 0.0 : screened.front().gain;
  std::map<std::string, int> count;
  std::vector<Candidate> chosen;
  for (const auto& candidate : screened) {
    if (candidate.gain < std::max(options.least_gain, far_behind * best) || chosen.size() >= options.most) break;
    const std::string& id = candidate.spec.id;
    if (count[id] >= options.per_family + (many_forms(id) ? 1 : 0)) continue;
    const physics::Component* component = base.machine().find(candidate.spec.word_or("component", ""));
    const bool near = component != nullptr && candidate.spec.numbers.count("position_mm") != 0 &&
                      std::any_of(chosen.begin(), chosen.end(), [&](const Candidate& other) {
                        return other.spec.id == id && other.spec.words == candidate.spec.words &&
                               std::abs(other.spec.number_or("position_mm", 0) -
                                        candidate.spec.number_or("position_mm", 0)) < 0.07 * component->length_mm;
                      });
    if (near) continue;
    ++count[id];
    chosen.push_back(candidate);
  }
  return chosen;
}

/// An unconverged fit with a large gain invents a second effect, so the leaders are polished before they are compared.
void polish(const ModelPtr& base, std::vector<ModelPtr>& fits) {
  std::set<const Model*> polished;
  for (int round = 0; round < 2 && !fits.empty(); ++round) {
    std::sort(fits.begin(), fits.end(), by_evidence);
    const double lead = fits.front()->log_evidence();
    const double margin = std::max(60.0, 0.35 * std::abs(lead - base->log_evidence()));
    std::map<std::string, int> count;
    std::vector<ModelPtr> turn;
    for (const auto& fit : fits) {
      const std::string& id = last_effect(*fit).id;
      if (count[id] >= (round == 0 ? 2 : 1) || count.size() > 4) continue;
      ++count[id];
      if (polished.count(fit.get()) != 0 || fit->log_evidence() < lead - margin) continue;
      turn.push_back(fit);
      polished.insert(fit.get());
    }
    in_parallel(turn.size(), [&](std::size_t i) { turn[i]->fit({15, 0.05, true}); });
  }
  std::sort(fits.begin(), fits.end(), by_evidence);
}

/// Belongs to an effect that is tried, not to the machine as described.
bool of_a_candidate(const Model& model, std::size_t unknown) {
  const int effect = model.unknown(unknown).effect;
  return effect >= 0 && model.machine().effects[static_cast<std::size_t>(effect)].candidate;
}

/// Where a candidate of the model stands; not a number without a place.
double place_of(const Model& model, std::size_t effect) {
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    if (model.unknown(i).effect == static_cast<int>(effect) && model.unknown(i).key == "position_mm") {
      return model.value(i);
    }
  }
  return std::nan("");
}

/// `to` with the values that the candidates of `from` have.
void take_candidates(Model& to, const Model& from) {
  for (std::size_t i = 0; i < from.unknowns(); ++i) {
    if (of_a_candidate(from, i)) to.set_z(i, from.z()[static_cast<Eigen::Index>(i)]);
  }
  to.gain = from.gain;
}

/// Its words, and which numbers it has: where it stands is no form.
std::string form_of(const physics::EffectSpec& spec) {
  std::string form;
  for (const auto& [key, word] : spec.words) form += key + '=' + word + ' ';
  for (const auto& [key, number] : spec.numbers) form += key + ' ';
  return form;
}

/// The last effect at the places where it scores best beside the machine as described: a machine that has bent itself
/// round the effect shows it elsewhere.
std::vector<ModelPtr> at_places_of_the_description(const Model& fit, const physics::RunFacts& facts) {
  constexpr std::size_t most = 2;
  constexpr double same_place = 0.07;  // of the length
  constexpr double worth = 0.25;       // of the best place's score
  const physics::EffectSpec& spec = last_effect(fit);
  const physics::Component* component = fit.machine().find(spec.word_or("component", ""));
  std::vector<ModelPtr> starts;
  if (component == nullptr || spec.numbers.count("position_mm") == 0) return starts;
  const ModelPtr less = reduced(fit, fit.machine().effects.size() - 1);
  Model described(less->machine(), fit.shared_data());
  take_candidates(described, *less);
  described.fit({0, 1.0, true});
  std::vector<Candidate> forms = screen(described, facts);
  std::erase_if(forms, [&](const Candidate& c) { return c.spec.id != spec.id || c.spec.words != spec.words; });
  std::vector<double> taken_mm = {place_of(fit, fit.machine().effects.size() - 1)};
  for (const Candidate& candidate : forms) {
    if (starts.size() == most || candidate.gain < std::max(6.0, worth * forms.front().gain)) break;
    const double at_mm = candidate.spec.number_or("position_mm", 0.0);
    const auto near = [&](double mm) { return std::abs(mm - at_mm) < same_place * component->length_mm; };
    if (std::any_of(taken_mm.begin(), taken_mm.end(), near)) continue;
    taken_mm.push_back(at_mm);
    starts.push_back(extended(described, candidate));
  }
  return starts;
}

}  // namespace

const physics::EffectSpec& last_effect(const Model& model) {
  return model.machine().effects.back();
}

bool by_evidence(const ModelPtr& a, const ModelPtr& b) {
  return a->log_evidence() > b->log_evidence();
}

std::vector<ModelPtr> refine(const ModelPtr& base, const std::vector<Candidate>& screened,
                             const RefineOptions& options) {
  const std::vector<Candidate> chosen = leaders(*base, screened, options);
  std::vector<ModelPtr> fits(chosen.size());
  in_parallel(chosen.size(), [&](std::size_t i) {
    fits[i] = extended(*base, chosen[i]);
    fits[i]->fit({8, 0.05, false});
  });
  polish(base, fits);
  return fits;
}

std::vector<ModelPtr> in_place_of(const Model& best, std::size_t effect, const physics::RunFacts& facts,
                                  bool own_family) {
  const ModelPtr without = reduced(best, effect);
  without->fit({10, 0.05, true});
  std::vector<Candidate> screened = screen(*without, facts);
  const std::string& own = best.machine().effects[effect].id;
  if (!own_family) std::erase_if(screened, [&](const Candidate& candidate) { return candidate.spec.id == own; });
  if (screened.size() > 40) screened.resize(40);
  return refine(without, screened, {1, 6.0, own_family ? 8u : 6u});
}

bool may_catch_up(const Model& model, double behind, std::span<const ModelPtr> before,
                  const std::vector<Candidate>& screened) {
  constexpr double beyond_the_score = 20.0;  // and the whole score, where a step that is one saves half of it
  static constexpr const char* same[] = {"component", "channel", "law"};
  const auto ends = [](const ModelPtr& one, const physics::EffectSpec& spec) {
    const physics::EffectSpec& last = last_effect(*one);
    return last.id == spec.id && std::all_of(std::begin(same), std::end(same), [&](const char* word) {
             return last.word_or(word, "") == spec.word_or(word, "");
           });
  };
  // From another valley it is not the same.
  const bool elsewhere = std::any_of(before.begin(), before.end(),
                                     [&](const auto& one) { return last_effect(*one).id == last_effect(model).id; });
  for (const Candidate& candidate : screened) {
    const bool tried = !elsewhere && std::any_of(before.begin(), before.end(),
                                                 [&](const auto& one) { return ends(one, candidate.spec); });
    if (!tried) return behind <= candidate.gain + beyond_the_score;  // the best comes first
  }
  return behind <= beyond_the_score;
}

std::vector<ModelPtr> in_other_forms(const Model& model, std::size_t effect, const physics::RunFacts& facts) {
  constexpr FitOptions brief = {4, 0.05, false};
  constexpr double far_behind = 60.0;
  static constexpr const char* places[] = {"component", "channel", "region"};
  const physics::EffectSpec& own = model.machine().effects[effect];
  physics::Machine less = model.machine();
  less.effects.erase(less.effects.begin() + static_cast<std::ptrdiff_t>(effect));
  std::set<std::string> seen = {form_of(own)};
  std::vector<ModelPtr> fits;
  for (physics::EffectSpec& spec : physics::find_effect(own.id)->candidates(less, facts)) {
    const bool here = std::all_of(std::begin(places), std::end(places),
                                  [&](const char* word) { return spec.word_or(word, "") == own.word_or(word, ""); });
    if (!here || !seen.insert(form_of(spec)).second) continue;
    for (auto& [key, number] : spec.numbers) number = own.number_or(key, number);
    physics::Machine machine = model.machine();
    machine.effects[effect] = std::move(spec);
    fits.push_back(std::make_shared<Model>(std::move(machine), model.shared_data()));
  }
  in_parallel(fits.size(), [&](std::size_t i) {
    fits[i]->start_from(model, true);
    fits[i]->fit(brief);
  });
  std::erase_if(fits, [&](const ModelPtr& fit) { return fit->log_evidence() < model.log_evidence() - far_behind; });
  in_parallel(fits.size(), [&](std::size_t i) { fits[i]->fit({15, 0.05, true}); });
  return fits;
}

bool near_its_description(const Model& model) {
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    if (!of_a_candidate(model, i) && std::abs(model.z()[static_cast<Eigen::Index>(i)]) > 1.3) return false;
  }
  return true;
}

ModelPtr restarted(const Model& fit, const physics::RunFacts& facts) {
  constexpr double same = 3.0;  // of the cost: it runs back to where it came from
  std::vector<ModelPtr> starts = at_places_of_the_description(fit, facts);
  starts.push_back(std::make_shared<Model>(fit.machine(), fit.shared_data()));
  take_candidates(*starts.back(), fit);
  in_parallel(starts.size(), [&](std::size_t i) { starts[i]->fit({7, 1.0, false}); });
  ModelPtr anew = *std::min_element(starts.begin(), starts.end(),
                                    [](const auto& a, const auto& b) { return a->cost() < b->cost(); });
  if (std::abs(anew->cost() - fit.cost()) < same) return nullptr;
  anew->fit({15, 0.05, true});
  return anew;
}

ModelPtr in_the_valley_of(const Model& fit, const Model& other) {
  auto moved = std::make_shared<Model>(fit.machine(), fit.shared_data());
  moved->start_from(other, false);
  take_candidates(*moved, fit);
  moved->fit({12, 0.05, true});
  return moved;
}

ModelPtr with_places_tried(const ModelPtr& model) {
  constexpr double aside = 0.05;  // of the length
  std::vector<ModelPtr> tries;
  for (std::size_t i = 0; i < model->unknowns(); ++i) {
    if (!of_a_candidate(*model, i) || model->unknown(i).key != "position_mm") continue;
    const auto& spec = model->machine().effects[static_cast<std::size_t>(model->unknown(i).effect)];
    const physics::Component* component = model->machine().find(spec.word_or("component", ""));
    if (component == nullptr) continue;
    for (const double side : {-aside, aside}) {
      auto moved = std::make_shared<Model>(model->machine(), model->shared_data());
      moved->start_from(*model, false);
      moved->gain = model->gain;
      moved->set_z(i, model->unknown(i).z_of(model->value(i) + side * component->length_mm));
      tries.push_back(std::move(moved));
    }
  }
  in_parallel(tries.size(), [&](std::size_t t) { tries[t]->fit({15, 0.05, true, true}); });
  ModelPtr best = model;
  for (const auto& one : tries) {
    if (by_evidence(one, best)) best = one;
  }
  return best;
}

ModelPtr refitted_under(const Model& model, const std::shared_ptr<const Dataset>& data) {
  auto again = std::make_shared<Model>(model.machine(), data);
  again->start_from(model, false);
  again->fit({12, 0.05, true});
  return again;
}

physics::Machine without_candidates(physics::Machine machine) {
  std::erase_if(machine.effects, [](const auto& spec) { return spec.candidate; });
  return machine;
}

}  // namespace zerodrift::diagnosis
