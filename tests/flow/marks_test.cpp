// The fixed marks in a job's calibration, as a run takes them up: now, in an old job, and after it was opened again.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <random>

#include "core/flow/steps/calibrate_step.h"
#include "core/vision/image_codec.h"
#include "tests/commissioning/temporary_folder.h"

namespace zerodrift::flow {
namespace {

using commissioning::Blob;
using commissioning::Job;
using commissioning::NewArtefact;
using commissioning::TemporaryFolder;
using nlohmann::json;

/// Three patches of blurred random squares on an even ground: the target in the middle and a mark at each side.
std::string template_png() {
  std::mt19937 random(1);
  vision::GrayImage image{640, 480, std::vector<std::uint8_t>(640 * 480, 190)};
  const auto patch = [&](int left, int top, int size) {
    for (int y = top; y < top + size; y += 6) {
      for (int x = left; x < left + size; x += 6) {
        const int dark = static_cast<int>(random() % 140);
        for (int dy = 0; dy < 6; ++dy) {
          for (int dx = 0; dx < 6; ++dx) {
            const bool rim = dx == 0 || dy == 0 || dx == 5 || dy == 5;
            image.at(x + dx, y + dy) = static_cast<std::uint8_t>(190 - (rim ? dark / 2 : dark));
          }
        }
      }
    }
  };
  patch(250, 170, 138);
  patch(58, 308, 84);
  patch(498, 308, 84);
  const auto png = vision::encode_png(image).value();
  return {png.begin(), png.end()};
}

/// A calibrated camera with these marks ("reference_roi"; null: none).
NewArtefact calibration_with(const json& marks) {
  std::vector<vision::CalibrationView> views;
  for (const auto& at : vision::propose_positions(1.0)) {
    views.push_back({"v", at.x_mm, at.y_mm, at.x_mm * 1000.0 / 12.0, -at.y_mm * 1000.0 / 12.0});
  }
  json camera = {{"id", "front"},
                 {"axes", {"X", "Z"}},
                 {"roi", {240, 160, 160, 160}},
                 {"calibration", vision::to_json(vision::calibrate(views).value())}};
  if (!marks.is_null()) camera["reference_roi"] = marks;
  return NewArtefact::of("calibration", {{"source", "camera"}, {"cameras", {camera}}}, {},
                         {Blob{"front-template.png", template_png()}});
}

Devices front_camera() {
  Devices devices;
  controller::CameraProfile profile;
  profile.id = "front";
  profile.axes = {"X", "Z"};
  devices.cameras.push_back({profile, nullptr});
  return devices;
}

std::vector<vision::Region> marks_taken_up(const Job& job) {
  Devices devices = front_camera();
  const auto views = calibrated_views(job, devices);
  EXPECT_TRUE(views) << describe(views.error());
  std::vector<vision::Region> regions;
  if (!views) return regions;
  for (const auto& mark : views->front().references) regions.push_back(mark.region());
  return regions;
}

TEST(CalibrationMarks, AreTakenUpAsTheyWereWritten) {
  struct Case {
    json written;
    std::vector<int> lefts;
  };
  const std::vector<Case> cases = {{nullptr, {}},
                                   {{52, 302, 96, 96}, {52}},  // so every job before had it
                                   {json::array({{52, 302, 96, 96}, {492, 302, 96, 96}}), {52, 492}}};
  for (const Case& one : cases) {
    const TemporaryFolder folder;
    {
      auto job = Job::create(folder / "a.zdj");
      ASSERT_TRUE(job);
      ASSERT_TRUE(job->put(calibration_with(one.written)));
    }
    const auto again = Job::open(folder / "a.zdj");
    ASSERT_TRUE(again) << describe(again.error());
    const auto taken = marks_taken_up(*again);
    ASSERT_EQ(taken.size(), one.lefts.size()) << one.written.dump();
    for (std::size_t k = 0; k < taken.size(); ++k) EXPECT_EQ(taken[k].x, one.lefts[k]);
  }
}

TEST(CalibrationMarks, AFlatOneIsRefusedByItsNumber) {
  const TemporaryFolder folder;
  auto job = Job::create(folder / "a.zdj");
  ASSERT_TRUE(job);
  ASSERT_TRUE(job->put(calibration_with(json::array({{52, 302, 96, 96}, {20, 20, 96, 96}}))));
  Devices devices = front_camera();
  const auto views = calibrated_views(*job, devices);
  ASSERT_FALSE(views);
  EXPECT_EQ(views.error().code, ErrorCode::template_without_texture);
  EXPECT_NE(views.error().context.at("file").find("(reference 2)"), std::string::npos) << describe(views.error());
}

TEST(CalibrationMarks, WhatAJobFromElsewhereHoldsDoesNoHarm) {
  for (const json& odd : {json("left"), json::array(), json{1, 2}, json::array({{1, 2, 3, 4}, 5}),
                          json::array({{1, 2, 3, "x"}}), json{{"x", 1}}}) {
    EXPECT_TRUE(marks_of({{"reference_roi", odd}}).empty()) << odd.dump();
  }
}

}  // namespace
}  // namespace zerodrift::flow
