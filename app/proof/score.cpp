#include "app/proof/score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace zerodrift::proof {
namespace {

using nlohmann::json;

constexpr int reliability_bins = 5;
constexpr double least_evidence = 8.0;  // that names an effect (diagnosis::SelectionOptions)

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

double median(const std::vector<double>& values) {
  return quantile(values, 0.5);
}

std::string kind_of(const std::string& channel) {
  return channel.rfind("dZ", 0) == 0 ? "dZ" : channel.rfind("dY", 0) == 0 ? "dY" : "T";
}

/// A source that is always on has two names in the list of effects; either is right.
std::string id_of(const json& effect, const OpenedAnswer& truth) {
  std::string id = effect.at("id");
  const auto hidden = [&](const char* other) {
    return std::find_if(truth.effects.begin(), truth.effects.end(), [&](const auto& e) { return e.id == other; });
  };
  const auto extra = hidden("extra_heat_source");
  if (id == "standing_heat" && extra != truth.effects.end() && extra->law == "constant") return extra->id;
  const json law = effect.value("parameters", json::object()).value("law", json());
  if (id == "extra_heat_source" && law == "constant" && hidden("standing_heat") != truth.effects.end()) {
    return "standing_heat";
  }
  return id;
}

/// Does one who is told what is hidden know its place well enough to tell it as a point (diagnosis: widest_point_mm)?
bool place_is_decidable(const OpenedAnswer& truth, const std::string& id) {
  constexpr double widest_point_mm = 6.0;
  const auto told = truth.told_place_sigma_mm.find(id == "standing_heat" ? "extra_heat_source" : id);
  return told != truth.told_place_sigma_mm.end() && told->second <= widest_point_mm;
}

std::string answer_of(const json& diagnosis, const OpenedAnswer& truth) {
  std::string verdict = diagnosis.value("verdict", "");
  if (verdict != "missing_effect") return verdict;
  std::string answer;
  for (const auto& effect : diagnosis.at("effects")) {
    answer += (answer.empty() ? "" : "+") + id_of(effect, truth);
  }
  return answer;
}

Outcome outcome_of(const OpenedAnswer& truth, const json& diagnosis) {
  const std::string verdict = diagnosis.value("verdict", "");
  const auto& effects = diagnosis.at("effects");
  const bool names = verdict == "missing_effect" && !effects.empty();
  if (truth.effects.empty()) return verdict == "consistent" ? Outcome::right : Outcome::false_alarm;
  if (verdict == "consistent") return Outcome::missed;
  if (truth.unlisted) return verdict == "unexplained" ? Outcome::right : Outcome::wrong_name;
  if (!names) return Outcome::given_up;
  std::multiset<std::string> hidden, named;  // the same name twice is one too many
  for (const auto& effect : truth.effects) hidden.insert(effect.id);
  for (const auto& effect : effects) named.insert(id_of(effect, truth));
  if (hidden == named) return Outcome::right;
  return hidden.count(id_of(effects.front(), truth)) != 0 ? Outcome::first_right : Outcome::wrong_name;
}

/// Which hidden effects the answer does not name, and what it said about their sizes.
std::vector<NotNamed> not_named(const OpenedAnswer& truth, const json& diagnosis) {
  std::vector<NotNamed> list;
  if (truth.unlisted) return list;
  std::multiset<std::string> named;
  if (diagnosis.value("verdict", "") == "missing_effect") {
    for (const auto& effect : diagnosis.at("effects")) named.insert(id_of(effect, truth));
  }
  const json could = diagnosis.value("could_have_detected", json::object());
  for (const auto& hidden : truth.effects) {
    if (const auto at = named.find(hidden.id); at != named.end()) {
      named.erase(at);
      continue;
    }
    NotNamed one{hidden.id, "", 0.0, 0.0};
    if (const auto least = could.find(hidden.id); least != could.end()) {
      const auto size = hidden.sizes.find(least->value("key", ""));
      if (size != hidden.sizes.end()) one = {hidden.id, size->first, size->second, least->at("value").get<double>()};
    }
    list.push_back(std::move(one));
  }
  return list;
}

ProofFigure share_figure(const std::string& id, const std::string& label, int good, int all, double must, bool least) {
  ProofFigure figure{id, label, "-", "", fmt::format("{} {:.0f} %", least ? "at least" : "at most", 100 * must), {}};
  if (all == 0) return figure;
  const double share = static_cast<double>(good) / all;
  figure.value = fmt::format("{}/{} = {:.1f}", good, all, 100 * share);
  figure.unit = "%";
  figure.met = least ? share >= must : share <= must;
  return figure;
}

/// A share that explains another one and has no limit of its own.
ProofFigure plain_share(const std::string& id, const std::string& label, int good, int all) {
  ProofFigure figure = share_figure(id, label, good, all, 0.0, true);
  figure.limit = "-";
  figure.met.reset();
  return figure;
}

ProofFigure number_figure(const std::string& id, const std::string& label, double value, int digits,
                          const std::string& unit, double must) {
  ProofFigure figure{id, label, "-", unit, fmt::format("at most {:g}{}{}", must, unit.empty() ? "" : " ", unit), {}};
  if (!std::isfinite(value)) return figure;
  figure.value = fmt::format("{:.{}f}", value, digits);
  figure.met = value <= must;
  return figure;
}

/// A number that explains another one and has no limit of its own.
ProofFigure plain_number(const std::string& id, const std::string& label, double value, int digits,
                         const std::string& unit) {
  ProofFigure figure = number_figure(id, label, value, digits, unit, 0.0);
  figure.limit = "-";
  figure.met.reset();
  return figure;
}

}  // namespace

std::string OpenedAnswer::words() const {
  if (effects.empty()) return "none";
  std::vector<std::string> ids;
  for (const auto& effect : effects) ids.push_back(effect.id);
  std::sort(ids.begin(), ids.end());
  return fmt::format("{}", fmt::join(ids, "+"));
}

bool Judgement::decidable() const {
  return !told || *told >= least_evidence;
}

std::string name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::right:
      return "right";
    case Outcome::first_right:
      return "first right";
    case Outcome::wrong_name:
      return "wrong name";
    case Outcome::given_up:
      return "given up";
    case Outcome::missed:
      return "missed";
    case Outcome::false_alarm:
      return "false alarm";
    case Outcome::failed:
      break;
  }
  return "failed";
}

Judgement Score::add(const OpenedAnswer& truth, const json& diagnosis) {
  for (const std::string& id : truth.put_aside) ++m_put_aside[id];
  Judgement judgement;
  judgement.name = truth.name;
  judgement.truth = truth.words();
  judgement.answer = answer_of(diagnosis, truth);
  judgement.outcome = outcome_of(truth, diagnosis);
  judgement.strength = truth.strength;
  judgement.left = truth.left;
  judgement.told = truth.told;
  judgement.seconds = diagnosis.value("seconds", 0.0);
  m_seconds.push_back(judgement.seconds);
  if (diagnosis.contains("processor_seconds")) m_processor_s.push_back(diagnosis.at("processor_seconds"));
  judgement.not_named = not_named(truth, diagnosis);
  const auto& effects = diagnosis.at("effects");
  const bool names = diagnosis.value("verdict", "") == "missing_effect" && !effects.empty();
  if (names) {
    judgement.confidence = effects.front().value("confidence", 0.0);
    m_confidence.emplace_back(judgement.confidence,
                              judgement.outcome == Outcome::right || judgement.outcome == Outcome::first_right);
  }
  if (!truth.effects.empty() && judgement.outcome != Outcome::missed) {
    const auto& channels = diagnosis.at("mismatch").at("channels");
    m_channel.add(!channels.empty() && channels.front() == truth.worst_channel);
  }
  count_location(truth, diagnosis, judgement);
  count_outcome(truth, judgement);
  count_rms(truth, diagnosis);
  m_judgements.push_back(judgement);
  return judgement;
}

Judgement Score::add_failure(const OpenedAnswer& truth, const std::string& answer) {
  for (const std::string& id : truth.put_aside) ++m_put_aside[id];
  Judgement judgement;
  judgement.name = truth.name;
  judgement.truth = truth.words();
  judgement.answer = answer;
  judgement.strength = truth.strength;
  judgement.left = truth.left;
  count_outcome(truth, judgement);
  m_judgements.push_back(judgement);
  return judgement;
}

void Score::count_outcome(const OpenedAnswer& truth, const Judgement& judgement) {
  ++m_confusion[judgement.truth][judgement.answer];
  const bool right = judgement.outcome == Outcome::right;
  m_first.add(right || judgement.outcome == Outcome::first_right);
  m_all_right.add(right);
  if (truth.effects.empty()) {
    m_quiet.add(right);
  } else if (truth.unlisted) {
    m_unlisted.add(right);
  } else {
    m_missed.add(judgement.outcome == Outcome::missed);
    if (truth.effects.size() == 2) m_pairs.add(right);
    if (truth.effects.size() == 2 && judgement.decidable()) m_pairs_decidable.add(right);
  }
}

void Score::count_location(const OpenedAnswer& truth, const json& diagnosis, Judgement& judgement) {
  for (const auto& hidden : truth.effects) {
    if (!hidden.position_mm) continue;
    for (const auto& effect : diagnosis.at("effects")) {
      if (id_of(effect, truth) != hidden.id || !effect.at("position_mm").is_number()) continue;
      judgement.location_error_mm = std::abs(effect.at("position_mm").get<double>() - *hidden.position_mm);
      m_location_mm.push_back(*judgement.location_error_mm);
      if (place_is_decidable(truth, hidden.id)) m_decidable_mm.push_back(*judgement.location_error_mm);
      const double stated_mm = effect.value("sigma", json::object()).value("position_mm", 0.0);
      m_location_stated.add(*judgement.location_error_mm <= 2.0 * stated_mm);
      if (const auto between = effect.find("between_mm"); between != effect.end() && between->is_array()) {
        m_stretch.add(*hidden.position_mm >= between->at(0) && *hidden.position_mm <= between->at(1));
      } else {
        m_point_mm.push_back(*judgement.location_error_mm);
      }
    }
  }
}

void Score::count_rms(const OpenedAnswer& truth, const json& diagnosis) {
  // What nobody listed cannot be predicted; it would only blur these figures.
  if (truth.unlisted) return;
  const auto& rmse = diagnosis.at("rmse");
  for (const bool second : {false, true}) {
    const auto part = [&](const char* fitted, const char* held) { return rmse.value(second ? held : fitted, json()); };
    const json before = part("before", "held_out_before");
    const json refitted = part("refitted", "held_out_refitted");
    const json after = part("after", "held_out_after");
    for (const auto& [channel, value] : after.items()) {
      const auto floor = truth.floor.find(channel);
      if (!value.is_number() || floor == truth.floor.end() || !before.contains(channel)) continue;
      Rms& rms = m_rms[{kind_of(channel), second}];
      rms.nominal.push_back(before.at(channel).get<double>());
      rms.refitted.push_back(refitted.value(channel, std::nan("")));
      rms.explained.push_back(value.get<double>());
      rms.floor.push_back(floor->second);
      const auto reached = truth.reached.find(channel);
      if (!second || reached == truth.reached.end()) continue;
      rms.reached.push_back(reached->second);
      rms.explained_there.push_back(value.get<double>());
    }
  }
}

std::vector<Score::Bin> Score::reliability() const {
  std::vector<Bin> bins(reliability_bins);
  for (int b = 0; b < reliability_bins; ++b) {
    bins[static_cast<std::size_t>(b)].low = static_cast<double>(b) / reliability_bins;
    bins[static_cast<std::size_t>(b)].high = static_cast<double>(b + 1) / reliability_bins;
  }
  for (const auto& [confidence, right] : m_confidence) {
    Bin& bin = bins[static_cast<std::size_t>(
        std::clamp(static_cast<int>(confidence * reliability_bins), 0, reliability_bins - 1))];
    bin.confidence += confidence;
    bin.right += right ? 1.0 : 0.0;
    ++bin.cases;
  }
  for (Bin& bin : bins) {
    if (bin.cases == 0) continue;
    bin.confidence /= bin.cases;
    bin.right /= bin.cases;
  }
  return bins;
}

double Score::expected_calibration_error() const {
  double sum = 0.0;
  for (const Bin& bin : reliability()) sum += bin.cases * std::abs(bin.confidence - bin.right);
  return m_confidence.empty() ? std::nan("") : sum / static_cast<double>(m_confidence.size());
}

std::vector<Score::Improvement> Score::improvements() const {
  std::vector<Improvement> list;
  for (const char* kind : {"T", "dZ", "dY"}) {
    for (const bool second : {false, true}) {
      const auto at = m_rms.find({kind, second});
      if (at == m_rms.end()) continue;
      const Rms& rms = at->second;
      Improvement one{kind,
                      second,
                      median(rms.nominal),
                      median(rms.refitted),
                      median(rms.explained),
                      median(rms.floor),
                      0.0,
                      static_cast<int>(rms.explained.size()),
                      median(rms.reached),
                      median(rms.explained_there) / median(rms.reached),
                      std::nan("")};
      std::vector<double> ratios;
      for (std::size_t i = 0; i < rms.reached.size(); ++i) {
        ratios.push_back(rms.explained_there[i] / std::max(1e-9, rms.reached[i]));
      }
      one.median_over_reached = median(ratios);
      for (std::size_t i = 0; i < rms.explained.size(); ++i) {
        one.worst_over_floor = std::max(one.worst_over_floor, rms.explained[i] / std::max(1e-9, rms.floor[i]));
      }
      list.push_back(one);
    }
  }
  return list;
}

std::vector<ProofFigure> Score::figures() const {
  std::vector<ProofFigure> list;
  list.push_back(share_figure("first_right", "effect named right, first of the list, all cases", m_first.good,
                              m_first.all, 0.92, true));
  list.push_back(share_figure("all_right", "all effects right", m_all_right.good, m_all_right.all, 0.91, true));
  list.push_back(share_figure("pairs", "two effects, both named", m_pairs.good, m_pairs.all, 0.95, true));
  list.push_back(plain_share("pairs_decidable", "pairs that the recording can decide, both named",
                             m_pairs_decidable.good, m_pairs_decidable.all));
  list.push_back(share_figure("false_alarms", "false alarms when nothing is missing", m_quiet.all - m_quiet.good,
                              m_quiet.all, 0.0, false));
  list.push_back(
      share_figure("missed", "effect there but called consistent", m_missed.good, m_missed.all, 0.07, false));
  list.push_back(
      share_figure("unlisted", "unlisted effect called unexplained", m_unlisted.good, m_unlisted.all, 0.75, true));
  list.push_back(
      share_figure("channel", "channel with the largest mismatch named", m_channel.good, m_channel.all, 0.85, true));
  list.push_back(number_figure("location_median_mm", "location, median", median(m_location_mm), 1, "mm", 2.0));
  list.push_back(number_figure("location_worst_mm", "location, worst", quantile(m_location_mm, 1.0), 1, "mm", 12.0));
  list.push_back(plain_number("location_decidable_median_mm", "location that one who is told knows to 6 mm, median",
                              median(m_decidable_mm), 1, "mm"));
  list.push_back(plain_number("location_decidable_worst_mm", "location that one who is told knows to 6 mm, worst",
                              quantile(m_decidable_mm, 1.0), 1, "mm"));
  list.push_back(plain_share("location_stated", "location within twice the stated uncertainty", m_location_stated.good,
                             m_location_stated.all));
  list.push_back(plain_number("location_point_median_mm", "location where it is told as a point, median",
                              median(m_point_mm), 1, "mm"));
  list.push_back(plain_number("location_point_worst_mm", "location where it is told as a point, worst",
                              quantile(m_point_mm, 1.0), 1, "mm"));
  list.push_back(plain_share("location_stretch", "location where it is told as a stretch, within it", m_stretch.good,
                             m_stretch.all));
  for (const Improvement& one : improvements()) {
    if (!one.second || !std::isfinite(one.over_reached)) continue;
    const double must = one.kind == "T" ? 1.2 : one.kind == "dZ" ? 1.0 : 2.0;
    list.push_back(number_figure("held_out_" + one.kind,
                                 "held-out recording, " + one.kind + ", over what the true structure reaches",
                                 one.over_reached, 4, "times", must));
  }
  list.push_back(number_figure("calibration_error", "confidence: expected calibration error",
                               expected_calibration_error(), 3, "", 0.10));
  list.push_back(number_figure("seconds_median", "whole diagnosis, median", median(m_seconds), 2, "s", 2.0));
  list.push_back(
      number_figure("processor_median", "whole diagnosis, processor time, median", median(m_processor_s), 2, "s", 2.0));
  return list;
}

Score::Undecidable Score::undecidable() const {
  Undecidable count;
  for (const Judgement& one : m_judgements) {
    if (one.outcome == Outcome::right || !one.told) continue;
    ++count.wrong;
    count.undecidable += one.decidable() ? 0 : 1;
    for (const NotNamed& effect : one.not_named) {
      count.compared += effect.compared() ? 1 : 0;
      count.said_so += effect.was_told() ? 1 : 0;
    }
  }
  return count;
}

}  // namespace zerodrift::proof
