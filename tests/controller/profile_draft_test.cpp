// A profile while it is set up: what is not edited stays, what is edited can be taken back, and only what its reader
// takes is saved. The templates of devices, and the values that are believed.

#include "core/controller/profile_draft.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/base/json_path.h"
#include "core/base/resources.h"
#include "core/controller/device_templates.h"
#include "core/controller/profile_signals.h"
#include "fixtures.h"

namespace zerodrift::controller {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const std::string example = std::string(ZERODRIFT_SOURCE_DIR) + "/examples/rig-profile.json";

/// Of a draft that its reader refuses: at which place.
std::string refused_at(const ProfileDraft& draft) {
  const auto read = draft.profile();
  if (read) return "";
  const auto key = read.error().context.find("key");
  return key == read.error().context.end() ? describe(read.error()) : key->second;
}

fs::path scratch(const std::string& name) {
  const fs::path folder = fs::path(testing::TempDir()) / ("profile-draft-" + std::to_string(::getpid()));
  fs::create_directories(folder);
  return folder / name;
}

json module(int unit = 1) {
  return {{"id", "module"}, {"kind", "modbus-rtu"}, {"device", "/dev/ttyUSB0"},
          {"parity", "N"},  {"unit", unit},         {"register_map", "temperature-module-8-pt100"}};
}

}  // namespace

TEST(ProfileDraft, ANewOneIsAControlWithoutALinkAndValid) {
  const ProfileDraft draft;
  const auto read = draft.profile();
  ASSERT_TRUE(read) << describe(read.error());
  EXPECT_TRUE(read->manual);
  EXPECT_FALSE(draft.changed());
}

TEST(ProfileDraft, SavingAnExampleUnchangedLosesNoKey) {
  auto draft = ProfileDraft::open(example);
  ASSERT_TRUE(draft);
  json before = draft->document();
  before["maintenance"] = {{"next", "2027-03"}};
  before["devices"][0]["serial_of_maker"] = "A-17";
  before["sensors"][3]["remark"] = "glued";
  ProfileDraft edited(before, example);
  const fs::path file = scratch("same.json");
  ASSERT_TRUE(edited.save(file));
  EXPECT_EQ(*read_json_file(file), before);
  ASSERT_TRUE(read_profile(file));
}

TEST(ProfileDraft, AnEditChangesItsPlaceAlone) {
  auto draft = ProfileDraft::open(example);
  ASSERT_TRUE(draft);
  json expected = draft->document();
  draft->enter("sensors[2]", "label", "Motor");
  expected["sensors"][2]["label"] = "Motor";
  draft->enter("devices[2]", "port", "1510");
  expected["devices"][2]["port"] = 1510;
  draft->enter("devices[0]", "poll_period_s", "0,5");
  expected["devices"][0]["poll_period_s"] = 0.5;
  EXPECT_EQ(draft->document(), expected);
  EXPECT_TRUE(draft->changed());
}

TEST(ProfileDraft, UndoAndRedoGoThroughEveryStep) {
  ProfileDraft draft;
  std::vector<json> steps = {draft.document()};
  draft.add_device(module());
  steps.push_back(draft.document());
  EXPECT_EQ(draft.add_sensors_of("module-1"), 8);
  steps.push_back(draft.document());
  draft.enter("devices[0]", "unit", "3");
  steps.push_back(draft.document());
  for (std::size_t i = steps.size() - 1; i > 0; --i) {
    ASSERT_TRUE(draft.can_undo());
    draft.undo();
    EXPECT_EQ(draft.document(), steps[i - 1]) << i;
  }
  EXPECT_FALSE(draft.can_undo());
  for (std::size_t i = 1; i < steps.size(); ++i) {
    draft.redo();
    EXPECT_EQ(draft.document(), steps[i]) << i;
  }
  EXPECT_FALSE(draft.can_redo());
  draft.undo();
  draft.enter("", "name", "Mill 7");
  EXPECT_FALSE(draft.can_redo()) << "another way was taken";
}

TEST(ProfileDraft, AFaultIsNamedAtItsPlace) {
  ProfileDraft draft;
  draft.add_device(module());
  EXPECT_EQ(refused_at(draft), "");
  draft.enter("devices[0]", "unit", "300");
  EXPECT_EQ(refused_at(draft), "devices[0].unit");
  draft.enter("devices[0]", "unit", "");
  draft.enter("devices[0]", "device", "");
  EXPECT_EQ(refused_at(draft), "devices[0].device");
  draft.enter("devices[0]", "device", "/dev/ttyUSB0");
  draft.enter("devices[0]", "register_map", "no-such-map");
  EXPECT_EQ(refused_at(draft), "devices[0].register_map");
  draft.enter("devices[0]", "register_map", "temperature-module-8-pt100");
  draft.add_sensor("module-1", "temperature_C[9]");
  EXPECT_EQ(refused_at(draft), "sensors[0].signal");
  draft.assign("sensors[0]", "module-1", "humidity");
  EXPECT_EQ(refused_at(draft), "sensors[0].signal");
  draft.assign("sensors[0]", "module-1", "temperature_C[8]");
  draft.assign("ambient", "module-1", "temperature_C[8]");
  EXPECT_EQ(refused_at(draft), "sensors[0].signal");  // read once already
  draft.assign("ambient", "", "");
  EXPECT_EQ(refused_at(draft), "");
  draft.add_device(json{{"id", "agent"}, {"kind", "mtconnect"}, {"url", "host:5000"}});
  EXPECT_EQ(refused_at(draft), "devices[1].url");
  draft.remove("devices[1]");
  draft.add_device(json{{"id", "shop"}, {"kind", "mqtt"}, {"host", "broker"}});
  draft.assign("ambient", "shop-1", "hall/+");
  EXPECT_EQ(refused_at(draft), "ambient.signal");
}

// An empty name would be the control's, an empty address anybody's.
TEST(ProfileDraft, AnEmptyTextIsMissing) {
  for (const char* key : {"id", "device"}) {
    json document = ProfileDraft().document();
    document["devices"].push_back(module());
    document["devices"][0][key] = "";
    const auto read = profile_from_json(document, "p.json");
    ASSERT_FALSE(read) << key;
    EXPECT_EQ(read.error().code, ErrorCode::json_missing_key);
    EXPECT_EQ(read.error().context.at("key"), std::string("devices[0].") + key);
  }
}

TEST(ProfileDraft, TwoUnitsOfOneNumberAreNamedAtTheSecond) {
  ProfileDraft draft;
  draft.add_device(module());
  draft.add_device(module());
  EXPECT_EQ(draft.document()["devices"][1]["unit"], 2) << "the next free unit of the line";
  EXPECT_EQ(refused_at(draft), "");
  draft.enter("devices[1]", "unit", "1");
  EXPECT_EQ(refused_at(draft), "devices[1].unit");
}

TEST(ProfileDraft, AModuleWithoutAPortIsAddedToTheLineOfTheOneBefore) {
  ProfileDraft draft;
  draft.add_device(module(4));
  json next = {
      {"id", "module"}, {"kind", "modbus-rtu"}, {"device", ""}, {"unit", 4}, {"register_map", "probe-amplifier"}};
  const std::string place = draft.add_device(next);
  const json& added = draft.document()["devices"][1];
  EXPECT_EQ(place, "devices[1]");
  EXPECT_EQ(added["device"], "/dev/ttyUSB0");
  EXPECT_EQ(added["parity"], "N");
  EXPECT_EQ(added["unit"], 5);
  EXPECT_EQ(added["id"], "module-2");
}

TEST(ProfileDraft, AnInvalidOneIsNotSaved) {
  ProfileDraft draft;
  draft.add_device(json{{"id", "amplifier"}, {"kind", "modbus-tcp"}, {"register_map", "probe-amplifier"}});
  const fs::path file = scratch("refused.json");
  const Status saved = draft.save(file);
  ASSERT_FALSE(saved);
  EXPECT_EQ(saved.error().context.at("key"), "devices[0].host");
  EXPECT_FALSE(fs::exists(file));
  EXPECT_TRUE(draft.changed());
}

TEST(ProfileDraft, WhatNamesADeviceFollowsItsNewIdAndGoesWithIt) {
  auto draft = ProfileDraft::open(example);
  ASSERT_TRUE(draft);
  draft->enter("devices[0]", "id", "spindle-module");
  draft->enter("devices[2]", "id", "probes");
  const auto read = draft->profile();
  ASSERT_TRUE(read) << describe(read.error());
  EXPECT_EQ(read->sensors[0].source.device, "spindle-module");
  EXPECT_EQ(read->sources.probes[4].device, "probes");
  draft->remove("devices[0]");
  draft->remove(place_of_device(draft->document(), "probes"));
  const auto rest = draft->profile();
  ASSERT_TRUE(rest) << describe(rest.error());
  EXPECT_EQ(rest->sensors.size(), 12u);
  EXPECT_EQ(rest->sensors[0].channel, "T9_C");
  EXPECT_TRUE(rest->sources.probes.empty());
}

TEST(ProfileDraft, NoKeyOfEitherFormOfProbesIsUnknown) {
  auto draft = ProfileDraft::open(example);
  ASSERT_TRUE(draft);
  std::vector<std::string> warnings;
  ASSERT_TRUE(profile_from_json(draft->document(), example, &warnings));
  draft->assign("probes.X2", "", "");
  ASSERT_TRUE(profile_from_json(draft->document(), example, &warnings));
  EXPECT_TRUE(warnings.empty()) << warnings.front();
}

TEST(ProfileDraft, OneProbeOfAnArrayIsReadElsewhereAndTheOthersStay) {
  auto draft = ProfileDraft::open(example);
  ASSERT_TRUE(draft);
  draft->assign("probes.Z", "agent", "Zprobe");
  draft->assign("probes.X2", "", "");
  const auto read = draft->profile();
  ASSERT_TRUE(read) << describe(read.error());
  EXPECT_EQ(read->sources.probes[0].signal, "probe_um[1]");
  EXPECT_EQ(read->sources.probes[1].device, "");
  EXPECT_EQ(read->sources.probes[4].device, "agent");
}

TEST(ProfileDraft, AScaleThatIsChangedBelongsToThisDeviceAlone) {
  ProfileDraft draft;
  draft.add_device(module(1));
  draft.add_device(module(2));
  ASSERT_TRUE(draft.set_register("devices[1]", "temperature_C", "scale", "0.1"));
  EXPECT_DOUBLE_EQ(draft.map_at("devices[0]")->find("temperature_C")->scale, 0.01);
  EXPECT_DOUBLE_EQ(draft.map_at("devices[1]")->find("temperature_C")->scale, 0.1);
  EXPECT_EQ(refused_at(draft), "");
  EXPECT_FALSE(draft.set_register("devices[1]", "temperature_C", "scale", "much"));
  ASSERT_TRUE(draft.set_register("devices[1]", "temperature_C", "address", "16"));
  EXPECT_EQ(draft.map_at("devices[1]")->find("temperature_C")->address, 16);
  draft.enter("devices[1]", "register_map", "temperature-module-8-ds18b20");
  EXPECT_EQ(draft.map_at("devices[1]")->find("temperature_C")->space, RegisterSpace::holding);
}

TEST(ProfileDraft, AnotherKindKeepsWhatBothHave) {
  ProfileDraft draft;
  draft.add_device(module(5));
  draft.enter("devices[0]", "remark", "left cabinet");
  draft.set_kind("devices[0]", "modbus-tcp");
  const json& device = draft.document()["devices"][0];
  EXPECT_EQ(device["unit"], 5);
  EXPECT_EQ(device["remark"], "left cabinet");
  EXPECT_FALSE(device.contains("device"));
  EXPECT_EQ(refused_at(draft), "devices[0].host");
}

TEST(ProfileDraft, PathsLeadToTheSameFilesFromAnotherFolder) {
  const fs::path map = scratch("own-map.json");
  fs::copy_file(*find_resource("register_maps/probe-amplifier.json"), map, fs::copy_options::overwrite_existing);
  ProfileDraft draft(ProfileDraft().document(), scratch("profile.json").string());
  draft.add_device(json{{"id", "a"}, {"kind", "modbus-tcp"}, {"host", "h"}, {"register_map", "own-map.json"}});
  ASSERT_TRUE(draft.save(scratch("profile.json")));
  fs::create_directories(scratch("other"));
  ASSERT_TRUE(draft.save(scratch("other/profile.json")));
  const auto read = read_profile(scratch("other/profile.json"));
  ASSERT_TRUE(read);
  EXPECT_EQ(read->devices[0].modbus.register_map, "../own-map.json");
  EXPECT_TRUE(load_register_map("../own-map.json", scratch("other")));
}

// A template is a device entry without its address.
TEST(DeviceTemplates, EachIsAValidDeviceWithItsMapOnceItHasAnAddress) {
  const auto templates = device_templates();
  EXPECT_GE(templates.size(), 5u);
  for (const DeviceTemplate& one : templates) {
    ProfileDraft draft;
    const std::string place = draft.add_device(one.entry);
    EXPECT_NE(refused_at(draft), "") << one.name << " has an address";
    draft.enter(place, one.entry.at("kind") == "modbus-rtu" ? "device" : "host", "somewhere");
    EXPECT_EQ(refused_at(draft), "") << one.name;
    const auto map = draft.map_at(place);
    ASSERT_TRUE(map) << one.name;
    const Register* measured = map->find("temperature_C") ? map->find("temperature_C") : map->find("probe_um");
    ASSERT_NE(measured, nullptr) << one.name;
    EXPECT_GE(measured->count, 4) << one.name;
  }
}

TEST(DeviceTemplates, FourProbesAreAssignedOneByOne) {
  ProfileDraft draft;
  json entry;
  for (const auto& one : device_templates()) {
    if (one.name == "probe-amplifier-4") entry = one.entry;
  }
  entry["host"] = "h";
  draft.add_device(entry);
  draft.assign("probes.X1", "amplifier-1", "probe_um[1]");
  draft.assign("probes.Y1", "amplifier-1", "probe_um[2]");
  draft.assign("probes.Z", "amplifier-1", "probe_um[3]");
  const auto read = draft.profile();
  ASSERT_TRUE(read) << describe(read.error());
  EXPECT_EQ(read->sources.probes[4].signal, "probe_um[3]");
  EXPECT_EQ(read->sources.probes[3].device, "");
}

TEST(SignalWatch, SaysWhetherAValueIsBelieved) {
  const SignalRange celsius = range_of(SignalUse::sensor);
  EXPECT_EQ(SignalWatch(celsius).judgement(), Plausibility::unknown);
  SignalWatch live(celsius);
  for (int i = 0; i < 30; ++i) live.add(21.0 + 0.01 * (i % 3));
  EXPECT_EQ(live.judgement(), Plausibility::ok);
  EXPECT_NEAR(live.change(), 0.02, 1e-9);
  SignalWatch stuck(celsius);
  for (int i = 0; i < 30; ++i) stuck.add(21.0);
  EXPECT_EQ(stuck.judgement(), Plausibility::unchanged);
  SignalWatch open(celsius);
  open.add(850.0);
  EXPECT_EQ(open.judgement(), Plausibility::out_of_range);
  live.add(NAN);
  EXPECT_EQ(live.judgement(), Plausibility::missing);
  SignalWatch speed(range_of(SignalUse::speed));
  for (int i = 0; i < 30; ++i) speed.add(0.0);
  EXPECT_EQ(speed.judgement(), Plausibility::ok) << "a spindle that is at rest";
}

}  // namespace zerodrift::controller
