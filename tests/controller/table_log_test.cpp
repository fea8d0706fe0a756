// The log of a machine's tables: what its lines tell, whatever befell them, and what one goes back to.

#include "core/controller/table_log.h"

#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/base/file.h"
#include "core/controller/table_history.h"
#include "core/controller/table_words.h"
#include "tests/support/own_folder.h"

namespace zerodrift::controller {
namespace {

using Words = std::vector<std::uint16_t>;

const Words empty_table = {1, 0};

Words words_of(int content) {
  return {1, 1, static_cast<std::uint16_t>(content)};
}

TableEntry entry_of(int version, int content, TableOrigin origin = TableOrigin::upload) {
  TableEntry entry;
  entry.version = version;
  entry.origin = origin;
  entry.words = words_of(content);
  entry.crc = crc_of_words(*entry.words);
  entry.who = "ann";
  return entry;
}

ActiveTable active_of(int version, int content) {
  return {words_of(content), version, crc_of_words(words_of(content))};
}

class TableHistoryTest : public testing::Test {
 protected:
  TableHistoryTest() {
    std::filesystem::remove_all(folder);
    history = TableHistory(folder);
  }
  ~TableHistoryTest() override { std::filesystem::remove_all(folder); }

  /// Written, and it ended well.
  TableEntry written(TableEntry entry) {
    EXPECT_TRUE(history.begin(5, entry));
    EXPECT_TRUE(history.end(5, entry.id, true));
    return entry;
  }
  std::vector<int> versions() {
    std::vector<int> all;
    const auto log = history.read(5);
    EXPECT_TRUE(log) << describe(log.error());
    for (const auto& entry : log->entries) all.push_back(entry.version);
    return all;
  }
  /// The version one goes back to by default; -1: none.
  int before() {
    const auto log = history.read(5);
    const TableEntry* entry = before_last(*log);
    return entry == nullptr ? -1 : entry->version;
  }
  std::filesystem::path file() const { return folder / "tables-5.jsonl"; }

  const std::filesystem::path folder = own_folder("zd_tables");
  TableHistory history;
};

}  // namespace

TEST_F(TableHistoryTest, KeepsEverythingInItsOrder) {
  EXPECT_TRUE(history.read(5)->entries.empty());
  for (int version = 1; version <= 200; ++version) written(entry_of(version, version));
  const auto log = history.read(5);
  ASSERT_EQ(log->entries.size(), 200U);
  EXPECT_EQ(log->entries.front().words, words_of(1));
  EXPECT_EQ(log->entries.back().words, words_of(200));
  EXPECT_EQ(log->entries.back().who, "ann");
  EXPECT_EQ(log->entries.back().time.size(), std::string("2026-01-01T00:00:00.000Z").size());
  EXPECT_LE(log->entries.front().time, log->entries.back().time);
  EXPECT_TRUE(history.read(6)->entries.empty());
}

// What is in the file is never changed: each write only makes it longer.
TEST_F(TableHistoryTest, OnlyEverAdds) {
  std::string before;
  const auto grew = [&] {
    const std::string now = read_file(file()).value();
    const bool longer = now.size() > before.size() && now.compare(0, before.size(), before) == 0;
    before = now;
    return longer;
  };
  TableEntry first = written(entry_of(1, 1));
  EXPECT_TRUE(grew());
  TableEntry failed = entry_of(2, 2);
  ASSERT_TRUE(history.begin(5, failed));
  ASSERT_TRUE(history.end(5, failed.id, false));
  EXPECT_TRUE(grew());
  TableEntry back = entry_of(3, 1, TableOrigin::rollback);
  back.of = first.id;
  written(back);
  EXPECT_TRUE(grew());
  ASSERT_TRUE(history.note_active(5, active_of(9, 9)));
  EXPECT_TRUE(grew());
  EXPECT_EQ(versions(), (std::vector<int>{1, 3, 9}));
}

TEST_F(TableHistoryTest, GoingBackTwiceIsTwoTablesBack) {
  const auto one = written(entry_of(1, 1));
  const auto two = written(entry_of(2, 2));
  written(entry_of(3, 3));
  EXPECT_EQ(before(), 2);
  TableEntry back = entry_of(4, 2, TableOrigin::rollback);
  back.of = two.id;
  back = written(back);
  EXPECT_EQ(before(), 1);
  TableEntry again = entry_of(5, 1, TableOrigin::rollback);
  again.of = one.id;
  written(again);
  EXPECT_EQ(before(), -1);
  written(entry_of(6, 6));
  EXPECT_EQ(before(), 5);
  EXPECT_EQ(versions(), (std::vector<int>{1, 2, 3, 4, 5, 6}));
}

TEST_F(TableHistoryTest, WhatComesFromElsewhereIsNotedButNotGuessedAt) {
  written(entry_of(1, 1));
  written(entry_of(2, 2));
  auto log = history.note_active(5, active_of(7, 7));
  ASSERT_TRUE(log);
  EXPECT_EQ(log->entries.back().origin, TableOrigin::found);
  EXPECT_EQ(before(), -1);
  ASSERT_TRUE(history.note_active(5, active_of(7, 7)));  // looked at again: nothing new
  EXPECT_EQ(versions(), (std::vector<int>{1, 2, 7}));
  written(entry_of(8, 8));
  EXPECT_EQ(before(), 7);
  // The same table under another number, after a restart of the controller for example: that is no stranger.
  ASSERT_TRUE(history.note_active(5, active_of(0, 8)));
  EXPECT_EQ(before(), 7);
}

// The program died between writing and noting how it ended: the machine tells.
TEST_F(TableHistoryTest, TheMachineSettlesWhatNobodySaw) {
  written(entry_of(1, 1));
  TableEntry open = entry_of(2, 2);
  ASSERT_TRUE(history.begin(5, open));
  EXPECT_TRUE(history.read(5)->entries.back().unsettled);
  ASSERT_TRUE(history.note_active(5, active_of(1, 1)));
  EXPECT_EQ(versions(), (std::vector<int>{1}));
  ASSERT_TRUE(history.begin(5, open));
  const auto log = history.note_active(5, active_of(2, 2));
  EXPECT_EQ(log->entries.back().origin, TableOrigin::upload);
  EXPECT_FALSE(history.read(5)->entries.back().unsettled);
  EXPECT_EQ(versions(), (std::vector<int>{1, 2}));
  // Another program looks while one is being written, and settles it wrongly: the writer has the last word.
  TableEntry slow = entry_of(3, 3);
  ASSERT_TRUE(history.begin(5, slow));
  ASSERT_TRUE(history.note_active(5, active_of(2, 2)));
  ASSERT_TRUE(history.end(5, slow.id, true));
  EXPECT_EQ(versions(), (std::vector<int>{1, 2, 3}));
}

TEST_F(TableHistoryTest, ATornLineTakesNothingWithIt) {
  written(entry_of(1, 1));
  written(entry_of(2, 2));
  {
    std::ofstream torn(file(), std::ios::app);
    torn << R"({"line":"begin","table":{"id":"x","ver)";
  }
  written(entry_of(3, 3));
  EXPECT_EQ(versions(), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(history.read(5)->damaged_lines, 1);
  std::ofstream(file(), std::ios::trunc) << R"({"line":"head","format":"zerodrift-table-history/3"})" << '\n';
  ASSERT_FALSE(history.read(5));
  EXPECT_EQ(history.read(5).error().code, ErrorCode::wrong_format);
}

// The first format said of each former table when, and by whom, it was replaced, and by which check sum.
TEST_F(TableHistoryTest, AStackOfTheFirstFormatLosesNothing) {
  std::filesystem::create_directories(folder);
  const nlohmann::json stack = {{"format", "zerodrift-table-history/1"},
                                {"serial", 5},
                                {"tables",
                                 {{{"time", "2026-01-01T08:00:00.000Z"},
                                   {"who", "ann"},
                                   {"sequence", 0},
                                   {"words", empty_table},
                                   {"replaced_by_crc", crc_of_words(words_of(1))}},
                                  {{"time", "2026-01-02T08:00:00.000Z"},
                                   {"who", "ben"},
                                   {"sequence", 1},
                                   {"words", words_of(1)},
                                   {"replaced_by_crc", crc_of_words(words_of(2))}}}}};
  ASSERT_TRUE(write_file(folder / "tables-5.json", stack.dump()));
  EXPECT_EQ(versions(), (std::vector<int>{0, 1, 2}));
  EXPECT_FALSE(history.read(5)->entries.back().words);
  ASSERT_TRUE(history.note_active(5, active_of(4, 2)));  // there were rollbacks in between: it is version 4
  const auto log = history.read(5);
  ASSERT_EQ(log->entries.size(), 3U);
  EXPECT_EQ(log->entries[0].time, "");
  EXPECT_EQ(log->entries[1].time, "2026-01-01T08:00:00.000Z");
  EXPECT_EQ(log->entries[1].who, "ann");
  EXPECT_EQ(log->entries[2].time, "2026-01-02T08:00:00.000Z");
  EXPECT_EQ(log->entries[2].who, "ben");
  EXPECT_EQ(log->entries[2].version, 4);
  EXPECT_EQ(log->entries[2].words, words_of(2));
  EXPECT_EQ(before(), 1);
  EXPECT_TRUE(std::filesystem::exists(folder / "tables-5.json"));
}

TEST_F(TableHistoryTest, AdoptsWhatAnotherKeeperHas) {
  const auto own = written(entry_of(2, 2));
  TableEntry earlier = entry_of(1, 1);
  earlier.id = "job-1";
  earlier.time = "2001-01-01T00:00:00.000Z";
  TableEntry same = own;
  same.id = "job-2";
  ASSERT_TRUE(history.adopt(5, {earlier, same}));
  ASSERT_TRUE(history.adopt(5, {earlier, same}));
  EXPECT_EQ(versions(), (std::vector<int>{1, 2}));
  EXPECT_EQ(before(), 1);
}

}  // namespace zerodrift::controller
