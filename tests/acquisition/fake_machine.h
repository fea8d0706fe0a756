#pragma once
// A machine and an error source without hardware: both live on the clock they are given, warm up by a simple law, and
// fail when told. One thread uses them, as it is with real ones.

#include <cmath>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "core/acquisition/error_source.h"
#include "core/acquisition/machine_io.h"
#include "core/base/clock.h"
#include "core/base/noise.h"

namespace zerodrift::acquisition {

class FakeMachine : public MachineIo {
 public:
  struct Command {
    double time_s;
    double spindle_rpm;
    bool coolant_on;
    bool path_cycle;
  };

  explicit FakeMachine(Clock& clock, std::size_t sensors = 4) : m_clock(clock) {
    identity.name = "Fake";
    identity.serial = 4711;
    for (std::size_t i = 0; i < sensors; ++i)
      identity.sensors.push_back({"T" + std::to_string(i + 1) + "_C", "", "", 0.1});
  }

  Result<MachineIdentity> identify() override {
    ZD_CHECK(link());
    return identity;
  }

  Result<MachineSample> read() override {
    ++reads;
    ZD_CHECK(link());
    MachineSample sample;
    sample.machine_time_s = now_s() - clock_zero_s;
    sample.spindle_rpm = rpm;
    sample.coolant_on = coolant;
    sample.feed_mm_min = {{"X", cycle ? 3000.0 : 0.0}, {"Y", cycle ? 2000.0 : 0.0}, {"Z", 0.0}};
    sample.ambient_C = 20.0;
    for (std::size_t i = 0; i < identity.sensors.size(); ++i) {
      const double rise = 10.0 * (1.0 - std::exp(-now_s() / 3600.0)) / double(i + 1);
      sample.temperature_C.push_back(std::round(16.0 * (20.0 + rise + 0.1 * m_noise.normal())) / 16.0);
    }
    if (change) change(sample);
    return sample;
  }

  Status command(double spindle_rpm, bool coolant_on, bool path_cycle) override {
    ZD_CHECK(link());
    rpm = spindle_rpm;
    coolant = coolant_on;
    cycle = path_cycle;
    commands.push_back({now_s(), spindle_rpm, coolant_on, path_cycle});
    return {};
  }

  Status move_to(const std::map<std::string, double>&) override {
    ZD_CHECK(link());
    ++moves;
    cycle = false;
    m_clock.wait_for(Seconds(move_s), {});
    return {};
  }

  Status switch_compensation(bool) override { return {}; }
  Status write_host_offset(const std::array<double, 3>&) override { return {}; }

  double now_s() const { return m_clock.steady().count(); }

  MachineIdentity identity;
  std::function<bool(double time_s)> cable_is_out;  // asked at every call
  ErrorCode link_error = ErrorCode::machine_link_lost;
  std::function<void(MachineSample&)> change;  // the last word on a reading
  double clock_zero_s = -1000.0;               // the machine was switched on 1000 s before
  double move_s = 2.0;
  double rpm = 0.0;
  bool coolant = false;
  bool cycle = false;
  int reads = 0;
  int moves = 0;
  std::vector<Command> commands;

 private:
  Status link() const {
    if (!cable_is_out || !cable_is_out(now_s())) return {};
    return fail(link_error, {{"what", "read"}, {"detail", "unplugged"}, {"exception", "11"}});
  }

  Clock& m_clock;
  Noise m_noise{1};
};

class FakeErrors : public ErrorSource {
 public:
  explicit FakeErrors(Clock& clock) : m_clock(clock) {}

  Status take_zero(const Stand&, const TaskContext&) override {
    ++zeros_taken;
    zero = raw();
    return {};
  }
  std::optional<std::array<double, 3>> zero_um() const override {
    if (!keeps_zero) return std::nullopt;
    return zero;
  }
  bool restore_zero_um(const std::array<double, 3>& kept) override {
    if (keeps_zero) zero = kept;
    return keeps_zero;
  }
  Result<ErrorSample> measure(const Stand&, const TaskContext& context) override {
    const Seconds begin = host_clock().steady();
    if (!m_clock.wait_for(Seconds(measure_s), context.stop)) return fail(ErrorCode::cancelled);
    if (failure && failure(m_clock.steady().count())) {
      return fail(ErrorCode::camera_silent, {{"url", "fake"}, {"seconds", "1"}});
    }
    const auto now = raw();
    ErrorSample sample{{now[0] - zero[0], now[1] - zero[1], now[2] - zero[2]}, {0.2, 0.2, 0.3}, {}};
    if (seen_at_once) {
      sample.seen = begin;
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
    if (moves) moves(sample);
    if (refuse) {
      sample.error_um[1] = std::nan("");
      sample.problems.push_back("glare");
    }
    return sample;
  }
  std::string name() const override { return "fake"; }

  /// What the source sees, in its own scale.
  std::array<double, 3> raw() const {
    const double warm = 1.0 - std::exp(-m_clock.steady().count() / 3600.0);
    return {offset_um + 10.0 * warm, offset_um - 5.0 * warm, offset_um + 60.0 * warm};
  }

  std::array<double, 3> zero{};
  std::function<bool(double time_s)> failure;
  bool seen_at_once = false;  // the pictures come first, then they are worked on
  bool refuse = false;
  std::function<void(ErrorSample&)> moves;  // the last word on a measurement
  bool keeps_zero = true;
  double offset_um = 7.0;
  double measure_s = 3.0;
  int zeros_taken = 0;

 private:
  Clock& m_clock;
};

}  // namespace zerodrift::acquisition
