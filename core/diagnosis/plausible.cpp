#include "core/diagnosis/plausible.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::diagnosis {

/// What the description itself says, and its name in the catalogue; empty: a nuisance.
static std::string quantity_of(const std::string& key) {
  if (key.starts_with("scale:")) return "quantity_heat";
  if (key == "conductivity_W_mK") return "quantity_conductivity";
  if (key == "heat_capacity_J_kgK" || key == "heat_capacity_J_K") return "quantity_capacity";
  if (key == "expansion_1_K") return "quantity_expansion";
  if (key == "h_W_m2K") return "quantity_film";
  if (key == "conductance_W_K") return "quantity_conductance";
  return {};
}

std::vector<FarParameter> far_from_description(const Model& model) {
  constexpr double far = 4.0;
  std::vector<FarParameter> list;
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    const physics::Parameter& p = model.unknown(i);
    const bool candidate = p.effect >= 0 && model.machine().effects[static_cast<std::size_t>(p.effect)].candidate;
    const std::string quantity = quantity_of(p.key);
    const double widths = std::abs(model.z()[static_cast<Eigen::Index>(i)]);
    // What is not logarithmic is not known to a share of itself: nothing is far from it.
    if (candidate || quantity.empty() || !p.logarithmic || widths <= far) continue;
    const std::size_t colon = p.key.find(':');
    std::string of = colon == std::string::npos ? p.component : p.key.substr(colon + 1);
    if (of.empty()) of = model.machine().components.front().id;
    list.push_back({quantity, std::move(of), model.value(i) / p.mean, widths, i});
  }
  std::sort(list.begin(), list.end(), [](const auto& a, const auto& b) { return a.widths > b.widths; });
  return list;
}

/// A joint may be many times tighter or looser than drawn: that is a fault of the machine and no wrong unit.
static bool by_much(const FarParameter& one, double factor) {
  return one.quantity != "quantity_conductance" && (one.factor > factor || one.factor < 1.0 / factor);
}

bool is_doubtful(const std::vector<FarParameter>& far) {
  constexpr double doubtful = 2.0;
  return std::any_of(far.begin(), far.end(), [](const FarParameter& one) { return by_much(one, doubtful); });
}

bool is_beyond_belief(const std::vector<FarParameter>& far) {
  constexpr double factor = 1.5;  // with so many tolerances
  constexpr double widths = 8.0;
  return is_doubtful(far) || std::any_of(far.begin(), far.end(), [](const FarParameter& one) {
           return one.widths > widths && by_much(one, factor);
         });
}

bool is_mirrored(const MeasuredChannel& channel, const std::vector<double>& nominal) {
  double count = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  for (std::size_t k = 0; k < nominal.size(); ++k) {
    if (!channel.present[k]) continue;
    count += 1.0;
    x += nominal[k];
    y += channel.values[k];
    xx += nominal[k] * nominal[k];
    xy += nominal[k] * channel.values[k];
    yy += channel.values[k] * channel.values[k];
  }
  if (channel.temperature || count < 20.0) return false;
  xx -= x * x / count;
  xy -= x * y / count;
  yy -= y * y / count;
  const double noise2 = channel.white * channel.white + channel.drift * channel.drift;
  if (xx <= 100.0 * count * noise2) return false;  // hardly moves
  const double slope = xy / xx;
  // The description's tolerances move the slope by tens of percent and the shape by little.
  constexpr double like = 0.95;  // of the variance
  return slope < -0.5 && slope > -2.0 && xy * xy > like * xx * yy;
}

}  // namespace zerodrift::diagnosis
