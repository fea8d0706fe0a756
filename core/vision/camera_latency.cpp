#include "core/vision/camera_latency.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/acquisition/stand.h"

namespace zerodrift::vision {
namespace {

using acquisition::LatencyBounds;
using acquisition::Stand;

constexpr double follow_patience_s = 10.0;  // for a move to show and to come to rest in the pictures
constexpr double rest_s = 0.2;              // without a change, and so many pictures
constexpr std::size_t rest_pictures = 3;
constexpr std::size_t noise_pictures = 5;
constexpr double moved_levels = 3.0;        // times the noise at rest: another place
constexpr double least_moved_levels = 6.0;  // grey levels
constexpr std::chrono::milliseconds picture_timeout{6000};
constexpr double latency_coverage = 3.0;

/// One camera and what the two places look like in it.
struct Watched {
  const LatencyCamera& what;
  Region cells;
  double limit = least_moved_levels;
  std::shared_ptr<const PictureSketch> home;
  std::vector<LatencyBounds> bounds;

  bool like(const PictureSketch& a, const PictureSketch& b) const { return difference(a, b, cells) <= limit; }
};

Error no_latency(const LatencyCamera& camera, const std::string& reason) {
  return {ErrorCode::calibration_refused, {{"reason", fmt::format("camera {}: {}", camera.id, reason)}}};
}

/// The picture at home: what it looks like, and its noise, once the machine has stood for longer than any picture is on
/// its way.
Status learn_home(Watched& camera, Seconds since, const TaskContext& context) {
  Seconds after = since;
  for (std::size_t k = 0; k < noise_pictures; ++k) {
    ZD_TRY(const auto frame, camera.what.camera->next_picture(after, picture_timeout, context.stop));
    if (k == 0) camera.cells = sketch_region(camera.what.region, frame->image);
    after = frame->stamp;
  }
  const Sketches sketches = camera.what.camera->sketches(since);
  camera.limit = std::max(least_moved_levels, moved_levels * noise_of(sketches, noise_pictures, camera.cells));
  camera.home = sketches.back();
  return {};
}

/// Waits until the pictures show the place, home or the other one, at rest. Its bounds are those of the stop.
Status follow(Watched& camera, const Stand& stand, bool home, const TaskContext& context) {
  Seconds after = stand.left;
  while (after < stand.since + Seconds(follow_patience_s)) {
    ZD_TRY(const auto frame, camera.what.camera->next_picture(after, picture_timeout, context.stop));
    after = frame->stamp;
    const Sketches sketches = camera.what.camera->sketches(stand.left);
    const PictureSketch& newest = *sketches.back();
    if (camera.like(newest, *camera.home) != home) continue;
    auto first = sketches.rbegin();  // of those that show the same place
    while (first + 1 != sketches.rend() && camera.like(**(first + 1), newest)) ++first;
    const auto same = static_cast<std::size_t>(first - sketches.rbegin()) + 1;
    if (first + 1 == sketches.rend()) continue;  // the move has not been seen
    if (same < rest_pictures || newest.stamp - (*first)->stamp < Seconds(rest_s)) continue;
    camera.bounds.push_back({((*(first + 1))->stamp - stand.since).count(), ((*first)->stamp - stand.left).count()});
    return {};
  }
  return fail(no_latency(camera.what, "its picture does not follow the machine"));
}

acquisition::Latency latency_by(const std::vector<LatencyBounds>& bounds) {
  acquisition::Latency latency;
  double sum_s = 0.0;
  double longest_s = 0.0;
  for (const LatencyBounds& one : bounds) {
    sum_s += 0.5 * (std::max(0.0, one.shortest_s) + one.longest_s);
    longest_s = std::max(longest_s, one.longest_s);
  }
  const auto n = static_cast<double>(bounds.size());
  latency.mean_s = sum_s / n;
  double squares_s2 = 0.0;
  for (const LatencyBounds& one : bounds) {
    const double off_s = 0.5 * (std::max(0.0, one.shortest_s) + one.longest_s) - latency.mean_s;
    squares_s2 += off_s * off_s / n;
  }
  latency.spread_s = std::max(longest_s - latency.mean_s, latency_coverage * std::sqrt(squares_s2));
  latency.observations = static_cast<int>(bounds.size());
  return latency;
}

class LatencyMeasurement {
 public:
  LatencyMeasurement(acquisition::MachineIo& machine, const LatencyPlan& plan, const TaskContext& context, Clock& host)
      : m_machine(machine), m_plan(plan), m_context(context), m_host(host), m_away_mm(plan.centre_mm) {
    for (const std::string& axis : plan.axes) m_away_mm[axis] += plan.way_mm;
  }

  /// `older_s`: no picture of before is expected to come later than this. `home`: where the machine is at rest already.
  Status run(std::vector<Watched>& cameras, double older_s, const std::optional<Stand>& home) {
    const bool there = home && home->still();
    ZD_TRY(const Stand first, there ? Result<Stand>(*home) : acquisition::come_to(m_machine, m_plan.centre_mm, m_host));
    if (!m_host.wait_until(first.since + Seconds(older_s), m_context.stop)) return fail(ErrorCode::cancelled);
    for (Watched& camera : cameras) ZD_CHECK(learn_home(camera, first.since + Seconds(older_s), m_context));
    for (int k = 0; k < m_plan.moves; ++k) {
      const bool back = k % 2 == 1;
      ZD_TRY(const Stand stand, acquisition::come_to(m_machine, back ? m_plan.centre_mm : m_away_mm, m_host));
      for (Watched& camera : cameras) ZD_CHECK(follow(camera, stand, back, m_context));
      m_context.progress(static_cast<double>(k + 1) / m_plan.moves, "latency");
    }
    return {};
  }

 private:
  acquisition::MachineIo& m_machine;
  const LatencyPlan& m_plan;
  const TaskContext& m_context;
  Clock& m_host;
  std::map<std::string, double> m_away_mm;
};

}  // namespace

Result<std::vector<acquisition::Latency>> measure_latency(acquisition::MachineIo& machine,
                                                          const std::vector<LatencyCamera>& cameras,
                                                          const LatencyPlan& plan, const TaskContext& context,
                                                          Clock& host) {
  LatencyMeasurement measurement(machine, plan, context, host);
  // Once more where a camera hung, and then after a longer rest: one that is slower than expected still showed an
  // earlier move.
  std::vector<Watched> watched;
  Status done;
  std::optional<Stand> home = plan.home;
  for (const double older_s : {plan.longest_s, plan.longest_s, 2.0 * plan.longest_s + follow_patience_s}) {
    watched.clear();
    for (const LatencyCamera& camera : cameras) watched.push_back({camera, {}, least_moved_levels, {}, {}});
    done = measurement.run(watched, older_s, std::exchange(home, std::nullopt));
    if (done) break;
    const ErrorCode code = done.error().code;
    if (code != ErrorCode::calibration_refused && code != ErrorCode::camera_frozen) break;
  }
  ZD_CHECK(acquisition::come_to(machine, plan.centre_mm, host).map([](const Stand&) {}));
  ZD_CHECK(done);
  std::vector<acquisition::Latency> out;
  for (const Watched& camera : watched) out.push_back(latency_by(camera.bounds));
  return out;
}

}  // namespace zerodrift::vision
