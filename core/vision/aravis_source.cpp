#include "core/vision/aravis_source.h"

#include <arv.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <mutex>

#include "core/vision/device_clock.h"
#include "core/vision/pixel_format.h"

namespace zerodrift::vision {
namespace {

using Steady = std::chrono::steady_clock;
using Milliseconds = std::chrono::milliseconds;

constexpr std::size_t scheme_length = 7;  // "aravis:"
constexpr int buffers = 10;               // that the library may fill while the reader is busy
constexpr Milliseconds turn{100};         // after which a wait looks whether it is to stop
constexpr double periods_of_silence = 3.0;
constexpr int reader_priority = 10;  // of realtime threads, 1 to 99
constexpr int reader_nice = -10;
constexpr std::uint64_t last_short_number = 65535;  // of a picture in GigE Vision 1; 1 follows it
constexpr std::uint64_t largest_gap = 1000;         // in the numbers; more is a camera that begins anew
constexpr double exposure_step = 0.1;  // relative; a camera takes the step of its own next to what is asked
constexpr double gain_step_db = 0.5;

struct Unref {
  void operator()(void* object) const { g_object_unref(object); }
};
template <class T>
using Owned = std::unique_ptr<T, Unref>;

class Failure {
 public:
  ~Failure() { g_clear_error(&m_error); }
  Failure() = default;
  Failure(const Failure&) = delete;
  Failure& operator=(const Failure&) = delete;
  /// For one call; what an earlier one left is forgotten.
  GError** of() {
    g_clear_error(&m_error);
    return &m_error;
  }
  explicit operator bool() const { return m_error != nullptr; }
  std::string text() const { return m_error != nullptr ? m_error->message : ""; }

 private:
  GError* m_error = nullptr;
};

std::string text_of(const char* text) {
  return text != nullptr ? text : "";
}

/// The library's list of devices is one for the whole program.
std::mutex& list_mutex() {
  static std::mutex mutex;
  return mutex;
}

struct Listed {
  std::string id;
  CameraIdentity identity;
};

std::vector<Listed> listed_cameras() {
  const std::lock_guard lock(list_mutex());
  arv_update_device_list();
  std::vector<Listed> found;
  for (unsigned i = 0; i < arv_get_n_devices(); ++i) {
    const std::string protocol = text_of(arv_get_device_protocol(i));
    if (protocol != "GigEVision" && protocol != "USB3Vision") continue;
    Listed one;
    one.id = text_of(arv_get_device_id(i));
    one.identity.kind = protocol == "GigEVision" ? "gige-vision" : "usb3-vision";
    one.identity.vendor = text_of(arv_get_device_vendor(i));
    one.identity.model = text_of(arv_get_device_model(i));
    one.identity.serial = text_of(arv_get_device_serial_nbr(i));
    one.identity.address = text_of(arv_get_device_address(i));
    found.push_back(std::move(one));
  }
  return found;
}

std::string serials_of(const std::vector<Listed>& cameras) {
  std::string all;
  for (const Listed& one : cameras) all += (all.empty() ? "" : ", ") + one.identity.serial;
  return all;
}

/// What a url names among the cameras that were found; a name that none has is left to the library, which asks the
/// network for an address beyond the reach of discovery.
Result<Listed> chosen(const std::string& name, const std::string& known_serial, const std::vector<Listed>& found) {
  const auto having = [&](auto matches) {
    std::vector<Listed> some;
    std::copy_if(found.begin(), found.end(), std::back_inserter(some), matches);
    return some;
  };
  std::vector<Listed> named = found;
  if (name != "*") {
    named = having([&](const Listed& one) { return one.identity.serial == name; });
    if (named.empty()) {
      named = having([&](const Listed& one) { return one.id == name || one.identity.address == name; });
    }
  }
  if (!known_serial.empty() && named.size() > 1) {
    std::erase_if(named, [&](const Listed& one) { return one.identity.serial != known_serial; });
  }
  if (named.size() == 1) return named.front();
  if (named.size() > 1) return fail(ErrorCode::camera_ambiguous, {{"found", serials_of(named)}});
  if (name.find('.') != std::string::npos || name.find(':') != std::string::npos) return Listed{name, {}};
  const std::string others = serials_of(found);
  return fail(ErrorCode::camera_unreachable,
              {{"detail", others.empty() ? "no camera was found" : fmt::format("found were only {}", others)}});
}

/// A picture comes as a burst of packets for which the network's buffer is small: its reader must not wait for others.
/// Where the system does not allow it the reader is one as all.
void reads_ahead(void*, ArvStreamCallbackType type, ArvBuffer*) {
  if (type == ARV_STREAM_CALLBACK_TYPE_INIT && !arv_make_thread_realtime(reader_priority)) {
    arv_make_thread_high_priority(reader_nice);
  }
}

class AravisStream : public PictureStream {
 public:
  AravisStream(Owned<ArvCamera> camera, CameraIdentity identity)
      : m_camera(std::move(camera)), m_identity(std::move(identity)) {}
  ~AravisStream() override { close(); }
  AravisStream(const AravisStream&) = delete;
  AravisStream& operator=(const AravisStream&) = delete;

  Status set_up(const CameraOptions& options);
  Status start(const CameraOptions& options);
  std::optional<StreamPicture> next(const std::stop_token& stop) override;
  CameraIdentity identity() const override { return m_identity; }
  CameraHealth health() const override;

 private:
  Status set_exposure(double exposure_us);
  Status set_gain(double gain_db);
  Status choose_format();
  void read_settings();
  void count(std::uint64_t number);
  std::optional<StreamPicture> picture_in(ArvBuffer* buffer);
  void close();

  Owned<ArvCamera> m_camera;
  Owned<ArvStream> m_stream;
  CameraIdentity m_identity;
  CameraHealth m_health;
  DeviceClock m_clock;
  std::optional<std::uint64_t> m_last_number;
  Steady::duration m_patience{};
  bool m_silent = false;
  std::vector<std::function<void(ArvCamera*)>> m_undo;  // the last change first
};

Status not_taken(const char* what, const std::string& found, double asked) {
  return fail(ErrorCode::camera_setting, {{"what", what}, {"found", found}, {"expected", fmt::format("{:g}", asked)}});
}

Status AravisStream::set_exposure(double exposure_us) {
  ArvCamera* camera = m_camera.get();
  Failure failure;
  if (!arv_camera_is_exposure_time_available(camera, failure.of())) return not_taken("exposure", "none", exposure_us);
  if (arv_camera_is_exposure_auto_available(camera, failure.of())) {
    const ArvAuto before = arv_camera_get_exposure_time_auto(camera, failure.of());
    if (!failure && before != ARV_AUTO_OFF) {
      arv_camera_set_exposure_time_auto(camera, ARV_AUTO_OFF, failure.of());
      m_undo.emplace_back([before](ArvCamera* c) { arv_camera_set_exposure_time_auto(c, before, nullptr); });
    }
  }
  double low = 0.0, high = 0.0;
  arv_camera_get_exposure_time_bounds(camera, &low, &high, failure.of());
  if (!failure && (exposure_us < low || exposure_us > high)) {
    return not_taken("exposure", fmt::format("{:g} to {:g}", low, high), exposure_us);
  }
  const double before_us = arv_camera_get_exposure_time(camera, failure.of());
  m_undo.emplace_back([before_us](ArvCamera* c) { arv_camera_set_exposure_time(c, before_us, nullptr); });
  arv_camera_set_exposure_time(camera, exposure_us, failure.of());
  if (failure) return not_taken("exposure", failure.text(), exposure_us);
  const double now_us = arv_camera_get_exposure_time(camera, failure.of());
  if (failure || std::abs(now_us - exposure_us) > exposure_step * exposure_us) {
    return not_taken("exposure", fmt::format("{:g}", now_us), exposure_us);
  }
  return {};
}

Status AravisStream::set_gain(double gain_db) {
  ArvCamera* camera = m_camera.get();
  Failure failure;
  if (!arv_camera_is_gain_available(camera, failure.of())) return not_taken("gain", "none", gain_db);
  if (arv_camera_is_gain_auto_available(camera, failure.of())) {
    const ArvAuto before = arv_camera_get_gain_auto(camera, failure.of());
    if (!failure && before != ARV_AUTO_OFF) {
      arv_camera_set_gain_auto(camera, ARV_AUTO_OFF, failure.of());
      m_undo.emplace_back([before](ArvCamera* c) { arv_camera_set_gain_auto(c, before, nullptr); });
    }
  }
  double low = 0.0, high = 0.0;
  arv_camera_get_gain_bounds(camera, &low, &high, failure.of());
  if (!failure && (gain_db < low || gain_db > high)) {
    return not_taken("gain", fmt::format("{:g} to {:g}", low, high), gain_db);
  }
  const double before_db = arv_camera_get_gain(camera, failure.of());
  m_undo.emplace_back([before_db](ArvCamera* c) { arv_camera_set_gain(c, before_db, nullptr); });
  arv_camera_set_gain(camera, gain_db, failure.of());
  if (failure) return not_taken("gain", failure.text(), gain_db);
  const double now_db = arv_camera_get_gain(camera, failure.of());
  if (failure || std::abs(now_db - gain_db) > gain_step_db)
    return not_taken("gain", fmt::format("{:g}", now_db), gain_db);
  return {};
}

/// A camera set to a format that is read stays with it.
Status AravisStream::choose_format() {
  ArvCamera* camera = m_camera.get();
  Failure failure;
  const ArvPixelFormat before = arv_camera_get_pixel_format(camera, failure.of());
  if (failure) return fail(ErrorCode::camera_unreachable, {{"detail", failure.text()}});
  if (is_readable_format(before)) return {};
  guint count = 0;
  gint64* formats = arv_camera_dup_available_pixel_formats(camera, &count, failure.of());
  const std::vector<gint64> available(formats, formats + (formats != nullptr ? count : 0));
  g_free(formats);
  for (const gint64 format : available) {
    if (!is_readable_format(static_cast<std::uint32_t>(format))) continue;
    arv_camera_set_pixel_format(camera, static_cast<ArvPixelFormat>(format), failure.of());
    if (failure) continue;
    m_undo.emplace_back([before](ArvCamera* c) { arv_camera_set_pixel_format(c, before, nullptr); });
    return {};
  }
  return fail(ErrorCode::camera_format,
              {{"found", text_of(arv_camera_get_pixel_format_as_string(camera, failure.of()))},
               {"expected", "Mono8, Mono12, BayerRG8"}});
}

void AravisStream::read_settings() {
  ArvCamera* camera = m_camera.get();
  Failure failure;
  const bool exposes_itself = arv_camera_is_exposure_auto_available(camera, failure.of()) &&
                              arv_camera_get_exposure_time_auto(camera, failure.of()) != ARV_AUTO_OFF;
  const double exposure_us = arv_camera_get_exposure_time(camera, failure.of());
  if (!failure && !exposes_itself) m_identity.exposure_us = exposure_us;
  const bool amplifies_itself = arv_camera_is_gain_auto_available(camera, failure.of()) &&
                                arv_camera_get_gain_auto(camera, failure.of()) != ARV_AUTO_OFF;
  const double gain_db = arv_camera_get_gain(camera, failure.of());
  if (!failure && !amplifies_itself) m_identity.gain_db = gain_db;
}

Status AravisStream::set_up(const CameraOptions& options) {
  ArvCamera* camera = m_camera.get();
  Failure failure;
  ZD_CHECK(choose_format());
  if (options.exposure_us) ZD_CHECK(set_exposure(*options.exposure_us));
  if (options.gain_db) ZD_CHECK(set_gain(*options.gain_db));
  read_settings();
  // Free running; a camera keeps a trigger of another program until it is switched off and on.
  arv_camera_clear_triggers(camera, failure.of());
  arv_camera_set_acquisition_mode(camera, ARV_ACQUISITION_MODE_CONTINUOUS, failure.of());
  if (failure) return fail(ErrorCode::camera_unreachable, {{"detail", failure.text()}});
  return {};
}

Status AravisStream::start(const CameraOptions& options) {
  ArvCamera* camera = m_camera.get();
  Failure failure;
  const guint payload = arv_camera_get_payload(camera, failure.of());
  if (!failure) m_stream.reset(arv_camera_create_stream(camera, reads_ahead, nullptr, failure.of()));
  if (failure || !m_stream) return fail(ErrorCode::camera_unreachable, {{"detail", failure.text()}});
  for (int i = 0; i < buffers; ++i) arv_stream_push_buffer(m_stream.get(), arv_buffer_new_allocate(payload));
  double period_s = m_identity.exposure_us.value_or(0.0) * 1e-6;
  if (arv_camera_is_frame_rate_available(camera, failure.of())) {
    const double rate = arv_camera_get_frame_rate(camera, failure.of());
    if (!failure && rate > 0.0) period_s = std::max(period_s, 1.0 / rate);
  }
  m_patience = std::max<Steady::duration>(
      options.read_timeout,
      std::chrono::duration_cast<Steady::duration>(Seconds(std::min(periods_of_silence * period_s, 60.0))));
  arv_camera_start_acquisition(camera, failure.of());
  if (failure) return fail(ErrorCode::camera_unreachable, {{"detail", failure.text()}});
  return {};
}

/// A picture that is waited for in vain comes after later ones: it was counted as lost and is not.
/// GigE Vision numbers none 0: a buffer with it never was filled.
void AravisStream::count(std::uint64_t number) {
  if (number == 0) return;
  const std::uint64_t last = m_last_number.value_or(number - 1);
  const bool wrapped = number < largest_gap && last <= last_short_number && last_short_number - last < largest_gap;
  const std::uint64_t next = wrapped ? number + last_short_number : number;
  if (next <= last && last - next < largest_gap) {
    if (m_health.lost > 0) --m_health.lost;
    return;
  }
  if (next > last && next - last < largest_gap) m_health.lost += next - last - 1;
  m_last_number = number;
}

std::optional<StreamPicture> AravisStream::picture_in(ArvBuffer* buffer) {
  const Seconds arrived = Steady::now().time_since_epoch();
  count(arv_buffer_get_frame_id(buffer));
  if (arv_buffer_get_status(buffer) != ARV_BUFFER_STATUS_SUCCESS || arv_buffer_get_n_parts(buffer) == 0) return {};
  std::size_t size = 0;
  const auto* data = static_cast<const std::uint8_t*>(arv_buffer_get_part_data(buffer, 0, &size));
  const ArvPixelFormat format = arv_buffer_get_part_pixel_format(buffer, 0);
  const int width = arv_buffer_get_part_width(buffer, 0);
  const int height = arv_buffer_get_part_height(buffer, 0);
  gint row_padding = 0, end_padding = 0;
  arv_buffer_get_part_padding(buffer, 0, &row_padding, &end_padding);
  std::vector<std::uint8_t> dense;
  if (row_padding > 0 && width > 0) {
    const std::size_t row =
        static_cast<std::size_t>(width) * ARV_PIXEL_FORMAT_BIT_PER_PIXEL(static_cast<std::size_t>(format)) / 8;
    const std::size_t step = row + static_cast<std::size_t>(row_padding);
    for (std::size_t at = 0; at + row <= size; at += step) dense.insert(dense.end(), data + at, data + at + row);
    data = dense.data();
    size = dense.size();
  }
  auto image = gray_from({data, size}, width, height, format);
  if (!image) return {};
  StreamPicture picture{std::move(*image), std::nullopt};
  if (const guint64 stamp_ns = arv_buffer_get_timestamp(buffer); stamp_ns != 0) {
    picture.stamp = m_clock.to_host(Seconds(static_cast<double>(stamp_ns) * 1e-9), arrived);
  }
  return picture;
}

std::optional<StreamPicture> AravisStream::next(const std::stop_token& stop) {
  const auto deadline = Steady::now() + m_patience;
  m_silent = false;
  while (!stop.stop_requested()) {
    constexpr guint64 turn_us = std::chrono::microseconds(turn).count();
    ArvBuffer* buffer = arv_stream_timeout_pop_buffer(m_stream.get(), turn_us);
    if (buffer != nullptr) {
      auto picture = picture_in(buffer);
      arv_stream_push_buffer(m_stream.get(), buffer);
      if (picture) return picture;
      ++m_health.incomplete;
    }
    if (Steady::now() > deadline) break;
  }
  m_silent = !stop.stop_requested();
  return std::nullopt;
}

CameraHealth AravisStream::health() const {
  CameraHealth health = m_health;
  if (m_stream && arv_camera_is_gv_device(m_camera.get())) {
    health.lost_packets = arv_stream_get_info_uint64_by_name(m_stream.get(), "n_missing_packets");
    health.resent_packets = arv_stream_get_info_uint64_by_name(m_stream.get(), "n_resent_packets");
  }
  return health;
}

void AravisStream::close() {
  Failure failure;
  if (m_stream) arv_camera_stop_acquisition(m_camera.get(), failure.of());
  const bool gone = m_silent && failure;  // each further request would wait seconds for its answer
  m_stream.reset();
  for (auto one = m_undo.rbegin(); !gone && one != m_undo.rend(); ++one) (*one)(m_camera.get());
}

}  // namespace

std::vector<FoundCamera> aravis_cameras() {
  std::vector<FoundCamera> cameras;
  for (Listed& one : listed_cameras()) {
    const std::string& name = one.identity.serial.empty() ? one.id : one.identity.serial;
    cameras.push_back({"aravis:" + name, std::move(one.identity)});
  }
  return cameras;
}

Result<std::unique_ptr<PictureStream>> open_aravis(const std::string& url, const std::string& serial,
                                                   const CameraOptions& options) {
  const std::string name = url.substr(std::min(scheme_length, url.size()));
  ZD_TRY(Listed camera, chosen(name, serial, listed_cameras()));
  const auto is_other = [&](const std::string& found) { return !serial.empty() && found != serial; };
  const auto refused = [&](const std::string& found) {
    return fail(ErrorCode::camera_exchanged, {{"found", found}, {"expected", serial}});
  };
  CameraIdentity& identity = camera.identity;
  if (!identity.kind.empty() && is_other(identity.serial)) return refused(identity.serial);
  Failure failure;
  Owned<ArvCamera> opened;
  {
    const std::lock_guard lock(list_mutex());
    opened.reset(arv_camera_new(camera.id.c_str(), failure.of()));
  }
  if (!opened) return fail(ErrorCode::camera_unreachable, {{"detail", failure.text()}});
  ArvDevice* device = arv_camera_get_device(opened.get());
  if (ARV_IS_GV_DEVICE(device) && !arv_gv_device_is_controller(ARV_GV_DEVICE(device))) {
    return fail(ErrorCode::camera_unreachable, {{"detail", "another program reads it"}});
  }
  if (identity.kind.empty()) {
    identity.kind = arv_camera_is_gv_device(opened.get()) ? "gige-vision" : "usb3-vision";
    identity.vendor = text_of(arv_camera_get_vendor_name(opened.get(), failure.of()));
    identity.model = text_of(arv_camera_get_model_name(opened.get(), failure.of()));
    identity.serial = text_of(arv_camera_get_device_serial_number(opened.get(), failure.of()));
    identity.address = name;
    if (is_other(identity.serial)) return refused(identity.serial);
  }
  auto stream = std::make_unique<AravisStream>(std::move(opened), identity);
  ZD_CHECK(stream->set_up(options));
  ZD_CHECK(stream->start(options));
  return stream;
}

}  // namespace zerodrift::vision
