#include "core/diagnosis/answer/regime.h"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <string_view>

namespace zerodrift::diagnosis {
namespace {

constexpr double longest_block_s = 1800.0;

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

/// A room that hardly changes explains nothing.
bool changes(const recording::Channel& room) {
  constexpr double least_K = 0.5;
  double low = 1e300, high = -1e300;
  for (const double v : room.values) {
    if (std::isfinite(v)) low = std::min(low, v), high = std::max(high, v);
  }
  return high - low >= least_K;
}

}  // namespace

std::string regime_of(const History& missing, const recording::Recording& recording) {
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
  double largest = least;
  for (const auto& driver : drivers) {
    const recording::Channel* channel = recording.find(driver.channel);
    if (channel == nullptr) continue;
    const bool load = std::string_view(driver.channel) == "spindle_load_W";
    if (load && !cuts(recording)) continue;
    const bool room = std::string_view(driver.channel) == "ambient_C";
    if (room && !changes(*channel)) continue;
    std::vector<double> acts = channel->values;
    for (double& v : acts) {
      if (std::isfinite(v)) v = driver.power == 0.0 ? (v > 1.0 ? 1.0 : 0.0) : std::pow(std::max(0.0, v), driver.power);
    }
    std::vector<double> level;
    for (const double t : missing.time_s) {
      level.push_back(mean_about(recording, acts, t, block_s).value_or(0.0));
    }
    const double r = std::abs(correlation(level, missing.value));
    if (r > largest) {
      largest = r;
      best = driver.words;
    }
  }
  return best;
}

}  // namespace zerodrift::diagnosis
