#include "core/analysis/folds.h"

#include <fmt/format.h>

#include <cmath>

namespace zerodrift::analysis {
namespace {

constexpr double shortest_cycle_s = 1800.0;
constexpr double shortest_plateau_s = 1200.0;

std::vector<int> starts_from_rest(const Prepared& data, const Eigen::VectorXd& speed) {
  std::vector<int> starts{0};
  bool first = true;
  for (int i = 1; i < data.rows(); ++i) {
    if (!(std::abs(speed(i)) > 0.0 && std::abs(speed(i - 1)) <= 0.0)) continue;
    if (first) {  // what stands before the first start belongs to the first cycle
      first = false;
      if (data.time_s[i] - data.time_s[0] < shortest_cycle_s) continue;
    }
    if (data.time_s[i] - data.time_s[starts.back()] >= shortest_cycle_s) starts.push_back(i);
  }
  return starts;
}

std::vector<int> plateaus(const Prepared& data, const Eigen::VectorXd& speed) {
  const double tolerance = 0.05 * speed.cwiseAbs().maxCoeff();
  std::vector<int> starts{0};
  int from = 0;
  for (int i = 1; i <= data.rows(); ++i) {
    if (i < data.rows() && std::abs(speed(i) - speed(from)) <= tolerance) continue;
    const double end_s = i < data.rows() ? data.time_s[i] : data.time_s.back();
    if (end_s - data.time_s[from] >= shortest_plateau_s && from > 0) starts.push_back(from);
    from = i;
  }
  return starts;
}

}  // namespace

std::vector<int> cycle_starts(const Prepared& data) {
  const int column = data.input_index("spindle_rpm");
  if (column < 0) return {0};
  const Eigen::VectorXd speed = data.input.col(column);
  std::vector<int> starts = starts_from_rest(data, speed);
  if (starts.size() < 2) {
    starts = plateaus(data, speed);
    if (starts.size() < 3) starts = {0};
  }
  return starts;
}

Folds make_folds(const std::vector<const Prepared*>& runs, const std::vector<const Samples*>& samples) {
  Folds folds;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const std::vector<int> starts = cycle_starts(*runs[r]);
    std::size_t cycle = 0;
    std::vector<int> mine;
    std::vector<int> sizes(starts.size(), 0);
    for (const auto& rows : samples[r]->rows) {
      while (cycle + 1 < starts.size() && rows.front() >= starts[cycle + 1]) ++cycle;
      mine.push_back(static_cast<int>(cycle));
      ++sizes[cycle];
    }
    std::vector<int> number(starts.size(), -1);
    for (std::size_t c = 0; c < starts.size(); ++c) {
      if (sizes[c] >= 4) number[c] = folds.count++;
    }
    for (const int c : mine) folds.fold_of.push_back(number[static_cast<std::size_t>(c)]);
  }
  folds.cycles = folds.count;
  if (folds.count >= 2) {
    folds.in_words = fmt::format("each of {} cycles in turn", folds.count);
    return folds;
  }
  const int n = static_cast<int>(folds.fold_of.size());
  for (int i = 0; i < n; ++i) folds.fold_of[static_cast<std::size_t>(i)] = i >= n - n / 4 ? 0 : -1;
  folds.count = 1;
  folds.cycles = 1;
  folds.in_words = "the last quarter of the run";
  return folds;
}

}  // namespace zerodrift::analysis
