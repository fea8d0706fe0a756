#include "core/controller/sign_check.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>

#include "core/controller/offset_exit.h"

namespace zerodrift::controller {
namespace {

constexpr double share = 0.3;     // seen must be within 1 +- share of commanded, another axis must move less than share
constexpr double coverage = 2.0;  // and the measurement may be wrong by so many standard uncertainties
constexpr const char* too_few_seen = "too few measurements were accepted";
constexpr int most_rounds = 3;       // more measurements while the answer is in doubt
constexpr double watchdog_s = 60.0;  // host seconds: nothing beats while the camera is looked at
constexpr double settle_timeout_machine_s = 300.0;
constexpr double settle_window_machine_s = 2.0;
constexpr double settled_um_s = 0.1;  // machine seconds: below any ramp, above the thermal drift of a table

std::size_t index_of(const std::string& axis) {
  return axis == "X" ? 0 : axis == "Y" ? 1 : 2;
}

/// One look, at its time, with the offset on (1) or off (0).
struct Look {
  double time_s = 0.0;
  double offset = 0.0;
  acquisition::ErrorSample sample;
};

/// The part of the looks that goes with the offset: least squares with a drift of second degree beside it, so that a
/// machine that warms meanwhile is not taken for a move. The uncertainty is the looks' own, carried through.
/// NaN where too few of them saw anything.
std::pair<double, double> seen_in(const std::vector<Look>& all, std::size_t direction) {
  std::vector<Look> looks;
  std::array<int, 2> states{};
  for (const Look& look : all) {
    if (!std::isfinite(look.sample.error_um[direction])) continue;
    looks.push_back(look);
    ++states[look.offset == 0.0 ? 0 : 1];
  }
  const double nothing = std::nan("");
  if (looks.size() < 5 || states[0] == 0 || states[1] == 0) return {nothing, nothing};
  const auto n = static_cast<Eigen::Index>(looks.size());
  Eigen::MatrixXd design(n, 4);
  Eigen::VectorXd error(n);
  Eigen::VectorXd sigma(n);
  const double start_s = looks.front().time_s;
  const double span_s = std::max(1e-6, looks.back().time_s - start_s);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Look& look = looks[static_cast<std::size_t>(i)];
    const double t = (look.time_s - start_s) / span_s;
    design.row(i) << look.offset, 1.0, t, t * t;
    error[i] = look.sample.error_um[direction];
    sigma[i] = look.sample.sigma_um[direction];
  }
  // The row of the pseudo-inverse that gives the offset's part.
  const Eigen::RowVectorXd weights = design.completeOrthogonalDecomposition().pseudoInverse().row(0);
  return {weights.dot(error), weights.transpose().cwiseProduct(sigma).norm()};
}

/// Where a test offset is put on and taken off.
class TestOffset {
 public:
  virtual ~TestOffset() = default;
  virtual Result<acquisition::MachineIdentity> identify() = 0;
  /// The switch on, and what the machine applies at rest.
  virtual Status begin() = 0;
  /// Puts the offset on the axis, or takes it off (0), and waits until it rests.
  virtual Status apply(std::size_t axis, double offset_um) = 0;
  virtual Result<bool> still_holds(std::size_t axis, double offset_um) = 0;
  virtual Result<double> time_s() = 0;
  /// Offset 0 and the switch as it was found, whatever happened; `reason` is why it ends.
  virtual Status end(const std::string& reason) = 0;
  /// Whether the offset is on, look by look.
  virtual std::array<bool, 4> order() const = 0;
};

/// Over the registers of a controller: another offset costs nothing.
class LinkedOffset : public TestOffset {
 public:
  LinkedOffset(ModbusMachine& machine, double size_um, const TaskContext& context)
      : m_machine(machine), m_size_um(size_um), m_context(context) {}

  Result<acquisition::MachineIdentity> identify() override { return m_machine.identify(); }

  Status begin() override {
    ZD_TRY(m_was_on, m_machine.compensation_on());
    m_begun = true;
    ZD_CHECK(m_machine.switch_compensation(true));
    ZD_CHECK(m_machine.set_watchdog(watchdog_s));
    ZD_CHECK(m_machine.wait_for_ramp(true).map([](double) {}));
    return settle(0.0);
  }

  Status apply(std::size_t axis, double offset_um) override {
    std::array<double, 3> offset{};
    offset[axis] = offset_um;
    ZD_TRY(const auto before, m_machine.read());
    // What is held counts, not what was written: the controller may have taken some of it out.
    ZD_TRY(const auto held_um, m_machine.held_offset_um());
    const double change = offset_um - held_um[axis];
    ZD_CHECK(m_machine.write_host_offset(offset));
    return settle(std::abs(change) / m_machine.profile().max_um_per_s, before.applied_um[axis] + change, axis);
  }

  Result<bool> still_holds(std::size_t axis, double offset_um) override {
    ZD_TRY(const auto held_um, m_machine.held_offset_um());
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(std::abs(held_um[i] - (i == axis ? offset_um : 0.0)) < 0.05 * m_size_um)) return false;
    }
    return true;
  }

  Result<double> time_s() override {
    ZD_TRY(const auto sample, m_machine.read());
    return time_of(sample);
  }

  Status end(const std::string& reason) override {
    if (!m_begun) return {};
    // The way back is not cancelled: offset 0, then the switch.
    OffsetExitOptions exit;
    exit.rate_um_s = std::numeric_limits<double>::infinity();  // the controller limits the test offset's rate by itself
    exit.patience_s = watchdog_s;
    exit.switch_off = !m_was_on;
    const Status guarded = m_machine.set_watchdog(ModbusMachine::default_watchdog_s);
    ZD_CHECK(leave_without_offset(m_machine, exit, reason));
    return guarded;
  }

  std::array<bool, 4> order() const override { return {true, false, true, false}; }

 private:
  double time_of(const acquisition::MachineSample& sample) const {
    if (std::isfinite(sample.machine_time_s)) return sample.machine_time_s;
    const std::chrono::duration<double> host = std::chrono::steady_clock::now().time_since_epoch();
    return host.count() * m_machine.profile().time_factor;
  }

  /// Waits, in the machine's time, until what the controller applies rests: ramps, limits of rate and the smoothing of
  /// its readings all move it for a while. With a goal, until it is near that as well. A controller that does not tell
  /// what it applies is given the time of the ramp.
  Status settle(double ramp_s, double goal_um = std::nan(""), std::size_t axis = 0) {
    if (m_machine.map().find("applied_um") == nullptr) {
      std::this_thread::sleep_for(std::chrono::duration<double>(1.0 + ramp_s / m_machine.profile().time_factor));
      return {};
    }
    const auto end = std::chrono::steady_clock::now() +
                     std::chrono::duration<double>(m_machine.host_seconds(settle_timeout_machine_s));
    std::optional<acquisition::MachineSample> last;
    for (;;) {
      ZD_CHECK(m_machine.beat());
      ZD_TRY(auto now, m_machine.read());
      const bool near = std::isnan(goal_um) || std::abs(now.applied_um[axis] - goal_um) < share * m_size_um;
      if (!last) last = now;
      const double window_s = time_of(now) - time_of(*last);
      if (window_s >= settle_window_machine_s) {
        if (near && rests(*last, now, window_s)) return {};
        last = std::move(now);
      }
      if (std::chrono::steady_clock::now() > end) break;
      if (m_context.cancelled()) return fail(ErrorCode::cancelled);
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return fail(ErrorCode::machine_not_ready,
                {{"what", "the sign check"}, {"reason", "the offset is not applied, or does not come to rest"}});
  }

  static bool rests(const acquisition::MachineSample& before, const acquisition::MachineSample& now, double window_s) {
    bool all = true;
    for (std::size_t i = 0; i < 3; ++i) {
      all = all && std::abs(now.applied_um[i] - before.applied_um[i]) <= settled_um_s * window_s;
    }
    return all;
  }

  ModbusMachine& m_machine;
  double m_size_um;
  const TaskContext& m_context;
  bool m_begun = false;
  bool m_was_on = false;
};

/// By a person at the control, whom another offset costs time: each is put on once.
class OffsetByHand : public TestOffset {
 public:
  OffsetByHand(ManualControl& control, const TaskContext& context) : m_control(control), m_context(context) {}

  Result<acquisition::MachineIdentity> identify() override { return m_control.identify(); }

  Status begin() override {
    ZD_TRY(m_was_on, m_control.compensation_on());
    m_begun = true;
    ZD_CHECK(m_control.switch_compensation(true));
    return m_control.wait_for_ramp(true, m_context.stop).map([](double) {});
  }

  Status apply(std::size_t axis, double offset_um) override {
    std::array<double, 3> offset{};
    offset[axis] = offset_um;
    ZD_CHECK(m_control.write_host_offset(offset));
    const Profile& profile = m_control.profile();
    const double settle_s = settle_window_machine_s + std::abs(offset_um) / profile.max_um_per_s;
    if (host_clock().wait_for(Seconds(settle_s / profile.time_factor), m_context.stop)) return {};
    return fail(ErrorCode::cancelled);
  }

  Result<bool> still_holds(std::size_t /*axis*/, double /*offset_um*/) override { return true; }

  Result<double> time_s() override { return host_clock().steady().count() * m_control.profile().time_factor; }

  Status end(const std::string& reason) override {
    if (!m_begun) return {};
    Status left = m_control.write_host_offset({});
    if (left && !m_was_on) left = m_control.switch_compensation(false);
    if (left) return {};
    return fail(
        ErrorCode::compensation_left,
        {{"reason", reason}, {"detail", describe(left.error())}, {"held", "the test offset"}, {"switch", "on"}});
  }

  std::array<bool, 4> order() const override { return {true, true, false, false}; }

 private:
  ManualControl& m_control;
  const TaskContext& m_context;
  bool m_begun = false;
  bool m_was_on = false;
};

class SignCheck {
 public:
  SignCheck(TestOffset& offset, acquisition::ErrorSource& source, const SignCheckOptions& options,
            const TaskContext& context)
      : m_offset(offset), m_source(source), m_options(options), m_context(context) {}

  SignCheckRecord run() {
    m_record.result = whole();
    return std::move(m_record);
  }

 private:
  Status whole() {
    ZD_TRY(const auto identity, m_offset.identify());
    if (!identity.accepts_host_offset) {
      return fail(ErrorCode::machine_unsupported,
                  {{"what", "the host offset"}, {"found", "none"}, {"expected", "one, for the sign check"}});
    }
    Status checked = m_offset.begin();
    if (checked) checked = without_throwing([this] { return watched(); });
    const Status left = m_offset.end(checked ? "the sign check is done" : describe(checked.error()));
    if (!left && left.error().code == ErrorCode::compensation_left) return left;
    return checked ? left : checked;
  }

  Status watched() {
    for (std::size_t i = 0; i < m_options.axes.size(); ++i) {
      m_context.progress(static_cast<double>(i) / static_cast<double>(m_options.axes.size()), "sign_check");
      ZD_CHECK(one_axis(m_options.axes[i]));
    }
    return {};
  }

  /// Without, and with and without in the order that suits the machine - and again while the answer is in doubt.
  Status one_axis(const std::string& axis) {
    std::vector<Look> looks;
    ZD_CHECK(look(axis, false, looks));
    for (int round = 1;; ++round) {
      for (const bool with : m_offset.order()) ZD_CHECK(look(axis, with, looks));
      const SignCheckAxis row = row_of(axis, looks);
      const std::string fault = row.watched || !some_seen(looks, index_of(axis)) ? fault_of(row) : too_few_seen;
      const bool doubt = !fault.empty() || coverage * row.sigma_um[index_of(axis)] > 0.2 * row.commanded_um;
      if (doubt && round < most_rounds && !clearly_wrong(row)) continue;
      m_record.axes.push_back(row);
      if (fault.empty()) return {};
      return fail(ErrorCode::sign_check_failed, {{"axis", axis},
                                                 {"commanded_um", fmt::format("{:.1f}", row.commanded_um)},
                                                 {"seen_um", seen_text(row) + " - " + fault}});
    }
  }

  static bool some_seen(const std::vector<Look>& looks, std::size_t direction) {
    return std::any_of(looks.begin(), looks.end(),
                       [&](const Look& one) { return std::isfinite(one.sample.error_um[direction]); });
  }

  SignCheckAxis row_of(const std::string& axis, const std::vector<Look>& looks) const {
    SignCheckAxis row{axis, m_options.offset_um, {}, {}, false};
    for (std::size_t i = 0; i < 3; ++i) std::tie(row.seen_um[i], row.sigma_um[i]) = seen_in(looks, i);
    row.watched = std::isfinite(row.seen_um[index_of(axis)]);
    return row;
  }

  static double allowed_um(const SignCheckAxis& row, std::size_t direction) {
    const double sigma = std::isfinite(row.sigma_um[direction]) ? row.sigma_um[direction] : 0.0;
    return share * std::abs(row.commanded_um) + coverage * sigma;
  }

  /// Empty when all is right.
  static std::string fault_of(const SignCheckAxis& row) {
    const std::size_t own = index_of(row.axis);
    std::string elsewhere;
    for (std::size_t i = 0; i < 3; ++i) {
      if (i == own || !std::isfinite(row.seen_um[i]) || std::abs(row.seen_um[i]) <= allowed_um(row, i)) continue;
      elsewhere = fmt::format("{}", "XYZ"[i]);
    }
    const double seen = row.seen_um[own] / row.commanded_um;
    const bool small = std::abs(row.seen_um[own]) <= allowed_um(row, own);
    if (!elsewhere.empty()) {
      const char* beside = row.watched && !small ? "it moves {} too" : "it moves {}, the wrong axis";
      return fmt::format(fmt::runtime(beside), elsewhere);
    }
    if (!row.watched) return {};
    if (allowed_um(row, own) > 0.6 * std::abs(row.commanded_um)) {
      return fmt::format("the measurement is too uncertain ({:.1f} um) to tell", row.sigma_um[own]);
    }
    if (std::abs(row.seen_um[own] - row.commanded_um) <= allowed_um(row, own)) return {};
    if (small) return "nothing moves";
    return seen < 0.0 ? "the sign is wrong" : "the size is wrong";
  }

  /// So wrong that another look would change nothing.
  static bool clearly_wrong(const SignCheckAxis& row) {
    const double own = row.seen_um[index_of(row.axis)] / row.commanded_um;
    return own < -(1.0 - share);
  }

  static std::string seen_text(const SignCheckAxis& row) {
    std::string text;
    for (std::size_t i = 0; i < 3; ++i) {
      if (!std::isfinite(row.seen_um[i])) continue;
      if (!text.empty()) text += ", ";
      text += fmt::format("{} {:.1f}", "XYZ"[i], row.seen_um[i]);
    }
    return text.empty() ? "nothing" : text;
  }

  /// Puts the offset on or off and measures; again when the offset did not stay meanwhile.
  Status look(const std::string& axis, bool with, std::vector<Look>& looks) {
    const std::size_t index = index_of(axis);
    const double offset_um = with ? m_options.offset_um : 0.0;
    for (int attempt = 0; attempt < 3; ++attempt) {
      ZD_CHECK(m_offset.apply(index, offset_um));
      ZD_TRY(const double start_s, m_offset.time_s());
      ZD_TRY(const auto sample, m_source.measure(acquisition::standing_now(), m_context));
      ZD_TRY(const double end_s, m_offset.time_s());
      ZD_TRY(const bool held, m_offset.still_holds(index, offset_um));
      if (!held) continue;
      looks.push_back({0.5 * (start_s + end_s), with ? 1.0 : 0.0, sample});
      return {};
    }
    return fail(ErrorCode::machine_not_ready,
                {{"what", "the sign check"}, {"reason", "the controller takes the test offset out by itself"}});
  }

  TestOffset& m_offset;
  acquisition::ErrorSource& m_source;
  const SignCheckOptions& m_options;
  const TaskContext& m_context;
  SignCheckRecord m_record;
};

}  // namespace

SignCheckRecord check_signs(ModbusMachine& machine, acquisition::ErrorSource& source, const SignCheckOptions& options,
                            const TaskContext& context) {
  LinkedOffset offset(machine, options.offset_um, context);
  return SignCheck(offset, source, options, context).run();
}

SignCheckRecord check_signs(ManualControl& control, acquisition::ErrorSource& source, const SignCheckOptions& options,
                            const TaskContext& context) {
  OffsetByHand offset(control, context);
  return SignCheck(offset, source, options, context).run();
}

nlohmann::json to_json(const SignCheckRecord& record) {
  nlohmann::json axes = nlohmann::json::array();
  for (const auto& row : record.axes) {
    axes.push_back({{"axis", row.axis},
                    {"commanded_um", row.commanded_um},
                    {"seen_um", row.seen_um},
                    {"sigma_um", row.sigma_um},
                    {"watched", row.watched}});
  }
  nlohmann::json out = {{"axes", axes}, {"passed", record.result.has_value()}};
  if (!record.result) out["error"] = describe(record.result.error());
  return out;
}

}  // namespace zerodrift::controller
