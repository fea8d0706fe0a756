#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "core/report/build.h"
#include "core/report/comparison.h"
#include "core/report/find_figure.h"
#include "core/report/promise.h"

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
  EXPECT_EQ(after->unit, "µm");
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

/// The first page speaks of the last verification: that it was not the first, and whether the fit kept its word.
TEST_F(ReportTest, TheFirstPageSaysWhatWasPromisedAndHowOftenItWasTried) {
  const auto first_page = [&] {
    std::string all;
    const auto report = build_report(*m_job);
    EXPECT_TRUE(report.has_value());
    for (const auto& block : report->sections.front().blocks) {
      if (const auto* text = std::get_if<Text>(&block)) all += text->text + "\n";
    }
    return all;
  };
  const auto model = NewArtefact::of("model", {{"figures", {{{"channel", "dZ_um"}, {"peak_held_out_um", 2.0}}}}});
  ASSERT_TRUE(m_job->put(model).has_value());
  commission(6.5, "failed");
  EXPECT_NE(first_page().find("promised at most 2.0 µm; measured are 6.5 µm: not reached"), std::string::npos)
      << first_page();
  EXPECT_EQ(first_page().find("These figures are of verification"), std::string::npos);
  commission(2.4, "passed");
  EXPECT_NE(first_page().find("promised at most 2.0 µm; measured are 2.4 µm: held"), std::string::npos) << first_page();
  EXPECT_NE(first_page().find("verification 2 of this job; the first one left at most 6.5 µm (failed)"),
            std::string::npos)
      << first_page();
}

/// Rail, page and report judge by the same.
TEST(Promise, IsHeldWithinItsReachAndBrokenBeyond) {
  const nlohmann::json model = {{"figures", {{{"peak_held_out_um", 2.0}}, {{"peak_held_out_um", 1.1}}}}};
  const auto left = [](double z_um) { return nlohmann::json{{"peak_error_after_um", {{"X", 0.4}, {"Z", z_um}}}}; };
  EXPECT_TRUE(promise_of(model, left(2.4)).held());
  EXPECT_FALSE(promise_of(model, left(2.6)).held());
  EXPECT_EQ(promise_of(model, left(2.6)).left_um, 2.6);
  EXPECT_FALSE(promise_of({}, left(2.6)).known());
  EXPECT_TRUE(promise_of({}, left(2.6)).held());
  // X was small before: that little of it is gone is no shortfall.
  const nlohmann::json verification = {{"limit_um", 5.0},
                                       {"peak_error_before_um", {{"X", 3.0}, {"Y", 12.0}, {"Z", 44.0}}},
                                       {"removed_percent", {{"X", 10.0}, {"Y", 84.7}, {"Z", 96.0}}}};
  EXPECT_EQ(least_removed_percent(verification), 84.0);
  EXPECT_TRUE(std::isnan(least_removed_percent({})));
}

/// What was red on a page is in the report, in words, and counted on its first page.
TEST_F(ReportTest, WhatWasDoubtfulIsListed) {
  const auto put = [&](const char* kind, const nlohmann::json& body) {
    ASSERT_TRUE(m_job->put(NewArtefact::of(kind, body)).has_value());
  };
  put("machine", {{"spread_K", 1.43},
                  {"round_trip_ms", 4.0},
                  {"problems", {"sensor T3_C (Column) is dead"}},
                  {"health", {{{"channel", "T3_C"}, {"label", "Column"}}}}});
  put("warmup", {{"series", record(0.6)}, {"rows", 300}, {"lost_samples", 160}, {"refused", 2}, {"measurements", 31}});
  put("sensors",
      {{"condition_number", {{"chosen", 912.0}}}, {"price", {{"held_out_rms_um", 2.4}, {"all_rms_um", 1.6}}}});
  put("model", {{"figures", {{{"channel", "dZ_um"}, {"peak_held_out_um", 7.2}}}}});
  put("verification", {{"series", record(0.02)},
                       {"peak_error_before_um", {{"Y", 4.2}, {"Z", 59.4}}},
                       {"peak_error_after_um", {{"Y", 4.5}, {"Z", 2.0}}},
                       {"removed_percent", {{"Y", -6.9}, {"Z", 96.6}}},
                       {"end_error_before_um", {{"Y", 1.0}, {"Z", 59.0}}},
                       {"end_error_after_um", {{"Y", 0.9}, {"Z", 1.9}}},
                       {"limit_um", 5.0},
                       {"problems",
                        {{{"said", "no_correction"},
                          {"code", "not_enough_data"},
                          {"context", {{"what", "axis Z"}, {"found", "3 measurements"}, {"needed", "at least 6"}}}}}},
                       {"verdict", "passed"}});
  const auto report = build_report(*m_job);
  ASSERT_TRUE(report.has_value()) << describe(report.error());
  std::vector<Text> doubts;
  std::string first_page;
  for (const auto& section : report->sections) {
    for (const auto& block : section.blocks) {
      const auto* text = std::get_if<Text>(&block);
      if (text == nullptr || !text->warning) continue;
      if (section.id == "doubts") doubts.push_back(*text);
      if (section.id == "summary") first_page += text->text;
    }
  }
  const auto said = [&](const char* artefact, const char* words) {
    return std::any_of(doubts.begin(), doubts.end(), [&](const Text& doubt) {
      return doubt.trace.artefact == artefact && doubt.text.find(words) != std::string::npos;
    });
  };
  EXPECT_TRUE(said("machine", "1.43 K"));
  EXPECT_TRUE(said("machine", "T3 Column"));
  EXPECT_TRUE(said("warmup", "160 of 460 samples"));
  EXPECT_TRUE(said("warmup", "2 of 31 measurements"));
  EXPECT_TRUE(said("sensors", "912"));
  EXPECT_TRUE(said("sensors", "50 % lost"));
  EXPECT_TRUE(said("model", "7.2 µm"));
  EXPECT_TRUE(said("verification", "Y became worse"));
  EXPECT_FALSE(said("verification", "Z became worse"));
  EXPECT_TRUE(said("verification", "no correction: too little data: axis Z has 3 measurements, at least 6 needed"));
  EXPECT_EQ(doubts.front().verdict, Verdict::bad);
  EXPECT_NE(first_page.find(std::to_string(doubts.size()) + " points"), std::string::npos) << first_page;
  // A direction that lost is never shown as good, nor as something removed.
  EXPECT_EQ(find_figure(*report, "peak_after_Y_um")->verdict, Verdict::doubtful);
  EXPECT_EQ(find_figure(*report, "peak_after_Z_um")->verdict, Verdict::good);
  const auto worse = find_figure(*report, "removed_Y_percent");
  ASSERT_TRUE(worse.has_value());
  EXPECT_EQ(worse->label, "Made worse, Y");
  EXPECT_EQ(worse->value, "6.9");
  EXPECT_EQ(worse->verdict, Verdict::doubtful);
}

TEST_F(ReportTest, RunsAreComparedAsFarAsBothGo) {
  recording::Recording before;
  recording::Recording after;
  before.ensure("dX_um");
  after.ensure("dX_um");
  for (int i = 0; i <= 100; ++i) {
    before.time_s.push_back(1000.0 + 60.0 * i);  // a run begins at any clock
    before.channels.front().values.push_back(0.5 * i);
    if (i > 60) continue;
    after.time_s.push_back(60.0 * i);
    after.channels.front().values.push_back(i < 50 ? -3.0 : 40.0);
  }
  const auto compared = compare_runs(before, after);
  EXPECT_DOUBLE_EQ(compared.span_s, 3600.0);
  ASSERT_EQ(compared.axes.size(), 1u);
  EXPECT_DOUBLE_EQ(compared.axes[0].before_um, 30.0);  // not 50, which it reached later
  EXPECT_DOUBLE_EQ(compared.axes[0].after_um, 40.0);
  EXPECT_TRUE(compared.axes[0].worse());
  EXPECT_TRUE(compared.axes[0].worse_at_the_end());
  EXPECT_NEAR(compared.axes[0].end_before_um, 28.5, 1e-9);
  EXPECT_NEAR(compared.axes[0].removed_percent, -33.3, 0.1);
}

TEST(Wording, IdentifiersBecomeWords) {
  const Labels labels = {{"T14_C", "Spindle nose"}};
  EXPECT_EQ(readable("T14_C rose by 3 um/K from 21.5 C; dY_um: 2 um", labels),
            "T14 Spindle nose rose by 3 µm/K from 21.5 °C; error in Y: 2 µm");
  EXPECT_EQ(readable("X T17_C", {{"T17_C", "C table drive"}}), "X T17 C table drive");
  EXPECT_EQ(readable("from -3 C to 21.5 C", labels), "from -3 °C to 21.5 °C");
  EXPECT_EQ(readable("T15_C, maximum, C1, Column", labels), "T15, maximum, C1, Column");
  EXPECT_EQ(channel_in_words("ambient_C", labels), "Room");
  // No space between Chinese words, one beside a word of another script.
  EXPECT_EQ(readable("不含时 T14_C 与仿真相差", {{"T14_C", "主轴前端"}}), "不含时 T14 主轴前端与仿真相差");
  EXPECT_EQ(readable("不含时 T14_C 与仿真相差", {}), "不含时 T14 与仿真相差");
}

}  // namespace zerodrift::report
