#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <cmath>
#include <numeric>

#include "app/machine/camera/camera_server.h"
#include "core/vision/image_codec.h"

namespace zerodrift::machine {
namespace {

constexpr RenderSwitches quiet{.noise = false, .lamp_drift = false};

/// Even light and no lens: then the centre of gravity of what differs from the ground is the target's place exactly.
ViewOptions plain_view() {
  ViewOptions view = view_options(View::front, 1);
  view.distortion_per_px2 = 0.0;
  view.vignetting_per_px2 = 0.0;
  view.light_slope_per_px = 0.0;
  return view;
}

struct Box {
  int x0, y0, x1, y1;
};
constexpr Box around_target{175, 95, 465, 385};
constexpr Box around_left_mark{20, 280, 172, 440};

template <class Levels>
PixelPosition centre_of_gravity(const Levels& levels, double ground, Box box) {
  double sum = 0.0;
  double x_sum = 0.0;
  double y_sum = 0.0;
  for (int y = box.y0; y < box.y1; ++y) {
    for (int x = box.x0; x < box.x1; ++x) {
      const double weight = levels[static_cast<std::size_t>(y) * 640 + x] - ground;
      sum += weight;
      x_sum += weight * x;
      y_sum += weight * y;
    }
  }
  return {x_sum / sum, y_sum / sum};
}

CameraScene target_at(double right_um, double up_um) {
  CameraScene scene;
  scene.target_right_um = right_um;
  scene.target_up_um = up_um;
  return scene;
}

TEST(CameraRenderer, TargetMovesExactlyAsTold) {
  const CameraRenderer renderer(plain_view());
  for (const auto& [right_um, up_um] :
       {std::pair{0.0, 0.0}, {3.7, -1.9}, {55.5, 41.25}, {-711.3, 698.9}, {640.0, 0.1}}) {
    const PixelPosition expected = pixel_from_object(renderer.options(), {right_um, up_um});
    const auto levels = renderer.render_levels(target_at(right_um, up_um), 0, quiet);
    const PixelPosition seen = centre_of_gravity(levels, levels[0], around_target);
    EXPECT_NEAR(seen.x_px, expected.x_px, 1e-4) << right_um;
    EXPECT_NEAR(seen.y_px, expected.y_px, 1e-4) << up_um;
  }
}

TEST(CameraRenderer, EightBitsKeepTheShiftToTwoThousandths) {
  const CameraRenderer renderer(plain_view());
  const auto still = renderer.render(target_at(0.0, 0.0), 0, quiet);
  const PixelPosition start = centre_of_gravity(still.pixels, still.pixels[0], around_target);
  for (double shift_um = -6.0; shift_um <= 6.0; shift_um += 0.73) {
    const auto moved = renderer.render(target_at(shift_um, 0.3 * shift_um), 0, quiet);
    const PixelPosition seen = centre_of_gravity(moved.pixels, moved.pixels[0], around_target);
    const PixelPosition origin = pixel_from_object(renderer.options(), {0.0, 0.0});
    const PixelPosition expected = pixel_from_object(renderer.options(), {shift_um, 0.3 * shift_um});
    EXPECT_NEAR(seen.x_px - start.x_px, expected.x_px - origin.x_px, 2e-3) << shift_um;
    EXPECT_NEAR(seen.y_px - start.y_px, expected.y_px - origin.y_px, 2e-3) << shift_um;
  }
}

TEST(CameraRenderer, UpIsUpAndRightIsRight) {
  ViewOptions view = plain_view();
  view.rotation_rad = 0.0;
  const PixelPosition origin = pixel_from_object(view, {0.0, 0.0});
  EXPECT_NEAR(pixel_from_object(view, {12.0, 0.0}).x_px - origin.x_px, 1.0, 1e-12);
  EXPECT_NEAR(pixel_from_object(view, {0.0, 12.0}).y_px - origin.y_px, -1.0, 1e-12);
  view.rotation_rad = 0.1;  // counter-clockwise: the right end of a level line rises in the picture
  EXPECT_LT(pixel_from_object(view, {1200.0, 0.0}).y_px, origin.y_px);
}

TEST(CameraRenderer, LensRoundTripAndItsSize) {
  for (const View which : {View::front, View::side}) {
    const ViewOptions view = view_options(which, 3);
    for (const PixelPosition pixel : {PixelPosition{0, 0}, {639, 479}, {100.25, 300.75}, {319.5, 239.5}}) {
      const PixelPosition back = pixel_from_object(view, object_from_pixel(view, pixel));
      EXPECT_NEAR(back.x_px, pixel.x_px, 1e-9);
      EXPECT_NEAR(back.y_px, pixel.y_px, 1e-9);
    }
    ViewOptions straight = view;
    straight.distortion_per_px2 = 0.0;
    const ObjectPosition corner = object_from_pixel(view, {639, 479});
    const PixelPosition undistorted = pixel_from_object(straight, corner);
    const double moved_px = std::hypot(undistorted.x_px - 639, undistorted.y_px - 479);
    EXPECT_GT(moved_px, 0.2);  // 0.1 % of 400 px
    EXPECT_LT(moved_px, 0.6);
  }
}

TEST(CameraRenderer, CameraDriftMovesBothTargetsTheOtherWay) {
  const CameraRenderer renderer(plain_view());
  CameraScene drifted;
  drifted.camera_drift_right_um = 6.0;
  drifted.camera_drift_up_um = -3.0;
  const auto before = renderer.render_levels({}, 0, quiet);
  const auto after = renderer.render_levels(drifted, 0, quiet);
  const PixelPosition origin = pixel_from_object(renderer.options(), {0.0, 0.0});
  const PixelPosition expected = pixel_from_object(renderer.options(), {-6.0, 3.0});
  for (const Box box : {around_target, around_left_mark}) {
    const PixelPosition a = centre_of_gravity(before, before[0], box);
    const PixelPosition b = centre_of_gravity(after, after[0], box);
    EXPECT_NEAR(b.x_px - a.x_px, expected.x_px - origin.x_px, 1e-4);
    EXPECT_NEAR(b.y_px - a.y_px, expected.y_px - origin.y_px, 1e-4);
  }
}

TEST(CameraRenderer, CameraTurnAndScaleMoveThePictureAboutItsMiddle) {
  ViewOptions view = plain_view();
  view.rotation_rad = 0.0;
  const CameraRenderer renderer(view);
  CameraScene turned;
  turned.camera_roll_urad = 300.0;
  turned.camera_scale_ppm = 200.0;
  const auto before = renderer.render_levels({}, 0, quiet);
  const auto after = renderer.render_levels(turned, 0, quiet);
  const auto moved = [&](Box box) {
    const PixelPosition a = centre_of_gravity(before, before[0], box);
    const PixelPosition b = centre_of_gravity(after, after[0], box);
    return PixelPosition{b.x_px - a.x_px, b.y_px - a.y_px};
  };
  EXPECT_NEAR(moved(around_target).x_px, 0.0, 1e-4);
  EXPECT_NEAR(moved(around_target).y_px, 0.0, 1e-4);
  // The mark is 220 px left of and 120 px below the middle. A camera turned counter-clockwise sees what is below move
  // to the left, and what is at the left move up.
  EXPECT_NEAR(moved(around_left_mark).x_px, -120.0 * 300e-6 - 220.0 * 200e-6, 1e-4);
  EXPECT_NEAR(moved(around_left_mark).y_px, -220.0 * 300e-6 + 120.0 * 200e-6, 1e-4);
}

TEST(CameraRenderer, ReferenceMarksStayWhenTheSpindleMoves) {
  const CameraRenderer renderer(view_options(View::side, 1));
  const auto before = renderer.render_levels(target_at(-800.0, -800.0), 0, quiet);
  const auto after = renderer.render_levels(target_at(800.0, 800.0), 0, quiet);
  for (int y = 300; y < 420; ++y) {
    for (int x = 40; x < 160; ++x) {
      const std::size_t left = static_cast<std::size_t>(y) * 640 + x;
      ASSERT_EQ(before[left], after[left]) << x << " " << y;
      ASSERT_EQ(before[left + 440], after[left + 440]) << x << " " << y;
    }
  }
}

TEST(CameraRenderer, FarAwayTheTargetIsNotInThePicture) {
  const CameraRenderer renderer(plain_view());
  const auto levels = renderer.render_levels(target_at(250000.0, 0.0), 0, quiet);
  EXPECT_FLOAT_EQ(levels[240 * 640 + 320], levels[0]);
}

TEST(CameraRenderer, RollTurnsCounterClockwise) {
  ViewOptions view = plain_view();
  view.rotation_rad = 0.0;
  const CameraRenderer renderer(view);
  CameraScene rolled;
  rolled.roll_urad = 20000.0;
  const auto before = renderer.render_levels({}, 0, quiet);
  const auto after = renderer.render_levels(rolled, 0, quiet);
  // The plate's upper edge lies at row 164.5: right of the middle it rises by 1.2 px, left of it it sinks.
  EXPECT_GT(after[163 * 640 + 380] - before[163 * 640 + 380], 20.0);
  EXPECT_LT(after[165 * 640 + 260] - before[165 * 640 + 260], -20.0);
}

TEST(CameraRenderer, NoiseHasTheSensorsVariance) {
  ViewOptions view = plain_view();
  const CameraRenderer renderer(view);
  const auto clean = renderer.render_levels({}, 0, quiet);
  const RenderSwitches noisy{.noise = true, .lamp_drift = false};
  double dark_squares = 0.0;
  double light_squares = 0.0;
  double sum = 0.0;
  int dark = 0;
  int light = 0;
  for (std::uint64_t frame = 0; frame < 4; ++frame) {
    const auto levels = renderer.render_levels({}, frame, noisy);
    for (std::size_t i = 0; i < levels.size(); ++i) {
      const double noise = levels[i] - clean[i];
      sum += noise;
      if (std::abs(clean[i] - clean[0]) < 0.01) {
        dark_squares += noise * noise;
        ++dark;
      } else if (clean[i] > 200.0F) {
        light_squares += noise * noise / (0.36 + clean[i] / 40.0);
        ++light;
      }
    }
  }
  EXPECT_NEAR(sum / (4.0 * static_cast<double>(clean.size())), 0.0, 0.005);
  EXPECT_NEAR(dark_squares / dark, 0.36 + clean[0] / 40.0, 0.01);
  ASSERT_GT(light, 50000);
  EXPECT_NEAR(light_squares / light, 1.0, 0.02);
}

TEST(CameraRenderer, FramesAndViewsHaveUnrelatedNoise) {
  const CameraRenderer renderer(plain_view());
  const auto clean = renderer.render_levels({}, 0, quiet);
  const RenderSwitches noisy{.noise = true, .lamp_drift = false};
  const auto first = renderer.render_levels({}, 0, noisy);
  const auto again = renderer.render_levels({}, 0, noisy);
  EXPECT_EQ(first, again);
  for (const std::uint64_t frame : {1U, 2U, 3U}) {
    const auto other = renderer.render_levels({}, frame, noisy);
    for (const std::size_t lag : {std::size_t{0}, std::size_t{1}, std::size_t{5}, std::size_t{640}}) {
      double product = 0.0;
      double square = 0.0;
      for (std::size_t i = 0; i + lag < clean.size(); ++i) {
        product += (first[i + lag] - clean[i + lag]) * (other[i] - clean[i]);
        square += (first[i] - clean[i]) * (first[i] - clean[i]);
      }
      EXPECT_NEAR(product / square, 0.0, 0.01) << frame << " " << lag;
    }
  }
}

TEST(CameraRenderer, NothingIsSaturatedInTheNormalLight) {
  for (const View which : {View::front, View::side}) {
    const CameraRenderer renderer(view_options(which, 5));
    for (double time_s = 0.0; time_s < 14400.0; time_s += 977.0) {
      CameraScene scene;
      scene.machine_time_s = time_s;
      const auto image = renderer.render(scene, 1);
      const auto brightest = *std::max_element(image.pixels.begin(), image.pixels.end());
      EXPECT_LT(brightest, 250);
      EXPECT_GT(brightest, 190);
    }
  }
}

TEST(CameraRenderer, ChipHidesMoreThanHalfOfTheTarget) {
  const CameraRenderer renderer(plain_view());
  RenderSwitches covered = quiet;
  covered.occluded = true;
  const auto open = renderer.render_levels({}, 0, quiet);
  const auto hidden = renderer.render_levels({}, 0, covered);
  int changed = 0;
  int plate = 0;
  for (int y = 165; y < 315; ++y) {
    for (int x = 245; x < 395; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * 640 + x;
      ++plate;
      changed += std::abs(open[i] - hidden[i]) > 5.0F ? 1 : 0;
    }
  }
  EXPECT_GT(changed, plate / 2);
}

TEST(CameraRenderer, ChipHidesTheRightMarkAndNothingElse) {
  const CameraRenderer renderer(view_options(View::front, 1));
  RenderSwitches covered = quiet;
  covered.mark_occluded = true;
  const auto open = renderer.render_levels({}, 0, quiet);
  const auto hidden = renderer.render_levels({}, 0, covered);
  int left = 0, right = 0;
  for (int y = 0; y < 480; ++y) {
    for (int x = 0; x < 640; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * 640 + x;
      if (std::abs(open[i] - hidden[i]) > 5.0F) ++(x < 430 ? left : right);
    }
  }
  EXPECT_EQ(left, 0);
  EXPECT_GT(right, 8000);
}

class CameraServerTest : public testing::Test {
 protected:
  CameraServerTest()
      : m_server(camera_options(7), [this](View) {
          CameraScene scene;
          scene.machine_time_s = ++m_asked;
          return scene;
        }) {}

  int start() {
    const auto port = m_server.start(0);
    EXPECT_TRUE(port.has_value());
    return port.value_or(0);
  }

  std::atomic<int> m_asked{0};
  CameraServer m_server;
};

TEST_F(CameraServerTest, StreamIsMultipartJpegOfFreshFrames) {
  httplib::Client client("127.0.0.1", start());
  std::string received;
  std::string type;
  client.Get(
      "/front.mjpg",
      [&](const httplib::Response& response) {
        type = response.get_header_value("Content-Type");
        return true;
      },
      [&](const char* data, std::size_t size) {
        received.append(data, size);
        return received.size() < 1500000;
      });
  ASSERT_EQ(type, "multipart/x-mixed-replace; boundary=zerodrift-frame");
  std::vector<vision::GrayImage> frames;
  std::vector<double> times;
  std::size_t at = 0;
  while (frames.size() < 3) {
    ASSERT_EQ(received.compare(at, 17, "--zerodrift-frame"), 0);
    const std::size_t head_end = received.find("\r\n\r\n", at);
    ASSERT_NE(head_end, std::string::npos);
    const std::string head = received.substr(at, head_end - at);
    const std::size_t size = std::stoul(head.substr(head.find("Content-Length: ") + 16));
    times.push_back(std::stod(head.substr(head.find("X-Machine-Time: ") + 16)));
    ASSERT_LE(head_end + 4 + size + 2, received.size()) << "fewer than three frames arrived";
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(received.data()) + head_end + 4, size);
    const auto decoded = vision::decode(bytes, "part");
    ASSERT_TRUE(decoded.has_value());
    EXPECT_EQ(decoded->image.width, 640);
    EXPECT_EQ(decoded->image.height, 480);
    frames.push_back(decoded->image);
    at = head_end + 4 + size + 2;
  }
  EXPECT_NE(frames[0].pixels, frames[1].pixels);
  EXPECT_LT(times[0], times[1]);
  EXPECT_LT(times[1], times[2]);
}

TEST_F(CameraServerTest, PngIsTheLosslessFrameWithItsTime) {
  httplib::Client client("127.0.0.1", start());
  const auto answer = client.Get("/side.png");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->get_header_value("X-Machine-Time"), "1.000");
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(answer->body.data()), answer->body.size());
  const auto decoded = vision::decode(bytes, "side.png");
  ASSERT_TRUE(decoded.has_value());
  CameraScene scene;
  scene.machine_time_s = 1.0;
  EXPECT_EQ(decoded->image.pixels, CameraRenderer(view_options(View::side, 7)).render(scene, 0).pixels);
}

TEST_F(CameraServerTest, FrozenItRepeatsTheLastFrameAndThenGoesOn) {
  httplib::Client client("127.0.0.1", start());
  const std::string before = client.Get("/front.png")->body;
  CameraFault fault;
  fault.kind = CameraFault::Kind::freeze;
  m_server.set_fault(fault);
  EXPECT_EQ(client.Get("/front.png")->body, before);
  EXPECT_EQ(client.Get("/front.png")->body, before);
  m_server.set_fault(CameraFault{});
  EXPECT_NE(client.Get("/front.png")->body, before);
}

TEST_F(CameraServerTest, FaultKeepsToItsMachineTime) {
  httplib::Client client("127.0.0.1", start());
  CameraFault fault;
  fault.kind = CameraFault::Kind::freeze;
  fault.from_machine_s = 2.0;
  fault.until_machine_s = 4.0;
  m_server.set_fault(fault);
  std::vector<std::string> times;
  for (int i = 0; i < 5; ++i) times.push_back(client.Get("/front.png")->get_header_value("X-Machine-Time"));
  EXPECT_EQ(times, (std::vector<std::string>{"1.000", "1.000", "1.000", "4.000", "5.000"}));
}

TEST_F(CameraServerTest, NothingIsRenderedWithoutAClient) {
  start();
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(m_asked, 0);
}

TEST_F(CameraServerTest, UnknownPathIsNotFound) {
  httplib::Client client("127.0.0.1", start());
  EXPECT_EQ(client.Get("/top.mjpg")->status, 404);
}

TEST_F(CameraServerTest, TakenPortIsNamed) {
  const int port = start();
  CameraServer second(camera_options(1), [](View) { return CameraScene{}; });
  const auto refused = second.start(port);
  ASSERT_FALSE(refused.has_value());
  EXPECT_EQ(refused.error().code, ErrorCode::port_unavailable);
  EXPECT_EQ(refused.error().context.at("port"), std::to_string(port));
}

TEST_F(CameraServerTest, StopEndsAStreamThatIsBeingRead) {
  httplib::Client client("127.0.0.1", start());
  std::atomic<bool> first_bytes{false};
  std::thread reader([&] {
    client.Get("/front.mjpg", [&](const char*, std::size_t) {
      first_bytes = true;
      return true;
    });
  });
  while (!first_bytes) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  m_server.stop();
  reader.join();
  EXPECT_GT(start(), 0) << "and it can be started again";
}

}  // namespace
}  // namespace zerodrift::machine
