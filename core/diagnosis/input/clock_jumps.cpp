#include "core/diagnosis/input/clock_jumps.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/description/inner_bodies.h"
#include "core/diagnosis/inference/fit.h"

namespace zerodrift::diagnosis {
namespace {

constexpr double several_intervals = 2.5;
constexpr double longest_s = 1800.0;     // what is longer is a gap (long_gaps.h)
constexpr std::size_t most_jumps = 3;    // a logger that stores on change has gaps everywhere
constexpr double least_evidence = 10.0;  // of log evidence: loggers miss samples more often than their clocks are set

void move_back(recording::Recording& recording, std::size_t from_row, double by_s) {
  for (std::size_t k = from_row; k < recording.rows(); ++k) recording.time_s[k] -= by_s;
}

/// Of the machine as described, fitted to the recording.
double log_evidence_of(const physics::Machine& machine, const recording::Recording& recording) {
  const auto evidence = std::make_shared<const inference::Evidence>(
      machine, std::vector<recording::Recording>{recording}, DiagnosisSettings{});
  inference::Fit fit(std::make_shared<inference::JointModel>(inference::Hypothesis{machine, {}, 0.0}, evidence),
                     evidence->usual_sizes());
  fit.fit({});
  return fit.log_evidence();
}

}  // namespace

std::vector<ClockJump> take_out_clock_jumps(const physics::Machine& machine, recording::Recording& recording) {
  std::vector<ClockJump> found;
  if (recording.rows() < 3) return found;
  std::vector<double> intervals_s;
  for (std::size_t k = 1; k < recording.rows(); ++k) {
    intervals_s.push_back(recording.time_s[k] - recording.time_s[k - 1]);
  }
  std::vector<double> sorted_s = intervals_s;
  const auto middle = sorted_s.begin() + std::ssize(sorted_s) / 2;
  std::nth_element(sorted_s.begin(), middle, sorted_s.end());
  const double usual_s = *middle;
  std::vector<std::size_t> rows;  // the first after each gap
  for (std::size_t k = 0; k < intervals_s.size(); ++k) {
    if (intervals_s[k] > several_intervals * usual_s && intervals_s[k] <= longest_s) rows.push_back(k + 1);
  }
  if (rows.empty() || rows.size() > most_jumps) return found;
  const physics::Machine bodies = with_inner_bodies(machine);
  double evidence = log_evidence_of(bodies, recording);
  double taken_out_s = 0.0;
  for (const std::size_t row : rows) {
    const ClockJump jump{recording.time_s[row] + taken_out_s, intervals_s[row - 1] - usual_s};
    recording::Recording without = recording;
    move_back(without, row, jump.by_s);
    const double then = log_evidence_of(bodies, without);
    if (then < evidence + least_evidence) continue;
    evidence = then;
    taken_out_s += jump.by_s;
    recording = std::move(without);
    found.push_back(jump);
  }
  return found;
}

}  // namespace zerodrift::diagnosis
