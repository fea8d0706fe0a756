// Cameras that lie: frozen, flickering, silent, gone, sending anything but pictures. Each gets its name within
// seconds, or what is measured is right all the same; nothing hangs and nothing is read beyond its end.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <mutex>
#include <random>
#include <thread>

#include "core/vision/camera_error_source.h"
#include "core/vision/image_codec.h"
#include "tests/support/amount.h"
#include "tests/vision/speckle.h"

namespace zerodrift::vision {
namespace {

using namespace std::chrono_literals;
using Steady = std::chrono::steady_clock;

enum class Lie { none, frozen, flickering, silent, gone, hostile };

/// An MJPEG camera over HTTP on a port of its own, 20 pictures a second, that begins to lie when told.
class LyingCamera {
 public:
  LyingCamera() {
    const testing::Speckle speckle(1);
    for (unsigned i = 0; i < 12; ++i) {
      const auto shown = [&](double gain) {
        const auto image =
            testing::render(speckle, {.dx = 1.5, .dy = -2.0}, {.gain = gain, .noise = 1.0, .seed = i + 1});
        const auto bytes = encode_jpeg(image, 95).value();
        return std::string(bytes.begin(), bytes.end());
      };
      m_pictures.push_back(shown(1.0));
      m_dark.push_back(shown(0.35));
    }
    m_listener = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    EXPECT_EQ(::bind(m_listener, generic, size), 0);
    EXPECT_EQ(::listen(m_listener, 4), 0);
    EXPECT_EQ(::getsockname(m_listener, generic, &size), 0);
    m_port = ntohs(address.sin_port);
    m_thread = std::jthread([this](const std::stop_token& stop) { serve(stop); });
  }
  ~LyingCamera() {
    m_thread.request_stop();
    m_thread.join();
    ::close(m_listener);
  }
  std::string url() const { return "http://ann:s3cret@127.0.0.1:" + std::to_string(m_port) + "/stream"; }
  void lie(Lie kind) { m_lie = kind; }
  /// What is sent instead of a stream, from the answer's first byte on.
  void answer(std::string bytes) {
    const std::scoped_lock lock(m_mutex);
    m_answer = std::move(bytes);
  }

 private:
  void serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      pollfd wait{m_listener, POLLIN, 0};
      if (::poll(&wait, 1, 20) <= 0) continue;
      const int peer = ::accept(m_listener, nullptr, nullptr);
      if (peer < 0) continue;
      if (m_lie != Lie::gone) stream(peer, stop);
      ::close(peer);
    }
  }

  static bool send_all(int peer, const std::string& bytes) {
    return ::send(peer, bytes.data(), bytes.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(bytes.size());
  }

  void stream(int peer, const std::stop_token& stop) {
    char request[2048];
    static_cast<void>(::recv(peer, request, sizeof request, 0));
    if (m_lie == Lie::hostile) {
      const std::scoped_lock lock(m_mutex);
      static_cast<void>(send_all(peer, m_answer));
      return;
    }
    if (!send_all(peer, "HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=frame\r\n\r\n")) return;
    for (unsigned n = 0; !stop.stop_requested() && m_lie != Lie::gone; ++n) {
      std::this_thread::sleep_for(50ms);
      if (m_lie == Lie::silent) continue;
      const std::string& picture = m_lie == Lie::frozen                     ? m_pictures[3]
                                   : m_lie == Lie::flickering && n % 2 == 1 ? m_dark[n % 12]
                                                                            : m_pictures[n % 12];
      if (!send_all(peer, "--frame\r\nContent-Type: image/jpeg\r\nContent-Length: " + std::to_string(picture.size()) +
                              "\r\n\r\n" + picture + "\r\n")) {
        return;
      }
    }
  }

  std::vector<std::string> m_pictures;
  std::vector<std::string> m_dark;
  std::mutex m_mutex;
  std::string m_answer;
  std::atomic<Lie> m_lie{Lie::none};
  int m_listener = -1;
  int m_port = 0;
  std::jthread m_thread;
};

/// Time in which this machine let nobody run: what a thread that wakes every 10 ms overslept by more than 50 ms. A
/// shared machine may stand still for seconds, which is not the camera's doing.
class Standstill {
 public:
  Standstill()
      : m_thread([this](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            const auto from = Steady::now();
            std::this_thread::sleep_for(10ms);
            const double late_s = std::chrono::duration<double>(Steady::now() - from).count() - 0.01;
            if (late_s > 0.05) m_seconds = m_seconds + late_s;
          }
        }) {}
  double seconds() const { return m_seconds; }

 private:
  std::atomic<double> m_seconds{0.0};
  std::jthread m_thread;
};

/// Seconds, without those this machine stood still, until a fresh picture is refused, and by what name; -1 when it is
/// not within thirty.
std::pair<double, ErrorCode> told_after(LyingCamera& device, Camera& camera, Lie lie) {
  EXPECT_TRUE(camera.fresh_frame(Steady::now(), 40s)) << "the camera works before";
  device.lie(lie);
  const auto from = Steady::now();
  const Standstill standstill;
  while (Steady::now() - from < 30s) {
    const double before_s = standstill.seconds();
    const auto frame = camera.fresh_frame(Steady::now(), 4s);
    if (!frame) {
      // While the machine stands still every camera is silent: asked once more.
      if (lie == Lie::frozen && frame.error().code == ErrorCode::camera_silent && standstill.seconds() - before_s > 1.0)
        continue;
      EXPECT_EQ(describe(frame.error()).find("s3cret"), std::string::npos);
      const double seconds = std::chrono::duration<double>(Steady::now() - from).count();
      return {seconds - standstill.seconds(), frame.error().code};
    }
  }
  return {-1.0, ErrorCode::internal};
}

}  // namespace

TEST(LyingCamera, FrozenSilentAndGoneAreNamedWithinSeconds) {
  const std::tuple<Lie, const char*, std::vector<ErrorCode>> cases[] = {
      {Lie::frozen, "frozen", {ErrorCode::camera_frozen}},
      {Lie::silent, "silent", {ErrorCode::camera_silent}},
      {Lie::gone, "gone", {ErrorCode::camera_silent, ErrorCode::camera_unreachable}}};
  for (const auto& [lie, name, codes] : cases) {
    LyingCamera device;
    Camera camera(device.url());
    const auto [seconds, code] = told_after(device, camera, lie);
    std::printf("%s camera: %s after %.1f s\n", name, std::string(name_of(code)).c_str(), seconds);
    EXPECT_TRUE(std::find(codes.begin(), codes.end(), code) != codes.end()) << name;
    EXPECT_GT(seconds, 0.0) << name;
    if (judges_durations()) {
      EXPECT_LT(seconds, 6.0) << name;
    }
    device.lie(Lie::none);  // it comes back by itself
    const auto from = Steady::now();
    const Standstill standstill;
    const auto again = camera.fresh_frame(from, 40s);
    const double back_s = std::chrono::duration<double>(Steady::now() - from).count() - standstill.seconds();
    if (judges_durations()) {
      EXPECT_LT(back_s, 12.0) << name;
    }
    EXPECT_TRUE(again) << name << ": " << describe(again.error());
  }
}

TEST(LyingCamera, FlickeringLightMeasuresRightOrNotAtAll) {
  LyingCamera device;
  device.lie(Lie::flickering);
  ErrorView view;
  view.id = "front";
  view.camera = std::make_shared<const Camera>(device.url());
  view.target = std::make_shared<const Target>(
      *Target::create(testing::render(testing::Speckle(1)), {240, 160, 160, 160}, std::nullopt, "template"));
  view.calibration.um_from_px << 12.0, 0.0, 0.0, -12.0;
  view.axes = {0, 2};
  view.latency = acquisition::Latency::none();
  CameraErrorSource source({view}, {.frames = 4});
  ASSERT_TRUE(source.restore_zero({{0, 0, 0, 0}}));
  int right = 0;
  for (int i = 0; i < 5; ++i) {
    const auto sample = source.measure(acquisition::standing_now(), {});
    ASSERT_TRUE(sample) << describe(sample.error());
    if (std::isnan(sample->error_um[0])) continue;
    EXPECT_NEAR(sample->error_um[0], 18.0, 0.5);
    EXPECT_NEAR(sample->error_um[2], 24.0, 0.5);
    ++right;
  }
  std::printf("flickering light: %d of 5 measurements, each right\n", right);
}

// Anything for an answer: broken headers, lengths that lie, bytes that are no picture, a picture cut short.
TEST(LyingCamera, HostileAnswersAreNoPictureAndNoHarm) {
  LyingCamera device;
  const auto jpeg_bytes = encode_jpeg(testing::render(testing::Speckle(1)), 60).value();
  const std::string jpeg(jpeg_bytes.begin(), jpeg_bytes.end());
  const std::string head = "HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=frame\r\n\r\n";
  const auto part = [&](const std::string& length, const std::string& body) {
    return head + "--frame\r\nContent-Type: image/jpeg\r\nContent-Length: " + length + "\r\n\r\n" + body + "\r\n";
  };
  std::vector<std::string> answers = {
      "",
      "\r\n\r\n",
      std::string(70000, 'A'),
      "HTTP/1.1 200 OK\r\n" + std::string(70000, 'A') + ": b\r\n\r\n",
      "HTTP/1.1 301 Moved\r\nLocation: file:///etc/passwd\r\n\r\n",
      "HTTP/1.1 301 Moved\r\nLocation: concat:/etc/passwd|/etc/hosts\r\n\r\n",
      "HTTP/1.1 401 No\r\nWWW-Authenticate: Basic realm=\"" + std::string(9000, 'x') + "\"\r\n\r\n",
      "HTTP/1.1 200 OK\r\nContent-Type: text/html\r\n\r\n<html>",
      part("-1", jpeg),
      part("99999999999999999999", jpeg),
      part("0", jpeg),
      part(std::to_string(jpeg.size()), std::string(jpeg.size(), '\0')),
      part(std::to_string(jpeg.size() / 2), jpeg.substr(0, jpeg.size() / 2))};
  std::mt19937 dice(5);
  const std::string good = part(std::to_string(jpeg.size()), jpeg);
  for (int i = 0; i < amount(6, 200); ++i) {
    std::string bytes = good;
    for (int k = 0; k < 12; ++k) bytes[dice() % (i % 2 == 0 ? 200U : bytes.size())] = static_cast<char>(dice());
    answers.push_back(bytes.substr(0, dice() % 3 == 0 ? dice() % bytes.size() : bytes.size()));
  }
  device.lie(Lie::hostile);
  for (std::size_t i = 0; i < answers.size(); ++i) {
    device.answer(answers[i]);
    const auto from = Steady::now();
    {
      const Camera camera(device.url(), {.open_timeout = 400ms, .read_timeout = 400ms});
      const auto frame = camera.fresh_frame(Steady::now(), 300ms);
      if (frame) {
        const auto& image = (*frame)->image;
        EXPECT_EQ(image.pixels.size(), std::size_t(image.width) * std::size_t(image.height));
      }
    }
    if (judges_durations()) {
      EXPECT_LT(Steady::now() - from, 5s) << "answer " << i;
    }
  }
  std::printf("%zu hostile answers\n", answers.size());
}

}  // namespace zerodrift::vision
