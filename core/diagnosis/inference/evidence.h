#pragma once
// All recordings of a machine, ready to be compared with hypotheses: the measured series, the drivers of the
// repeatable discrepancy, and what of the likelihood depends on neither hypothesis nor parameters.

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <stop_token>
#include <vector>

#include "core/diagnosis/inference/discrepancy.h"
#include "core/diagnosis/inference/run.h"
#include "core/physics/machine.h"

namespace zerodrift::diagnosis::inference {

/// What the discrepancy's sizes are: of the slow part for each series (index into settings.slow_sizes) with its time,
/// of the repeatable part for temperatures and for displacements (index into settings.repeatable_sizes).
struct Sizes {
  std::vector<int> slow;
  std::vector<int> time;  // of each series: index into settings.slow_times_s
  std::array<int, 2> repeatable{0, 0};
  bool operator==(const Sizes&) const = default;
};

/// A series at one size of its slow discrepancy: the filters, and the basis of the repeatable part through them.
struct WhitenedSeries {
  std::vector<Whitener> whitener;  // of each run
  std::vector<RowMatrix> basis;    // of each run: rows x gains; no columns without gains
  Eigen::MatrixXd basis_gram;      // sum over runs
  double log_determinant = 0.0;    // of all runs' filters
};

class Evidence {
 public:
  Evidence(physics::Machine machine, const std::vector<recording::Recording>& recordings,
           const DiagnosisSettings& settings, std::stop_token stop = {});

  const physics::Machine& machine() const { return m_machine; }
  const DiagnosisSettings& settings() const { return m_settings; }
  const std::vector<Run>& runs() const { return m_runs; }
  const std::vector<Driver>& drivers() const { return m_drivers; }
  const std::vector<GainGroup>& gains() const { return m_gains; }
  std::size_t series() const { return m_runs.front().series.size(); }
  /// Samples of a series in all runs.
  int samples(std::size_t series) const;
  int samples() const;
  bool stopped() const { return m_stop.stop_requested(); }
  /// Group and place in it of a series' gains; group -1: none.
  std::pair<int, int> gain_place(std::size_t series) const { return m_gain_place[series]; }
  const WhitenedSeries& whitened(std::size_t series, const Sizes& sizes) const {
    return whitened(series, sizes.slow[series], sizes.time[series]);
  }
  const WhitenedSeries& whitened(std::size_t series, int slow_size, int slow_time) const;
  double log_prior(const Sizes& sizes) const;
  double log_prior_of_slow(std::size_t series, int slow_size) const;
  Sizes usual_sizes() const;
  /// How far evidence can be trusted, at most 1. A description that is k times as coarse as one by rods of stated
  /// sizes, or needs k times the discrepancy that such descriptions usually have, is no more than near the truth, and
  /// what decides between hypotheses that are all wrong counts 1/k (the coarsened posterior of Miller and Dunson 2019,
  /// with the power from the discrepancy).
  double trust(const Sizes& sizes) const;
  double range(std::size_t series) const;
  /// Of a part whose numbers stand for many parts each, or are guessed.
  bool is_coarse(std::size_t series) const { return m_coarse[series]; }

 private:
  physics::Machine m_machine;
  DiagnosisSettings m_settings;
  std::stop_token m_stop;
  std::vector<Run> m_runs;
  std::vector<Driver> m_drivers;
  std::vector<GainGroup> m_gains;
  std::vector<std::pair<int, int>> m_gain_place;
  std::vector<bool> m_coarse;  // of each series
  mutable std::mutex m_mutex;
  mutable std::map<std::array<std::size_t, 3>, std::unique_ptr<WhitenedSeries>> m_whitened;
};

}  // namespace zerodrift::diagnosis::inference
