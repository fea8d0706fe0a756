#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <thread>

#include "core/commissioning/job.h"
#include "core/commissioning/series_codec.h"
#include "core/recording/recording.h"
#include "temporary_folder.h"

namespace zerodrift::commissioning {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();

std::vector<double> sample(int i) {
  return {20.0 + 0.0625 * (i % 37), i % 60 == 0 ? 0.1 * i : missing};
}

void expect_rows(const recording::Recording& r, int count) {
  ASSERT_EQ(r.rows(), std::size_t(count));
  ASSERT_EQ(r.channels.size(), 2u);
  for (int i = 0; i < count; ++i) {
    const auto at = std::size_t(i);
    ASSERT_EQ(r.time_s[at], i * 10.0);
    ASSERT_EQ(r.channels[0].values[at], sample(i)[0]);
    if (i % 60 == 0) {
      ASSERT_EQ(r.channels[1].values[at], 0.1 * i);
    } else {
      ASSERT_TRUE(std::isnan(r.channels[1].values[at]));
    }
  }
}

class Series : public testing::Test {
 protected:
  void SetUp() override {
    job.emplace(Job::create(file, {"", "", "", "Ann", ""}));
    ASSERT_OK(*job);
    const auto id = (*job)->start_series("warm-up", {"T1_C", "dZ_um"}, R"({"plan":"x"})");
    ASSERT_OK(id);
    series = *id;
  }
  void append(int from, int to) {
    for (int i = from; i < to; ++i) ASSERT_OK((*job)->append(series, i * 10.0, sample(i)));
  }
  void reopen() {
    job.reset();
    job.emplace(Job::open(file));
    ASSERT_OK(*job);
  }
  Job& j() { return **job; }

  TemporaryFolder folder;
  std::filesystem::path file = folder / "a.zdj";
  std::optional<Result<Job>> job;
  SeriesId series = 0;
};

TEST_F(Series, ReadsBackWhatWasWritten) {
  append(0, 2500);
  ASSERT_OK(j().flush());
  expect_rows(*j().read_series(series), 2500);
  const auto info = j().series_info(series);
  ASSERT_OK(info);
  EXPECT_EQ(info->rows, 2500);
  EXPECT_EQ(info->name, "warm-up");
  EXPECT_EQ(info->details, R"({"plan":"x"})");
  EXPECT_EQ(info->state, SeriesState::open);
  const auto report = j().check();
  ASSERT_OK(report);
  EXPECT_TRUE(report->ok());
  EXPECT_EQ(report->chunks, 2);
  EXPECT_EQ(report->open_rows, 2500 - 2 * 960);
}

TEST_F(Series, IsTheSameHoweverOftenItIsFlushed) {
  for (int i = 0; i < 2500; i += 7) {
    append(i, std::min(i + 7, 2500));
    ASSERT_OK(j().flush());
  }
  expect_rows(*j().read_series(series), 2500);
  EXPECT_EQ(j().check()->chunks, 2);
}

TEST_F(Series, GoesOnAfterReopening) {
  for (int i = 0; i < 2000; i += 333) {
    append(i, std::min(i + 333, 2000));
    ASSERT_OK(j().flush());
    reopen();
  }
  EXPECT_FALSE(j().append(series, 1999 * 10.0, sample(0)));  // time must go on
  append(2000, 2100);
  ASSERT_OK(j().finish_series(series));
  expect_rows(*j().read_series(series), 2100);
}

TEST_F(Series, IsClosedWithAHash) {
  append(0, 1000);
  ASSERT_OK(j().finish_series(series, SeriesState::aborted));
  const auto info = j().series_info(series);
  EXPECT_EQ(info->state, SeriesState::aborted);
  EXPECT_EQ(info->content_hash.size(), 64u);
  EXPECT_EQ(j().check()->open_rows, 0);
  EXPECT_EQ(code_of(j().append(series, 1e6, sample(0))), ErrorCode::bad_argument);
  expect_rows(*j().read_series(series), 1000);
}

TEST_F(Series, RefusesWrongRows) {
  append(0, 2);
  EXPECT_EQ(code_of(j().append(series, 10.0, sample(0))), ErrorCode::bad_argument);
  EXPECT_EQ(code_of(j().append(series, missing, sample(0))), ErrorCode::bad_argument);
  EXPECT_EQ(code_of(j().append(series, 100.0, std::vector<double>{1.0})), ErrorCode::bad_argument);
  EXPECT_EQ(code_of(j().append(99, 100.0, sample(0))), ErrorCode::bad_argument);
  ASSERT_OK(j().flush());
  expect_rows(*j().read_series(series), 2);
}

TEST_F(Series, HasEventsAndTheRowsBeforeThem) {
  append(0, 3);
  ASSERT_OK(j().add_event(series, {20.0, "note", "door opened", "{}", {}}));
  EXPECT_EQ(j().series_info(series)->rows, 3);
  const auto events = j().events(series);
  ASSERT_OK(events);
  ASSERT_EQ(events->size(), 1u);
  EXPECT_EQ(events->front().text, "door opened");
  EXPECT_EQ(events->front().time_s, 20.0);
  EXPECT_EQ(events->front().utc.size(), 24u);
  EXPECT_FALSE(j().add_event(99, {0.0, "note", "", "{}", {}}));
}

TEST_F(Series, SurvivesABusyDatabase) {
  append(0, 10);
  sqlite3* other = nullptr;
  ASSERT_EQ(sqlite3_open(file.c_str(), &other), SQLITE_OK);
  ASSERT_EQ(sqlite3_exec(other, "BEGIN IMMEDIATE", nullptr, nullptr, nullptr), SQLITE_OK);
  EXPECT_EQ(code_of(j().flush()), ErrorCode::job_busy);
  append(10, 1000);
  sqlite3_close(other);
  ASSERT_OK(j().flush());
  expect_rows(*j().read_series(series), 1000);
}

TEST_F(Series, IsReadWhileItIsWritten) {
  std::thread writer([&] {
    for (int i = 0; i < 3000; ++i) {
      ASSERT_OK(j().append(series, i * 10.0, sample(i)));
      if (i % 100 == 99) {
        ASSERT_OK(j().flush());
      }
    }
  });
  for (int i = 0; i < 50; ++i) {
    const auto r = j().read_series(series);
    ASSERT_OK(r);
    expect_rows(*r, int(r->rows()));
  }
  writer.join();
}

TEST(SeriesCodec, KeepsEveryBit) {
  const std::vector<double> rows = {0.0, -0.0, 1e300, 5e-324, missing, -1.5};
  std::vector<double> back;
  ASSERT_TRUE(decode_chunk(encode_chunk(rows, 2), 3, 2, back));
  ASSERT_EQ(back.size(), rows.size());
  EXPECT_EQ(std::memcmp(back.data(), rows.data(), rows.size() * sizeof(double)), 0);
  EXPECT_FALSE(decode_chunk(encode_chunk(rows, 2), 4, 2, back));
  EXPECT_FALSE(decode_chunk("rubbish", 3, 2, back));
  back.clear();
  ASSERT_TRUE(decode_row(encode_row(rows), 6, back));
  EXPECT_EQ(std::memcmp(back.data(), rows.data(), rows.size() * sizeof(double)), 0);
  EXPECT_FALSE(decode_row("1234567", 1, back));
}

}  // namespace
}  // namespace zerodrift::commissioning
