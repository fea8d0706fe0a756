// A run measures with the camera that was calibrated, set as it was then.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/flow/steps/calibrate_step.h"
#include "core/vision/image_codec.h"
#include "tests/commissioning/temporary_folder.h"

namespace zerodrift::flow {

using commissioning::Job;
using commissioning::NewArtefact;
using commissioning::TemporaryFolder;
using nlohmann::json;

namespace {

vision::CameraIdentity shop_camera() {
  vision::CameraIdentity identity;
  identity.kind = "gige-vision";
  identity.vendor = "Maker";
  identity.model = "Five";
  identity.serial = "42";
  identity.exposure_us = 5000.0;
  identity.gain_db = 3.0;
  return identity;
}

/// What differs, "" when nothing does.
std::string difference(const json& kept, const vision::CameraIdentity& now) {
  const Status same = same_device("front", kept, now);
  if (same) return "";
  EXPECT_EQ(same.error().code, ErrorCode::calibration_of_another_camera);
  EXPECT_EQ(same.error().context.at("camera"), "front");
  return same.error().context.at("what") + ": " + same.error().context.at("found") + " for " +
         same.error().context.at("expected");
}

}  // namespace

TEST(SameCamera, AnotherSerialNumberExposureOrGainIsNamed) {
  const json kept = device_json(shop_camera());
  EXPECT_EQ(kept.at("serial"), "42");
  EXPECT_EQ(difference(kept, shop_camera()), "");
  auto now = shop_camera();
  now.serial = "43";
  EXPECT_EQ(difference(kept, now), "the serial number: 43 for 42");
  now = shop_camera();
  now.exposure_us = 5020.0;  // the step of the camera's clock
  EXPECT_EQ(difference(kept, now), "");
  now.exposure_us = 8000.0;
  EXPECT_EQ(difference(kept, now), "the exposure: 8000 us for 5000 us");
  now = shop_camera();
  now.gain_db = 6.0;
  EXPECT_EQ(difference(kept, now), "the gain: 6 dB for 3 dB");
}

TEST(SameCamera, WhatACameraDoesNotTellIsNotCompared) {
  EXPECT_TRUE(device_json({}).is_null()) << "a stream over the network tells nothing";
  auto now = shop_camera();
  now.exposure_us.reset();
  now.gain_db.reset();
  EXPECT_EQ(difference(device_json(shop_camera()), now), "");
  EXPECT_EQ(difference(json::object(), shop_camera()), "");
  EXPECT_EQ(difference({{"serial", 7}, {"exposure_us", "long"}}, shop_camera()), "") << "of a job from elsewhere";
  now = {};
  EXPECT_EQ(difference(device_json(shop_camera()), now), "the serial number: none for 42");
}

TEST(SameCamera, IsNoticedBeforeARun) {
  const TemporaryFolder folder;
  ASSERT_TRUE(vision::write_png(folder / "img_0000.png", {8, 6, std::vector<std::uint8_t>(48, 90)}));
  auto job = Job::create(folder / "a.zdj");
  ASSERT_TRUE(job);
  const json body = {{"source", "camera"},
                     {"cameras", json::array({{{"id", "front"}, {"device", device_json(shop_camera())}}})}};
  ASSERT_TRUE(job->put(NewArtefact::of("calibration", body)));
  Devices devices;
  CameraDevice front;
  front.profile.id = "front";
  front.profile.url = (folder / "img_%04d.png").string();
  front.camera = open_camera(front.profile);
  devices.cameras.push_back(front);
  const auto views = calibrated_views(*job, devices);
  ASSERT_FALSE(views);
  EXPECT_EQ(views.error().code, ErrorCode::calibration_of_another_camera) << describe(views.error());
}

TEST(SameCamera, ADeviceIsOpenedOnceForAllWhoReadIt) {
  controller::CameraProfile profile;
  profile.url = "aravis:no-such-camera";
  const auto preview = open_camera(profile);
  EXPECT_EQ(open_camera(profile), preview);
  profile.exposure_us = 5000.0;
  EXPECT_NE(open_camera(profile), preview) << "set otherwise";
  profile.url = "http://127.0.0.1:9/none.mjpg";
  profile.exposure_us.reset();
  const auto stream = open_camera(profile);
  EXPECT_NE(open_camera(profile), stream);
}

}  // namespace zerodrift::flow
