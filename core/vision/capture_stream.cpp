#include "core/vision/capture_stream.h"

#include <algorithm>
#include <cstdlib>
#include <opencv2/core/utils/logger.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "core/vision/camera_controls.h"
#include "core/vision/camera_list.h"
#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

// What the automatics of a device are given to find the light before they are held.
constexpr std::chrono::milliseconds automatics_settle{1500};

// The libraries below print to stderr on their own; what matters is said through the errors.
void quiet_libraries() {
  static const bool once = [] {
    cv::utils::logging::setLogLevel(cv::utils::logging::LOG_LEVEL_SILENT);
    ::setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
    return true;
  }();
  (void)once;
}

GrayImage gray_of(const cv::Mat& picture) {
  if (picture.channels() == 1) return gray_from_mat(picture);
  cv::Mat gray;
  cv::cvtColor(picture, gray, picture.channels() == 4 ? cv::COLOR_BGRA2GRAY : cv::COLOR_BGR2GRAY);
  return gray_from_mat(gray);
}

class CaptureControls : public ControlPort {
 public:
  explicit CaptureControls(cv::VideoCapture& capture) : m_capture(capture) {}
  std::optional<double> value(Control control) const override {
    const double value = m_capture.get(property_of(control));  // -1: the device has none
    return value < 0.0 ? std::nullopt : std::optional(value);
  }
  bool set(Control control, double value) override { return m_capture.set(property_of(control), value); }

 private:
  static int property_of(Control control) {
    switch (control) {
      case Control::auto_exposure:
        return cv::CAP_PROP_AUTO_EXPOSURE;
      case Control::exposure:
        return cv::CAP_PROP_EXPOSURE;
      case Control::gain:
        return cv::CAP_PROP_GAIN;
      case Control::auto_focus:
        return cv::CAP_PROP_AUTOFOCUS;
      case Control::focus:
        return cv::CAP_PROP_FOCUS;
      case Control::auto_white_balance:
        return cv::CAP_PROP_AUTO_WB;
      case Control::white_balance:
        return cv::CAP_PROP_WB_TEMPERATURE;
    }
    return -1;
  }
  cv::VideoCapture& m_capture;
};

class CaptureStream : public PictureStream {
 public:
  explicit CaptureStream(SourceKind kind) : m_device(kind == SourceKind::device) {}

  cv::VideoCapture& capture() { return m_capture; }
  std::optional<StreamPicture> next(const std::stop_token&) override {
    if (!m_capture.read(m_picture) || m_picture.empty()) return std::nullopt;
    StreamPicture picture{gray_of(m_picture), std::nullopt};
    // V4L2 stamps its buffers by the host's monotonic clock; what other back ends call a position is the stream's own.
    if (m_device) picture.stamp = Seconds(m_capture.get(cv::CAP_PROP_POS_MSEC) / 1000.0);
    return picture;
  }
  double claimed_rate_hz() const override { return m_capture.get(cv::CAP_PROP_FPS); }
  CameraIdentity identity() const override { return m_identity; }

  /// Without asked values the automatics first find the light: the pictures of that time are thrown away.
  Status hold(const std::string& source, const CameraOptions& options, const std::stop_token& stop) {
    const auto until = std::chrono::steady_clock::now() + automatics_settle;
    while (!options.exposure_us && !stop.stop_requested() && std::chrono::steady_clock::now() < until) {
      if (!m_capture.grab()) break;
    }
    Status held = m_held.hold(options.exposure_us, options.gain_db);
    if (!held) {
      Error error = held.error();
      error.context["url"] = source;
      return fail(std::move(error));
    }
    m_identity = v4l2_identity(source);
    m_identity.exposure_us = m_held.exposure_us();
    m_identity.gain_db = m_held.gain();
    return {};
  }

 private:
  bool m_device;
  cv::VideoCapture m_capture;
  CaptureControls m_controls{m_capture};
  HeldControls m_held{m_controls};
  CameraIdentity m_identity;
  cv::Mat m_picture;
};

}  // namespace

SourceKind kind_of(const std::string& source) {
  if (source.rfind("aravis:", 0) == 0) return SourceKind::genicam;
  if (source.find("://") != std::string::npos) return SourceKind::stream;
  const bool number =
      !source.empty() && std::all_of(source.begin(), source.end(), [](char c) { return c >= '0' && c <= '9'; });
  return number || source.rfind("/dev/", 0) == 0 ? SourceKind::device : SourceKind::file;
}

Result<std::unique_ptr<PictureStream>> open_capture(const std::string& source, const CameraOptions& options,
                                                    const std::stop_token& stop) {
  quiet_libraries();
  const SourceKind kind = kind_of(source);
  auto stream = std::make_unique<CaptureStream>(kind);
  // The back end is always named: the automatic choice walks through all of them, which takes seconds.
  if (kind == SourceKind::device) {
    const bool number = source.front() != '/';
    const bool opened = number ? stream->capture().open(std::atoi(source.c_str()), cv::CAP_V4L2)
                               : stream->capture().open(source, cv::CAP_V4L2);
    if (!opened) return nullptr;
    ZD_CHECK(stream->hold(source, options, stop));
    return stream;
  }
  const bool opened =
      stream->capture().open(source, cv::CAP_FFMPEG,
                             {cv::CAP_PROP_OPEN_TIMEOUT_MSEC, static_cast<int>(options.open_timeout.count()),
                              cv::CAP_PROP_READ_TIMEOUT_MSEC, static_cast<int>(options.read_timeout.count())});
  if (!opened) return nullptr;
  return stream;
}

}  // namespace zerodrift::vision
