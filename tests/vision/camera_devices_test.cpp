// V4L2 cameras without one: their controls on a stand-in, their list on folders as the kernel makes them.

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>

#include "core/vision/camera_controls.h"
#include "core/vision/camera_list.h"

namespace zerodrift::vision {
namespace {

namespace fs = std::filesystem;

/// Some devices fall back to a default when an automatic is switched off.
class FakeControls : public ControlPort {
 public:
  std::map<Control, double> values;
  std::map<Control, double> largest;
  double exposure_when_manual = -1.0;

  std::optional<double> value(Control control) const override {
    const auto at = values.find(control);
    return at == values.end() ? std::nullopt : std::optional(at->second);
  }
  bool set(Control control, double value) override {
    if (!values.contains(control)) return false;
    if (largest.contains(control)) value = std::min(value, largest[control]);
    values[control] = value;
    if (control == Control::auto_exposure && value == manual_exposure && exposure_when_manual >= 0.0) {
      values[Control::exposure] = exposure_when_manual;
    }
    return true;
  }
};

FakeControls everything() {
  FakeControls port;
  port.values = {{Control::auto_exposure, 3.0},   {Control::exposure, 250.0}, {Control::gain, 12.0},
                 {Control::auto_focus, 1.0},      {Control::focus, 40.0},     {Control::auto_white_balance, 1.0},
                 {Control::white_balance, 4600.0}};
  return port;
}

TEST(HeldControls, AutomaticsAreOffWhileHeldAndAsFoundAfterwards) {
  FakeControls port = everything();
  const auto found = port.values;
  {
    HeldControls held(port);
    EXPECT_FALSE(held.exposure_us()) << "an automatic sets it";
    ASSERT_TRUE(held.hold(2000.0, 30.0));
    EXPECT_EQ(port.values[Control::auto_exposure], manual_exposure);
    EXPECT_EQ(port.values[Control::auto_focus], 0.0);
    EXPECT_EQ(port.values[Control::auto_white_balance], 0.0);
    EXPECT_EQ(port.values[Control::exposure], 20.0) << "in units of 100 us";
    EXPECT_EQ(held.exposure_us(), 2000.0);
    EXPECT_EQ(held.gain(), 30.0);
  }
  EXPECT_EQ(port.values, found);
}

TEST(HeldControls, WhatTheAutomaticFoundIsKept) {
  FakeControls port = everything();
  port.exposure_when_manual = 156.0;
  HeldControls held(port);
  ASSERT_TRUE(held.hold({}, {}));
  EXPECT_EQ(port.values[Control::exposure], 250.0);
  EXPECT_EQ(port.values[Control::gain], 12.0);
  EXPECT_EQ(port.values[Control::focus], 40.0);
}

TEST(HeldControls, ACameraWithoutThemIsHeldUnlessOneIsAsked) {
  FakeControls none;
  HeldControls held(none);
  EXPECT_TRUE(held.hold({}, {}));
  const auto asked = held.hold(5000.0, {});
  ASSERT_FALSE(asked);
  EXPECT_EQ(asked.error().code, ErrorCode::camera_setting);
  EXPECT_EQ(asked.error().context.at("what"), "exposure");
}

TEST(HeldControls, AValueThatIsNotTakenIsNamedAndUndone) {
  FakeControls port = everything();
  port.largest[Control::exposure] = 300.0;
  const auto found = port.values;
  {
    HeldControls held(port);
    const auto done = held.hold(100000.0, {});
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().context.at("found"), "30000");
    EXPECT_EQ(done.error().context.at("expected"), "100000");
  }
  EXPECT_EQ(port.values, found);
}

class Listed : public ::testing::Test {
 protected:
  void SetUp() override {
    fs::remove_all(m_root);
    fs::create_directories(m_root / "class");
    write(m_root / "usb/1-4/manufacturer", "Maker\n");
    write(m_root / "usb/1-4/serial", "SN0042\n");
    fs::create_directories(m_root / "usb/1-4/1-4:1.0");
    for (const auto& [name, index] : {std::pair{"video10", "0"}, {"video2", "0"}, {"video3", "1"}}) {
      write(m_root / "class" / name / "name", "Shop Camera\n");
      write(m_root / "class" / name / "index", index);
    }
    fs::create_directory_symlink(m_root / "usb/1-4/1-4:1.0", m_root / "class/video2/device");
    write(m_root / "class/v4l-subdev0/name", "no camera");
  }
  void TearDown() override { fs::remove_all(m_root); }
  static void write(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  fs::path m_root = fs::temp_directory_path() / ("zerodrift_video_" + std::to_string(::getpid()));
};

TEST_F(Listed, DevicesThatDeliverPicturesInTheOrderOfTheirNumbers) {
  const auto cameras = v4l2_cameras(m_root / "class");
  ASSERT_EQ(cameras.size(), 2u);
  EXPECT_EQ(cameras[0].url, "/dev/video2");
  EXPECT_EQ(cameras[0].identity.kind, "v4l2");
  EXPECT_EQ(cameras[0].identity.vendor, "Maker");
  EXPECT_EQ(cameras[0].identity.model, "Shop Camera");
  EXPECT_EQ(cameras[0].identity.serial, "SN0042");
  EXPECT_EQ(cameras[0].identity.address, "1-4");
  EXPECT_EQ(cameras[1].url, "/dev/video10");
  EXPECT_EQ(cameras[1].identity.serial, "") << "not of USB";
  EXPECT_TRUE(v4l2_cameras(m_root / "nowhere").empty());
}

TEST_F(Listed, ADeviceIsKnownByItsNumberAndItsName) {
  EXPECT_EQ(v4l2_identity("2", m_root / "class").serial, "SN0042");
  EXPECT_EQ(v4l2_identity("/dev/video2", m_root / "class").serial, "SN0042");
  EXPECT_EQ(v4l2_identity("7", m_root / "class").model, "");
}

}  // namespace
}  // namespace zerodrift::vision
