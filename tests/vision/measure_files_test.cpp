#include "core/vision/measure_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/vision/error_view.h"
#include "core/vision/image_codec.h"
#include "core/vision/region_finder.h"
#include "core/vision/target_file.h"
#include "tests/vision/speckle.h"

namespace zerodrift::vision {
namespace {

namespace fs = std::filesystem;
using testing::Pose;
using testing::render;
using testing::Speckle;

const Region file_region{240, 160, 160, 160};

class MeasureFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    m_folder = fs::temp_directory_path() / fmt::format("zerodrift_measure_files_{}",
                                                       ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::remove_all(m_folder);
    fs::create_directories(m_folder / "frames");
    put("template.png", {});
  }
  void TearDown() override { fs::remove_all(m_folder); }
  void put(const std::string& name, const Pose& pose, unsigned seed = 1) {
    ASSERT_TRUE(write_png(m_folder / name, render(Speckle(1), pose, {.noise = 1.0, .seed = seed})));
  }
  Target target() {
    const auto result = load_target({m_folder / "template.png", file_region, std::nullopt}, nullptr);
    EXPECT_TRUE(result);
    return *result;
  }
  fs::path m_folder;
};

TEST_F(MeasureFiles, BadFramesAreNamedAndGoodOnesMeasured) {
  put("frames/b.png", {.dx = 2.5, .dy = -1.0}, 2);
  put("frames/a.png", {.dx = 0.5, .dy = 0.25}, 3);
  const auto whole = read_file(m_folder / "frames/a.png");
  ASSERT_TRUE(whole);
  ASSERT_TRUE(write_file(m_folder / "frames/c_cut.png", whole->substr(0, whole->size() / 2)));
  ASSERT_TRUE(write_file(m_folder / "frames/d_empty.jpg", ""));
  ASSERT_TRUE(write_png(m_folder / "frames/e_small.png", GrayImage{100, 80, std::vector<std::uint8_t>(8000, 90)}));
  ASSERT_TRUE(write_file(m_folder / "frames/notes.txt", "hello"));
  fs::create_directories(m_folder / "frames/g_folder.png");
  ASSERT_EQ(::mkfifo((m_folder / "frames/f_pipe.png").c_str(), 0600), 0);
  std::vector<std::string> warnings;
  const auto positions = locate_in_folder(target(), {}, m_folder / "frames", &warnings, {});
  ASSERT_TRUE(positions);
  ASSERT_EQ(positions->size(), 5u);
  EXPECT_EQ((*positions)[0].frame, "a.png");
  EXPECT_NEAR((*positions)[0].location.x_px, 0.5, 0.02);
  EXPECT_NEAR((*positions)[1].location.y_px, -1.0, 0.02);
  EXPECT_NE((*positions)[2].location.reason.find("ends early"), std::string::npos);
  EXPECT_NE((*positions)[3].location.reason.find("empty"), std::string::npos);
  EXPECT_EQ((*positions)[4].location.reason, "another resolution than the template");
  EXPECT_EQ(warnings.size(), 6u);
  EXPECT_EQ(std::count(warnings.begin(), warnings.end(), "g_folder.png is a folder, no picture, and was left out"), 1);
  EXPECT_EQ(
      std::count(warnings.begin(), warnings.end(), "f_pipe.png is a pipe or a device, no picture, and was left out"),
      1);
  const std::string csv = positions_csv(*positions, false);
  EXPECT_EQ(csv.substr(0, csv.find('\n')), "frame,x_px,y_px,sigma_x_px,sigma_y_px,ok,reason");
  EXPECT_NE(csv.find("c_cut.png,,,,,0,"), std::string::npos);
}

TEST_F(MeasureFiles, FolderWithoutPicturesIsAnError) {
  const auto nothing = locate_in_folder(target(), {}, m_folder / "frames", nullptr, {});
  EXPECT_EQ(nothing.error().code, ErrorCode::wrong_format);
  EXPECT_EQ(nothing.error().context.at("file"), (m_folder / "frames").string());
  EXPECT_EQ(locate_in_folder(target(), {}, m_folder / "none", nullptr, {}).error().code, ErrorCode::file_not_found);
  const auto file = locate_in_folder(target(), {}, m_folder / "template.png", nullptr, {});
  EXPECT_EQ(file.error().code, ErrorCode::wrong_format);
  EXPECT_EQ(file.error().context.at("found"), "a file");
}

TEST_F(MeasureFiles, CalibratesFromViewsAndStoresTheTarget) {
  std::ofstream csv(m_folder / "views.csv");
  csv << "image,x_mm,y_mm\n";
  int number = 0;
  for (const double x : {-0.3, 0.0, 0.3}) {
    for (const double y : {-0.3, 0.0, 0.3}) {
      const std::string name = fmt::format("view{}.png", number++);
      put(name, {.dx = x / 0.012, .dy = -y / 0.012}, static_cast<unsigned>(number));
      csv << fmt::format("{},{},{}\n", name, 50.0 + x, 10.0 + y);
    }
  }
  csv << "absent.png,51,10\n";
  csv.close();
  const auto views = read_views(m_folder / "views.csv");
  ASSERT_TRUE(views) << describe(views.error());
  std::vector<std::string> warnings;
  const auto result = calibrate_from_files(target(), *views, &warnings, {});
  ASSERT_TRUE(result) << describe(result.error());
  EXPECT_EQ(warnings.size(), 1u);
  EXPECT_NEAR(result->calibration.um_from_px(0, 0), 12.0, 0.01);
  EXPECT_NEAR(result->calibration.um_from_px(1, 1), -12.0, 0.01);
  EXPECT_LT(result->calibration.rms_um, 0.2);

  nlohmann::json document = to_json(result->calibration);
  document["target"] = target_to_json(result->target, "template.png");
  const auto stored = target_from_json(document);
  ASSERT_TRUE(stored);
  EXPECT_EQ(stored->region.width, file_region.width);
  EXPECT_EQ(stored->mask, result->target.mask());
  ASSERT_EQ(stored->backdrop != nullptr, result->target.backdrop() != nullptr);
  if (stored->backdrop) {
    const FloatImage& kept = stored->backdrop->levels;
    ASSERT_EQ(kept.values.size(), result->target.backdrop()->levels.values.size());
    for (std::size_t k = 0; k < kept.values.size(); ++k) {
      ASSERT_NEAR(kept.values[k], result->target.backdrop()->levels.values[k], 0.51);
    }
  }
  document["target"]["mask_runs"] = {1, 2, 3};
  EXPECT_FALSE(target_from_json(document));
}

// Three views in nine leave nothing to check the matrix with.
TEST_F(MeasureFiles, MostViewsWithoutTheTargetAreNoCalibration) {
  std::vector<ViewRow> views;
  for (int k = 0; k < 9; ++k) {
    const double x = (k % 3 - 1) * 10.0, y = (k / 3 - 1) * 10.0;
    const std::string name = fmt::format("v{}.png", k);
    const unsigned seed = static_cast<unsigned>(10 + k);
    const Speckle print(k % 3 == 2 && k / 3 != 1 ? 1 : k == 4 ? 1 : 7);  // on three views ours, on six another
    ASSERT_TRUE(write_png(m_folder / name, render(print, {.dx = x, .dy = y}, {.noise = 1.0, .seed = seed})));
    views.push_back({m_folder / name, name, 0.01 * x, -0.01 * y});
  }
  std::vector<std::string> warnings;
  const auto result = calibrate_from_files(target(), views, &warnings, {});
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().code, ErrorCode::calibration_refused);
  EXPECT_NE(result.error().context.at("reason").find("found in 3 of 9 views"), std::string::npos);
  EXPECT_EQ(warnings.size(), 6u);
}

TEST_F(MeasureFiles, ViewsFileFaultsAreNamed) {
  ASSERT_TRUE(write_file(m_folder / "views.csv", "image,x_mm\na.png,1\n"));
  EXPECT_EQ(read_views(m_folder / "views.csv").error().code, ErrorCode::csv_bad_header);
  ASSERT_TRUE(write_file(m_folder / "views.csv", "image,x_mm,y_mm\na.png,1,up\n"));
  EXPECT_EQ(read_views(m_folder / "views.csv").error().code, ErrorCode::csv_bad_number);
  ASSERT_TRUE(write_file(m_folder / "views.csv", "image,x_mm,y_mm\na.png,1,\n"));
  EXPECT_EQ(read_views(m_folder / "views.csv").error().code, ErrorCode::bad_argument);
}

TEST(RegionFinder, FindsThePatternAndSaysWhenThereIsNone) {
  const auto found = find_textured_region(render(Speckle(1)), "t.png");
  ASSERT_TRUE(found);
  EXPECT_NEAR(centre_of(*found).x_px, 320.0, 15.0);
  EXPECT_NEAR(centre_of(*found).y_px, 240.0, 15.0);
  const GrayImage flat{640, 480, std::vector<std::uint8_t>(640 * 480, 120)};
  EXPECT_EQ(find_textured_region(flat, "t.png").error().code, ErrorCode::template_without_texture);
}

TEST(Reference, TheCamerasOwnMotionIsTakenOff) {
  // Target in the middle, a fixed mark on each side; the camera moves, the target moves as well.
  const auto scene = [](double target_dx, double camera_dx, double camera_dy, unsigned seed) {
    Speckle all(1, 320.0 + target_dx + camera_dx, 240.0 + camera_dy, 110.0);
    for (const Speckle& mark : {Speckle(8, 100.0 + camera_dx, 350.0 + camera_dy, 90.0),
                                Speckle(9, 540.0 + camera_dx, 350.0 + camera_dy, 90.0)}) {
      all.dots.insert(all.dots.end(), mark.dots.begin(), mark.dots.end());
    }
    return render(all, {}, {.noise = 0.5, .seed = seed});
  };
  const GrayImage image = scene(0.0, 0.0, 0.0, 1);
  const Target target = *Target::create(image, {260, 180, 120, 120}, std::nullopt, "t");
  const std::vector<Target> marks{*Target::create(image, {52, 302, 96, 96}, std::nullopt, "t"),
                                  *Target::create(image, {492, 302, 96, 96}, std::nullopt, "t")};
  const Location at = locate_against(target, marks, scene(1.25, 0.8, -0.6, 2));
  ASSERT_TRUE(at.ok) << at.reason;
  EXPECT_NEAR(at.x_px, 1.25, 0.02);
  EXPECT_NEAR(at.y_px, 0.0, 0.02);
  Location covered = locate_against(target, {*Target::create(image, {52, 302, 96, 96}, std::nullopt, "t")},
                                    render(Speckle(1, 320.0, 240.0, 110.0)));
  EXPECT_FALSE(covered.ok);
  EXPECT_EQ(covered.reason.rfind("reference: ", 0), 0u);
}

}  // namespace
}  // namespace zerodrift::vision
