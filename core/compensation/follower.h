#pragma once
// The host compensator's arithmetic (C1), apart from any link: temperatures in, the offset to write out. The offset is
// limited in size and rate; a dead sensor lets it run to 0, temperatures beyond the model's training are held at its
// edge, where the model is still known - both with a reason in words.

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "core/compensation/table.h"

namespace zerodrift::compensation {

/// The error predicted now, X Y Z, from the machine's time and channels (temperatures and inputs); for models that
/// remember.
using Predictor =
    std::function<Result<std::array<double, 3>>(double time_s, const std::map<std::string, double>& channels)>;

struct FollowerOptions {
  double largest_step_um = 20.0;        // one write; the controller refuses more
  double extrapolation_margin_K = 1.0;  // beyond the training range, still trusted
};

enum class FollowerMode {
  following,
  held_at_edge,  // a temperature is outside the training range
  safe_zero,     // a sensor is dead: the offset runs to 0
  stopping,      // asked to end: the offset runs to 0
};

struct FollowerOutput {
  FollowerMode mode = FollowerMode::following;
  std::array<double, 3> predicted_um{};  // error the model predicts, X Y Z
  std::array<double, 3> offset_um{};     // compensation to write
  std::vector<std::string> reasons;      // why not plainly following
};

class Follower {
 public:
  /// Without a predictor the table predicts; with one the table gives limits and training ranges only.
  explicit Follower(Table table, FollowerOptions options = {}, Predictor predictor = {})
      : m_table(std::move(table)), m_options(options), m_predictor(std::move(predictor)) {}

  /// One turn at the machine's time: temperatures (and inputs) by channel, positions by axis.
  FollowerOutput step(double time_s, const Temperatures& channels, const std::map<std::string, double>& positions_mm);
  /// What the controller holds now; it may have taken the offset out by itself (switch off, watchdog).
  void start_from(const std::array<double, 3>& offset_um) { m_offset_um = offset_um; }
  /// The slowest of the axes, um/s of the machine's time.
  double slowest_rate_um_s() const;
  const Table& table() const { return m_table; }

 private:
  Temperatures held(const Temperatures& channels, FollowerOutput& output) const;
  Result<std::array<double, 3>> predict(double time_s, const Temperatures& channels,
                                        const std::map<std::string, double>& positions_mm) const;
  void limit(double dt_s, const std::array<double, 3>& wanted_um, FollowerOutput& output);

  Table m_table;
  FollowerOptions m_options;
  Predictor m_predictor;
  std::optional<double> m_time_s;
  std::array<double, 3> m_offset_um{};
};

}  // namespace zerodrift::compensation
