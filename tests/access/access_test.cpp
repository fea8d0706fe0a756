// Who may write, from where, and what a job from elsewhere cannot do.

#include "core/access/access.h"

#include <gtest/gtest.h>
#include <stdlib.h>
#include <sys/stat.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/controller/modbus_machine.h"
#include "core/controller/profile.h"

namespace zerodrift::access {
namespace {

class AccessTest : public testing::Test {
 protected:
  AccessTest() {
    std::string pattern = testing::TempDir() + "zd-access-XXXXXX";
    m_folder = ::mkdtemp(pattern.data());
  }
  ~AccessTest() override { std::filesystem::remove_all(m_folder); }
  std::filesystem::path file() const { return m_folder / "deep" / "access.json"; }
  std::string text() const {
    std::ifstream stream(file());
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  Access open() const {
    return Access(file(), [this] { return now_s; });
  }
  double now_s = 1000.0;
  std::filesystem::path m_folder;
};

nlohmann::json profile_document() {
  return {
      {"format", "zerodrift-profile/1"},
      {"name", "VMC"},
      {"controller", {{"kind", "modbus-tcp"}, {"host", "127.0.0.1"}, {"port", 1}}},
      {"cameras",
       {{{"id", "a"}, {"url", "http://ann:s3cret@cam/1"}, {"axes", {"X", "Z"}}, {"target_roi_px", {1, 2, 30, 40}}}}}};
}

ErrorCode code(const Status& status) {
  return status ? ErrorCode::internal : status.error().code;
}

}  // namespace

TEST_F(AccessTest, WithoutAPinEverybodyIsTheEngineer) {
  Access access = open();
  EXPECT_FALSE(access.has_pin());
  EXPECT_EQ(access.role(), Role::engineer);
  ASSERT_TRUE(access.permit("writing"));
  EXPECT_TRUE(access.permit("writing")->may_write());
  now_s += 1e6;
  EXPECT_FALSE(access.lock_when_idle());
  access.lock();
  EXPECT_EQ(access.role(), Role::engineer);
  EXPECT_FALSE(std::filesystem::exists(file()));
}

TEST_F(AccessTest, WithAPinTheOperatorReads) {
  { ASSERT_TRUE(open().set_pin("", "2718281")); }
  EXPECT_EQ(text().find("2718281"), std::string::npos);
  struct stat status {};
  ASSERT_EQ(::stat(file().c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777, 0600U);
  Access access = open();
  EXPECT_TRUE(access.has_pin());
  EXPECT_EQ(access.role(), Role::operator_);
  EXPECT_EQ(access.permit("writing").error().code, ErrorCode::access_locked);
  EXPECT_EQ(code(access.unlock("2718282")), ErrorCode::access_wrong_pin);
  EXPECT_EQ(access.role(), Role::operator_);
  ASSERT_TRUE(access.unlock("2718281"));
  EXPECT_TRUE(access.permit("writing"));
  access.lock();
  EXPECT_FALSE(access.permit("writing"));
  EXPECT_EQ(code(access.set_pin("000000", "111111")), ErrorCode::access_wrong_pin);
  EXPECT_EQ(code(access.set_pin("2718281", "1")), ErrorCode::access_bad_pin);
  ASSERT_TRUE(access.clear_pin("2718281"));
  EXPECT_FALSE(open().has_pin());
}

TEST_F(AccessTest, TwoSaltsOnePin) {
  const auto first = hash_pin("314159");
  const auto second = hash_pin("314159");
  ASSERT_TRUE(first && second);
  EXPECT_NE(first->salt, second->salt);
  EXPECT_NE(first->hash, second->hash);
  EXPECT_TRUE(matches(*first, "314159").value());
  EXPECT_FALSE(matches(*first, "314158").value());
  EXPECT_FALSE(matches(*first, "").value());
}

// RFC 7914, section 12, second vector, first 32 bytes.
TEST_F(AccessTest, HashesAsTheStandardSays) {
  PinHash pin;
  pin.salt = "NaCl";
  pin.cost = 1024;
  pin.parallel = 16;
  const unsigned char expected[] = {0xfd, 0xba, 0xbe, 0x1c, 0x9d, 0x34, 0x72, 0x00, 0x78, 0x56, 0xe7,
                                    0x19, 0x0d, 0x01, 0xe9, 0xfe, 0x7c, 0x6a, 0xd7, 0xcb, 0xc8, 0x23,
                                    0x78, 0x30, 0xe7, 0x73, 0x76, 0x63, 0x4b, 0x37, 0x31, 0x62};
  pin.hash.assign(reinterpret_cast<const char*>(expected), sizeof expected);
  EXPECT_TRUE(matches(pin, "password").value());
}

TEST_F(AccessTest, LocksAfterIdleAndNotBefore) {
  Access access = open();
  ASSERT_TRUE(access.set_pin("", "314159"));
  now_s += default_idle_lock_s - 1.0;
  EXPECT_FALSE(access.lock_when_idle());
  access.touch();
  now_s += default_idle_lock_s - 1.0;
  EXPECT_FALSE(access.lock_when_idle());
  const auto held = access.permit("a long write");
  now_s += 2.0;
  EXPECT_TRUE(access.lock_when_idle());
  EXPECT_FALSE(access.lock_when_idle());
  EXPECT_EQ(access.role(), Role::operator_);
  EXPECT_TRUE(held->may_write());  // what has begun is finished
}

TEST_F(AccessTest, GuessingGetsSlower) {
  Access access = open();
  ASSERT_TRUE(access.set_pin("", "314159"));
  access.lock();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(code(access.unlock("000000")), ErrorCode::access_wrong_pin);
  EXPECT_EQ(code(access.unlock("314159")), ErrorCode::access_wait);
  now_s += 5.1;
  EXPECT_EQ(code(access.unlock("000000")), ErrorCode::access_wrong_pin);
  now_s += 5.1;
  EXPECT_EQ(code(access.unlock("314159")), ErrorCode::access_wait);
  now_s += 5.0;
  EXPECT_TRUE(access.unlock("314159"));
}

TEST_F(AccessTest, AFileThatCannotBeReadLocks) {
  { ASSERT_TRUE(open().set_pin("", "314159")); }
  for (const char* bytes : {"", "{", "{\"format\":\"zerodrift-access/1\",\"pin\":{}}",
                            "{\"format\":\"zerodrift-access/1\",\"pin\":{\"kdf\":\"scrypt\",\"n\":1073741824}}"}) {
    std::ofstream(file(), std::ios::trunc) << bytes;
    Access access = open();
    EXPECT_TRUE(access.has_pin()) << bytes;
    EXPECT_FALSE(access.permit("writing")) << bytes;
    EXPECT_FALSE(access.unlock("314159")) << bytes;
    EXPECT_FALSE(access.set_pin("", "271828")) << bytes;
  }
}

TEST_F(AccessTest, WithoutAPermitNoByteIsWritten) {
  controller::Profile profile;
  profile.controller.port = 1;  // nobody there: a request would be machine_unreachable
  auto machine = controller::ModbusMachine::open(profile);
  ASSERT_TRUE(machine);
  EXPECT_EQ(code((*machine)->command(100.0, false, false)), ErrorCode::access_locked);
  EXPECT_EQ(code((*machine)->switch_compensation(true)), ErrorCode::access_locked);
  EXPECT_EQ(code((*machine)->write_words("table_staging", 0, std::vector<std::uint16_t>(4))), ErrorCode::access_locked);
  EXPECT_EQ(code((*machine)->set_watchdog(5.0)), ErrorCode::access_locked);
  EXPECT_EQ((*machine)->health().requests, 0);
}

TEST(JobFromElsewhere, NamesNoFile) {
  auto document = profile_document();
  ASSERT_TRUE(controller::profile_from_job(document));
  document["machine"] = "/etc/hostname";
  EXPECT_EQ(controller::profile_from_job(document).error().code, ErrorCode::job_reaches_out);
  document.erase("machine");
  for (const char* map : {"/etc/hostname", "../map.json", "map.json", "..", "a\\b"}) {
    document["controller"]["register_map"] = map;
    EXPECT_EQ(controller::profile_from_job(document).error().code, ErrorCode::job_reaches_out) << map;
  }
  document["controller"].erase("register_map");
  for (const char* url : {"file:///etc/passwd", "/home/ann/film.mp4", "concat:a|b", "/dev/video0/../../etc/passwd",
                          "subfile,,start,0,end,9,,:/etc/passwd"}) {
    document["cameras"][0]["url"] = url;
    EXPECT_EQ(controller::profile_from_job(document).error().code, ErrorCode::job_reaches_out) << url;
  }
  document["cameras"][0]["url"] = "";
  EXPECT_EQ(controller::profile_from_job(document).error().code, ErrorCode::json_missing_key);
}

TEST(JobFromElsewhere, AMapOfTheSameNameBesideIsNotRead) {
  std::string pattern = testing::TempDir() + "zd-beside-XXXXXX";
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder);
  std::ofstream(folder / "zerodrift-virtual") << "{}";
  const auto profile = controller::profile_from_job(profile_document());
  const bool opened = profile && controller::map_of(*profile).has_value();
  std::filesystem::current_path(before);
  std::filesystem::remove_all(folder);
  EXPECT_TRUE(opened);
}

TEST(JobFromElsewhere, KeepsWhatItNeedsAndNoPassword) {
  std::string pattern = testing::TempDir() + "zd-kept-XXXXXX";
  const std::filesystem::path folder = ::mkdtemp(pattern.data());
  const auto shipped = controller::load_register_map("zerodrift-virtual");
  ASSERT_TRUE(shipped);
  ASSERT_TRUE(write_json_file(folder / "own.json", controller::to_json(*shipped)));
  auto document = profile_document();
  document["machine"] = "machine.json";
  document["controller"]["register_map"] = "own.json";
  ASSERT_TRUE(write_json_file(folder / "machine.json", {{"name", "VMC"}}));
  ASSERT_TRUE(write_json_file(folder / "profile.json", document));
  const auto profile = controller::read_profile(folder / "profile.json");
  ASSERT_TRUE(profile) << describe(profile.error());
  const auto kept = controller::document_for_job(document, *profile);
  std::filesystem::remove_all(folder);
  ASSERT_TRUE(kept) << describe(kept.error());
  EXPECT_EQ(kept->dump().find("s3cret"), std::string::npos);
  const auto again = controller::profile_from_job(*kept);
  ASSERT_TRUE(again) << describe(again.error());
  ASSERT_TRUE(again->machine);
  EXPECT_EQ(again->machine->at("name"), "VMC");
  const auto map = controller::map_of(*again);
  ASSERT_TRUE(map) << describe(map.error());
  EXPECT_EQ(map->registers.size(), shipped->registers.size());
}

}  // namespace zerodrift::access
