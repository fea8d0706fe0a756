#include "core/controller/sign_check.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

namespace zerodrift::controller {
namespace {

constexpr double apply_timeout_machine_s = 120.0;
constexpr double share = 0.5;  // seen/commanded must be within 1 +- share; another axis must move less than share

std::size_t index_of(const std::string& axis) {
  return axis == "X" ? 0 : axis == "Y" ? 1 : 2;
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
    ZD_CHECK(m_machine.switch_compensation(true));
    ZD_CHECK(m_machine.wait_for_ramp(true).map([](double) {}));
    ZD_TRY(const auto start, m_machine.read());
    m_base_um = start.applied_um;
    Status checked = all_axes();
    // The way back is not cancelled: offset 0, then the switch.
    const Status zeroed = apply({0.0, 0.0, 0.0});
    const Status switched = was_on ? Status{} : m_machine.switch_compensation(false);
    if (!checked) return checked;
    return zeroed ? switched : zeroed;
  }

  Status all_axes() {
    for (std::size_t i = 0; i < m_options.axes.size(); ++i) {
      m_context.progress(static_cast<double>(i) / static_cast<double>(m_options.axes.size()), "sign_check");
      ZD_CHECK(one_axis(m_options.axes[i]));
    }
    return {};
  }

  /// Before, with, after: the mean of before and after takes out a drift that goes on meanwhile.
  Status one_axis(const std::string& axis) {
    ZD_TRY(const auto before, m_source.measure(m_context));
    std::array<double, 3> offset{};
    offset[index_of(axis)] = m_options.offset_um;
    ZD_CHECK(apply(offset));
    ZD_TRY(const auto with, m_source.measure(m_context));
    ZD_CHECK(apply({0.0, 0.0, 0.0}));
    ZD_TRY(const auto after, m_source.measure(m_context));
    SignCheckAxis row{axis, m_options.offset_um, {}, false};
    for (std::size_t i = 0; i < 3; ++i) {
      row.seen_um[i] = with.error_um[i] - 0.5 * (before.error_um[i] + after.error_um[i]);
    }
    row.watched = std::isfinite(row.seen_um[index_of(axis)]);
    m_record.axes.push_back(row);
    return judge(row);
  }

  static Status judge(const SignCheckAxis& row) {
    const auto failed = [&](const std::string& seen) {
      return fail(ErrorCode::sign_check_failed,
                  {{"axis", row.axis}, {"commanded_um", fmt::format("{:.1f}", row.commanded_um)}, {"seen_um", seen}});
    };
    for (std::size_t i = 0; i < 3; ++i) {
      const bool own = i == index_of(row.axis);
      const double expected = own ? row.commanded_um : 0.0;
      if (!std::isfinite(row.seen_um[i])) continue;
      if (std::abs(row.seen_um[i] - expected) <= share * std::abs(row.commanded_um)) continue;
      return failed(own ? fmt::format("{:.1f}", row.seen_um[i])
                        : fmt::format("{:.1f} um in {}, not 0.0", row.seen_um[i], "XYZ"[i]));
    }
    return {};
  }

  /// Writes the offset and waits until the controller has gone there (or, if it does not tell, long enough).
  Status apply(const std::array<double, 3>& offset_um) {
    ZD_CHECK(m_machine.write_host_offset(offset_um));
    if (m_machine.map().find("applied_um") == nullptr) {
      const double ramp_s = m_options.offset_um / m_machine.profile().max_um_per_s;
      std::this_thread::sleep_for(std::chrono::duration<double>(1.0 + ramp_s / m_machine.profile().time_factor));
      return {};
    }
    const auto host_s = std::chrono::duration<double>(m_machine.host_seconds(apply_timeout_machine_s));
    const auto end = std::chrono::steady_clock::now() + host_s;
    for (;;) {
      ZD_CHECK(m_machine.beat());
      ZD_TRY(const auto sample, m_machine.read());
      if (arrived(sample.applied_um, offset_um)) return {};
      if (std::chrono::steady_clock::now() > end) {
        return fail(ErrorCode::machine_not_ready,
                    {{"what", "the sign check"}, {"reason", "the offset is not applied"}});
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(30));
    }
  }

  /// The table's own part is what was applied at offset 0, and may drift a little meanwhile.
  bool arrived(const std::array<double, 3>& applied_um, const std::array<double, 3>& offset_um) {
    bool all = true;
    for (std::size_t i = 0; i < 3; ++i) {
      all = all && std::abs(applied_um[i] - m_base_um[i] - offset_um[i]) < 0.1 * m_options.offset_um;
    }
    return all;
  }

  ModbusMachine& m_machine;
  acquisition::ErrorSource& m_source;
  const SignCheckOptions& m_options;
  const TaskContext& m_context;
  SignCheckRecord m_record;
  std::array<double, 3> m_base_um{};
};

}  // namespace

SignCheckRecord check_signs(ModbusMachine& machine, acquisition::ErrorSource& source, const SignCheckOptions& options,
                            const TaskContext& context) {
  return SignCheck(machine, source, options, context).run();
}

nlohmann::json to_json(const SignCheckRecord& record) {
  nlohmann::json axes = nlohmann::json::array();
  for (const auto& row : record.axes) {
    axes.push_back(
        {{"axis", row.axis}, {"commanded_um", row.commanded_um}, {"seen_um", row.seen_um}, {"watched", row.watched}});
  }
  nlohmann::json out = {{"axes", axes}, {"passed", record.result.has_value()}};
  if (!record.result) out["error"] = describe(record.result.error());
  return out;
}

}  // namespace zerodrift::controller
