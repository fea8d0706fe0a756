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

class SignCheck {
 public:
  SignCheck(ModbusMachine& machine, acquisition::ErrorSource& source, const SignCheckOptions& options,
            const TaskContext& context)
      : m_machine(machine), m_source(source), m_options(options), m_context(context) {}

  SignCheckRecord run() {
    m_record.result = whole();
    return std::move(m_record);
  }

 private:
  Status whole() {
    ZD_TRY(const auto identity, m_machine.identify());
    if (!identity.accepts_host_offset) {
      return fail(ErrorCode::machine_unsupported,
                  {{"what", "the host offset"}, {"found", "none"}, {"expected", "one, for the sign check"}});
    }
    ZD_TRY(const bool was_on, m_machine.compensation_on());
    Status checked = m_machine.switch_compensation(true);
    if (checked) checked = without_throwing([this] { return watched(); });
    // The way back is not cancelled: offset 0, then the switch.
    OffsetExitOptions exit;
    exit.rate_um_s = std::numeric_limits<double>::infinity();  // the controller limits the test offset's rate by itself
    exit.patience_s = watchdog_s;
    exit.switch_off = !was_on;
    const Status guarded = m_machine.set_watchdog(ModbusMachine::default_watchdog_s);
    ZD_CHECK(leave_without_offset(m_machine, exit, checked ? "the sign check is done" : describe(checked.error())));
    return checked ? guarded : checked;
  }

  Status watched() {
    ZD_CHECK(m_machine.set_watchdog(watchdog_s));
    ZD_CHECK(m_machine.wait_for_ramp(true).map([](double) {}));
    ZD_CHECK(settle(0.0));
    for (std::size_t i = 0; i < m_options.axes.size(); ++i) {
      m_context.progress(static_cast<double>(i) / static_cast<double>(m_options.axes.size()), "sign_check");
      ZD_CHECK(one_axis(m_options.axes[i]));
    }
    return {};
  }

  /// Without, with, without, with, without - and again while the answer is in doubt.
  Status one_axis(const std::string& axis) {
    std::vector<Look> looks;
    ZD_CHECK(look(axis, false, looks));
    for (int round = 1;; ++round) {
      for (const bool with : {true, false, true, false}) ZD_CHECK(look(axis, with, looks));
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

  /// Puts the offset on or off, waits until it rests and measures; again when the offset did not stay meanwhile.
  Status look(const std::string& axis, bool with, std::vector<Look>& looks) {
    std::array<double, 3> offset{};
    if (with) offset[index_of(axis)] = m_options.offset_um;
    for (int attempt = 0; attempt < 3; ++attempt) {
      ZD_TRY(const auto before, m_machine.read());
      // What is held counts, not what was written: the controller may have taken some of it out.
      ZD_TRY(const RegisterValues held_before, m_machine.read_values({"host_offset_um"}));
      const double change = offset[index_of(axis)] - held_before.at("host_offset_um").at(index_of(axis));
      ZD_CHECK(m_machine.write_host_offset(offset));
      ZD_CHECK(settle(offset_time_s(change), before.applied_um[index_of(axis)] + change, index_of(axis)));
      ZD_TRY(const auto start, m_machine.read());
      ZD_TRY(const auto sample, m_source.measure(acquisition::standing_now(), m_context));
      ZD_TRY(const auto end, m_machine.read());
      ZD_TRY(const bool held, still_holds(offset));
      if (!held) continue;
      looks.push_back({0.5 * (time_of(start) + time_of(end)), with ? 1.0 : 0.0, sample});
      return {};
    }
    return fail(ErrorCode::machine_not_ready,
                {{"what", "the sign check"}, {"reason", "the controller takes the test offset out by itself"}});
  }

  Result<bool> still_holds(const std::array<double, 3>& offset_um) {
    ZD_TRY(const RegisterValues now, m_machine.read_values({"host_offset_um"}));
    const auto& held = now.at("host_offset_um");
    for (std::size_t i = 0; i < 3; ++i) {
      if (!(std::abs(held.at(i) - offset_um[i]) < 0.05 * m_options.offset_um)) return false;
    }
    return true;
  }

  /// Machine seconds that a controller may take to go there.
  double offset_time_s(double change_um) const { return std::abs(change_um) / m_machine.profile().max_um_per_s; }

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
      const bool near = std::isnan(goal_um) || std::abs(now.applied_um[axis] - goal_um) < share * m_options.offset_um;
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
  acquisition::ErrorSource& m_source;
  const SignCheckOptions& m_options;
  const TaskContext& m_context;
  SignCheckRecord m_record;
};

}  // namespace

SignCheckRecord check_signs(ModbusMachine& machine, acquisition::ErrorSource& source, const SignCheckOptions& options,
                            const TaskContext& context) {
  return SignCheck(machine, source, options, context).run();
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
