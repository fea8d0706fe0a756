#pragma once
// A machine and a camera in simulated time whose pictures are late: the camera shows a speckle target where the machine
// was when the picture was exposed. Between its exposure and its arrival the latency passes, which may jump.

#include <gtest/gtest.h>

#include <array>
#include <deque>
#include <functional>
#include <memory>
#include <vector>

#include "core/acquisition/machine_io.h"
#include "core/base/clock.h"
#include "core/vision/picture_source.h"
#include "tests/vision/speckle.h"

namespace zerodrift::testing {

/// X to the right, Z upwards in the picture; a picture of 160 x 120 pixels.
class LateMachine : public acquisition::MachineIo {
 public:
  ManualClock clock;
  double feed_mm_s = 20.0;
  std::function<double(double time_s)> slip_mm = [](double) { return 0.0; };  // of the target in X, unknown to it

  Result<acquisition::MachineIdentity> identify() override { return acquisition::MachineIdentity{}; }
  Result<acquisition::MachineSample> read() override {
    clock.advance(Seconds(0.002));
    acquisition::MachineSample sample;
    sample.machine_time_s = now();
    const auto at = position_mm(now());
    sample.axes = {{"X", at[0]}, {"Y", 0.0}, {"Z", at[1]}};
    sample.moving = now() < m_legs.back().end_s;
    return sample;
  }
  Status command(double, bool, bool) override { return {}; }
  Status move_to(const std::map<std::string, double>& target_mm) override {
    const auto from = position_mm(now());
    const std::array<double, 2> to{target_mm.at("X"), target_mm.at("Z")};
    const double way_mm = std::max(std::abs(to[0] - from[0]), std::abs(to[1] - from[1]));
    m_legs.push_back({now(), now() + way_mm / feed_mm_s, from, to});
    clock.advance(Seconds(way_mm / feed_mm_s + 0.001));
    return {};
  }
  Status switch_compensation(bool) override { return {}; }
  Status write_host_offset(const std::array<double, 3>&) override { return {}; }

  double now() const { return clock.steady().count(); }
  /// Moves that had been commanded then.
  int moves_until(double time_s) const {
    int moves = -1;  // the first leg is none
    for (const Leg& one : m_legs) moves += one.start_s <= time_s;
    return moves;
  }
  /// X and Z.
  std::array<double, 2> position_mm(double time_s) const {
    const Leg* leg = &m_legs.front();
    for (const Leg& one : m_legs) {
      if (one.start_s <= time_s) leg = &one;
    }
    if (time_s >= leg->end_s) return leg->to;
    const double part = (time_s - leg->start_s) / (leg->end_s - leg->start_s);
    return {leg->from[0] + part * (leg->to[0] - leg->from[0]), leg->from[1] + part * (leg->to[1] - leg->from[1])};
  }

 private:
  struct Leg {
    double start_s, end_s;
    std::array<double, 2> from, to;
  };
  std::vector<Leg> m_legs{{-1e9, -1e9, {0, 0}, {0, 0}}};
};

class LateCamera : public vision::PictureSource {
 public:
  static constexpr double um_per_px = 50.0;
  static constexpr vision::Region target{50, 30, 60, 60};

  /// `latency_s` of the picture exposed at a time.
  LateCamera(LateMachine& machine, double frames_per_s, std::function<double(double)> latency_s)
      : m_machine(machine), m_period_s(1.0 / frames_per_s), m_latency_s(std::move(latency_s)) {}

  bool blind = false;  // the target is not in the picture: it never shows a move

  vision::GrayImage picture(double time_s, unsigned seed) const {
    Pose pose{0.0, 0.0, 0.0, 80.0, 60.0};
    if (!blind) {
      const auto at = m_machine.position_mm(time_s);
      pose.dx = 1000.0 * (at[0] + m_machine.slip_mm(time_s)) / um_per_px;
      pose.dy = -1000.0 * at[1] / um_per_px;
    }
    Light light;
    light.noise = 1.0;
    light.seed = seed;
    return render(m_speckle, pose, light, 160, 120);
  }

  Result<std::shared_ptr<const vision::CameraFrame>> next_picture(Seconds after, std::chrono::milliseconds timeout,
                                                                  const std::stop_token&) const override {
    const Seconds deadline = m_machine.clock.steady() + timeout;
    for (;;) {
      come_up_to(m_machine.now());
      if (m_newest && m_newest->stamp > after) return m_newest;
      if (m_coming_s > deadline.count()) return fail(ErrorCode::camera_silent);
      m_machine.clock.wait_until(Seconds(m_coming_s), {});
    }
  }
  vision::Sketches sketches(Seconds from) const override {
    come_up_to(m_machine.now());
    std::size_t first = m_sketches.size();
    while (first > 0 && (first == m_sketches.size() || m_sketches[first]->stamp > from)) --first;
    return {m_sketches.begin() + static_cast<std::ptrdiff_t>(first), m_sketches.end()};
  }
  bool is_file() const override { return false; }

 private:
  /// In the order in which they were exposed: none overtakes another.
  void come_up_to(double now_s) const {
    while (m_coming_s <= now_s) {
      auto frame = std::make_shared<vision::CameraFrame>();
      frame->image = picture(m_exposed_s, ++m_count);
      frame->count = m_count;
      frame->stamp = Seconds(m_coming_s);
      m_sketches.push_back(
          std::make_shared<const vision::PictureSketch>(vision::sketch_of(frame->image, frame->stamp)));
      m_newest = std::move(frame);
      m_exposed_s += m_period_s;
      m_coming_s = std::max(m_coming_s + 0.001, m_exposed_s + m_latency_s(m_exposed_s));
    }
  }

  LateMachine& m_machine;
  double m_period_s;
  std::function<double(double)> m_latency_s;
  Speckle m_speckle{3, 80.0, 60.0, 56.0};
  mutable unsigned m_count = 0;
  mutable double m_exposed_s = 0.0;
  mutable double m_coming_s = 0.0;
  mutable std::shared_ptr<const vision::CameraFrame> m_newest;
  mutable std::deque<std::shared_ptr<const vision::PictureSketch>> m_sketches;
};

}  // namespace zerodrift::testing
