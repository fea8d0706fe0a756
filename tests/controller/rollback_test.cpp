// Uploads and rollbacks as the window and the command line do them, against a small device: what the log says then.

#include "core/controller/rollback.h"

#include <gtest/gtest.h>

#include "fake_controller.h"
#include "fixtures.h"
#include "tests/support/own_folder.h"

namespace zerodrift::controller {
namespace {

class RollbackTest : public testing::Test {
 protected:
  RollbackTest() {
    std::filesystem::remove_all(folder);
    history = TableHistory(folder);
    machine = open(device.profile());
  }
  ~RollbackTest() override { std::filesystem::remove_all(folder); }

  UploadRecord push(double coefficient) {
    return push_table(*machine, sample_table(coefficient), TableOrigin::upload, {}, {}, history);
  }
  UploadRecord back(const RollbackChoice& choice = {}) {
    const auto target = rollback_target(*machine, choice, history);
    if (target) return roll_back(*machine, *target, {}, {}, history);
    UploadRecord refused;
    refused.result = fail(target.error());
    return refused;
  }
  /// "found 0, upload 1, ..." as the log has it with what the machine holds.
  std::string log() {
    const auto kept = history.read(machine->identify()->serial);
    EXPECT_TRUE(kept) << describe(kept.error());
    std::string text;
    for (const auto& entry : kept->entries) {
      text += (text.empty() ? "" : ", ") + std::string(name_of(entry.origin)) + ' ' + std::to_string(entry.version);
      if (const auto* of = kept->find(entry.of)) text += " of " + std::to_string(of->version);
      if (entry.unsettled) text += "?";
    }
    return text;
  }

  const std::filesystem::path folder = own_folder("zd_rollback");
  FakeController device;
  std::unique_ptr<ModbusMachine> machine;
  TableHistory history;
};

}  // namespace

TEST_F(RollbackTest, EverythingThatWasActiveIsInTheLog) {
  const auto first = push(1.0);
  const auto second = push(2.0);
  ASSERT_TRUE(push_table(*machine, sample_table(3.0), TableOrigin::correction, {}, {}, history).result);
  EXPECT_EQ(log(), "found 0, upload 1, upload 2, correction 3");
  ASSERT_TRUE(back().result);
  EXPECT_EQ(device.active(), second.new_words);
  ASSERT_TRUE(back().result);
  EXPECT_EQ(device.active(), first.new_words);
  ASSERT_TRUE(back().result);  // to no compensation at all
  const auto end = back();
  ASSERT_FALSE(end.result);
  EXPECT_EQ(end.result.error().code, ErrorCode::not_enough_data);
  EXPECT_EQ(log(), "found 0, upload 1, upload 2, correction 3, rollback 4 of 2, rollback 5 of 1, rollback 6 of 0");
}

TEST_F(RollbackTest, AnyVersionCanBeChosen) {
  const auto first = push(1.0);
  ASSERT_TRUE(push(2.0).result);
  const auto third = push(3.0);
  ASSERT_TRUE(back({1, ""}).result);
  EXPECT_EQ(device.active(), first.new_words);
  ASSERT_TRUE(back({3, ""}).result);  // and forward again
  EXPECT_EQ(device.active(), third.new_words);
  const auto none = back({9, ""});
  ASSERT_FALSE(none.result);
  EXPECT_EQ(none.result.error().code, ErrorCode::bad_argument);
  EXPECT_NE(text_of(none.result).find("0, 1, 2, 3, 4"), std::string::npos) << text_of(none.result);
  EXPECT_EQ(log(), "found 0, upload 1, upload 2, upload 3, rollback 4 of 1, rollback 5 of 3");
}

TEST_F(RollbackTest, ADryRunLeavesNoTrace) {
  ASSERT_TRUE(push(1.0).result);
  const auto target = rollback_target(*machine, {}, history);
  ASSERT_TRUE(target) << describe(target.error());
  UploadOptions dry;
  dry.dry_run = true;
  const auto record = roll_back(*machine, *target, dry, {}, history);
  ASSERT_TRUE(record.result) << text_of(record.result);
  EXPECT_GT(record.difference.at(0).largest_um, 3.9);
  EXPECT_EQ(log(), "found 0, upload 1");
}

TEST_F(RollbackTest, AStrangersTableIsNotGuessedPastButMayBeLeft) {
  const auto first = push(1.0);
  ASSERT_TRUE(push(2.0).result);
  const auto seen = rollback_target(*machine, {}, history);
  ASSERT_TRUE(seen);
  const auto strange = upload_table(*machine, sample_table(7.0), {}, {});  // not through the log
  ASSERT_TRUE(strange.result);
  EXPECT_EQ(roll_back(*machine, *seen, {}, {}, history).result.error().code, ErrorCode::data_does_not_fit)
      << "what was agreed to is not what is there any more";
  EXPECT_EQ(back().result.error().code, ErrorCode::data_does_not_fit);
  EXPECT_EQ(device.active(), strange.new_words);
  ASSERT_TRUE(back({1, ""}).result);
  EXPECT_EQ(device.active(), first.new_words);
  EXPECT_EQ(log(), "found 0, upload 1, upload 2, found 3, rollback 4 of 1");
}

// A controller that refuses leaves the old table active: nothing new was ever active. One that takes the table and then
// cannot be switched on gets the old one back, under a new number.
TEST_F(RollbackTest, AFailedUploadIsToldAsItWas) {
  const auto first = push(1.0);
  device.on_write = [&](int address, std::span<const std::uint16_t>) -> std::optional<ModbusException> {
    if (address == 205) device.set_unlocked(17, 1);  // the switch is on at the commit: rejected
    return std::nullopt;
  };
  ASSERT_FALSE(push(2.0).result);
  EXPECT_EQ(log(), "found 0, upload 1");
  int refused = 0;
  device.on_write = [&](int address, std::span<const std::uint16_t> values) -> std::optional<ModbusException> {
    if (address == 76 && values[0] == 1 && refused++ == 0) return ModbusException::illegal_value;
    return std::nullopt;
  };
  const auto failed = push(3.0);
  ASSERT_FALSE(failed.result);
  EXPECT_EQ(failed.reached, UploadState::restored);
  EXPECT_EQ(device.active(), first.new_words);
  ASSERT_TRUE(failed.restored_sequence);
  EXPECT_EQ(log(), "found 0, upload 1, restored " + std::to_string(*failed.restored_sequence) + " of 1");
  const auto kept = history.read(failed.serial);
  EXPECT_NE(kept->entries.back().note.find("version"), std::string::npos);
  device.on_write = nullptr;
  ASSERT_TRUE(back().result);  // before the first: nothing
  EXPECT_LE(device.active().size(), 2U);
}

}  // namespace zerodrift::controller
