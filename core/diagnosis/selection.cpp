#include "core/diagnosis/selection.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <set>

#include "core/diagnosis/elsewhere.h"
#include "core/diagnosis/parallel.h"
#include "core/diagnosis/refine.h"
#include "core/diagnosis/selector.h"

namespace zerodrift::diagnosis {

Result<Selection> Selector::run(const physics::Machine& machine, std::shared_ptr<const Dataset> data) {
  m_result.described = machine.effects.size();
  m_usual = std::move(data);
  m_result.base = std::make_shared<Model>(machine, m_usual);
  m_result.base->fit({60, 0.05, true});
  m_result.base = settled_ordinary(m_result.base);
  m_result.best = m_result.base;
  const ModelPtr described = m_result.base;
  ZD_CHECK(search());
  only_what_stands();
  if (m_result.best == m_result.base && m_result.best != described) {
    // Perhaps none had been compared at its best.
    const ModelPtr none = settled_ordinary(m_result.base);
    const bool deeper = total_gain(*none, *described) > clearly_deeper;
    m_result.best = m_result.base = deeper ? none : described;
    if (deeper) {
      ZD_CHECK(search());
      only_what_stands();
    }
  }
  try_settling();
  return m_result;
}

Status Selector::search() {
  m_result.levels.clear();
  m_context.progress(0.15, "screening");
  if (m_context.cancelled()) return fail(ErrorCode::cancelled);
  HiddenPair pair;
  m_result.screened = screen(*m_result.base, m_facts, &pair, m_options.second_screen);
  auto first = refine(m_result.base, m_result.screened, {});
  m_result.levels.push_back(first);
  m_context.progress(0.5, "refitting");
  if (m_context.cancelled()) return fail(ErrorCode::cancelled);
  const std::vector<ModelPtr> leading = leaders_of(first);
  if (!leading.empty()) base_from(*leading.front());
  const bool one_found =
      !leading.empty() && total_gain(*leading.front(), *m_result.base) > least_first(*leading.front());
  const ModelPtr two = with_pair(pair);
  if (!one_found && !found_together(two)) {
    ask_others();
    if (m_result.best != m_result.base) align();
    tell_apart();
    return {};
  }
  m_result.best = one_found ? leading.front() : two;
  if (!one_found) eliminate();
  for (int level = one_found ? 2 : 3; level <= m_options.most_effects; ++level) {
    const ModelPtr before = m_result.best;
    std::vector<ModelPtr> beam = leading;
    if (m_other_valley != nullptr) beam.push_back(m_other_valley);
    if (level == 2) {
      add_one(beam, two);
    } else {
      add_one({m_result.best});
    }
    m_context.progress(0.4 + 0.25 * level, "further_effects");
    if (m_context.cancelled()) return fail(ErrorCode::cancelled);
    if (m_result.best == before) break;
    eliminate();
    // With the others known, another effect may fit better in the place of an earlier one.
    const ModelPtr grown = m_result.best;
    for (int round = 0; round < 3 && swap_one(true); ++round) {
    }
    if (m_result.best != grown) eliminate();
  }
  if (m_options.own_misfit) m_result.best = with_places_tried(m_result.best);
  ask_others();
  align();
  tell_apart();
  return {};
}

Result<Selection> Selector::again(const Selection& selection, const std::shared_ptr<const Dataset>& data) {
  m_result.described = selection.described;
  m_result.screened = selection.screened;
  m_result.base = std::make_shared<Model>(selection.base->machine(), data);
  m_result.base->continue_from(*selection.base);
  m_result.base->fit({});
  m_result.best = std::make_shared<Model>(selection.best->machine(), data);
  m_result.best->continue_from(*selection.best);
  m_result.best->fit({20, 0.05, true});
  if (m_context.cancelled()) return fail(ErrorCode::cancelled);
  eliminate();
  for (int round = 0; round < 2 && swap_one(); ++round) {
  }
  // The last effect of all is judged against none.
  const double gained = m_result.best->log_evidence() - m_result.base->log_evidence();
  if (m_result.best->machine().effects.size() == m_result.described + 1 && gained <= m_options.first) {
    m_result.best = m_result.base;
  }
  only_what_stands();
  try_settling();
  return m_result;
}

/// What is told must stand where it is told: each effect shows its evidence once more against a model without it that
/// was fitted from there, under the noise of the answer.
void Selector::only_what_stands() {
  m_result.without.clear();
  m_result.shown.clear();
  while (m_result.best->machine().effects.size() > m_result.described) {
    const Model& best = *m_result.best;
    const std::vector<std::size_t> named = m_result.effects();
    const double least = named.size() == 1 ? m_options.first : m_options.second_clean;
    std::vector<ModelPtr> without(named.size());
    in_parallel(named.size(), [&](std::size_t i) {
      without[i] = reduced(best, named[i]);
      without[i]->fit({8, 0.05, true});
    });
    std::vector<double> shown(named.size());
    for (std::size_t i = 0; i < named.size(); ++i) {
      const bool last = i + 1 == named.size();
      shown[i] = best.log_evidence() - without[i]->log_evidence();
      if (last) shown[i] += best.elsewhere;
      // Where the others were asked about the last effect, an earlier one may stand by them as well.
      if (!last && shown[i] <= least && best.elsewhere != 0.0) shown[i] += shown_elsewhere(best, *without[i]);
    }
    const auto weakest = std::min_element(shown.begin(), shown.end()) - shown.begin();
    if (shown[static_cast<std::size_t>(weakest)] > least) {
      m_result.without = std::move(without);
      m_result.shown = std::move(shown);
      return;
    }
    m_result.best = without[static_cast<std::size_t>(weakest)];
    if (named.size() > 1) continue;
    if (by_evidence(m_result.best, m_result.base)) m_result.base = m_result.best;
    m_result.best = m_result.base;
  }
}

double Selector::shown_elsewhere(const Model& best, const Model& without) const {
  std::vector<ModelPtr> asked = {std::make_shared<Model>(best)};
  ask_elsewhere(asked, without, m_options.others);
  return asked.empty() ? 0.0 : asked.front()->elsewhere;
}

ModelPtr Selector::under(const Model& model, const std::shared_ptr<const Dataset>& data) {
  auto result = std::make_shared<Model>(model.machine(), data);
  result->continue_from(model);
  result->elsewhere = model.elsewhere;
  result->fit({20, 0.05, true});
  return result;
}

ModelPtr Selector::with_ordinary(const ModelPtr& model) const {
  if (!m_options.own_misfit || m_usual == nullptr) return model;
  auto data =
      std::make_shared<Dataset>(with_discrepancy(*m_usual, ordinary_discrepancy(*m_usual, model->prediction())));
  auto result = std::make_shared<Model>(model->machine(), data);
  result->continue_from(*model);
  result->gain = model->gain;
  result->fit({12, 0.05, true});
  return result;
}

/// A misfit chosen before a fit under it is not yet the one that suits the fit.
ModelPtr Selector::settled_ordinary(ModelPtr model) const {
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds; ++round) {
    ModelPtr next = with_ordinary(model);
    const bool better = round == 0 || total_gain(*next, *model) > clearly_deeper;
    if (better) model = std::move(next);
    if (!better || !m_options.own_misfit) break;
  }
  return model;
}

std::vector<ModelPtr> Selector::leaders_of(const std::vector<ModelPtr>& fits) {
  std::vector<ModelPtr> list;
  std::set<std::string> ids;
  for (const auto& fit : fits) {
    if (fit->log_evidence() < m_result.base->log_evidence() - 1.0 || list.size() == 3) break;
    if (ids.insert(last_effect(*fit).id).second) list.push_back(fit);
  }
  in_parallel(list.size(), [&](std::size_t i) { list[i] = with_ordinary(list[i]); });
  std::sort(list.begin(), list.end(), by_total);
  // Another valley is worth some share of what an effect explains: what is further behind does not get to the front.
  std::vector<ModelPtr> others(list.size());
  const auto near = [&](const Model& model, double share) {
    return total_gain(*list.front(), model) < std::max(60.0, share * total_gain(*list.front(), *m_result.base));
  };
  in_parallel(list.size(), [&](std::size_t i) { others[i] = near(*list[i], 0.1) ? other_valley(list[i]) : nullptr; });
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (others[i] == nullptr) continue;
    if (total_gain(*others[i], *list[i]) > clearly_deeper) {
      std::swap(others[i], list[i]);
      m_moved = true;
    }
    // The lower valley leaves something slow: with a second effect it may be the deeper one.
    if (excess_of(*others[i]).largest < 2.0 || !near(*others[i], 0.03)) continue;
    if (m_other_valley == nullptr || by_total(others[i], m_other_valley)) m_other_valley = others[i];
  }
  std::sort(list.begin(), list.end(), by_total);
  return list;
}

ModelPtr Selector::other_valley(const ModelPtr& model) const {
  if (!m_options.own_misfit || near_its_description(*model)) return nullptr;
  const ModelPtr anew = restarted(*model, m_facts);
  return anew == nullptr ? nullptr : with_ordinary(anew);
}

ModelPtr Selector::in_the_deeper_valley(const ModelPtr& model) {
  ModelPtr other = other_valley(model);
  if (other == nullptr || total_gain(*other, *model) <= clearly_deeper) return model;
  m_moved = true;
  return other;
}

void Selector::base_from(const Model& best) {
  if (!m_moved) return;
  ModelPtr without = reduced(best, best.machine().effects.size() - 1);
  without->fit({15, 0.05, true});
  without = with_ordinary(without);
  if (by_total(without, m_result.base)) m_result.best = m_result.base = without;
}

void Selector::ask_others() {
  while (static_cast<int>(m_result.best->machine().effects.size() - m_result.described) < m_options.most_effects &&
         !m_context.cancelled() && ask_others_for_one()) {
  }
}

bool Selector::ask_others_for_one() {
  const Model& best = *m_result.best;
  if (m_options.others.empty() || !m_options.own_misfit || happened_once(best)) return false;
  std::vector<Candidate> screened = screen(best, m_facts);
  // What a room sensor does wrong is its own in each recording.
  std::erase_if(screened, [](const Candidate& candidate) {
    return physics::happens_once(candidate.spec.id) || candidate.spec.id == "room_sensor_fault";
  });
  const bool alone = m_result.best == m_result.base;
  std::vector<ModelPtr> doubtful = refine(m_result.best, screened, {1, 3.0, 8});
  in_parallel(doubtful.size(), [&](std::size_t i) { doubtful[i] = with_ordinary(doubtful[i]); });
  std::erase_if(doubtful,
                [&](const ModelPtr& fit) { return total_gain(*fit, best) < speaks_against || doubles_a_joint(*fit); });
  ask_elsewhere(doubtful, best, m_options.others);
  const auto together = [&](const ModelPtr& fit) { return total_gain(*fit, best) + fit->elsewhere; };
  // What is not quite right about a strong effect's law shows in both.
  const double least =
      alone ? m_options.together : std::max(m_options.together, least_gain(2.0 * total_gain(best, *m_result.base)));
  std::erase_if(doubtful, [&](const ModelPtr& fit) {
    const double of_its_kind = mends_a_joint(*fit) ? m_options.second : worth_naming(*fit) ? 0.0 : m_options.tiny;
    return together(fit) <= std::max(least, of_its_kind);
  });
  std::sort(doubtful.begin(), doubtful.end(), [&](auto& a, auto& b) { return together(a) > together(b); });
  if (doubtful.empty() || within_tolerance(*doubtful.front())) return false;
  m_result.best = doubtful.front();
  m_result.levels.push_back(std::move(doubtful));
  return true;
}

std::vector<ModelPtr> Selector::rivals_in_doubt(const Model& best, bool asked) const {
  constexpr double in_doubt = 8.0;
  const std::size_t count = best.machine().effects.size();
  const auto doubtful = [&](const ModelPtr& fit) { return best.log_evidence() - fit->log_evidence() < in_doubt; };
  std::vector<ModelPtr> near, forms;
  const auto add_forms = [&](const Model& of, std::size_t end) {
    for (std::size_t e = m_result.described; e < end; ++e) {
      for (const ModelPtr& fit : in_other_forms(of, e, m_facts)) forms.push_back(fit);
    }
  };
  add_forms(best, count);
  for (const auto& level : m_result.levels) {
    for (const ModelPtr& fit : level) {
      const bool other = last_effect(*fit).id != last_effect(best).id && fit->machine().effects.size() == count;
      if (!other || happened_once(*fit) || within_tolerance(*fit) || !doubtful(fit)) continue;
      add_forms(*fit, count - 1);
      if (!asked && !m_options.others.empty() && worth_naming(*fit)) near.push_back(fit);
    }
  }
  std::copy_if(forms.begin(), forms.end(), std::back_inserter(near), doubtful);
  return near;
}

void Selector::tell_apart() {
  const ModelPtr best = m_result.best;
  if (!m_options.own_misfit || best == m_result.base || happened_once(*best)) return;
  const bool asked = best->elsewhere != 0.0;
  std::vector<ModelPtr> near = rivals_in_doubt(*best, asked);
  if (near.empty()) return;
  const auto same_family = [&](const ModelPtr& fit) { return last_effect(*fit).id == last_effect(*best).id; };
  const bool only_forms = std::all_of(near.begin(), near.end(), same_family);
  near.push_back(best);
  const auto without_last = [](const Model& model) {
    ModelPtr less = reduced(model, model.machine().effects.size() - 1);
    less->fit({15, 0.05, true});
    return less;
  };
  std::vector<ModelPtr> fit_there = near;
  ask_elsewhere(fit_there, *without_last(*best), m_options.others);
  // Where none fits there the fitted one decides alone.
  for (const ModelPtr& fit : fit_there.empty() ? near : fit_there) {
    if (evidence_of(*fit) > evidence_of(*m_result.best)) m_result.best = fit;
  }
  Model& told = *m_result.best;
  if (only_forms && !asked && told.log_evidence() >= best->log_evidence()) {
    told.elsewhere = 0.0;  // its form was in doubt, not the effect
  } else if (m_result.best != best) {
    told.elsewhere = shown_elsewhere(told, *without_last(told));
  }
}

void Selector::align() {
  const auto& data = m_result.best->shared_data();
  if (!m_options.own_misfit) return;
  m_result.base = under(*m_result.base, data);
  const std::size_t size = m_result.best->machine().effects.size();
  for (auto& level : m_result.levels) {
    std::vector<ModelPtr> kept;
    std::set<std::string> ids;
    for (const auto& fit : level) {
      if (fit->machine().effects.size() != size || kept.size() == 4) continue;
      if (ids.insert(last_effect(*fit).id).second) kept.push_back(fit);
    }
    in_parallel(kept.size(), [&](std::size_t i) {
      kept[i] = under(*kept[i], data);
      if (!m_moved) return;
      const ModelPtr moved = in_the_valley_of(*kept[i], *m_result.best);
      if (by_evidence(moved, kept[i])) kept[i] = moved;
    });
    level = std::move(kept);
  }
}

bool Selector::swap_one(bool forms) {
  const std::size_t count = m_result.best->machine().effects.size();
  if (forms && count < m_result.described + 2) return false;
  for (std::size_t i = m_result.described; i < count; ++i) {
    const auto rivals = in_place_of(*m_result.best, i, m_facts, forms);
    if (rivals.empty() || doubles_a_joint(*rivals.front())) continue;
    if (rivals.front()->log_evidence() < m_result.best->log_evidence() + 0.5) continue;
    m_result.best = rivals.front();
    return true;
  }
  return false;
}

ModelPtr Selector::with_pair(const HiddenPair& pair) const {
  if (pair.effects.empty() || !m_options.own_misfit) return nullptr;
  const ModelPtr two = extended(*m_result.base, pair.effects);
  two->fit({15, 0.05, true});
  return with_ordinary(two);
}

bool Selector::found_together(const ModelPtr& two) const {
  if (two == nullptr || doubles_a_joint(*two) || within_tolerance(*two)) return false;
  return total_gain(*two, *m_result.base) > least_first(*two) + m_options.second_clean;
}

void Selector::add_one(const std::vector<ModelPtr>& beam, const ModelPtr& pair) {
  std::vector<ModelPtr> fits;
  if (pair != nullptr) fits.push_back(pair);
  for (std::size_t b = 0; b < beam.size(); ++b) {
    const ModelPtr& start = beam[b];
    start->fit({2, 0.05, true});
    auto screened = screen(*start, m_facts);
    const double behind = total_gain(*beam.front(), *start);
    if (!may_catch_up(*start, behind, std::span(beam).first(b), screened)) continue;
    if (screened.size() > 60) screened.resize(60);
    for (auto& fit : refine(start, screened, {1, m_options.second_screen, 7})) fits.push_back(std::move(fit));
  }
  std::sort(fits.begin(), fits.end(), by_total);
  m_result.levels.push_back(fits);
  std::vector<ModelPtr> leading(fits.begin(), fits.begin() + std::min<std::ptrdiff_t>(2, std::ssize(fits)));
  in_parallel(leading.size(), [&](std::size_t i) { leading[i] = with_ordinary(leading[i]); });
  std::sort(leading.begin(), leading.end(), by_total);
  const Excess before = excess_of(*m_result.best);
  for (const auto& fit : leading) {
    if (doubles_a_joint(*fit)) {
      if (const ModelPtr single = one_of_its_joints(*fit)) {
        m_result.best = single;
        return;
      }
    }
    if (accepted(*fit, before)) {
      m_result.best = in_the_deeper_valley(fit);
      return;
    }
  }
}

ModelPtr Selector::one_of_its_joints(const Model& doubled) const {
  ModelPtr best;
  for (std::size_t i = m_result.described; i < doubled.machine().effects.size(); ++i) {
    if (doubled.machine().effects[i].id != "contact_resistance") continue;
    ModelPtr single = reduced(doubled, i);
    single->fit({15, 0.05, true});
    single = with_ordinary(single);
    if (best == nullptr || by_total(single, best)) best = single;
  }
  return best != nullptr && total_gain(*best, *m_result.best) > clearly_deeper ? best : nullptr;
}

double Selector::least_first(const Model& fit) const {
  // What a sound sensor's tolerance explains best is no effect, and no rival's either.
  if (within_tolerance(fit)) return std::numeric_limits<double>::infinity();
  if (!m_options.own_misfit || worth_naming(fit)) return m_options.first;
  // Where something evidently is missing, it is no longer what every machine has.
  const bool evident = excess_of(*m_result.base).largest > least_evident && excess_of(fit).largest < least_evident;
  return evident ? m_options.first : m_options.tiny;
}

bool Selector::accepted(const Model& fit, const Excess& before) const {
  if (doubles_a_joint(fit) || within_tolerance(fit)) return false;
  const double gained = total_gain(fit, *m_result.best);
  const double so_far = total_gain(*m_result.best, *m_result.base);
  if (m_options.own_misfit && gained <= m_options.tiny && !worth_naming(fit)) return false;
  if (before.largest < 2.0 && !mends_a_joint(fit)) return gained > least_gain(so_far);
  if (gained <= std::max(m_options.second, m_options.second_relative * so_far)) return false;
  if (!m_options.excess_must_fall) return true;
  const Excess after = excess_of(fit);
  return after.largest - 1.0 < 0.6 * (before.largest - 1.0) || after.mean - 1.0 < 0.6 * (before.mean - 1.0);
}

void Selector::eliminate() {
  constexpr int most_rounds = 4;
  for (int round = 0; round < most_rounds && remove_one(); ++round) add_one({m_result.best});
}

bool Selector::remove_one() {
  const std::size_t count = m_result.best->machine().effects.size();
  if (count <= m_result.described + 1) return false;
  std::vector<ModelPtr> without(count - m_result.described);
  in_parallel(without.size(), [&](std::size_t i) {
    without[i] = reduced(*m_result.best, m_result.described + i);
    without[i]->fit({15, 0.05, true});
    without[i] = with_ordinary(without[i]);
  });
  for (const ModelPtr& less : without) {
    const double so_far = total_gain(*less, *m_result.base);
    if (total_gain(*m_result.best, *less) >= least_gain(so_far)) continue;
    m_result.best = less;
    return true;
  }
  return false;
}

Excess excess_of(const Dataset& data, const Eigen::VectorXd& residual) {
  Excess excess;
  excess.per_channel = block_excess(data, residual);
  int count = 0;
  for (std::size_t c = 0; c < excess.per_channel.size(); ++c) {
    const MeasuredChannel& channel = data.channels[c];
    if (channel.samples == 0) continue;
    excess.largest = std::max(excess.largest, excess.per_channel[c]);
    if (channel.temperature) excess.warmest = std::max(excess.warmest, excess.per_channel[c]);
    excess.mean += excess.per_channel[c];
    ++count;
  }
  if (count > 0) excess.mean /= count;
  return excess;
}

Excess excess_of(const Model& model) {
  return excess_of(model.data(), model.residual());
}

std::vector<std::size_t> Selection::effects() const {
  std::vector<std::size_t> list;
  for (std::size_t i = described; i < best->machine().effects.size(); ++i) list.push_back(i);
  return list;
}

Result<Selection> reconsider(const Selection& selection, const std::shared_ptr<const Dataset>& data,
                             const physics::RunFacts& facts, const SelectionOptions& options,
                             const TaskContext& context) {
  return Selector(facts, options, context).again(selection, data);
}

Result<Selection> grow_effects(const physics::Machine& machine, std::shared_ptr<const Dataset>& data,
                               const physics::RunFacts& facts, const SelectionOptions& options,
                               const TaskContext& context) {
  return Selector(facts, options, context).grow(machine, data);
}

Result<Selection> select_effects(const physics::Machine& machine, std::shared_ptr<const Dataset> data,
                                 const physics::RunFacts& facts, const SelectionOptions& options,
                                 const TaskContext& context) {
  return Selector(facts, options, context).run(machine, std::move(data));
}

}  // namespace zerodrift::diagnosis
