#include "core/vision/camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <opencv2/core.hpp>
#include <optional>
#include <thread>

#include "core/base/redact.h"
#include "core/vision/aravis_source.h"
#include "core/vision/capture_stream.h"
#include "core/vision/mjpeg_stream.h"

namespace zerodrift::vision {
namespace {

using Steady = std::chrono::steady_clock;
using Milliseconds = std::chrono::milliseconds;

constexpr double default_file_rate_hz = 25.0;
constexpr std::uint64_t fewest_repeats = 5;
constexpr std::uint64_t longest_line = 12;  // pictures that may wait between camera and reader
constexpr double longest_history_s = 60.0;
constexpr std::size_t most_sketches = 2000;
// A device's stamp is believed when it is of the host's own clock: not of the future, and not older than this.
constexpr double oldest_stamp_s = 10.0;

CameraHealth sum(const CameraHealth& a, const CameraHealth& b) {
  CameraHealth both = a;
  both.incomplete += b.incomplete;
  both.lost += b.lost;
  both.lost_packets += b.lost_packets;
  both.resent_packets += b.resent_packets;
  return both;
}

std::string seconds_text(Steady::duration duration) {
  return fmt::format("{:.1f}", std::chrono::duration<double>(duration).count());
}

}  // namespace

struct Camera::Work {
  std::string source;
  CameraOptions options;
  mutable std::mutex mutex;
  mutable std::condition_variable_any changed;
  std::shared_ptr<const CameraFrame> frame;
  Steady::time_point started = Steady::now();
  Steady::time_point last_change;  // when the picture last differed from the one before
  std::uint64_t last_changed = 0;  // and which frame that was
  std::deque<Steady::time_point> arrivals;
  std::deque<std::shared_ptr<const PictureSketch>> history;
  std::uint64_t opened = 0;
  std::string detail = "not opened yet";
  std::optional<Error> refused;  // why what is there is not read
  CameraIdentity identity;
  CameraHealth health;  // of the streams before the one that is open
  CameraHealth open_health;
  std::jthread thread;

  void run(const std::stop_token& stop);
  Result<std::unique_ptr<PictureStream>> open(const std::stop_token& stop);
  void read_all(PictureStream& stream, const std::stop_token& stop);
  void publish(GrayImage image, std::optional<Seconds> device_stamp);
  Result<std::shared_ptr<const CameraFrame>> state(Steady::time_point now) const;
  std::optional<Steady::duration> repeating(Steady::time_point now) const;
  bool in_a_burst() const;
  bool pause(Steady::duration duration, const std::stop_token& stop) {
    std::unique_lock lock(mutex);
    return !changed.wait_for(lock, stop, duration, [&] { return stop.stop_requested(); });
  }
};

Result<std::unique_ptr<PictureStream>> Camera::Work::open(const std::stop_token& stop) {
  if (kind_of(source) == SourceKind::genicam) return open_aravis(source, identity.serial, options);
  if (source.rfind("http://", 0) == 0 || source.rfind("https://", 0) == 0) {
    ZD_TRY(auto pictures, open_mjpeg(source, options, stop));
    if (pictures) return pictures;
  }
  ZD_TRY(auto stream, open_capture(source, options, stop));
  if (!stream) return fail(ErrorCode::camera_unreachable, {{"detail", "no picture could be opened"}});
  return stream;
}

void Camera::Work::run(const std::stop_token& stop) {
  Milliseconds wait{200};
  while (!stop.stop_requested()) {
    bool worked = false;
    try {
      auto stream = open(stop);
      {
        const std::lock_guard lock(mutex);
        refused.reset();
        if (stream) {
          ++opened;
          identity = (*stream)->identity();
          detail = "the stream ended";
        } else if (stream.error().code == ErrorCode::camera_unreachable) {
          detail = stream.error().context["detail"];
        } else {
          refused = stream.error();
          refused->context["url"] = without_secrets(source);
        }
      }
      changed.notify_all();
      if (stream) {
        const std::uint64_t before = frame ? frame->count : 0;
        read_all(**stream, stop);
        worked = frame && frame->count > before;
      }
    } catch (const cv::Exception& problem) {
      const std::lock_guard lock(mutex);
      detail = problem.err;
    }
    if (stop.stop_requested()) return;
    if (kind_of(source) == SourceKind::file && worked) continue;
    wait = worked ? Milliseconds{200} : std::min(2 * wait, options.longest_pause);
    if (!pause(wait, stop)) return;
  }
}

void Camera::Work::read_all(PictureStream& stream, const std::stop_token& stop) {
  const bool from_file = kind_of(source) == SourceKind::file;
  double rate = stream.claimed_rate_hz();
  if (!(rate > 0.5 && rate < 500.0)) rate = default_file_rate_hz;
  const auto period = std::chrono::duration_cast<Steady::duration>(std::chrono::duration<double>(1.0 / rate));
  Steady::time_point due = Steady::now();
  while (!stop.stop_requested()) {
    auto picture = stream.next(stop);
    {
      const std::lock_guard lock(mutex);
      open_health = stream.health();
    }
    if (!picture) break;
    publish(std::move(picture->image), picture->stamp);
    if (!from_file) continue;
    due += period;
    if (!pause(due - Steady::now(), stop)) break;
  }
  const std::lock_guard lock(mutex);
  health = sum(health, open_health);
  open_health = {};
}

void Camera::Work::publish(GrayImage image, std::optional<Seconds> device_stamp) {
  auto next = std::make_shared<CameraFrame>();
  next->image = std::move(image);
  next->arrived = Steady::now();
  next->stamp = Seconds(next->arrived.time_since_epoch());
  if (device_stamp && *device_stamp<next->stamp&& * device_stamp> next->stamp - Seconds(oldest_stamp_s)) {
    next->stamp = *device_stamp;
  }
  auto sketch = std::make_shared<const PictureSketch>(sketch_of(next->image, next->stamp));
  const std::lock_guard lock(mutex);
  next->count = frame ? frame->count + 1 : 1;
  const bool other = !frame || frame->image.pixels != next->image.pixels;
  if (other) {
    last_change = next->arrived;
    last_changed = next->count;
    history.push_back(std::move(sketch));
  }
  while (history.size() > most_sketches ||
         history.back()->stamp - history.front()->stamp > Seconds(longest_history_s)) {
    history.pop_front();
  }
  frame = std::move(next);
  arrivals.push_back(frame->arrived);
  if (arrivals.size() > 60) arrivals.pop_front();
  changed.notify_all();
}

// With the mutex held.
Result<std::shared_ptr<const CameraFrame>> Camera::Work::state(Steady::time_point now) const {
  const bool live = kind_of(source) != SourceKind::file;
  if (refused) return fail(*refused);
  if (!frame) {
    if (opened == 0) return fail(ErrorCode::camera_unreachable, {{"url", without_secrets(source)}, {"detail", detail}});
    return fail(ErrorCode::camera_silent, {{"url", without_secrets(source)}, {"seconds", seconds_text(now - started)}});
  }
  if (now - frame->arrived > options.silent_after) {
    return fail(ErrorCode::camera_silent,
                {{"url", without_secrets(source)}, {"seconds", seconds_text(now - frame->arrived)}});
  }
  if (live && now - last_change > options.frozen_after) {
    return fail(ErrorCode::camera_frozen,
                {{"url", without_secrets(source)}, {"seconds", seconds_text(now - last_change)}});
  }
  return frame;
}

// With the mutex held. For how long a live camera has sent one picture over and over, when that is too long to wait for
// in a measurement: the machine drifts meanwhile.
std::optional<Steady::duration> Camera::Work::repeating(Steady::time_point now) const {
  const bool repeats = kind_of(source) != SourceKind::file && frame && frame->count >= last_changed + fewest_repeats;
  const auto since = now - last_change;
  return repeats && since > options.repeats_after ? std::optional(since) : std::nullopt;
}

// With the mutex held. The newest picture came much sooner after the one before than pictures usually do.
bool Camera::Work::in_a_burst() const {
  if (kind_of(source) == SourceKind::file || arrivals.size() < 10) return false;
  const auto usual = (arrivals.back() - arrivals.front()) / static_cast<int>(arrivals.size() - 1);
  return arrivals.back() - arrivals[arrivals.size() - 2] < usual / 4;
}

Camera::Camera(std::string source, CameraOptions options) : m_work(std::make_shared<Work>()) {
  m_work->source = std::move(source);
  m_work->options = options;
  m_work->thread = std::jthread([work = m_work.get()](const std::stop_token& stop) { work->run(stop); });
}

Camera::~Camera() {
  m_work->thread.request_stop();
  m_work->thread.join();  // at most the read timeout; of a camera at aravis: a search or a camera that is gone, seconds
}

bool Camera::is_exclusive(const std::string& source) {
  return kind_of(source) == SourceKind::device || kind_of(source) == SourceKind::genicam;
}

const std::string& Camera::source() const {
  return m_work->source;
}

Result<std::shared_ptr<const CameraFrame>> Camera::newest() const {
  const std::lock_guard lock(m_work->mutex);
  return m_work->state(Steady::now());
}

Result<std::shared_ptr<const CameraFrame>> Camera::fresh_frame(Time after, Milliseconds timeout,
                                                               const std::stop_token& stop) const {
  std::unique_lock lock(m_work->mutex);
  const Time deadline = Steady::now() + timeout;
  std::uint64_t first_after = 0;
  while (true) {
    const auto& frame = m_work->frame;
    if (frame && frame->arrived > after) {
      if (first_after == 0) first_after = frame->count;
      // The first may have been exposed before; so may one that repeats it, as a camera does that froze just then, and
      // those that a starved reader finds waiting in the line: they arrive at once, one upon the other.
      const bool waited = !m_work->in_a_burst() || frame->count > first_after + longest_line;
      if (m_work->last_changed > first_after && waited) return frame;
      if (kind_of(m_work->source) == SourceKind::file && frame->count > first_after) return frame;
      if (const auto repeated = m_work->repeating(Steady::now())) {
        return fail(ErrorCode::camera_frozen,
                    {{"url", without_secrets(m_work->source)}, {"seconds", seconds_text(*repeated)}});
      }
    }
    if (stop.stop_requested()) return fail(ErrorCode::cancelled);
    if (m_work->refused) return fail(*m_work->refused);
    const std::uint64_t seen = frame ? frame->count : 0;
    const bool more = m_work->changed.wait_until(
        lock, stop, deadline, [&] { return m_work->refused || (m_work->frame && m_work->frame->count != seen); });
    if (more) continue;
    if (stop.stop_requested()) return fail(ErrorCode::cancelled);
    const Time now = Steady::now();
    if (now < deadline) continue;
    if (const auto state = m_work->state(now); !state) return fail(state.error());
    const bool frozen = m_work->frame && m_work->frame->count > first_after && first_after > 0;
    return fail(frozen ? ErrorCode::camera_frozen : ErrorCode::camera_silent,
                {{"url", without_secrets(m_work->source)}, {"seconds", seconds_text(timeout)}});
  }
}

Result<std::shared_ptr<const CameraFrame>> Camera::next_picture(Seconds after, Milliseconds timeout,
                                                                const std::stop_token& stop) const {
  std::unique_lock lock(m_work->mutex);
  const Time deadline = Steady::now() + timeout;
  const bool file = kind_of(m_work->source) == SourceKind::file;
  std::uint64_t first = 0;
  while (true) {
    const auto& frame = m_work->frame;
    if (frame && frame->stamp > after) {
      if (first == 0) first = frame->count;
      const bool own = file || m_work->last_changed == frame->count;
      if (own && (!m_work->in_a_burst() || frame->count > first + longest_line)) return frame;
      if (const auto repeated = m_work->repeating(Steady::now())) {
        return fail(ErrorCode::camera_frozen,
                    {{"url", without_secrets(m_work->source)}, {"seconds", seconds_text(*repeated)}});
      }
    }
    if (stop.stop_requested()) return fail(ErrorCode::cancelled);
    if (m_work->refused) return fail(*m_work->refused);
    const std::uint64_t seen = frame ? frame->count : 0;
    const bool more = m_work->changed.wait_until(
        lock, stop, deadline, [&] { return m_work->refused || (m_work->frame && m_work->frame->count != seen); });
    if (more) continue;
    if (stop.stop_requested()) return fail(ErrorCode::cancelled);
    const Time now = Steady::now();
    if (now < deadline) continue;
    if (const auto state = m_work->state(now); !state) return fail(state.error());
    return fail(ErrorCode::camera_silent,
                {{"url", without_secrets(m_work->source)}, {"seconds", seconds_text(timeout)}});
  }
}

Sketches Camera::sketches(Seconds from) const {
  const std::lock_guard lock(m_work->mutex);
  Sketches out;
  for (auto one = m_work->history.rbegin(); one != m_work->history.rend(); ++one) {
    out.push_back(*one);
    if ((*one)->stamp <= from) break;
  }
  std::reverse(out.begin(), out.end());
  return out;
}

bool Camera::is_file() const {
  return kind_of(m_work->source) == SourceKind::file;
}

double Camera::frames_per_s() const {
  const std::lock_guard lock(m_work->mutex);
  const auto& arrivals = m_work->arrivals;
  if (arrivals.size() < 2 || Steady::now() - arrivals.back() > std::chrono::seconds(2)) return 0.0;
  const double span_s = std::chrono::duration<double>(arrivals.back() - arrivals.front()).count();
  return span_s > 0.0 ? static_cast<double>(arrivals.size() - 1) / span_s : 0.0;
}

std::optional<CameraIdentity> Camera::identity(Milliseconds wait, const std::stop_token& stop) const {
  std::unique_lock lock(m_work->mutex);
  m_work->changed.wait_for(lock, stop, wait, [&] { return m_work->opened > 0; });
  return m_work->opened > 0 ? std::optional(m_work->identity) : std::nullopt;
}

CameraHealth Camera::health() const {
  const std::lock_guard lock(m_work->mutex);
  CameraHealth health = sum(m_work->health, m_work->open_health);
  health.pictures = m_work->frame ? m_work->frame->count : 0;
  health.reconnections = m_work->opened > 0 ? m_work->opened - 1 : 0;
  return health;
}

}  // namespace zerodrift::vision
