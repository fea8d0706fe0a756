// MJPEG cameras as they are: without the first boundary, with lengths that are wrong, with pictures that break off.

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <functional>
#include <random>
#include <thread>

#include "core/vision/camera.h"
#include "core/vision/image_codec.h"
#include "core/vision/jpeg_cutter.h"
#include "tests/vision/speckle.h"

namespace zerodrift::vision {
namespace {

using namespace std::chrono_literals;
using Steady = std::chrono::steady_clock;

std::string jpeg_of(unsigned seed) {
  const auto image = testing::render(testing::Speckle(1), {.dx = 1.0}, {.noise = 2.0, .seed = seed}, 160, 120);
  const auto bytes = encode_jpeg(image, 90).value();
  return {bytes.begin(), bytes.end()};
}

const std::vector<std::string>& jpegs() {
  static const std::vector<std::string> all = {jpeg_of(1), jpeg_of(2), jpeg_of(3)};
  return all;
}

/// Answers every request with an endless stream of parts, 25 a second.
class Server {
 public:
  using Part = std::function<std::string(const std::string& jpeg, int number)>;

  explicit Server(Part part) : m_part(std::move(part)), m_listener(::socket(AF_INET, SOCK_STREAM, 0)) {
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
  ~Server() {
    m_thread.request_stop();
    m_thread.join();
    ::close(m_listener);
  }
  std::string url() const { return "http://127.0.0.1:" + std::to_string(m_port) + "/video"; }

 private:
  void serve(const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      pollfd wait{m_listener, POLLIN, 0};
      if (::poll(&wait, 1, 20) <= 0) continue;
      const int peer = ::accept(m_listener, nullptr, nullptr);
      char request[2048];
      static_cast<void>(::recv(peer, request, sizeof request, 0));
      std::string bytes = "HTTP/1.1 200 OK\r\nContent-Type: multipart/x-mixed-replace; boundary=frame\r\n\r\n";
      for (int n = 0; !stop.stop_requested() && sent(peer, bytes); ++n) {
        if (n > 0) std::this_thread::sleep_for(40ms);
        bytes = m_part(jpegs()[static_cast<std::size_t>(n) % jpegs().size()], n);
      }
      ::close(peer);
    }
  }
  static bool sent(int peer, const std::string& bytes) {
    for (std::size_t at = 0; at < bytes.size();) {
      const auto count = ::send(peer, bytes.data() + at, bytes.size() - at, MSG_NOSIGNAL);
      if (count <= 0) return false;
      at += static_cast<std::size_t>(count);
    }
    return true;
  }

  Part m_part;
  int m_listener;
  int m_port = 0;
  std::jthread m_thread;
};

std::string part(const std::string& length, const std::string& body) {
  return "--frame\r\nContent-Type: image/jpeg\r\nContent-Length: " + length + "\r\n\r\n" + body + "\r\n";
}

TEST(Mjpeg, IsReadWithoutAFirstBoundaryAndWithWrongLengths) {
  const std::pair<const char*, Server::Part> cameras[] = {
      {"by the standard", [](const auto& jpeg, int) { return part(std::to_string(jpeg.size()), jpeg); }},
      {"without a first boundary",
       [](const auto& jpeg, int n) {
         const std::string all = part(std::to_string(jpeg.size()), jpeg);
         return n == 0 ? all.substr(all.find("Content-Type")) : all;
       }},
      {"only pictures", [](const auto& jpeg, int) { return jpeg; }},
      {"without lengths",
       [](const auto& jpeg, int) { return "--frame\r\nContent-Type: image/jpeg\r\n\r\n" + jpeg + "\r\n"; }},
      {"length too small", [](const auto& jpeg, int) { return part(std::to_string(jpeg.size() / 2), jpeg); }},
      {"length too large", [](const auto& jpeg, int) { return part(std::to_string(jpeg.size() + 777), jpeg); }},
      {"length 0", [](const auto& jpeg, int) { return part("0", jpeg); }},
      {"length -1", [](const auto& jpeg, int) { return part("-1", jpeg); }},
      {"another boundary than it says",
       [](const auto& jpeg, int) { return "--other\r\nContent-Type: image/jpeg\r\n\r\n" + jpeg + "\r\n"; }},
      {"every second breaks off", [](const auto& jpeg, int n) {
         return part(std::to_string(jpeg.size()), n % 2 == 1 ? jpeg.substr(0, jpeg.size() / 2) : jpeg);
       }}};
  std::vector<GrayImage> originals;
  for (const std::string& jpeg : jpegs()) {
    originals.push_back(decode({reinterpret_cast<const std::uint8_t*>(jpeg.data()), jpeg.size()}, "original")->image);
  }
  for (const auto& [name, camera_part] : cameras) {
    const Server server(camera_part);
    const Camera camera(server.url());
    for (int i = 0; i < 4; ++i) {
      const auto frame = camera.fresh_frame(Steady::now(), 40s);
      ASSERT_TRUE(frame) << name << ": " << describe(frame.error());
      const bool whole = std::any_of(originals.begin(), originals.end(),
                                     [&](const GrayImage& one) { return one.pixels == (*frame)->image.pixels; });
      EXPECT_TRUE(whole) << name;
    }
    EXPECT_EQ(camera.health().reconnections, 0u) << name;
  }
}

TEST(JpegCutter, FindsWholePicturesInWhateverPieces) {
  std::string stream = "HTTP\xFF\xD8";
  for (const std::string& jpeg : jpegs()) stream += jpeg + "\r\n--frame\xFF\r\n";
  for (const std::size_t piece : {std::size_t{1}, std::size_t{2}, std::size_t{7}, std::size_t{1460}, stream.size()}) {
    JpegCutter cutter;
    std::vector<std::string> found;
    for (std::size_t at = 0; at < stream.size(); at += piece) {
      cutter.add(std::string_view(stream).substr(at, piece));
      while (auto one = cutter.next()) found.push_back(std::move(*one));
    }
    EXPECT_EQ(found, jpegs()) << piece;
  }
}

TEST(JpegCutter, ASmallPictureWithinAPictureIsItsPart) {
  const std::string& jpeg = jpegs()[0];
  const std::string small = "\xFF\xD8\xFF\xD9";
  const std::string thumbnail = std::string("\xFF\xE1\x00\x06", 4) + small;
  const std::string with = jpeg.substr(0, 2) + thumbnail + jpeg.substr(2);
  JpegCutter cutter;
  cutter.add(with + with);
  EXPECT_EQ(cutter.next(), with);
  EXPECT_EQ(cutter.next(), with);
  EXPECT_FALSE(cutter.next());
}

TEST(JpegCutter, WhatBreaksOffCostsThatPictureAlone) {
  const std::string& jpeg = jpegs()[1];
  for (std::size_t cut = 1; cut < jpeg.size(); cut += 37) {
    JpegCutter cutter;
    cutter.add(jpeg.substr(0, cut) + "\r\n--frame\r\n\r\n" + jpeg + jpeg + jpeg);
    std::vector<std::string> found;
    while (auto one = cutter.next()) found.push_back(std::move(*one));
    ASSERT_GE(found.size(), 2u) << cut;
    EXPECT_EQ(found.back(), jpeg) << cut;
  }
}

TEST(JpegCutter, HostileBytesDoNoHarm) {
  std::mt19937 dice(3);
  for (int i = 0; i < 200; ++i) {
    JpegCutter cutter;
    std::string bytes = jpegs()[0] + jpegs()[1];
    for (int k = 0; k < 20; ++k) bytes[dice() % bytes.size()] = static_cast<char>(dice() % 3 == 0 ? 0xFF : dice());
    cutter.add(bytes);
    std::size_t taken = 0;
    while (auto one = cutter.next()) taken += one->size();
    EXPECT_LE(taken, bytes.size());
  }
}

}  // namespace
}  // namespace zerodrift::vision
