#include "core/diagnosis/search/stepwise_search.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>

#include "core/diagnosis/description/corrected_value.h"
#include "core/diagnosis/description/description_candidates.h"
#include "core/diagnosis/inference/adequacy.h"
#include "core/diagnosis/inference/parallel.h"
#include "core/diagnosis/search/intervals.h"
#include "core/diagnosis/search/run_facts.h"
#include "core/diagnosis/search/score_test.h"

namespace zerodrift::diagnosis::search {
namespace {

using inference::Evidence;
using inference::Fit;
using inference::HeldEffect;
using inference::Hypothesis;
using inference::JointModel;

struct Node {
  std::shared_ptr<Fit> settled;   // at its own most likely sizes
  std::shared_ptr<Fit> straight;  // its effects beside the description as it is, at the usual sizes: not fitted
  double adequacy = 1.0;          // probability of what it leaves at the usual sizes, when nothing is missing
  double log_evidence = 0.0;
  std::size_t parent = 0;  // index among the nodes
  bool extended = false;
  bool swapped = false;
  bool roughly = false;  // fitted in a few steps, from its parent alone
};

/// A child still to be fitted.
struct Proposal {
  std::size_t parent = 0;
  bool from_straight = false;
  Candidate candidate;
  Score score;
  std::optional<DescriptionError> error = {};  // instead of the candidate
};

class Search {
 public:
  Search(std::shared_ptr<const Evidence> evidence, const TaskContext& context)
      : m_evidence(std::move(evidence)), m_settings(m_evidence->settings()), m_context(context) {
    for (const auto& run : m_evidence->runs()) m_facts.push_back(run_facts(m_evidence->machine(), run.recording));
  }

  Result<Posterior> run() {
    m_context.progress(0.0, "fitting");
    m_nodes.push_back(
        fitted_node(std::make_shared<Fit>(model_of({m_evidence->machine(), {}, 0.0}), m_evidence->usual_sizes())));
    for (int round = 0; round < m_settings.most_rounds; ++round) {
      if (m_context.cancelled()) return fail(ErrorCode::cancelled);
      m_context.progress((round + 1.0) / (m_settings.most_rounds + 1.0), "searching");
      if (!extend_best()) break;
    }
    swap_of_best();
    if (m_context.cancelled()) return fail(ErrorCode::cancelled);
    return posterior();
  }

 private:
  std::shared_ptr<const JointModel> model_of(Hypothesis hypothesis) const {
    return std::make_shared<JointModel>(std::move(hypothesis), m_evidence);
  }

  /// Fitted from where it starts and, lest it stays in a valley that the parent was bent into, from the description;
  /// the latter only where it could become the best.
  Node fitted_node(std::shared_ptr<Fit> start, bool also_from_description = true) {
    Node node;
    node.straight = std::make_shared<Fit>(*start);
    node.straight->set_sizes(m_evidence->usual_sizes());
    node.straight->reset_description();
    node.settled = std::move(start);
    node.settled->settle();
    node.log_evidence = node.settled->log_evidence();
    const bool could_win =
        also_from_description && !m_nodes.empty() && ahead(node.log_evidence, *node.settled) > -m_settings.margin;
    if (could_win) {
      auto other = std::make_shared<Fit>(*node.straight);
      other->settle();
      if (const double found = other->log_evidence(); found > node.log_evidence) {
        node.settled = std::move(other);
        node.log_evidence = found;
      }
    }
    Fit usual(*node.settled);
    usual.set_sizes(m_evidence->usual_sizes());
    node.adequacy = inference::adequacy(usual);
    ++m_fitted;
    return node;
  }

  /// The best proposals of one fit of a node.
  void propose(std::size_t at, bool straight, std::vector<Proposal>& list) const {
    propose_of(m_nodes[at], straight, at, list);
  }

  void propose_of(const Node& node, bool straight, std::size_t at, std::vector<Proposal>& list) const {
    const Fit& fit = straight ? *node.straight : *node.settled;
    std::vector<Candidate> candidates = candidates_for(fit.model().hypothesis(), m_facts, m_settings.effect_log_prior);
    // When something may have acted is only looked for where anything is left.
    if (node.adequacy < m_settings.significance) {
      std::vector<Candidate> timed = interval_candidates(fit, m_facts);
      std::move(timed.begin(), timed.end(), std::back_inserter(candidates));
    }
    const std::vector<Score> scores = score_test(fit, candidates);
    std::vector<std::size_t> order(candidates.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return scores[a].log_odds > scores[b].log_odds; });
    std::map<std::string, std::size_t> of_kind;
    std::size_t taken = 0;
    for (const std::size_t i : order) {
      // Far behind the best, an effect can wait until that one is in the model.
      constexpr double share = 0.05;  // of the best one's log odds
      const double least = std::max(-m_settings.decisive, share * scores[order.front()].log_odds);
      if (taken == m_settings.proposals || scores[i].log_odds < least) break;
      if (of_kind[candidates[i].effect.spec.id]++ >= m_settings.forms_of_a_kind) continue;
      list.push_back({at, straight, candidates[i], scores[i]});
      ++taken;
    }
  }

  /// Mistakes in the description, where a hypothesis leaves more than it should, bends the description to suit, or lets
  /// an effect promise anything.
  void propose_errors(std::size_t at, std::vector<Proposal>& list) const {
    const Node& node = m_nodes[at];
    const bool promised = std::any_of(list.begin(), list.end(), [&](const Proposal& one) {
      return one.parent == at && one.score.log_odds > m_settings.decisive;
    });
    if (!promised && node.adequacy >= m_settings.significance &&
        inference::bending(*node.settled) >= m_settings.significance)
      return;
    Fit usual(*node.straight);
    usual.fit({m_settings.iterations, true});
    for (auto& [error, log_odds] :
         description::description_candidates(*node.straight, usual, *node.settled, m_settings.proposals))
      list.push_back({at, true, {}, {log_odds, {}, 0.0}, std::move(error)});
  }

  std::shared_ptr<Fit> child_of(const Proposal& proposal) const { return child_of(proposal, m_nodes[proposal.parent]); }

  std::shared_ptr<Fit> child_of(const Proposal& proposal, const Node& node) const {
    const Fit& parent = proposal.from_straight ? *node.straight : *node.settled;
    if (proposal.error) return description::fitted_with(parent, *proposal.error);
    Hypothesis hypothesis = parent.model().hypothesis();
    const auto added = static_cast<int>(hypothesis.effects.size());
    hypothesis.effects.push_back(proposal.candidate.effect);
    hypothesis.log_prior += proposal.candidate.log_prior;
    auto fit = std::make_shared<Fit>(model_of(std::move(hypothesis)), parent.sizes());
    fit->start_from(parent, true);
    std::size_t amplitude = 0;
    for (std::size_t i = 0; i < fit->model().unknowns(); ++i) {
      const auto& unknown = fit->model().unknown(i);
      if (unknown.effect != added || !unknown.parameter.amplitude) continue;
      if (amplitude < proposal.score.step.size())
        fit->set_z(i, std::clamp(proposal.score.step[amplitude++], -3.0, 3.0));
    }
    fit->fit({4, false});
    return fit;
  }

  std::shared_ptr<Fit> without(const Fit& fit, std::size_t effect) const {
    Hypothesis hypothesis = fit.model().hypothesis();
    hypothesis.effects.erase(hypothesis.effects.begin() + static_cast<std::ptrdiff_t>(effect));
    // The prior of what stays: as when it was proposed.
    hypothesis.log_prior = 0.0;
    for (const HeldEffect& held : hypothesis.effects) hypothesis.log_prior += held.spec.log_prior;
    for (const DescriptionError& error : hypothesis.errors) hypothesis.log_prior += error.log_prior();
    auto reduced = std::make_shared<Fit>(model_of(std::move(hypothesis)), fit.sizes());
    reduced->start_from(fit, false);
    return reduced;
  }

  /// The same effects at nearly the same places.
  bool known(const Fit& fit) const {
    return std::any_of(m_nodes.begin(), m_nodes.end(), [&](const Node& node) { return alike(*node.settled, fit); });
  }

  static bool alike(const Fit& a, const Fit& b) {
    const auto& one = a.model().hypothesis().effects;
    const auto& two = b.model().hypothesis().effects;
    if (one.size() != two.size() || !same_errors(a.model().hypothesis(), b.model().hypothesis())) return false;
    std::vector<bool> used(two.size(), false);
    for (std::size_t i = 0; i < one.size(); ++i) {
      bool found = false;
      for (std::size_t j = 0; j < two.size() && !found; ++j) {
        if (used[j] || one[i].spec.id != two[j].spec.id || one[i].spec.words != two[j].spec.words ||
            one[i].run != two[j].run || !near(a, static_cast<int>(i), b, static_cast<int>(j)))
          continue;
        used[j] = found = true;
      }
      if (!found) return false;
    }
    return true;
  }

  static bool same_errors(const Hypothesis& a, const Hypothesis& b) {
    constexpr double same = 0.1;  // of what a value may be
    return std::is_permutation(a.errors.begin(), a.errors.end(), b.errors.begin(), b.errors.end(),
                               [](const DescriptionError& one, const DescriptionError& two) {
                                 return name_of(one) == name_of(two) && one.other == two.other &&
                                        (!is_sought(one) || std::abs(one.value - two.value) < same * one.spread);
                               });
  }

  /// Places and moments that were fitted agree.
  static bool near(const Fit& a, int effect_a, const Fit& b, int effect_b) {
    constexpr double same = 0.5;  // prior standard deviations of a place or a moment
    for (std::size_t i = 0; i < a.model().unknowns(); ++i) {
      const auto& unknown = a.model().unknown(i);
      if (unknown.effect != effect_a || unknown.parameter.amplitude || unknown.parameter.logarithmic) continue;
      for (std::size_t k = 0; k < b.model().unknowns(); ++k) {
        const auto& other = b.model().unknown(k);
        if (other.effect != effect_b || other.parameter.key != unknown.parameter.key) continue;
        if (std::abs(a.value(i) - b.value(k)) > same * unknown.parameter.sigma) return false;
      }
    }
    return true;
  }

  double highest() const {
    double best = -1e300;
    for (const Node& node : m_nodes) best = std::max(best, rank(node));
    return best;
  }

  /// Evidence counts as far as the best description so far can be trusted.
  double rank(double log_evidence, const Fit& fit) const {
    return m_trust * log_evidence + fit.model().hypothesis().log_prior;
  }
  double rank(const Node& node) const { return rank(node.log_evidence, *node.settled); }

  const Node& best() const {
    return *std::max_element(m_nodes.begin(), m_nodes.end(),
                             [&](const Node& a, const Node& b) { return rank(a) < rank(b); });
  }

  /// Of a hypothesis over the best so far.
  double ahead(double log_evidence, const Fit& fit) const {
    const Node& first = best();
    return rank(log_evidence, fit) - rank(first);
  }

  void choose_trust() {
    const Node* best = &m_nodes.front();
    for (const Node& node : m_nodes) {
      if (node.log_evidence + node.settled->model().hypothesis().log_prior >
          best->log_evidence + best->settled->model().hypothesis().log_prior)
        best = &node;
    }
    m_trust = m_evidence->trust(best->settled->sizes());
  }

  /// What a hypothesis says, apart from figures: ids with the part or channel that each acts on.
  static std::string kind_of(const Hypothesis& hypothesis) {
    std::vector<std::string> names;
    for (const HeldEffect& held : hypothesis.effects) {
      std::string name = held.spec.id;
      for (const char* word : {"component", "channel", "driver"}) name += ":" + held.spec.word_or(word, "");
      names.push_back(std::move(name));
    }
    for (const DescriptionError& error : hypothesis.errors) names.push_back(diagnosis::name_of(error));
    std::sort(names.begin(), names.end());
    std::string kind;
    for (const std::string& name : names) kind += name + " ";
    return kind;
  }

  /// How far behind the best a hypothesis may be and still lead to it. While much is unexplained, differences between
  /// incomplete hypotheses say little: a tenth of what was gained so far.
  double search_margin() const { return std::max(m_settings.margin, 0.1 * (highest() - rank(m_nodes.front()))); }

  /// The nodes to extend next: the best of each kind that were not extended.
  std::vector<std::size_t> beam() const {
    std::vector<std::size_t> order;
    for (std::size_t i = 0; i < m_nodes.size(); ++i) {
      if (rank(m_nodes[i]) > highest() - search_margin()) order.push_back(i);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return rank(m_nodes[a]) > rank(m_nodes[b]); });
    std::vector<std::size_t> list;
    std::set<std::string> kinds;
    for (const std::size_t i : order) {
      if (kinds.insert(kind_of(m_nodes[i].settled->model().hypothesis())).second && !m_nodes[i].extended)
        list.push_back(i);
      if (list.size() == m_settings.beam) break;
    }
    return list;
  }

  bool extend_best() {
    std::vector<Proposal> proposals;
    for (const std::size_t at : beam()) {
      m_nodes[at].extended = true;
      if (m_nodes[at].settled->model().hypothesis().effects.size() >= static_cast<std::size_t>(m_settings.most_effects))
        continue;
      propose(at, false, proposals);
      propose(at, true, proposals);
      propose_errors(at, proposals);
    }
    if (proposals.empty()) return false;
    std::vector<std::shared_ptr<Fit>> children(proposals.size());
    std::vector<double> promise(proposals.size(), -1e300);
    in_parallel(proposals.size(), [&](std::size_t i) {
      if (m_context.cancelled()) return;
      children[i] = child_of(proposals[i]);
      // What the linear model promises of other sizes has to be reached.
      if (children[i]->choose_sizes()) children[i]->fit({4, false});
      promise[i] = ahead(children[i]->log_evidence_at(children[i]->sizes()), *children[i]);
    });
    if (m_context.cancelled()) return false;
    std::vector<std::size_t> order(children.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return promise[a] > promise[b]; });
    const double best = promise[order.front()];
    remember(children);
    std::vector<std::shared_ptr<Fit>> kept;
    std::map<std::string, std::size_t> of_kind;
    for (const std::size_t i : order) {
      if (promise[i] < std::max(best, 0.0) - search_margin()) break;
      const bool twice =
          std::any_of(kept.begin(), kept.end(), [&](const auto& one) { return alike(*one, *children[i]); });
      if (twice || known(*children[i])) continue;
      if (of_kind[kind_of(children[i]->model().hypothesis())]++ >= m_settings.forms_of_a_kind) continue;
      kept.push_back(children[i]);
      if (kept.size() == m_settings.followed) break;
    }
    return take_in(kept);
  }

  /// What is not promising enough to be followed is a rival all the same.
  void remember(const std::vector<std::shared_ptr<Fit>>& children) {
    for (const std::shared_ptr<Fit>& child : children) {
      Node node;
      node.settled = child;
      node.log_evidence = child->log_evidence_at(child->sizes());
      node.roughly = node.extended = node.swapped = true;
      m_rivals.push_back(std::move(node));
    }
  }

  /// Fits what is promising to the end, and what it is without each of its effects. True where the best has improved.
  bool take_in(const std::vector<std::shared_ptr<Fit>>& kept) {
    const Fit* before = best().settled.get();
    std::vector<Node> fresh(kept.size());
    in_parallel(kept.size(), [&](std::size_t i) { fresh[i] = fitted_node(kept[i]); });
    for (Node& node : fresh) m_nodes.push_back(std::move(node));
    std::vector<std::shared_ptr<Fit>> reduced;
    const std::size_t first = m_nodes.size() - fresh.size();
    for (std::size_t i = first; i < m_nodes.size(); ++i) {
      const auto& effects = m_nodes[i].settled->model().hypothesis().effects;
      if (effects.size() < 2 || rank(m_nodes[i]) < highest()) continue;
      for (std::size_t e = 0; e + 1 < effects.size(); ++e) {
        auto less = without(*m_nodes[i].settled, e);
        if (!known(*less)) reduced.push_back(std::move(less));
      }
    }
    std::vector<Node> less(reduced.size());
    in_parallel(reduced.size(), [&](std::size_t i) { less[i] = fitted_node(reduced[i], false); });
    for (Node& node : less) m_nodes.push_back(std::move(node));
    return best().settled.get() != before;
  }

  /// Each effect of the best exchanged for what else could be there in its place.
  void swap_of_best() {
    std::size_t best = 0;
    for (std::size_t i = 1; i < m_nodes.size(); ++i) {
      if (rank(m_nodes[i]) > rank(m_nodes[best])) best = i;
    }
    const Hypothesis& hypothesis = m_nodes[best].settled->model().hypothesis();
    if (hypothesis.effects.size() < 2 || m_nodes[best].swapped) return;
    m_nodes[best].swapped = true;
    std::vector<Proposal> proposals;
    std::vector<Node> reduced(hypothesis.effects.size());
    for (std::size_t e = 0; e < hypothesis.effects.size(); ++e) {
      reduced[e].settled = without(*m_nodes[best].settled, e);
      reduced[e].settled->fit({m_settings.iterations, true});
      reduced[e].adequacy = 0.0;
      propose_of(reduced[e], false, e, proposals);
    }
    std::vector<std::shared_ptr<Fit>> children(proposals.size());
    std::vector<double> promise(proposals.size(), -1e300);
    in_parallel(proposals.size(), [&](std::size_t i) {
      if (m_context.cancelled()) return;
      children[i] = child_of(proposals[i], reduced[proposals[i].parent]);
      if (children[i]->choose_sizes()) children[i]->fit({4, false});
      promise[i] = ahead(children[i]->log_evidence_at(children[i]->sizes()), *children[i]);
    });
    if (m_context.cancelled()) return;
    remember(children);
    std::vector<std::shared_ptr<Fit>> kept;
    for (std::size_t i = 0; i < children.size(); ++i) {
      const bool twice =
          std::any_of(kept.begin(), kept.end(), [&](const auto& one) { return alike(*one, *children[i]); });
      if (promise[i] > -m_settings.margin && !twice && !known(*children[i])) kept.push_back(children[i]);
    }
    std::vector<Node> fresh(kept.size());
    in_parallel(kept.size(), [&](std::size_t i) { fresh[i] = fitted_node(kept[i]); });
    for (Node& node : fresh) m_nodes.push_back(std::move(node));
  }

  /// Everything that was fitted, evidence counted as far as the best description can be trusted. What then comes first
  /// is fitted to the end.
  Posterior posterior() {
    choose_trust();
    const Fit* described = m_nodes.front().settled.get();
    Posterior out;
    out.evidence = m_evidence;
    out.described_straight = m_nodes.front().straight;
    std::move(m_rivals.begin(), m_rivals.end(), std::back_inserter(m_nodes));
    while (true) {
      std::stable_sort(m_nodes.begin(), m_nodes.end(), [&](const Node& a, const Node& b) { return rank(a) > rank(b); });
      if (!m_nodes.front().roughly) break;
      m_nodes.front() = fitted_node(m_nodes.front().settled);
    }
    out.fitted = m_fitted;
    const double highest = rank(m_nodes.front());
    for (const Node& node : m_nodes) {
      const bool is_described = node.settled.get() == described;
      if (!is_described && rank(node) < highest - m_settings.margin) continue;
      const bool twice = std::any_of(out.explanations.begin(), out.explanations.end(),
                                     [&](const auto& one) { return alike(*one.fit, *node.settled); });
      if (twice) continue;
      if (is_described) out.described = out.explanations.size();
      out.explanations.push_back({node.settled, rank(node)});
    }
    return out;
  }

  std::shared_ptr<const Evidence> m_evidence;
  const DiagnosisSettings& m_settings;
  const TaskContext& m_context;
  std::vector<physics::RunFacts> m_facts;
  std::vector<Node> m_nodes;
  std::vector<Node> m_rivals;  // fitted roughly
  double m_trust = 1.0;        // of the evidence
  std::atomic<int> m_fitted{0};
};

}  // namespace

Result<Posterior> stepwise_search(std::shared_ptr<const Evidence> evidence, const TaskContext& context) {
  return Search(std::move(evidence), context).run();
}

}  // namespace zerodrift::diagnosis::search
