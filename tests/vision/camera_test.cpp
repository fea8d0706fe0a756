#include "core/vision/camera.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <thread>

#include "core/vision/camera_error_source.h"
#include "core/vision/image_codec.h"
#include "tests/support/own_folder.h"
#include "tests/vision/speckle.h"

namespace zerodrift::vision {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;
using testing::render;
using testing::Speckle;

const Region region{240, 160, 160, 160};

// A folder with a sequence of pictures of the target displaced as given, played by the camera in a loop.
class Sequence {
 public:
  Sequence(const std::string& name, const std::vector<std::pair<double, double>>& shifts_px, bool other_target = false)
      : m_folder(own_folder("zerodrift_camera_test_" + name)) {
    fs::remove_all(m_folder);
    fs::create_directories(m_folder);
    for (std::size_t k = 0; k < shifts_px.size(); ++k) {
      const Speckle speckle(other_target ? 77 : 1);
      const GrayImage image = render(speckle, {.dx = shifts_px[k].first, .dy = shifts_px[k].second},
                                     {.noise = 1.0, .seed = static_cast<unsigned>(k + 1)});
      EXPECT_TRUE(write_png(m_folder / fmt::format("img_{:04}.png", k), image));
    }
  }
  ~Sequence() { fs::remove_all(m_folder); }
  std::string source() const { return (m_folder / "img_%04d.png").string(); }

 private:
  fs::path m_folder;
};

Calibration twelve_um_per_px() {
  Calibration c;
  c.um_from_px << 12.0, 0.0, 0.0, -12.0;
  return c;
}

TEST(Camera, PlaysASequenceAndKeepsTheNewest) {
  const Sequence sequence("newest", {{0, 0}, {1, 0}, {2, 0}, {3, 0}});
  const Camera camera(sequence.source());
  const auto first = camera.fresh_frame(std::chrono::steady_clock::now(), 5s);
  ASSERT_TRUE(first) << describe(first.error());
  EXPECT_EQ((*first)->image.width, 640);
  EXPECT_EQ((*first)->image.height, 480);
  const auto asked = std::chrono::steady_clock::now();
  const auto second = camera.fresh_frame(asked, 5s);
  ASSERT_TRUE(second);
  EXPECT_GT((*second)->arrived, asked);
  EXPECT_GT((*second)->count, (*first)->count + 1);
  EXPECT_GT(camera.frames_per_s(), 1.0);
  EXPECT_TRUE(camera.newest());
}

TEST(Camera, NamesWhatIsNotThere) {
  const Camera camera("http://127.0.0.1:9/none.mjpg", {.open_timeout = 300ms});
  const auto frame = camera.fresh_frame(std::chrono::steady_clock::now(), 1s);
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, ErrorCode::camera_unreachable);
  EXPECT_EQ(camera.newest().error().context.at("url"), "http://127.0.0.1:9/none.mjpg");
}

TEST(Camera, WaitingCanBeCancelled) {
  const Camera camera("/nowhere/img_%04d.png");
  std::stop_source stop;
  std::jthread later([&] { stop.request_stop(); });
  const auto frame = camera.fresh_frame(std::chrono::steady_clock::now(), 20s, stop.get_token());
  ASSERT_FALSE(frame);
  EXPECT_EQ(frame.error().code, ErrorCode::cancelled);
}

ErrorView view_of(const std::string& id, const std::string& source, std::array<int, 2> axes) {
  ErrorView view;
  view.id = id;
  view.camera = std::make_shared<const Camera>(source);
  view.target = std::make_shared<const Target>(*Target::create(render(Speckle(1)), region, std::nullopt, "template"));
  view.calibration = twelve_um_per_px();
  view.axes = axes;
  return view;
}

TEST(CameraErrorSource, CombinesTwoViewsInMachineAxes) {
  const Sequence front("front", {{1.5, -2.0}});
  const Sequence side("side", {{-0.5, -2.0}});
  CameraErrorSource source({view_of("front", front.source(), {0, 2}), view_of("side", side.source(), {1, 2})},
                           {.frames = 2});
  ASSERT_TRUE(source.restore_zero({{0, 0, 0, 0}, {0, 0, 0, 0}}));
  const auto sample = source.measure(acquisition::standing_now(), {});
  ASSERT_TRUE(sample) << describe(sample.error());
  EXPECT_TRUE(sample->problems.empty());
  EXPECT_NEAR(sample->error_um[0], 18.0, 0.2);
  EXPECT_NEAR(sample->error_um[1], -6.0, 0.2);
  EXPECT_NEAR(sample->error_um[2], 24.0, 0.2);
  EXPECT_LT(sample->sigma_um[2], sample->sigma_um[0]);
  // The zero taken here, the same place measures nothing.
  ASSERT_TRUE(source.take_zero(acquisition::standing_now(), {}));
  const auto again = source.measure(acquisition::standing_now(), {});
  ASSERT_TRUE(again);
  EXPECT_NEAR(again->error_um[0], 0.0, 0.2);
  EXPECT_EQ(source.states().size(), 2u);
  EXPECT_EQ(source.states()[0].trail.size(), 2u);
}

TEST(CameraErrorSource, RefusedViewsAreMissingWithTheirReason) {
  const Sequence front("good", {{1.0, 1.0}});
  const Sequence side("bad", {{0.0, 0.0}}, true);
  CameraErrorSource source({view_of("front", front.source(), {0, 2}), view_of("side", side.source(), {1, 2})},
                           {.frames = 2});
  const auto sample = source.measure(acquisition::standing_now(), {});
  ASSERT_TRUE(sample);
  EXPECT_TRUE(std::isnan(sample->error_um[1]));
  EXPECT_NEAR(sample->error_um[2], -12.0, 0.2);
  ASSERT_EQ(sample->problems.size(), 1u);
  EXPECT_EQ(sample->problems[0].rfind("camera side: ", 0), 0u);
}

TEST(CameraErrorSource, ADeadCameraIsAFailure) {
  ErrorView view = view_of("front", "/nowhere/img_%04d.png", {0, 2});
  CameraErrorSource source({view}, {.frames = 1, .frame_timeout = 300ms});
  const auto sample = source.measure(acquisition::standing_now(), {});
  ASSERT_FALSE(sample);
  EXPECT_EQ(sample.error().code, ErrorCode::camera_unreachable);
}

}  // namespace
}  // namespace zerodrift::vision
