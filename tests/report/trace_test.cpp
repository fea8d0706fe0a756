// Every figure can be traced to what stands in the job, and no zero has a sign.

#include <gtest/gtest.h>

#include <cmath>

#include "core/report/build.h"
#include "core/report/find_figure.h"
#include "core/report/uncertainty.h"
#include "tests/report/rich_job.h"

namespace zerodrift::report {

TEST(ReportTrace, EveryFigureLeadsToItsArtefactAndRows) {
  RichJob rich({"VMC", "17", "", "A. Keller", ""});
  const auto report = build_report(rich.job());
  ASSERT_TRUE(report.has_value()) << describe(report.error());
  std::set<std::string> ids;
  int stored = 0;
  int with_rows = 0;
  for (const auto& figure : all_figures(*report)) {
    EXPECT_TRUE(ids.insert(figure.id).second) << "twice: " << figure.id;
    EXPECT_GT(figure.trace.id, 0) << figure.id;
    EXPECT_FALSE(figure.trace.artefact.empty()) << figure.id;
    const auto origin = origin_of(rich.job(), figure);
    ASSERT_TRUE(origin.has_value()) << figure.id;
    EXPECT_FALSE(origin->at("content_hash").get<std::string>().empty());
    if (!figure.trace.pointer.empty()) {
      ++stored;
      EXPECT_TRUE(figure.value == "-" || !origin->at("stored").is_null()) << figure.id << " " << figure.trace.pointer;
    }
    for (const auto& row : figure.trace.rows) {
      ++with_rows;
      const auto run = rich.job().read_series(row.series);
      ASSERT_TRUE(run.has_value()) << figure.id;
      const auto* channel = run->find(row.channel);
      ASSERT_NE(channel, nullptr) << figure.id << " " << row.channel;
      EXPECT_DOUBLE_EQ(channel->values.at(static_cast<std::size_t>(row.row)), row.value) << figure.id;
      EXPECT_DOUBLE_EQ(run->time_s.at(static_cast<std::size_t>(row.row)), row.time_s) << figure.id;
    }
    EXPECT_NE(origin_in_words(*origin).find(figure.id), std::string::npos);
  }
  EXPECT_GT(stored, 100);
  EXPECT_GT(with_rows, 20);
}

TEST(ReportTrace, TheShownValueIsTheStoredOne) {
  RichJob rich({"VMC", "17", "", "A. Keller", ""});
  const auto report = build_report(rich.job());
  ASSERT_TRUE(report.has_value());
  int compared = 0;
  for (const auto& figure : all_figures(*report)) {
    const auto origin = origin_of(rich.job(), figure).value();
    if (!origin.contains("stored") || !origin.at("stored").is_number()) continue;
    char* end = nullptr;
    const double shown = std::strtod(figure.value.c_str(), &end);
    if (end == figure.value.c_str() || *end != '\0') continue;
    const std::size_t point = figure.value.find('.');
    const auto digits = point == std::string::npos ? 0 : static_cast<int>(figure.value.size() - point) - 1;
    const double stored = origin.at("stored").get<double>();
    // Percent of shares and µm of mm; "made worse" turns the sign.
    bool same = false;
    for (const double factor : {1.0, 100.0, 1000.0, -1.0}) {
      same = same || std::abs(factor * stored - shown) <= 0.5001 * std::pow(10.0, -digits);
    }
    EXPECT_TRUE(same) << figure.id << ": " << figure.value << " against " << stored;
    ++compared;
  }
  EXPECT_GT(compared, 60);
}

TEST(ReportTrace, NoZeroHasASign) {
  EXPECT_EQ(shown(-0.04, 1), "0.0");
  EXPECT_EQ(shown(-0.4, 0), "0");
  EXPECT_EQ(shown(-0.06, 1), "-0.1");
  EXPECT_EQ(readable("moved by -0.00 um and -0.02 um", {}), "moved by 0.00 µm and -0.02 µm");
  RichJob rich({"VMC", "17", "", "", ""});
  for (const auto language : {Language::english, Language::chinese}) {
    const auto report = build_report(rich.job(), language).value();
    for (const auto& section : report.sections) {
      for (const auto& block : section.blocks) {
        const auto* table = std::get_if<Table>(&block);
        for (std::size_t r = 0; table != nullptr && r < table->rows.size(); ++r) {
          for (const auto& cell : table->rows[r]) {
            EXPECT_EQ(cell.text.find("-0.00 "), std::string::npos) << cell.text;
            EXPECT_NE(cell.text, "-0.0");
            EXPECT_NE(cell.text, "-0.000");
          }
        }
      }
    }
  }
}

TEST(ReportTrace, TheBudgetAddsUp) {
  RichJob rich({"VMC", "17", "", "", ""});
  const auto source = Source::load(rich.job(), {});
  ASSERT_TRUE(source.has_value());
  const auto budget = budget_of_measurement(*source);
  std::set<std::string> parts;
  for (const auto& part : budget.parts) parts.insert(part.id);
  for (const char* wanted : {"camera", "calibration", "axes", "camera_drift", "expansion", "holder_temperature"}) {
    EXPECT_TRUE(parts.contains(wanted)) << wanted;
  }
  double squares = 0.0;
  for (const auto& part : budget.parts) squares += std::pow(part.u_um.count("Z") != 0 ? part.u_um.at("Z") : 0.0, 2);
  EXPECT_NEAR(budget.combined_um().at("Z"), std::sqrt(squares), 1e-12);
  // 22 nm at the start; a scale known to 0.02 % of some 57 µm; aluminium 100 mm and a room that changed by 1 K.
  const auto u = [&](const char* id) {
    for (const auto& part : budget.parts) {
      if (part.id == id) return part.u_um.at("Z");
    }
    return std::nan("");
  };
  EXPECT_NEAR(u("camera"), 0.022, 1e-9);
  EXPECT_NEAR(u("calibration"), 0.0024 / 12.0 * 60.0 * (1.0 - std::exp(-3.0)), 1e-9);
  EXPECT_NEAR(u("camera_drift"), 2.3 / std::sqrt(3.0), 1e-6);
  const auto after = budget_of_compensation(*source);
  ASSERT_EQ(after.parts.size(), 3u);
  EXPECT_GT(after.combined_um().at("Z"), budget.combined_um().at("Z"));
}

/// What of the cameras' own drift remains possible, without a mark, with one, with two.
TEST(ReportTrace, WhatTheReferenceMarksLeaveIsSaid) {
  const auto said = [](const nlohmann::json& marks, const char* takes_off, std::set<std::string>& parts) {
    RichJob rich({"VMC", "17", "", "A. Keller", ""});
    const auto kept = rich.job().latest("calibration").value();
    nlohmann::json body = kept->document().value();
    body["reference_target"] = !marks.is_null();
    for (auto& camera : body["cameras"]) {
      camera["roi"] = {240, 160, 160, 160};
      if (!marks.is_null()) camera["reference_roi"] = marks;
      if (takes_off != nullptr) camera["takes_off"] = takes_off;
    }
    rich.put("calibration", body);
    for (const auto& part : budget_of_measurement(*Source::load(rich.job(), {})).parts) {
      parts.insert(part.id);
      if (part.id != "camera_turn") continue;
      // 1 in 10 000 of 220 and 120 px of 12 um; of 120 px from the middle of two.
      const double mm = marks.front().is_array() ? 1.44 : 3.007;
      EXPECT_NEAR(part.u_um.at("Z"), 0.1 * mm / std::sqrt(3.0), 1e-3);
    }
    std::string all;
    const auto report = build_report(rich.job()).value();
    for (const auto& section : report.sections) {
      for (const auto& block : section.blocks) {
        if (const auto* text = std::get_if<Text>(&block)) all += text->text + "\n";
      }
    }
    return all;
  };
  std::set<std::string> none, one, two, close;
  EXPECT_NE(said(nullptr, nullptr, none).find("no fixed reference target"), std::string::npos);
  EXPECT_TRUE(none.contains("camera_drift") && !none.contains("camera_turn"));
  const std::string shift = said({40, 300, 120, 120}, nullptr, one);
  EXPECT_NE(shift.find("remains possible: 0.30 µm for 0.1 mrad or 1 in 10 000, over the 3.0 mm"), std::string::npos)
      << shift;
  EXPECT_TRUE(!one.contains("camera_drift") && one.contains("camera_turn"));
  const auto pair = nlohmann::json::array({{40, 300, 120, 120}, {480, 300, 120, 120}});
  EXPECT_NE(said(pair, "turn", two).find("shifts, turns and changes its scale"), std::string::npos);
  EXPECT_TRUE(!two.contains("camera_drift") && !two.contains("camera_turn"));
  EXPECT_NE(said(pair, "shift", close).find("That it turns or changes its scale remains"), std::string::npos);
  EXPECT_TRUE(close.contains("camera_turn"));
}

TEST(ReportTrace, WhoDidItIsAskedFor) {
  RichJob nobody({"VMC", "17", "", "", ""});
  RichJob somebody({"VMC", "17", "", "A. Keller", ""});
  const auto says = [](RichJob& rich) {
    const auto report = build_report(rich.job()).value();
    std::string all;
    for (const auto& section : report.sections) {
      for (const auto& block : section.blocks) {
        if (const auto* text = std::get_if<Text>(&block)) all += text->text + "\n";
      }
    }
    for (const auto& [name, value] : report.header) all += name + "=" + value + "\n";
    return all;
  };
  EXPECT_NE(says(nobody).find("Nobody is named as the engineer"), std::string::npos);
  EXPECT_NE(says(nobody).find("Engineer=not named"), std::string::npos);
  EXPECT_EQ(says(somebody).find("Nobody is named"), std::string::npos);
  EXPECT_NE(says(somebody).find("Engineer=A. Keller"), std::string::npos);
}

// Two places over three times, as the search found them.
TEST(HeatMapOfReport, HasARowAPosition) {
  RichJob rich({"VMC", "17", "", "A. Keller", ""});
  const auto report = build_report(rich.job());
  ASSERT_TRUE(report) << describe(report.error());
  const HeatMap* map = nullptr;
  for (const Section& section : report->sections) {
    for (const auto& block : section.blocks) {
      if (std::holds_alternative<HeatMap>(block)) map = &std::get<HeatMap>(block);
    }
  }
  ASSERT_NE(map, nullptr);
  const std::vector<std::vector<double>> expected{{-0.1, 0.2, 0.3}, {0.0, 0.1, -0.4}};
  EXPECT_EQ(map->rows, expected);
}

}  // namespace zerodrift::report
