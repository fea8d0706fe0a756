// The score as result.json and as text.
#include <fmt/format.h>

#include <cmath>

#include "app/proof/score.h"

namespace zerodrift::proof {

using nlohmann::json;

json Score::to_json() const {
  json out = {{"cases", m_judgements.size()},
              {"figures", json::array()},
              {"confusion", m_confusion},
              {"rmse", json::array()},
              {"reliability", json::array()}};
  out["put_aside"] = m_put_aside;
  out["not_right"] = undecidable().wrong;
  out["not_right_and_undecidable"] = undecidable().undecidable;
  out["not_named_compared"] = undecidable().compared;
  out["not_named_and_said_not_to_show"] = undecidable().said_so;
  for (const auto& figure : figures()) {
    out["figures"].push_back({{"id", figure.id},
                              {"label", figure.label},
                              {"value", figure.value},
                              {"unit", figure.unit},
                              {"must", figure.limit},
                              {"met", figure.met ? json(*figure.met) : json()}});
  }
  for (const auto& one : improvements()) {
    out["rmse"].push_back({{"channels", one.kind},
                           {"recording", one.second ? "held out" : "fitted"},
                           {"before", one.nominal},
                           {"refitted", one.refitted},
                           {"after", one.explained},
                           {"floor", one.floor},
                           {"worst_over_floor", one.worst_over_floor}});
    if (!std::isfinite(one.reached)) continue;
    out["rmse"].back()["true_structure"] = one.reached;
    out["rmse"].back()["over_true_structure"] = one.over_reached;
    out["rmse"].back()["median_over_true_structure"] = one.median_over_reached;
  }
  for (const auto& bin : reliability()) {
    out["reliability"].push_back({{"from", bin.low},
                                  {"to", bin.high},
                                  {"cases", bin.cases},
                                  {"confidence", bin.confidence},
                                  {"right", bin.right}});
  }
  for (const auto& one : m_judgements) {
    out["answers"].push_back({{"case", one.name},
                              {"hidden", one.truth},
                              {"answer", one.answer},
                              {"outcome", name_of(one.outcome)},
                              {"confidence", one.confidence},
                              {"strength", one.strength},
                              {"left", one.left},
                              {"evidence_if_told", one.told ? json(*one.told) : json()},
                              {"location_error_mm", one.location_error_mm ? json(*one.location_error_mm) : json()},
                              {"seconds", one.seconds}});
    for (const NotNamed& effect : one.not_named) {
      const bool same_unit = effect.compared();
      out["answers"].back()["not_named"].push_back(
          {{"id", effect.id},
           {"parameter", same_unit ? json(effect.key) : json()},
           {"hidden", same_unit ? json(effect.hidden) : json()},
           {"could_show_from", same_unit ? json(effect.could_show_from) : json()}});
    }
  }
  return out;
}

std::string Score::text() const {
  std::string out = fmt::format("cases {}\n", m_judgements.size());
  for (const auto& figure : figures()) {
    out += fmt::format("{:<50} {:>18} {:<3} (must: {}){}\n", figure.label, figure.value, figure.unit, figure.limit,
                       figure.met && !*figure.met ? "  NOT MET" : "");
  }
  out += fmt::format("{:<22} {:>9} {:>10} {:>12} {:>8} {:>14} {:>15} {:>8}\n", "rms, median", "nominal", "re-fitted",
                     "with effect", "floor", "worst / floor", "true structure", "over it");
  for (const auto& one : improvements()) {
    out += fmt::format("{:<3} {:<18} {:>9.3f} {:>10.3f} {:>12.3f} {:>8.3f} {:>14.2f} {:>15.3f} {:>8.2f}\n", one.kind,
                       one.second ? "held-out recording" : "fitted recording", one.nominal, one.refitted, one.explained,
                       one.floor, one.worst_over_floor, one.reached, one.over_reached);
  }
  const Undecidable hard = undecidable();
  out += fmt::format(
      "listed effects not answered rightly: {}, undecidable even for one who is told: {}; not named, of comparable "
      "size: {}, said beforehand not to show: {}\n",
      hard.wrong, hard.undecidable, hard.compared, hard.said_so);
  for (const auto& [truth, answers] : m_confusion) {
    out += fmt::format("  {:<44}", truth);
    for (const auto& [answer, n] : answers) out += fmt::format(" {} x{}", answer, n);
    out += "\n";
  }
  return out;
}

}  // namespace zerodrift::proof
