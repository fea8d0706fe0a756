#include "core/diagnosis/locate.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <string_view>

#include "core/diagnosis/parallel.h"
#include "core/diagnosis/screening.h"
#include "core/physics/hat.h"

namespace zerodrift::diagnosis {
namespace {

using Eigen::Index;

constexpr double longest_block_s = 1800.0;
constexpr int places_of_a_rod = 17;
constexpr int sizes = 8;

/// The nominal network with a source at every place whose strength is one parameter; responses to a first half hat and
/// to one whole hat, the rest follow by shifting in time.
struct Responses {
  std::vector<physics::Prediction> first;  // derivative columns: one a place
  std::vector<physics::Prediction> whole;
};

physics::Law hat_in_time(double centre_s, double block_s) {
  return [centre_s, block_s](const physics::LawPoint& at) {
    physics::Strength s;
    s.by_parameter[0] = physics::hat((at.time_s - centre_s) / block_s);
    s.value = at.values[0] * s.by_parameter[0];
    return s;
  };
}

physics::Prediction responses(const Model& nominal, const std::string& component,
                              const std::vector<double>& position_mm, double centre_s, double block_s) {
  physics::NetworkBuilder builder(nominal.machine(), *nominal.data().recording, {});
  builder.build();
  const double length_mm = nominal.machine().find(component)->length_mm;
  std::vector<int> parameters;
  for (const double x : position_mm) {
    physics::Parameter place;
    place.sigma = 0.0;
    place.start = x;
    physics::Parameter watts;
    parameters.push_back(builder.add_parameter(watts));
    physics::Term source = builder.source_at(component, builder.add_parameter(place), 0.03 * length_mm);
    source.law_kind = physics::LawKind::time;
    source.parameters = {parameters.back()};
    source.law = hat_in_time(centre_s, block_s);
    builder.add(std::move(source));
  }
  const physics::InputSet inputs = physics::make_inputs(builder.network(), *nominal.data().recording);
  std::vector<double> values = nominal.values();
  values.resize(builder.network().parameters.size(), 0.0);
  for (std::size_t p = 0; p < values.size(); ++p) {
    if (builder.network().parameters[p].sigma == 0.0) values[p] = builder.network().parameters[p].start;
  }
  return physics::predict(builder.network(), inputs, values, parameters);
}

/// Column of a hat at block b for one place: the response of block 1 later by (b - 1) blocks.
void put_column(const Dataset& data, const physics::Prediction& first, const physics::Prediction& whole,
                std::size_t place, std::size_t block, std::size_t shift, physics::Prediction& out) {
  const std::size_t columns = first.columns;
  for (std::size_t c = 0; c < out.channels.size(); ++c) {
    for (std::size_t k = 0; k < data.rows(); ++k) {
      double value = 0.0;
      if (block == 0) {
        value = first.channels[c].derivatives[k * columns + place];
      } else if (k >= (block - 1) * shift) {
        value = whole.channels[c].derivatives[(k - (block - 1) * shift) * columns + place];
      }
      out.channels[c].derivatives[k * out.columns + block] = value;
    }
  }
}

double correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const double n = static_cast<double>(a.size());
  const double ma = std::accumulate(a.begin(), a.end(), 0.0) / n;
  const double mb = std::accumulate(b.begin(), b.end(), 0.0) / n;
  double aa = 0, bb = 0, ab = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    aa += (a[i] - ma) * (a[i] - ma);
    bb += (b[i] - mb) * (b[i] - mb);
    ab += (a[i] - ma) * (b[i] - mb);
  }
  return aa > 0 && bb > 0 ? ab / std::sqrt(aa * bb) : 0.0;
}

}  // namespace

SourceScan scan_sources(const Model& nominal, const std::string& component) {
  SourceScan scan;
  scan.component = component;
  const Dataset& data = nominal.data();
  const physics::Component& part = *nominal.machine().find(component);
  const int places = part.lump ? 1 : places_of_a_rod;
  const double length_mm = part.lump ? 0.0 : part.length_mm;
  for (int i = 0; i < places; ++i) {
    scan.position_mm.push_back(length_mm * (0.02 + 0.96 * i / (places_of_a_rod - 1)));
  }
  const double duration_s = data.time_s.back() - data.time_s.front();
  constexpr double least_blocks = 12.0;  // a lump may be a heater that is done in minutes
  const double block_s = part.lump ? std::min(longest_block_s, duration_s / least_blocks) : longest_block_s;
  const double period_s = duration_s / static_cast<double>(data.rows() - 1);
  const std::size_t blocks = static_cast<std::size_t>(std::ceil(duration_s / block_s)) + 1;
  const std::size_t shift = std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(block_s / period_s)));
  const physics::Prediction first = responses(nominal, component, scan.position_mm, data.time_s.front(), block_s);
  const physics::Prediction whole =
      responses(nominal, component, scan.position_mm, data.time_s.front() + block_s, block_s);
  const Eigen::MatrixXd base = nominal.hessian();
  const Eigen::VectorXd base_gradient = nominal.jacobian().transpose() * nominal.residual() - nominal.z();
  const Eigen::LDLT<Eigen::MatrixXd> without(base);
  scan.evidence_without =
      0.5 * base_gradient.dot(without.solve(base_gradient)) - 0.5 * without.vectorD().array().max(1e-300).log().sum();
  const Index n0 = base.rows();
  const Index nb = static_cast<Index>(blocks);
  Eigen::MatrixXd smooth = 0.05 * Eigen::MatrixXd::Identity(nb, nb);
  for (Index i = 0; i + 1 < nb; ++i) {
    smooth(i, i) += 1.0;
    smooth(i + 1, i + 1) += 1.0;
    smooth(i, i + 1) -= 1.0;
    smooth(i + 1, i) -= 1.0;
  }
  const double smooth_log = smooth.llt().matrixL().toDenseMatrix().diagonal().array().log().sum() * 2.0;
  scan.evidence.assign(places, -1e300);
  scan.watts_by_position.assign(places, {});
  in_parallel(places, [&](std::size_t place) {
    physics::Prediction history;
    history.columns = blocks;
    history.rows = data.rows();
    history.channels.resize(data.channels.size());
    for (auto& channel : history.channels) channel.derivatives.resize(data.rows() * blocks);
    for (std::size_t b = 0; b < blocks; ++b) put_column(data, first, whole, place, b, shift, history);
    RowMatrix columns(nominal.residual().size(), nb);
    std::vector<int> targets(blocks);
    std::iota(targets.begin(), targets.end(), 0);
    whiten_columns(data, history, std::vector<double>(blocks, 1.0), columns, targets);
    Eigen::MatrixXd h(n0 + nb, n0 + nb);
    h.topLeftCorner(n0, n0) = base;
    h.topRightCorner(n0, nb) = nominal.jacobian().transpose() * columns;
    h.bottomLeftCorner(nb, n0) = h.topRightCorner(n0, nb).transpose();
    h.bottomRightCorner(nb, nb) = columns.transpose() * columns;
    Eigen::VectorXd g(n0 + nb);
    g << base_gradient, columns.transpose() * nominal.residual();
    double highest = -1e300, sum = 0.0;
    for (int level = 0; level < sizes; ++level) {
      const double watts = std::pow(10.0, -1.0 + 0.5 * level);
      Eigen::MatrixXd full = h;
      full.bottomRightCorner(nb, nb) += smooth / (watts * watts);
      const Eigen::LDLT<Eigen::MatrixXd> factors(full);
      const Eigen::VectorXd solution = factors.solve(g);
      const double evidence = 0.5 * g.dot(solution) - 0.5 * factors.vectorD().array().max(1e-300).log().sum() +
                              0.5 * (smooth_log - 2.0 * static_cast<double>(nb) * std::log(watts));
      sum = evidence > highest ? sum * std::exp(highest - evidence) + 1.0 : sum + std::exp(evidence - highest);
      if (evidence <= highest) continue;
      highest = evidence;
      scan.watts_by_position[place].assign(solution.data() + n0, solution.data() + n0 + nb);
    }
    scan.evidence[place] = highest + std::log(sum / sizes);  // every size is as likely
  });
  const auto best = std::max_element(scan.evidence.begin(), scan.evidence.end()) - scan.evidence.begin();
  const double step_mm = 0.96 * length_mm / (places_of_a_rod - 1);
  scan.best_mm = scan.position_mm[best];
  if (best > 0 && best + 1 < places) {  // vertex of the parabola through the three best
    const double l = scan.evidence[best - 1], m = scan.evidence[best], r = scan.evidence[best + 1];
    const double curvature = l - 2.0 * m + r;
    if (curvature < 0.0) scan.best_mm += 0.5 * step_mm * (l - r) / curvature;
  }
  scan.from_mm = scan.to_mm = scan.best_mm;
  for (int i = 0; i < places; ++i) {
    if (scan.evidence[i] < scan.evidence[best] - 3.0) continue;
    scan.from_mm = std::min(scan.from_mm, scan.position_mm[i] - 0.5 * step_mm);
    scan.to_mm = std::max(scan.to_mm, scan.position_mm[i] + 0.5 * step_mm);
  }
  scan.from_mm = std::max(0.0, scan.from_mm);
  scan.to_mm = std::min(length_mm, scan.to_mm);
  scan.watts = scan.watts_by_position[best];
  for (std::size_t b = 0; b < blocks; ++b)
    scan.time_s.push_back(data.time_s.front() + static_cast<double>(b) * block_s);
  return scan;
}

double evidence_of_wandering_heat(const Model& model) {
  double largest = -1e300;
  for (const auto& component : model.machine().components) {
    if (component.lump || component.prescribed) continue;
    const SourceScan scan = scan_sources(model, component.id);
    const double best = *std::max_element(scan.evidence.begin(), scan.evidence.end());
    double sum = 0.0;  // every place is as likely
    for (const double evidence : scan.evidence) sum += std::exp(evidence - best) / places_of_a_rod;
    largest = std::max(largest, best + std::log(sum) - scan.evidence_without);
  }
  return largest;
}

namespace {

/// Over a block; none where no sample is there.
std::optional<double> mean_about(const recording::Recording& recording, const std::vector<double>& values, double at_s,
                                 double block_s = longest_block_s) {
  double sum = 0.0;
  int count = 0;
  for (std::size_t k = 0; k < recording.rows(); ++k) {
    if (!std::isfinite(values[k]) || std::abs(recording.time_s[k] - at_s) > 0.5 * block_s) continue;
    sum += values[k];
    ++count;
  }
  return count > 0 ? std::optional(sum / count) : std::nullopt;
}

/// The load of a spindle that only turns follows its speed: a recording in which it does says nothing of cutting.
bool cuts(const recording::Recording& recording) {
  const recording::Channel* load = recording.find("spindle_load_W");
  const recording::Channel* speed = recording.find("spindle_rpm");
  if (load == nullptr || speed == nullptr) return load != nullptr;
  std::vector<std::size_t> rows;
  double largest_rpm = 1.0;
  for (std::size_t k = 0; k < recording.rows(); ++k) {
    if (!std::isfinite(load->values[k]) || !std::isfinite(speed->values[k])) continue;
    rows.push_back(k);
    largest_rpm = std::max(largest_rpm, std::abs(speed->values[k]));
  }
  if (rows.size() < 10) return true;
  Eigen::MatrixXd terms(rows.size(), 4);
  Eigen::VectorXd watts(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double n = std::abs(speed->values[rows[i]]) / largest_rpm;
    terms.row(static_cast<Eigen::Index>(i)) << 1.0, n > 0.0 ? 1.0 : 0.0, n, n * n;
    watts[static_cast<Eigen::Index>(i)] = load->values[rows[i]];
  }
  const Eigen::VectorXd left = watts - terms * terms.colPivHouseholderQr().solve(watts).eval();
  const double spread = (watts.array() - watts.mean()).square().sum();
  return left.squaredNorm() > 0.03 * spread;
}

}  // namespace

History history_of(const recording::Recording& recording, const std::vector<double>& one,
                   const std::vector<double>& other) {
  History history;
  std::vector<double> off(recording.rows());
  for (std::size_t k = 0; k < off.size(); ++k) off[k] = one[k] - other[k];
  for (double t = recording.time_s.front(); t <= recording.time_s.back(); t += longest_block_s) {
    history.time_s.push_back(t);
    history.value.push_back(mean_about(recording, off, t).value_or(0.0));
  }
  return history;
}

std::string regime_of(const History& missing, const recording::Recording& recording, const std::string& driven_by) {
  struct Driver {
    const char* channel;
    double power;
    const char* words;
  };
  static constexpr Driver drivers[] = {{"spindle_rpm", 1.0, "in step with the spindle speed"},
                                       {"spindle_rpm", 2.0, "with the square of the spindle speed"},
                                       {"spindle_rpm", 0.0, "while the spindle turns"},
                                       {"coolant_on", 1.0, "while the coolant runs"},
                                       {"spindle_load_W", 1.0, "while the machine cuts"},
                                       {"ambient_C", 1.0, "as the room changes"}};
  const double mean =
      std::accumulate(missing.value.begin(), missing.value.end(), 0.0) / static_cast<double>(missing.value.size());
  double spread = 0.0;
  for (const double w : missing.value) spread += (w - mean) * (w - mean);
  spread = std::sqrt(spread / static_cast<double>(missing.value.size()));
  if (spread < 0.35 * std::abs(mean)) return "all the time";
  std::string best = "at irregular times";
  const double block_s = missing.time_s.size() > 1 ? missing.time_s[1] - missing.time_s[0] : longest_block_s;
  constexpr double least = 0.55;
  constexpr double least_of_the_named = 0.3;
  double largest = least;
  double largest_of_the_named = least_of_the_named;
  const char* words_of_the_named = nullptr;
  for (const auto& driver : drivers) {
    const recording::Channel* channel = recording.find(driver.channel);
    if (channel == nullptr) continue;
    const bool load = std::string_view(driver.channel) == "spindle_load_W";
    if (load && !cuts(recording)) continue;
    std::vector<double> acts = channel->values;
    for (double& v : acts) {
      if (std::isfinite(v)) v = driver.power == 0.0 ? (v > 1.0 ? 1.0 : 0.0) : std::pow(std::max(0.0, v), driver.power);
    }
    std::vector<double> level;
    for (const double t : missing.time_s) {
      level.push_back(mean_about(recording, acts, t, block_s).value_or(0.0));
    }
    const double r = std::abs(correlation(level, missing.value));
    if (driven_by == driver.channel && r > largest_of_the_named) {
      largest_of_the_named = r;
      words_of_the_named = driver.words;
    }
    if (r > largest) {
      largest = r;
      best = driver.words;
    }
  }
  // Speed and coolant go together in most plans: the evidence for the named effect tells more than a correlation.
  return words_of_the_named != nullptr ? words_of_the_named : best;
}

}  // namespace zerodrift::diagnosis
