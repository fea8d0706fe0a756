#include "core/diagnosis/inference/evidence.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/description/inner_bodies.h"
#include "core/diagnosis/input/thinning.h"
#include "core/physics/builder.h"

namespace zerodrift::diagnosis::inference {
namespace {

/// A part whose numbers stand for many parts each, or are guessed; what it hands to its neighbours is as coarse.
bool is_of_coarse_part(const physics::Machine& machine, const std::string& channel) {
  std::string component;
  if (const physics::Sensor* sensor = machine.sensor(channel)) component = sensor->component;
  for (const auto& displacement : machine.displacements) {
    if (displacement.channel == channel) component = displacement.component;
  }
  const physics::Component* part = machine.find(component);
  return part == nullptr || part->lump || touches_lump(machine, component);
}

}  // namespace

Evidence::Evidence(physics::Machine machine, const std::vector<recording::Recording>& recordings,
                   const DiagnosisSettings& settings, std::stop_token stop)
    : m_machine(std::move(machine)), m_settings(settings), m_stop(std::move(stop)) {
  double longest_s = 0.0;
  for (const auto& recording : recordings)
    longest_s = std::max(longest_s, recording.time_s.back() - recording.time_s.front());
  const double share = std::min(1.0, longest_s / m_settings.full_run_s);
  for (double& time_s : m_settings.slow_times_s) time_s *= share;
  for (double& lag_s : m_settings.lags_s) lag_s *= share;
  for (const auto& recording : recordings) {
    recording::Recording fitted = thinned(recording, m_settings.most_rows);
    const physics::Network nominal = physics::build_network(m_machine, fitted);
    m_runs.push_back(make_run(std::move(fitted), nominal, m_settings));
  }
  // What a channel usually leaves is a share of what it does in any recording.
  for (std::size_t c = 0; c < series(); ++c) {
    double slow = 0.0;
    for (const Run& run : m_runs) slow = std::max(slow, run.series[c].slow);
    for (Run& run : m_runs) run.series[c].slow = slow;
    m_coarse.push_back(is_of_coarse_part(m_machine, m_runs.front().series[c].channel));
  }
  m_drivers = make_drivers(m_machine, m_runs, m_settings);
  m_gains = make_gains(m_machine, m_runs, m_drivers, m_settings);
  m_gain_place.assign(series(), {-1, -1});
  for (std::size_t g = 0; g < m_gains.size(); ++g) {
    for (std::size_t i = 0; i < m_gains[g].series.size(); ++i)
      m_gain_place[m_gains[g].series[i]] = {static_cast<int>(g), static_cast<int>(i)};
  }
}

int Evidence::samples(std::size_t series) const {
  int count = 0;
  for (const Run& run : m_runs) count += run.series[series].samples;
  return count;
}

int Evidence::samples() const {
  int count = 0;
  for (std::size_t c = 0; c < series(); ++c) count += samples(c);
  return count;
}

double Evidence::range(std::size_t series) const {
  double range = 0.0;
  for (const Run& run : m_runs) range = std::max(range, run.series[series].range);
  return range;
}

const WhitenedSeries& Evidence::whitened(std::size_t series, int slow_size, int slow_time) const {
  const std::lock_guard lock(m_mutex);
  std::unique_ptr<WhitenedSeries>& kept =
      m_whitened[{series, static_cast<std::size_t>(slow_size), static_cast<std::size_t>(slow_time)}];
  if (kept) return *kept;
  kept = std::make_unique<WhitenedSeries>();
  const auto [group, place] = m_gain_place[series];
  const Eigen::Index gains =
      group < 0 ? 0 : static_cast<Eigen::Index>(m_gains[group].driver[static_cast<std::size_t>(place)].size());
  kept->basis_gram.setZero(gains, gains);
  for (std::size_t r = 0; r < m_runs.size(); ++r) {
    const MeasuredSeries& measured = m_runs[r].series[series];
    kept->whitener.emplace_back(measured, m_runs[r].recording.time_s,
                                m_settings.slow_sizes[static_cast<std::size_t>(slow_size)],
                                m_settings.slow_times_s[static_cast<std::size_t>(slow_time)]);
    kept->log_determinant += kept->whitener.back().log_determinant();
    RowMatrix basis(static_cast<Eigen::Index>(m_runs[r].rows()), gains);
    if (gains > 0) {
      kept->whitener.back().apply(m_gains[group].basis[static_cast<std::size_t>(place)][r], basis);
      kept->basis_gram.noalias() += basis.transpose() * basis;
    }
    kept->basis.push_back(std::move(basis));
  }
  return *kept;
}

double Evidence::log_prior_of_slow(std::size_t series, int slow_size) const {
  const DiagnosisSettings& s = m_settings;
  const double usual = m_coarse[series] ? s.coarse_slow_size : s.usual_slow_size;
  const double spread = m_coarse[series] ? s.coarse_slow_spread : s.slow_size_spread;
  const double off = std::log(s.slow_sizes[static_cast<std::size_t>(slow_size)] / usual) / spread;
  return -0.5 * off * off;
}

double Evidence::log_prior(const Sizes& sizes) const {
  double sum = 0.0;
  for (std::size_t c = 0; c < series(); ++c) {
    if (samples(c) == 0) continue;
    sum += log_prior_of_slow(c, sizes.slow[c]) + (sizes.time[c] > 0 ? m_settings.short_time_log_prior : 0.0);
  }
  for (std::size_t g = 0; g < m_gains.size(); ++g) {
    if (m_gains[g].count > 0)
      sum += m_settings.repeatable_sizes[static_cast<std::size_t>(sizes.repeatable[g])].log_prior;
  }
  return sum;
}

double Evidence::trust(const Sizes& sizes) const {
  double sum = 0.0;
  int count = 0;
  for (std::size_t c = 0; c < series(); ++c) {
    if (samples(c) == 0) continue;
    const double usual = m_coarse[c] ? m_settings.coarse_slow_size : m_settings.usual_slow_size;
    const double coarse = usual / m_settings.usual_slow_size;
    const double needed = m_settings.slow_sizes[static_cast<std::size_t>(sizes.slow[c])] / usual;
    sum += std::max({1.0, coarse, needed});
    ++count;
  }
  return count == 0 ? 1.0 : count / sum;
}

Sizes Evidence::usual_sizes() const {
  Sizes sizes;
  for (std::size_t c = 0; c < series(); ++c) {
    int best = 0;
    for (int i = 1; i < static_cast<int>(m_settings.slow_sizes.size()); ++i) {
      if (log_prior_of_slow(c, i) > log_prior_of_slow(c, best)) best = i;
    }
    sizes.slow.push_back(best);
    sizes.time.push_back(0);
  }
  return sizes;
}

}  // namespace zerodrift::diagnosis::inference
