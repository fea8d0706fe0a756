// A connection profile: the fixed marks of a camera (none, one, several), and what measuring needs of it.

#include "core/controller/profile.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/base/json.h"

namespace zerodrift::controller {
namespace {

using Marks = std::vector<std::array<int, 4>>;
using nlohmann::json;

json shipped() {
  return *read_json_file(std::string(ZERODRIFT_SOURCE_DIR) + "/resources/profiles/virtual-five-axis.json");
}

json with_marks(const json& marks) {
  json document = shipped();
  document["cameras"][1]["reference_roi_px"] = marks;
  return document;
}

Marks marks_of(const json& document) {
  const auto profile = profile_from_json(document, "machine.json");
  EXPECT_TRUE(profile) << describe(profile.error());
  return profile ? profile->cameras[1].reference_rois_px : Marks{};
}

// No position is assumed: 0, 0, 0 may be anywhere, and a machine would go there.
TEST(ProfileMeasuring, APositionThatIsNotGivenIsNone) {
  json document = shipped();
  EXPECT_EQ(profile_from_json(document, "machine.json")->measure_position_mm.size(), 3u);
  document.erase("measure_position_mm");
  EXPECT_TRUE(profile_from_json(document, "machine.json")->measure_position_mm.empty());
  document["measure_position_mm"] = {{"Z", -12.5}};
  EXPECT_EQ(profile_from_json(document, "machine.json")->measure_position_mm,
            (std::map<std::string, double>{{"Z", -12.5}}));
}

TEST(ProfileMeasuring, LatencyAndDriftHaveSafeDefaultsAndLimits) {
  json document = shipped();
  const auto profile = profile_from_json(document, "machine.json");
  ASSERT_TRUE(profile);
  EXPECT_GE(profile->cameras[0].assumed_latency_s, 1.0);
  EXPECT_GT(profile->max_drift_um_per_min, 0.0);
  document["cameras"][0]["assumed_latency_s"] = 0.0;
  const auto refused = profile_from_json(document, "machine.json");
  ASSERT_FALSE(refused) << "a latency of nothing would trust any picture";
  EXPECT_EQ(refused.error().context.at("key"), "cameras[0].assumed_latency_s");
}

TEST(ProfileCameras, ExposureAndGainOfACameraThatCanBeSet) {
  json document = shipped();
  json& camera = document["cameras"][0];
  EXPECT_FALSE(profile_from_json(document, "machine.json")->cameras[0].exposure_us);
  for (const char* url : {"aravis:DA1234567", "aravis:*", "/dev/video0", "0"}) {
    camera["url"] = url;
    camera["exposure_us"] = 5000;
    camera["gain_db"] = -1.5;
    const auto profile = profile_from_json(document, "machine.json");
    ASSERT_TRUE(profile) << describe(profile.error());
    EXPECT_EQ(profile->cameras[0].exposure_us, 5000.0);
    EXPECT_EQ(profile->cameras[0].gain_db, -1.5);
    EXPECT_TRUE(profile_from_job(*document_for_job(document, *profile))) << "a job may lead to " << url;
  }
  camera["exposure_us"] = 0;
  EXPECT_EQ(profile_from_json(document, "machine.json").error().context.at("key"), "cameras[0].exposure_us");
  camera["exposure_us"] = 5000;
  camera["url"] = "http://127.0.0.1/front.mjpg";
  const auto stream = profile_from_json(document, "machine.json");
  ASSERT_FALSE(stream) << "nothing would set it";
  EXPECT_EQ(stream.error().context.at("key"), "cameras[0].exposure_us");
}

TEST(ProfileMarks, NoneOneAndSeveral) {
  json without = shipped();
  without["cameras"][1].erase("reference_roi_px");
  EXPECT_EQ(marks_of(without), Marks{});
  EXPECT_EQ(marks_of(with_marks(nullptr)), Marks{});
  EXPECT_EQ(marks_of(with_marks({40, 300, 120, 110})), (Marks{{40, 300, 120, 110}}));
  const json pair = json::array({{40, 300, 120, 110}, {480, 300, 120, 100}});
  EXPECT_EQ(marks_of(with_marks(pair)), (Marks{{40, 300, 120, 110}, {480, 300, 120, 100}}));
  EXPECT_EQ(marks_of(with_marks(json::array({{40, 300, 120, 110}}))), (Marks{{40, 300, 120, 110}}));
  EXPECT_EQ(marks_of(shipped()).size(), 2u) << "the virtual machine's cameras see two";
}

TEST(ProfileMarks, AJobKeepsThemAsTheyWereWritten) {
  for (const json& marks : {json{40, 300, 120, 110}, json::array({{40, 300, 120, 110}, {480, 300, 120, 100}})}) {
    const json document = with_marks(marks);
    const auto profile = profile_from_json(document, "machine.json");
    ASSERT_TRUE(profile) << describe(profile.error());
    const auto kept = document_for_job(document, *profile);
    ASSERT_TRUE(kept) << describe(kept.error());
    EXPECT_EQ((*kept)["cameras"][1]["reference_roi_px"], marks);
    const auto again = profile_from_job(*kept);
    ASSERT_TRUE(again) << describe(again.error());
    EXPECT_EQ(again->cameras[1].reference_rois_px, profile->cameras[1].reference_rois_px);
  }
}

TEST(ProfileMarks, WhatIsWrongIsNamedWithFileAndField) {
  struct Case {
    json marks;
    const char* key;
  };
  const std::vector<Case> cases = {
      {json::array(), "reference_roi_px"},
      {"left", "reference_roi_px"},
      {{40, 300, 120}, "reference_roi_px"},
      {{40, 300, 0, 120}, "reference_roi_px"},
      {{40, 300, "wide", 120}, "reference_roi_px[2]"},
      {json::array({{40, 300, 120, 120}, {480, 300, 120}}), "reference_roi_px[1]"},
      {json::array({{40, 300, 120, 120}, {480, 300, 120, -4}}), "reference_roi_px[1]"},
      {json::array({{40, 300, 120, 120}, {-1, 300, 120, 120}}), "reference_roi_px[1]"},
      {json::array({{40, 300, 120, 120}, {480, 1e9, 120, 120}}), "reference_roi_px[1]"},
      {json::array({{40, 300, 120, 120}, 480, 300, 120, 120}), "reference_roi_px[1]"},
      {json::array({{40, 300, 120, 120}, {480, nullptr, 120, 120}}), "reference_roi_px[1]"},
      {json::array({40, {480, 300, 120, 120}, 300, 120}), "reference_roi_px[1]"},
      {json::array({{{"x", 40}}, {{"x", 40}}}), "reference_roi_px"}};
  for (const Case& one : cases) {
    const auto profile = profile_from_json(with_marks(one.marks), "machine.json");
    ASSERT_FALSE(profile) << one.marks.dump();
    EXPECT_EQ(profile.error().code, ErrorCode::json_bad_value) << one.marks.dump();
    EXPECT_EQ(profile.error().context.at("file"), "machine.json");
    EXPECT_EQ(profile.error().context.at("key"), std::string("cameras[1].") + one.key) << one.marks.dump();
    EXPECT_FALSE(profile.error().context.at("expected").empty());
  }
}

}  // namespace
}  // namespace zerodrift::controller
