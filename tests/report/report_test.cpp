#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/report/build.h"
#include "core/report/find_figure.h"

namespace zerodrift::report {
namespace {

using commissioning::Job;
using commissioning::NewArtefact;

class ReportTest : public testing::Test {
 protected:
  void SetUp() override {
    m_folder = std::filesystem::path(testing::TempDir()) / ("zd_report_" + std::to_string(::getpid()));
    std::filesystem::remove_all(m_folder);
    std::filesystem::create_directories(m_folder);
    m_job = std::make_unique<Job>(Job::create(m_folder / "a.zdj", {"VMC <3>", "17", "", "A. Keller", ""}).value());
  }
  void TearDown() override {
    m_job.reset();
    std::filesystem::remove_all(m_folder);
  }
  commissioning::SeriesId record(double scale) {
    const auto series = m_job->start_series("warm-up", {"spindle_rpm", "T1_C", "dZ_um"}).value();
    for (int i = 0; i < 100; ++i) {
      const std::vector<double> row = {3000.0, 20.0 + 0.1 * i, scale * i};
      EXPECT_TRUE(m_job->append(series, 60.0 * i, row).has_value());
    }
    EXPECT_TRUE(m_job->flush().has_value());
    EXPECT_TRUE(m_job->finish_series(series).has_value());
    return series;
  }
  void commission(double after_um, const char* verdict) {
    ASSERT_TRUE(m_job->put(NewArtefact::of("warmup", {{"series", record(0.6)}})).has_value());
    ASSERT_TRUE(m_job
                    ->put(NewArtefact::of("verification", {{"series", record(0.02)},
                                                           {"peak_error_before_um", {{"Z", 59.4}}},
                                                           {"peak_error_after_um", {{"Z", after_um}}},
                                                           {"rms_error_after_um", {{"Z", 1.04}}},
                                                           {"removed_percent", {{"Z", 96.7}}},
                                                           {"limit_um", 5.0},
                                                           {"verdict", verdict}}))
                    .has_value());
  }

  std::filesystem::path m_folder;
  std::unique_ptr<Job> m_job;
};

}  // namespace

TEST_F(ReportTest, AnEmptyJobSaysThatNothingWasVerified) {
  const auto report = build_report(*m_job);
  ASSERT_TRUE(report.has_value()) << describe(report.error());
  ASSERT_FALSE(report->sections.empty());
  EXPECT_EQ(report->sections.front().id, "summary");
  EXPECT_TRUE(std::get<Text>(report->sections.front().blocks.front()).warning);
}

TEST_F(ReportTest, FiguresAreTheJobs) {
  commission(1.96, "passed");
  const auto report = build_report(*m_job);
  ASSERT_TRUE(report.has_value());
  const auto after = find_figure(*report, "peak_after_Z_um");
  ASSERT_TRUE(after.has_value());
  EXPECT_EQ(after->value, "2.0");
  EXPECT_EQ(after->unit, "um");
  EXPECT_EQ(after->verdict, Verdict::good);
  EXPECT_EQ(after->trace.artefact, "verification");
  EXPECT_EQ(after->trace.id, m_job->latest("verification").value()->id);
  EXPECT_EQ(find_figure(*report, "range_total_Z_um")->value, "59.4");
  EXPECT_EQ(find_figure(*report, "range_60min_Z_um")->value, "36.0");
  EXPECT_FALSE(find_figure(*report, "nonsense").has_value());
}

TEST_F(ReportTest, TooMuchLeftIsBadInWordsAndColour) {
  commission(7.3, "failed");
  const auto report = build_report(*m_job);
  ASSERT_TRUE(report.has_value());
  EXPECT_EQ(find_figure(*report, "peak_after_Z_um")->verdict, Verdict::bad);
  EXPECT_TRUE(std::get<Text>(report->sections.front().blocks.front()).warning);
}

}  // namespace zerodrift::report
