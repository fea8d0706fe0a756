#pragma once
// The host compensator's arithmetic (C1), apart from any link: temperatures in, the offset to write out. The offset is
// limited in size and rate; a dead sensor lets it run to 0, temperatures beyond the model's training are held at its
// edge, where the model is still known - both with a reason in words.

#include <array>
#include <map>
#include <string>
#include <vector>

#include "core/compensation/table.h"

namespace zerodrift::compensation {

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
  explicit Follower(Table table, FollowerOptions options = {}) : m_table(std::move(table)), m_options(options) {}

  /// One turn, dt_s after the last: temperatures by channel, positions by axis.
  FollowerOutput step(double dt_s, const Temperatures& temperatures, const std::map<std::string, double>& positions_mm);
  /// From now on run to 0.
  void stop() { m_stopping = true; }
  /// What the controller holds now; it may have taken the offset out by itself (switch off, watchdog).
  void start_from(const std::array<double, 3>& offset_um) { m_offset_um = offset_um; }
  bool at_zero() const;
  const Table& table() const { return m_table; }

 private:
  Temperatures held(const Temperatures& temperatures, FollowerOutput& output) const;
  void limit(double dt_s, const std::array<double, 3>& wanted_um, FollowerOutput& output);

  Table m_table;
  FollowerOptions m_options;
  bool m_stopping = false;
  std::array<double, 3> m_offset_um{};
};

}  // namespace zerodrift::compensation
