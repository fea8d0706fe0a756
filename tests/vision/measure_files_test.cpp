#include "core/vision/measure_files.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <random>

#include "core/base/file.h"
#include "core/vision/error_view.h"
#include "core/vision/file_order.h"
#include "core/vision/image_codec.h"
#include "core/vision/one_direction.h"
#include "core/vision/region_finder.h"
#include "core/vision/target_file.h"
#include "tests/support/own_folder.h"
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
    m_folder = own_folder("zerodrift_measure_files");
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
  EXPECT_EQ(warnings.size(), 4u);  // what is unreadable is told once, with the frame's row
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
  const auto read = target_from_json(document, "c.json");
  ASSERT_TRUE(read && *read) << describe(read.error());
  const std::optional<StoredTarget>& stored = *read;
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
  EXPECT_TRUE(made_with(*stored, result->target, "c.json", "t.png"));
  put("again.png", {.dx = 0.3}, 99);  // the same target, another day
  const auto again = load_target({m_folder / "again.png", file_region, std::nullopt}, nullptr);
  ASSERT_TRUE(again);
  EXPECT_TRUE(made_with(*stored, *again, "c.json", "t.png"));
  const auto other = Target::create(render(Speckle(5)), file_region, std::nullopt, "o");
  ASSERT_TRUE(other);
  EXPECT_EQ(made_with(*stored, *other, "c.json", "o.png").error().code, ErrorCode::calibration_of_another_target);
  const auto small = Target::create(render(Speckle(1), {}, {}, 600, 400), file_region, std::nullopt, "s");
  ASSERT_TRUE(small);
  const Status size = made_with(*stored, *small, "c.json", "s.png");
  ASSERT_FALSE(size);
  EXPECT_NE(size.error().context.at("detail").find("640x480 pixels, the template has 600x400"), std::string::npos);
  // As files of before were: nothing to tell it by.
  document["target"].erase("size_px");
  document["target"].erase("picture_png");
  const auto before = target_from_json(document, "c.json");
  ASSERT_TRUE(before && *before);
  EXPECT_TRUE(made_with(**before, *other, "c.json", "o.png"));
}

// Whatever of the target is damaged is named by its key.
TEST_F(MeasureFiles, ADamagedTargetInTheCalibrationIsNamed) {
  const nlohmann::json good{{"target", target_to_json(target(), "template.png")}};
  ASSERT_TRUE(target_from_json(good, "c.json"));
  EXPECT_FALSE(*target_from_json(nlohmann::json::object(), "c.json"));
  const auto fault = [&](const std::string& key, const nlohmann::json& value) {
    nlohmann::json document = good;
    document["target"][key] = value;
    const auto read = target_from_json(document, "c.json");
    if (read) return std::string("accepted");
    EXPECT_EQ(read.error().context.at("file"), "c.json");
    return read.error().context.at("key");
  };
  EXPECT_EQ(fault("mask_runs", {1, 2, 3}), "target.mask_runs");
  EXPECT_EQ(fault("mask_runs", {-5, 25605}), "target.mask_runs");
  EXPECT_EQ(fault("mask_runs", {160 * 160}), "target.mask_runs");
  EXPECT_EQ(fault("mask_runs", {0, 1e18}), "target.mask_runs");
  EXPECT_EQ(fault("mask_runs", nullptr), "target.mask_runs");
  EXPECT_EQ(fault("roi_px", {600, 400, 160, 160}), "target.roi_px");
  EXPECT_EQ(fault("roi_px", {-1, 160, 160, 160}), "target.roi_px");
  EXPECT_EQ(fault("roi_px", {240, 160, 0, 160}), "target.roi_px");
  EXPECT_EQ(fault("roi_px", {240, 160}), "target.roi_px");
  EXPECT_EQ(fault("point_px", {1e9, 0}), "target.point_px");
  EXPECT_EQ(fault("lens_per_px2", 1), "target.lens_per_px2");
  EXPECT_EQ(fault("lens_sigma_per_px2", 0), "target.lens_sigma_per_px2");
  EXPECT_EQ(fault("size_px", {640.5, 480}), "target.size_px");
  EXPECT_EQ(fault("picture_png", "AAAA"), "target.picture_png");
  EXPECT_EQ(fault("mean_png", good["target"]["picture_png"]), "target.mean_png");  // without the margin
  EXPECT_EQ(fault("backdrop", {{"x_px", 0}, {"y_px", 0}, {"levels_png", "?"}}), "target.backdrop.levels_png");
}

TEST_F(MeasureFiles, FramesBeyondTheCalibrationAreSaidOnce) {
  put("frames/a.png", {.dx = 2.5, .dy = -1.0}, 2);
  put("frames/b.png", {.dx = 12.5, .dy = -1.0}, 3);
  put("frames/c.png", {.dx = 2.5, .dy = -9.0}, 4);
  LocateRequest request;
  request.calibration = Calibration{};
  std::vector<std::string> warnings;
  ASSERT_TRUE(locate_in_folder(target(), request, m_folder / "frames", &warnings, {}));
  EXPECT_TRUE(warnings.empty());  // a file that does not say how far it reaches
  request.calibration->range_px = {8.0, 6.0};
  ASSERT_TRUE(locate_in_folder(target(), request, m_folder / "frames", &warnings, {}));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_EQ(warnings[0].rfind("2 of 3 frames lie beyond the range of the calibration, +-8.0 and +-6.0 px (the first "
                              "is b.png at 12.5, -1.0 px)",
                              0),
            0u)
      << warnings[0];
}

// Three views in nine leave nothing to check the matrix with.
// Two patterns of which the fainter one moves: nobody has said which is the target.
TEST_F(MeasureFiles, WithoutARegionWhatStandsStillBesideSomethingThatMovesIsRefused) {
  const Speckle mark(1, 180.0, 240.0, 140.0);
  Speckle faint(2, 450.0, 240.0, 140.0);
  for (Speckle::Dot& dot : faint.dots) dot.depth *= 0.4;
  const auto put_both = [&](const std::string& name, const Pose& of_mark, const Pose& of_faint, unsigned seed) {
    GrayImage image = render(mark, of_mark, {.noise = 1.0, .seed = seed});
    const GrayImage other = render(faint, of_faint, {.noise = 1.0, .seed = seed + 100});
    for (int y = 0; y < image.height; ++y) {
      std::copy_n(other.pixels.begin() + std::ptrdiff_t{y} * image.width + 315, image.width - 315,
                  image.pixels.begin() + std::ptrdiff_t{y} * image.width + 315);
    }
    ASSERT_TRUE(write_png(m_folder / name, image));
  };
  put_both("both.png", {}, {}, 1);
  const auto target = load_target({m_folder / "both.png", std::nullopt, std::nullopt}, nullptr);
  ASSERT_TRUE(target);
  ASSERT_LT(target->region().x + target->region().width, 315);
  LocateRequest request;
  request.other = other_pattern(*target);
  ASSERT_TRUE(request.other);
  EXPECT_GT(request.other->region().x, 315);
  const auto measured = [&](double mark_px, double faint_px) {
    for (int k = 0; k < 4; ++k) {
      const unsigned seed = 10 + static_cast<unsigned>(k);
      put_both(fmt::format("frames/{}.png", k), {.dx = mark_px * k}, {.dx = faint_px * k, .dy = -0.2}, seed);
    }
    return locate_in_folder(*target, request, m_folder / "frames", nullptr, {});
  };
  const auto refused = measured(0.0, 1.3);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::bad_argument);
  EXPECT_NE(refused.error().context.at("found").find("moves by up to 3.9 px"), std::string::npos)
      << describe(refused.error());
  // What moves is the target; and where nothing moves nothing tells.
  const auto moves = measured(1.3, 0.0);
  ASSERT_TRUE(moves);
  EXPECT_NEAR(moves->back().location.x_px, 3.9, 0.02);
  EXPECT_TRUE(measured(0.0, 0.0));
}

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

// A spreadsheet of another country: ";" and decimal commas; the same positions.
TEST_F(MeasureFiles, ViewsWithDecimalCommas) {
  ASSERT_TRUE(write_file(m_folder / "views.csv", "image;x_mm;y_mm\na.png;0,012;-0,007\nb.png;1,5;0,06\n"));
  const auto views = read_views(m_folder / "views.csv");
  ASSERT_TRUE(views) << describe(views.error());
  ASSERT_EQ(views->size(), 2U);
  EXPECT_DOUBLE_EQ((*views)[0].x_mm, 0.012);
  EXPECT_DOUBLE_EQ((*views)[0].y_mm, -0.007);
  EXPECT_DOUBLE_EQ((*views)[1].x_mm, 1.5);
  // Nothing says whether the comma is a decimal mark; and both marks in one file.
  ASSERT_TRUE(write_file(m_folder / "views.csv", "image;x_mm;y_mm\na.png;1,234;2,345\nb.png;1,500;2,000\n"));
  EXPECT_FALSE(read_views(m_folder / "views.csv"));
  ASSERT_TRUE(write_file(m_folder / "views.csv", "image;x_mm;y_mm\na.png;1,5;2\nb.png;2.5;3\n"));
  EXPECT_FALSE(read_views(m_folder / "views.csv"));
}

TEST(FileOrder, NumbersAreComparedAsNumbers) {
  std::vector<std::string> names = {"image_10.png", "image_2.png",    "image_1.png",   "b_1.png",
                                    "image_02.png", "image_2_10.png", "image_2_9.png", "image.png"};
  std::sort(names.begin(), names.end(), [](const auto& a, const auto& b) { return is_before_by_number(a, b); });
  EXPECT_EQ(names, (std::vector<std::string>{"b_1.png", "image.png", "image_1.png", "image_2.png", "image_02.png",
                                             "image_2_9.png", "image_2_10.png", "image_10.png"}));
  EXPECT_FALSE(is_before_by_number("a1", "a1"));
  EXPECT_TRUE(is_before_by_number("f_99999999999999999999", "f_100000000000000000000"));
}

TEST_F(MeasureFiles, ViewsFileFaultsAreNamed) {
  ASSERT_TRUE(write_file(m_folder / "views.csv", "image,x_mm\na.png,1\n"));
  EXPECT_EQ(read_views(m_folder / "views.csv").error().code, ErrorCode::csv_bad_header);
  ASSERT_TRUE(write_file(m_folder / "views.csv", "image,x_mm,y_mm\na.png,1,up\n"));
  const auto only = read_views(m_folder / "views.csv");
  ASSERT_FALSE(only);
  EXPECT_EQ(only.error().code, ErrorCode::bad_argument);
  EXPECT_EQ(only.error().context.at("what"), (m_folder / "views.csv").string() + ", line 2, y_mm");
  EXPECT_EQ(only.error().context.at("found"), "up");
  ASSERT_TRUE(write_file(m_folder / "views.csv", "image,x_mm,y_mm\na.png,1,\n"));
  EXPECT_EQ(read_views(m_folder / "views.csv").error().code, ErrorCode::bad_argument);
}

TEST_F(MeasureFiles, AViewWithoutAPositionIsNamedAndTheOthersStay) {
  ASSERT_TRUE(write_file(m_folder / "views.csv", "image,x_mm,y_mm\na.png,1,1\nb.png,1,up\nc.png,nan,2\nd.png,2,1\n"));
  std::vector<std::string> warnings;
  const auto views = read_views(m_folder / "views.csv", &warnings);
  ASSERT_TRUE(views);
  ASSERT_EQ(views->size(), 2u);
  EXPECT_EQ((*views)[1].name, "d.png");
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0],
            (m_folder / "views.csv").string() + ", line 3, y_mm: \"up\" is no position in mm; b.png was left out");
  EXPECT_NE(warnings[1].find("line 4, x_mm: \"nan\""), std::string::npos);
}

TEST_F(MeasureFiles, APictureCountsOnceAndStandsAtOnePlace) {
  ASSERT_TRUE(write_file(m_folder / "views.csv", "image,x_mm,y_mm\na.png,1,1\na.png,1,1\nb.png,2,1e300\nc.png,2,1\n"));
  std::vector<std::string> warnings;
  const auto views = read_views(m_folder / "views.csv", &warnings);
  ASSERT_TRUE(views);
  EXPECT_EQ(views->size(), 2u);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(warnings[0], (m_folder / "views.csv").string() + ", line 3: a.png is there already; it counts once");
  EXPECT_NE(warnings[1].find("\"1e300\" is no position in mm"), std::string::npos);
  ASSERT_TRUE(write_file(m_folder / "views.csv", "image,x_mm,y_mm\na.png,1,1\nb.png,2,1\na.png,3,1\n"));
  const auto twice = read_views(m_folder / "views.csv");
  ASSERT_FALSE(twice);
  EXPECT_EQ(twice.error().context.at("what"), (m_folder / "views.csv").string() + ", line 4");
  EXPECT_EQ(twice.error().context.at("found"), "a.png once more, at another position");
}

TEST(OneDirection, WhatBarsDoNotShowIsSaid) {
  const auto bars = [](double turn_deg) {
    GrayImage image{320, 240, std::vector<std::uint8_t>(320 * 240)};
    std::mt19937 random(3);
    std::normal_distribution<double> noise(0.0, 2.0);
    const double across_x = std::cos(turn_deg * M_PI / 180.0), across_y = std::sin(turn_deg * M_PI / 180.0);
    for (int y = 0; y < 240; ++y) {
      for (int x = 0; x < 320; ++x) {
        const double u = across_x * x + across_y * y;
        image.at(x, y) =
            static_cast<std::uint8_t>(120.0 + 30.0 * std::sin(u / 3.0 + 2.0 * std::sin(u / 17.0)) + noise(random));
      }
    }
    return unseen_direction(image, {60, 40, 160, 160});
  };
  EXPECT_EQ(bars(0.0).rfind("the region shows little but bars along y: a motion up and down (y) can hardly be seen", 0),
            0u);
  EXPECT_EQ(bars(90.0).rfind("the region shows little but bars along x: a motion from side to side (x)", 0), 0u);
  EXPECT_NE(bars(30.0).find("rising to the right at 60 degrees to x"), std::string::npos) << bars(30.0);
  EXPECT_NE(bars(-30.0).find("falling to the right at 60 degrees to x"), std::string::npos) << bars(-30.0);
  EXPECT_EQ(unseen_direction(render(Speckle(1)), file_region), "");
}

TEST(RegionFinder, FindsThePatternAndSaysWhenThereIsNone) {
  const auto found = find_textured_region(render(Speckle(1)), "t.png");
  ASSERT_TRUE(found);
  EXPECT_NEAR(centre_of(*found).x_px, 320.0, 15.0);
  EXPECT_NEAR(centre_of(*found).y_px, 240.0, 15.0);
  const GrayImage flat{640, 480, std::vector<std::uint8_t>(640 * 480, 120)};
  EXPECT_EQ(find_textured_region(flat, "t.png").error().code, ErrorCode::template_without_texture);
}

// Of what is larger than the window all is found, with what its outline stands before; what is everywhere has no end.
TEST(RegionFinder, FindsAllOfASingleThing) {
  const auto found = find_textured_region(render(Speckle(3, 330.0, 236.0, 200.0)), "t.png");
  ASSERT_TRUE(found);
  EXPECT_LE(found->x, 230 - 4);
  EXPECT_LE(found->y, 136 - 4);
  EXPECT_GE(found->x + found->width, 430 + 4);
  EXPECT_GE(found->y + found->height, 336 + 4);
  EXPECT_LE(std::max(found->width, found->height), 200 + 60);
  // And hardly more than a small one.
  const auto small = find_textured_region(render(Speckle(5, 330.0, 236.0, 60.0)), "t.png");
  ASSERT_TRUE(small);
  EXPECT_NEAR(centre_of(*small).x_px, 330.0, 8.0);
  EXPECT_NEAR(centre_of(*small).y_px, 236.0, 8.0);
  EXPECT_LE(std::max(small->width, small->height), 60 + 45);
  EXPECT_GE(std::min(small->width, small->height), 60 + 8);
  const auto everywhere = find_textured_region(render(Speckle(4, 320.0, 240.0, 700.0)), "t.png");
  ASSERT_TRUE(everywhere);
  EXPECT_EQ(everywhere->width, 160);
  EXPECT_EQ(everywhere->height, 160);
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
