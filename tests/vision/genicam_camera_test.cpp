// GigE Vision through Aravis, against its fake camera on the loopback: found, read, lost and found again.

#include "tests/vision/genicam_camera.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <thread>

#include "core/vision/camera.h"
#include "core/vision/camera_list.h"

namespace zerodrift::vision {
namespace {

using namespace std::chrono_literals;
using Steady = std::chrono::steady_clock;
using zerodrift::testing::GenicamCamera;
using zerodrift::testing::own_serial;

constexpr auto patience = 60s;  // of a busy computer
constexpr std::uint32_t mono8 = 0x01080001, bayer_rg8 = 0x01080009, rgb8 = 0x02180014;

class GigeCamera : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!GenicamCamera::installed()) GTEST_SKIP() << "the package aravis-tools, the fake GigE camera, is not installed";
  }
};

/// A picture within the patience; a camera that is refused or silent meanwhile is asked again.
std::shared_ptr<const CameraFrame> picture_of(const Camera& camera) {
  const auto until = Steady::now() + patience;
  while (Steady::now() < until) {
    if (auto frame = camera.fresh_frame(Steady::now(), 5s); frame) return *frame;
    std::this_thread::sleep_for(100ms);
  }
  return nullptr;
}

/// The error that the camera comes to within the patience; internal when it has none.
Error error_of(const Camera& camera, ErrorCode awaited) {
  const auto until = Steady::now() + patience;
  Error last{ErrorCode::internal, {}};
  while (Steady::now() < until) {
    const auto frame = camera.newest();
    if (!frame) last = frame.error();
    if (last.code == awaited && last.context["detail"] != "not opened yet") return last;
    std::this_thread::sleep_for(50ms);
  }
  return last;
}

/// The fake camera's pictures are a diagonal ramp that moves on with each: one step of grey to the right and down.
bool is_whole_ramp(const GrayImage& image) {
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) {
      const int expected = (image.at(0, 0) + x + y) % 255;
      if (image.at(x, y) != expected && image.at(x, y) % 255 != expected) return false;
    }
  }
  return true;
}

TEST_F(GigeCamera, IsListedAndReadByItsSerialNumber) {
  GenicamCamera device;
  const std::string serial = own_serial("A");
  device.start(serial);
  const auto cameras = find_cameras();
  const auto at =
      std::find_if(cameras.begin(), cameras.end(), [&](const auto& c) { return c.identity.serial == serial; });
  ASSERT_NE(at, cameras.end());
  EXPECT_EQ(at->url, "aravis:" + serial);
  EXPECT_EQ(at->identity.kind, "gige-vision");
  EXPECT_EQ(at->identity.vendor, "Aravis");
  EXPECT_EQ(at->identity.model, "Fake");
  EXPECT_EQ(at->identity.address, "127.0.0.1");
  const Camera camera("aravis:" + serial);
  const auto frame = picture_of(camera);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->image.width, 160);
  EXPECT_EQ(frame->image.height, 120);
  EXPECT_TRUE(is_whole_ramp(frame->image));
  EXPECT_FALSE(camera.is_file());
  const auto identity = camera.identity();
  ASSERT_TRUE(identity);
  EXPECT_EQ(identity->serial, serial);
  EXPECT_EQ(camera.health().reconnections, 0u);
  EXPECT_GE(camera.health().pictures, 2u);
}

TEST_F(GigeCamera, ItsOwnTimeStampsThePictures) {
  GenicamCamera device;
  device.start(own_serial("T"));
  const Camera camera("aravis:" + own_serial("T"));
  std::uint64_t stamped = 0;
  Seconds before{0.0};
  const auto until = Steady::now() + patience;
  while (stamped < 10 && Steady::now() < until) {
    const auto frame = camera.fresh_frame(Steady::now(), 5s);
    if (!frame) continue;
    EXPECT_LE((*frame)->stamp, Seconds((*frame)->arrived.time_since_epoch()));
    EXPECT_GT((*frame)->stamp, before);
    before = (*frame)->stamp;
    ++stamped;
  }
  EXPECT_EQ(stamped, 10u);
}

TEST_F(GigeCamera, WhatIsNotThereIsNamedWithWhatIs) {
  GenicamCamera device;
  const std::string serial = own_serial("B");
  device.start(serial);
  const Camera other("aravis:no-such-serial");
  const Error error = error_of(other, ErrorCode::camera_unreachable);
  EXPECT_EQ(error.code, ErrorCode::camera_unreachable);
  EXPECT_NE(error.context.at("detail").find(serial), std::string::npos) << error.context.at("detail");
  // One program only controls a camera.
  const Camera first("aravis:" + serial);
  ASSERT_TRUE(picture_of(first));
  const Camera second("aravis:" + serial);
  EXPECT_EQ(error_of(second, ErrorCode::camera_unreachable).context.at("detail"), "another program reads it");
}

TEST_F(GigeCamera, ComesBackByItself) {
  GenicamCamera device;
  device.start(own_serial("C"));
  const Camera camera("aravis:" + own_serial("C"));
  ASSERT_TRUE(picture_of(camera));
  device.stop();
  EXPECT_EQ(error_of(camera, ErrorCode::camera_silent).code, ErrorCode::camera_silent);
  device.start(own_serial("C"));
  EXPECT_TRUE(picture_of(camera));
  EXPECT_GE(camera.health().reconnections, 1u);
}

TEST_F(GigeCamera, AnotherSerialNumberAtItsAddressIsRefused) {
  GenicamCamera device;
  device.start(own_serial("D"));
  const Camera camera("aravis:127.0.0.1");
  ASSERT_TRUE(picture_of(camera));
  device.stop();
  device.start(own_serial("E"));
  const Error error = error_of(camera, ErrorCode::camera_exchanged);
  ASSERT_EQ(error.code, ErrorCode::camera_exchanged) << describe(error);
  EXPECT_EQ(error.context.at("found"), own_serial("E"));
  EXPECT_EQ(error.context.at("expected"), own_serial("D"));
  EXPECT_EQ(error.context.at("url"), "aravis:127.0.0.1");
  EXPECT_FALSE(camera.fresh_frame(Steady::now(), 2s)) << "the other camera is not measured with";
  device.stop();
  device.start(own_serial("D"));
  EXPECT_TRUE(picture_of(camera));
}

TEST_F(GigeCamera, PicturesWithLostPacketsAreCountedAndNeverDelivered) {
  GenicamCamera device({"-r", "40"});  // of a thousand packets
  device.start(own_serial("F"));
  const Camera camera("aravis:" + own_serial("F"));
  int seen = 0;
  const auto from = Steady::now();
  const auto until = from + patience;
  CameraHealth health;
  while ((health.incomplete + health.lost == 0 || seen < 10) && Steady::now() < until) {
    if (const auto frame = camera.fresh_frame(Steady::now(), 5s); frame) {
      EXPECT_TRUE(is_whole_ramp((*frame)->image));
      ++seen;
    }
    health = camera.health();
  }
  std::printf("%d pictures seen; %llu incomplete, %llu lost, %llu packets lost\n", seen,
              static_cast<unsigned long long>(health.incomplete), static_cast<unsigned long long>(health.lost),
              static_cast<unsigned long long>(health.lost_packets));
  EXPECT_GT(health.incomplete + health.lost, 0u);
  EXPECT_GE(seen, 10);
  const double sent = 25.0 * std::chrono::duration<double>(Steady::now() - from).count();
  EXPECT_LT(static_cast<double>(health.pictures + health.incomplete + health.lost), 1.1 * sent + 10.0);
}

TEST_F(GigeCamera, ExposureAndGainAreSetAndPutBack) {
  GenicamCamera device;
  device.start(own_serial("G"));
  const std::string url = "aravis:" + own_serial("G");
  const auto found = Camera(url).identity(patience);
  ASSERT_TRUE(found);
  {
    const Camera camera(url, {.exposure_us = 5000.0, .gain_db = 3.0});
    ASSERT_TRUE(picture_of(camera));
    EXPECT_EQ(camera.identity()->exposure_us, 5000.0);
    EXPECT_EQ(camera.identity()->gain_db, 3.0);
  }
  const auto after = Camera(url).identity(patience);
  ASSERT_TRUE(after);
  EXPECT_EQ(after->exposure_us, found->exposure_us);
  EXPECT_EQ(after->gain_db, found->gain_db);
  const Camera dark(url, {.exposure_us = 1.0});
  const Error error = error_of(dark, ErrorCode::camera_setting);
  EXPECT_EQ(error.code, ErrorCode::camera_setting) << describe(error);
  EXPECT_EQ(error.context.at("what"), "exposure");
  EXPECT_EQ(error.context.at("expected"), "1");
}

TEST_F(GigeCamera, AMosaicIsReadAndAnUnreadFormatIsChanged) {
  GenicamCamera device;
  device.start(own_serial("H"));
  for (const std::uint32_t format : {mono8, bayer_rg8, rgb8}) {
    device.write_register(GenicamCamera::pixel_format, format);
    const Camera camera("aravis:" + own_serial("H"));
    const auto frame = picture_of(camera);
    ASSERT_TRUE(frame) << std::hex << format;
    EXPECT_EQ(frame->image.pixels.size(), 160u * 120u);
  }
}

}  // namespace
}  // namespace zerodrift::vision
