#include "core/analysis/training.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace zerodrift::analysis {
namespace {

using recording::Channel;
using recording::ChannelKind;
using recording::Recording;

constexpr double longest_join_gap_s = 1800.0;
constexpr double join_tolerance_K = 1.0;

double first_present(const Channel& channel) {
  for (const double v : channel.values) {
    if (std::isfinite(v)) return v;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

double last_present(const Channel& channel) {
  for (std::size_t i = channel.values.size(); i-- > 0;) {
    if (std::isfinite(channel.values[i])) return channel.values[i];
  }
  return std::numeric_limits<double>::quiet_NaN();
}

bool goes_on(const Recording& before, const Recording& after) {
  if (before.rows() == 0 || after.rows() == 0) return false;
  const double gap_s = after.time_s.front() - before.time_s.back();
  if (gap_s <= 0.0 || gap_s > longest_join_gap_s) return false;
  std::vector<double> differences;
  for (const auto& channel : after.channels) {
    const Channel* twin = before.find(channel.name);
    if (twin == nullptr) return false;
    if (channel.kind() != ChannelKind::temperature && channel.kind() != ChannelKind::ambient) continue;
    const double difference = std::abs(first_present(channel) - last_present(*twin));
    if (std::isfinite(difference)) differences.push_back(difference);
  }
  if (differences.empty() || before.channels.size() != after.channels.size()) return false;
  const auto middle = differences.begin() + static_cast<std::ptrdiff_t>(differences.size() / 2);
  std::nth_element(differences.begin(), middle, differences.end());
  return *middle < join_tolerance_K;
}

/// A channel that one recording lacks is told; one that was dropped there is told already.
void tell_absent(const Prepared& there, const Recording& recording, std::vector<Finding>& findings) {
  for (const auto* names : {&there.sensors, &there.errors}) {
    for (const std::string& name : *names) {
      if (recording.find(name) != nullptr) continue;
      findings.push_back({FindingKind::not_in_every_run, FindingAction::dropped, name, recording.name});
    }
  }
}

void keep_common(std::vector<std::string>& names, const std::vector<std::string>& other) {
  std::erase_if(names, [&](const std::string& n) { return std::find(other.begin(), other.end(), n) == other.end(); });
}

int column_of(const std::vector<std::string>& names, const std::string& name) {
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

/// Noise of each common sensor's readings, from what a local straight line does not follow. Trimmed, so that jumps and
/// spikes do not count: without the largest 5 % a normal deviate keeps 0.7590 of its variance. The line itself follows
/// 1/m of the noise of m readings.
std::vector<double> reading_noise_C(const TrainingSet& set) {
  constexpr double kept = 0.95;
  constexpr double kept_variance = 0.7590;
  std::vector<double> out;
  for (const auto& sensor : set.sensors) {
    std::vector<double> squares;
    double readings = 0.0;
    for (std::size_t r = 0; r < set.runs.size(); ++r) {
      const Prepared& run = set.runs[r];
      const int column = run.sensor(sensor);
      for (Eigen::Index i = 0; i < run.rows(); ++i) {
        squares.push_back(std::pow(run.temperature_C(i, column) - set.smoothed_C[r](i, column), 2));
      }
      const double period_s = (run.time_s.back() - run.time_s.front()) / std::max(run.rows() - 1, 1);
      readings += run.rows() * (1.0 + 2.0 * smoothing_half_window_s(run) / std::max(period_s, 1e-9));
    }
    readings /= static_cast<double>(squares.size());
    std::sort(squares.begin(), squares.end());
    squares.resize(std::max<std::size_t>(static_cast<std::size_t>(kept * static_cast<double>(squares.size())), 1));
    double sum = 0.0;
    for (const double s : squares) sum += s;
    const double variance = sum / static_cast<double>(squares.size()) / kept_variance;
    out.push_back(std::sqrt(variance / (1.0 - 1.0 / std::max(readings, 2.0))));
  }
  return out;
}

}  // namespace

Eigen::VectorXd TrainingSet::feature_noise_C(const std::vector<FeatureSpec>& specs) const {
  Eigen::VectorXd out = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(specs.size()));
  for (std::size_t f = 0; f < specs.size(); ++f) {
    if (!specs[f].temperature || specs[f].time_constant_s > 0.0) continue;
    out(static_cast<Eigen::Index>(f)) = noise_C[static_cast<std::size_t>(column_of(sensors, specs[f].channel))];
  }
  return out;
}

double TrainingSet::duration_s() const {
  double longest_s = 0.0;
  for (const auto& r : runs) longest_s = std::max(longest_s, r.time_s.back() - r.time_s.front());
  return longest_s;
}

std::vector<Recording> join_continuing(const std::vector<Recording>& recordings) {
  std::vector<Recording> out;
  for (const auto& recording : recordings) {
    if (out.empty() || !goes_on(out.back(), recording)) {
      out.push_back(recording);
      continue;
    }
    Recording& joined = out.back();
    joined.name += " + " + recording.name;
    joined.time_s.insert(joined.time_s.end(), recording.time_s.begin(), recording.time_s.end());
    for (auto& channel : joined.channels) {
      const auto& more = recording.find(channel.name)->values;
      channel.values.insert(channel.values.end(), more.begin(), more.end());
    }
  }
  return out;
}

Result<TrainingSet> make_training(const std::vector<Recording>& recordings, const PrepareOptions& options) {
  if (recordings.empty()) {
    return fail(ErrorCode::not_enough_data, {{"what", "the fit"}, {"found", "no recording"}, {"needed", "one"}});
  }
  TrainingSet set;
  const std::vector<Recording> joined = join_continuing(recordings);
  for (const auto& recording : joined) {
    auto run = prepare(recording, options);
    if (!run) return fail(std::move(run).error().with("recording", recording.name));
    set.findings.insert(set.findings.end(), run->findings.begin(), run->findings.end());
    if (set.runs.empty()) {
      set.sensors = run->sensors;
      set.errors = run->errors;
    } else {
      keep_common(set.sensors, run->sensors);
      keep_common(set.errors, run->errors);
      tell_absent(set.runs.front(), recording, set.findings);
      tell_absent(*run, joined.front(), set.findings);
    }
    set.runs.push_back(std::move(*run));
  }
  if (set.sensors.empty() || set.errors.empty()) {
    return fail(ErrorCode::data_does_not_fit, {{"what", "the recordings"},
                                               {"found", set.sensors.empty() ? "no common sensor" : "no common error"},
                                               {"expected", "runs of the same machine"}});
  }
  std::vector<const Prepared*> runs;
  std::vector<const Samples*> samples;
  for (const auto& run : set.runs) {
    set.smoothed_C.push_back(smooth(run.time_s, run.temperature_C, smoothing_half_window_s(run)));
    set.samples.push_back(sample(run));
  }
  Eigen::Index total = 0;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    runs.push_back(&set.runs[r]);
    samples.push_back(&set.samples[r]);
    total += static_cast<Eigen::Index>(set.samples[r].time_s.size());
  }
  set.error_um.resize(total, static_cast<Eigen::Index>(set.errors.size()));
  Eigen::Index at = 0;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    const auto n = static_cast<Eigen::Index>(set.samples[r].time_s.size());
    for (std::size_t e = 0; e < set.errors.size(); ++e) {
      set.error_um.block(at, static_cast<Eigen::Index>(e), n, 1) =
          set.samples[r].error_um.col(column_of(set.runs[r].errors, set.errors[e]));
    }
    set.time_s.insert(set.time_s.end(), set.samples[r].time_s.begin(), set.samples[r].time_s.end());
    set.run.insert(set.run.end(), static_cast<std::size_t>(n), static_cast<int>(r));
    at += n;
  }
  if (total < 8) {
    return fail(ErrorCode::not_enough_data, {{"what", "the run"},
                                             {"found", fmt::format("errors at {} times", total)},
                                             {"needed", "at least 8, spread over the run"}});
  }
  set.noise_C = reading_noise_C(set);
  set.folds = make_folds(runs, samples);
  return set;
}

Result<Eigen::MatrixXd> design(const TrainingSet& set, const std::vector<FeatureSpec>& specs) {
  Eigen::MatrixXd out(static_cast<Eigen::Index>(set.time_s.size()), static_cast<Eigen::Index>(specs.size()));
  Eigen::Index at = 0;
  for (std::size_t r = 0; r < set.runs.size(); ++r) {
    Prepared smoothed = set.runs[r];
    smoothed.temperature_C = set.smoothed_C[r];
    ZD_TRY(const Eigen::MatrixXd all, features(smoothed, specs, start_references(set.runs[r], specs)));
    for (const auto& rows : set.samples[r].rows) {
      out.row(at).setZero();
      for (const int row : rows) out.row(at) += all.row(row);
      out.row(at) /= static_cast<double>(rows.size());
      ++at;
    }
  }
  return out;
}

std::vector<ErrorGroup> error_groups(const TrainingSet& set) {
  std::vector<ErrorGroup> groups;
  for (Eigen::Index e = 0; e < set.error_um.cols(); ++e) {
    std::vector<int> samples;
    for (Eigen::Index i = 0; i < set.error_um.rows(); ++i) {
      if (std::isfinite(set.error_um(i, e))) samples.push_back(static_cast<int>(i));
    }
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const auto& g) { return g.samples == samples; });
    if (same != groups.end()) {
      same->errors.push_back(e);
    } else {
      groups.push_back({{e}, std::move(samples)});
    }
  }
  return groups;
}

Rows rows_of(const TrainingSet& set, const Eigen::MatrixXd& design, const std::vector<int>& samples,
             Eigen::Index error) {
  Rows all;
  all.x = design;
  all.y = set.error_um.col(error);
  all.time_s = set.time_s;
  all.run = set.run;
  return pick(all, samples);
}

}  // namespace zerodrift::analysis
