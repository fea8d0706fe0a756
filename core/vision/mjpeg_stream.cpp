#include "core/vision/mjpeg_stream.h"

#include <httplib.h>

#include <algorithm>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <regex>
#include <thread>

#include "core/vision/image_codec.h"
#include "core/vision/jpeg_cutter.h"

namespace zerodrift::vision {
namespace {

constexpr std::size_t most_waiting = 4;  // pictures; the oldest are dropped when the reader is slow

struct Address {
  std::string server;  // http://host:port
  std::string user;
  std::string password;
  std::string path;
};

std::string without_percents(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const std::string hex = text[i] == '%' && i + 2 < text.size() ? text.substr(i + 1, 2) : "";
    if (hex.size() == 2 && hex.find_first_not_of("0123456789abcdefABCDEF") == std::string::npos) {
      plain += static_cast<char>(std::stoi(hex, nullptr, 16));
      i += 2;
    } else {
      plain += text[i];
    }
  }
  return plain;
}

Address address_of(const std::string& url) {
  static const std::regex pattern(R"(^(https?://)(?:([^/@:]*)(?::([^/@]*))?@)?([^/?#]*)([^#]*).*$)");
  std::smatch parts;
  if (!std::regex_match(url, parts, pattern)) return {};
  std::string path = parts[5].str();
  if (path.empty() || path.front() != '/') path.insert(0, "/");
  return {parts[1].str() + parts[4].str(), without_percents(parts[2].str()), without_percents(parts[3].str()), path};
}

class MjpegStream : public PictureStream {
 public:
  enum class Answer { none, pictures, something_else, unreachable };

  MjpegStream(const Address& address, const CameraOptions& options) : m_client(address.server) {
    m_client.set_connection_timeout(options.open_timeout);
    m_client.set_read_timeout(options.read_timeout);
    m_client.set_write_timeout(options.open_timeout);
    m_client.set_follow_location(true);
    // Cameras certify themselves.
    m_client.enable_server_certificate_verification(false);
    if (!address.user.empty()) {
      m_client.set_basic_auth(address.user, address.password);
      m_client.set_digest_auth(address.user, address.password);
    }
    m_thread = std::jthread([this, path = address.path](const std::stop_token& stop) { read(path, stop); });
  }
  ~MjpegStream() override {
    m_thread.request_stop();
    m_client.stop();
  }
  MjpegStream(const MjpegStream&) = delete;
  MjpegStream& operator=(const MjpegStream&) = delete;

  /// What answers there; waits for it.
  Answer answer(const std::stop_token& stop) {
    std::unique_lock lock(m_mutex);
    m_changed.wait(lock, stop, [this] { return m_answer != Answer::none; });
    return m_answer;
  }

  std::optional<StreamPicture> next(const std::stop_token& stop) override {
    while (true) {
      std::string bytes;
      {
        std::unique_lock lock(m_mutex);
        m_changed.wait(lock, stop, [this] { return m_ended || !m_waiting.empty(); });
        if (stop.stop_requested() || m_waiting.empty()) return std::nullopt;
        bytes = std::move(m_waiting.front());
        m_waiting.pop_front();
      }
      auto decoded = decode({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, "picture");
      if (decoded) return StreamPicture{std::move(decoded->image), std::nullopt};
      ++m_damaged;
    }
  }
  CameraHealth health() const override {
    CameraHealth health;
    health.incomplete = m_damaged;
    return health;
  }

 private:
  void read(const std::string& path, const std::stop_token& stop) {
    const auto answered = [this](Answer answer) {
      const std::lock_guard lock(m_mutex);
      if (m_answer == Answer::none) m_answer = answer;
      m_changed.notify_all();
    };
    bool pictures = false;
    JpegCutter cutter;
    const auto result = m_client.Get(
        path, {},
        [&](const httplib::Response& response) {
          const bool on_the_way = response.status == 401 || response.status / 100 == 3;
          pictures = response.status == 200 && response.get_header_value("Content-Type").rfind("multipart/", 0) == 0;
          if (pictures) answered(Answer::pictures);
          return !stop.stop_requested() && (pictures || on_the_way);
        },
        [&](const char* data, std::size_t length) {
          if (pictures) cutter.add({data, length});
          while (auto picture = cutter.next()) {
            const std::lock_guard lock(m_mutex);
            m_waiting.push_back(std::move(*picture));
            if (m_waiting.size() > most_waiting) m_waiting.pop_front();
            m_changed.notify_all();
          }
          return !stop.stop_requested();
        });
    const bool nobody = result.error() == httplib::Error::Connection ||
                        result.error() == httplib::Error::ConnectionTimeout ||
                        result.error() == httplib::Error::SSLConnection;
    answered(nobody ? Answer::unreachable : Answer::something_else);
    const std::lock_guard lock(m_mutex);
    m_ended = true;
    m_changed.notify_all();
  }

  httplib::Client m_client;
  std::mutex m_mutex;
  std::condition_variable_any m_changed;
  Answer m_answer = Answer::none;
  std::deque<std::string> m_waiting;
  bool m_ended = false;
  std::atomic<std::uint64_t> m_damaged{0};
  std::jthread m_thread;  // ends before what it uses
};

}  // namespace

Result<std::unique_ptr<PictureStream>> open_mjpeg(const std::string& url, const CameraOptions& options,
                                                  const std::stop_token& stop) {
  const Address address = address_of(url);
  if (address.server.empty()) return nullptr;
  auto stream = std::make_unique<MjpegStream>(address, options);
  switch (stream->answer(stop)) {
    case MjpegStream::Answer::pictures:
      return stream;
    case MjpegStream::Answer::unreachable:
      return fail(ErrorCode::camera_unreachable, {{"detail", "no picture could be opened"}});
    case MjpegStream::Answer::none:
    case MjpegStream::Answer::something_else:
      break;
  }
  return nullptr;
}

}  // namespace zerodrift::vision
