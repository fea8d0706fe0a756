#include "app/machine/camera/camera_server.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <thread>

#include "app/machine/http/loopback_server.h"
#include "core/vision/image_codec.h"

namespace zerodrift::machine {
namespace {

constexpr std::string_view boundary = "zerodrift-frame";
// How long a latency lasts before it jumps to another value within its jitter.
constexpr double shortest_spell_s = 0.5;
constexpr double longest_spell_s = 4.0;

std::string part_header(const EncodedFrame& frame) {
  return fmt::format("--{}\r\nContent-Type: image/jpeg\r\nContent-Length: {}\r\nX-Machine-Time: {:.3f}\r\n\r\n",
                     boundary, frame.bytes.size(), frame.machine_time_s);
}

bool send(httplib::DataSink& sink, const EncodedFrame& frame) {
  const std::string header = part_header(frame);
  return sink.write(header.data(), header.size()) &&
         sink.write(reinterpret_cast<const char*>(frame.bytes.data()), frame.bytes.size()) && sink.write("\r\n", 2);
}

}  // namespace

/// The pictures of one stream that are on their way.
class DelayLine {
 public:
  using Time = std::chrono::steady_clock::time_point;
  struct Picture {
    std::int64_t tick;
    CameraScene scene;
    Time due;
  };

  DelayLine(const CameraOptions& options, std::uint64_t seed)
      : m_options(options), m_random(seed), m_latency_s(options.latency_s) {}

  void put(std::int64_t tick, const CameraScene& scene, Time now) {
    if (m_options.latency_jitter_s > 0.0 && now >= m_spell_end) {
      m_latency_s = std::max(0.0, m_options.latency_s + m_options.latency_jitter_s * between(-1.0, 1.0));
      m_spell_end = now + seconds(between(shortest_spell_s, longest_spell_s));
    }
    m_last_due = std::max(m_last_due, now + seconds(m_latency_s));
    m_pictures.push_back({tick, scene, m_last_due});
  }
  std::optional<Time> next_due() const {
    return m_pictures.empty() ? std::nullopt : std::optional(m_pictures.front().due);
  }
  std::optional<Picture> take(Time now) {
    if (m_pictures.empty() || m_pictures.front().due > now) return std::nullopt;
    Picture first = m_pictures.front();
    m_pictures.pop_front();
    return first;
  }

 private:
  static std::chrono::steady_clock::duration seconds(double s) {
    return std::chrono::duration_cast<std::chrono::steady_clock::duration>(std::chrono::duration<double>(s));
  }
  double between(double low, double high) { return std::uniform_real_distribution(low, high)(m_random); }

  const CameraOptions& m_options;
  std::mt19937_64 m_random;
  double m_latency_s;
  Time m_spell_end{};
  Time m_last_due{};
  std::deque<Picture> m_pictures;
};

struct CameraServer::Service {
  Service(const CameraOptions& camera_options, const SceneSource& scene)
      : options(camera_options),
        front(View::front, options.views[0], scene),
        side(View::side, options.views[1], scene),
        period(1.0 / std::clamp(options.frames_per_s, 0.1, 100.0)) {}

  FrameSource& source(View view) { return view == View::front ? front : side; }
  using Time = std::chrono::steady_clock::time_point;
  std::int64_t tick_at(Time now) const { return static_cast<std::int64_t>(std::floor((now - begin) / period)); }
  Time time_of(std::int64_t tick) const {
    return begin + std::chrono::duration_cast<std::chrono::steady_clock::duration>(period * tick);
  }
  bool wait_until(Time due);
  void serve_stream(View view, httplib::Response& response);
  void serve_png(View view, httplib::Response& response);
  void add_routes();

  CameraOptions options;
  FrameSource front;
  FrameSource side;
  std::chrono::duration<double> period;
  std::chrono::steady_clock::time_point begin = std::chrono::steady_clock::now();
  std::mutex mutex;
  std::condition_variable stopping_changed;
  bool stopping = false;
  std::atomic<std::uint64_t> streams = 1;
  std::unique_ptr<LoopbackServer> server;
};

/// False when the server stops.
bool CameraServer::Service::wait_until(Time due) {
  std::unique_lock lock(mutex);
  return !stopping_changed.wait_until(lock, due, [&] { return stopping; });
}

void CameraServer::Service::serve_stream(View view, httplib::Response& response) {
  response.set_header("Cache-Control", "no-store");
  const auto line = std::make_shared<DelayLine>(options, streams++);
  const auto next = [this, view, line, tick = tick_at(std::chrono::steady_clock::now())](
                        std::size_t, httplib::DataSink& sink) mutable {
    const Time due = line->next_due().value_or(Time::max());
    if (!wait_until(std::min(due, time_of(tick)))) return false;
    const Time now = std::chrono::steady_clock::now();
    if (now >= time_of(tick)) {
      line->put(tick_at(now), source(view).look(), now);
      tick = tick_at(now) + 1;  // a slow client skips frames
    }
    const auto picture = line->take(std::chrono::steady_clock::now());
    if (!picture) return true;
    const auto frame = source(view).jpeg(picture->tick, picture->scene, options.jpeg_quality);
    return frame && send(sink, **frame);
  };
  response.set_content_provider(fmt::format("multipart/x-mixed-replace; boundary={}", boundary), next);
}

void CameraServer::Service::serve_png(View view, httplib::Response& response) {
  const Frame frame = source(view).now();
  const auto bytes = vision::encode_png(frame.image);
  if (!bytes) {
    response.status = 500;
    response.set_content(describe(bytes.error()), "text/plain");
    return;
  }
  response.set_header("Cache-Control", "no-store");
  response.set_header("X-Machine-Time", fmt::format("{:.3f}", frame.machine_time_s));
  response.set_content(reinterpret_cast<const char*>(bytes->data()), bytes->size(), "image/png");
}

void CameraServer::Service::add_routes() {
  for (const View view : {View::front, View::side}) {
    server->http().Get(fmt::format("/{}\\.mjpg", name_of(view)),
                       [this, view](const httplib::Request&, httplib::Response& r) { serve_stream(view, r); });
    server->http().Get(fmt::format("/{}\\.png", name_of(view)),
                       [this, view](const httplib::Request&, httplib::Response& r) { serve_png(view, r); });
  }
}

CameraOptions camera_options(std::uint64_t seed) {
  CameraOptions options;
  options.views = {view_options(View::front, seed), view_options(View::side, seed)};
  return options;
}

CameraServer::CameraServer(const CameraOptions& options, const SceneSource& scene)
    : m_service(std::make_unique<Service>(options, scene)) {}

CameraServer::~CameraServer() {
  stop();
}

Result<int> CameraServer::start(int port) {
  stop();
  Service& service = *m_service;
  service.stopping = false;
  service.server = std::make_unique<LoopbackServer>();
  service.add_routes();
  auto bound = service.server->start(port);
  if (!bound) service.server.reset();
  return bound;
}

void CameraServer::stop() {
  Service& service = *m_service;
  if (!service.server) return;
  {
    const std::lock_guard lock(service.mutex);
    service.stopping = true;
  }
  service.stopping_changed.notify_all();
  service.server.reset();
}

void CameraServer::set_fault(CameraFault fault) {
  for (const View view : {View::front, View::side}) set_fault(view, fault);
}

void CameraServer::set_fault(View view, CameraFault fault) {
  m_service->source(view).set_fault(fault);
}

}  // namespace zerodrift::machine
