// The report in two languages: complete, and the same in every figure.

#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "core/diagnosis/answer/sentences.h"
#include "core/report/build.h"
#include "core/report/find_figure.h"
#include "tests/report/rich_job.h"

namespace zerodrift::report {
namespace {

const std::string literal = R"("(?:[^"\\]|\\.)*")";

/// The literals that stand side by side, as one text.
std::string joined(const std::string& literals) {
  static const std::regex one(R"x("((?:[^"\\]|\\.)*)")x");
  std::string text;
  for (std::sregex_iterator at(literals.begin(), literals.end(), one), end; at != end; ++at) text += (*at)[1].str();
  return std::regex_replace(text, std::regex(R"(\\")"), "\"");
}

std::multiset<std::string> all_of(const std::string& text, const char* pattern) {
  const std::regex expression(pattern);
  std::multiset<std::string> found;
  for (std::sregex_iterator at(text.begin(), text.end(), expression), end; at != end; ++at) found.insert(at->str());
  return found;
}

/// Every text of a report with the place it stands at.
std::vector<std::pair<std::string, std::string>> texts_of(const Report& report) {
  std::vector<std::pair<std::string, std::string>> all = {
      {"title", report.title}, {"contents", report.contents}, {"origins", report.origins}, {"foot", report.provenance}};
  for (const auto& [name, value] : report.header) all.emplace_back("header", name);
  for (const auto& section : report.sections) {
    all.emplace_back(section.id, section.title);
    const auto add = [&](const std::string& text) { all.emplace_back(section.id, text); };
    for (const auto& block : section.blocks) {
      if (const auto* text = std::get_if<Text>(&block)) add(text->text);
      if (const auto* figures = std::get_if<Figures>(&block)) {
        for (const auto& f : figures->figures) {
          add(f.label);
          add(f.limit);
        }
      }
      if (const auto* table = std::get_if<Table>(&block)) {
        add(table->title);
        for (const auto& cell : table->header) add(cell);
        for (const auto& row : table->rows) {
          for (const auto& cell : row) add(cell.text);
        }
      }
      if (const auto* plot = std::get_if<Plot>(&block)) {
        add(plot->title);
        add(plot->x_label);
        add(plot->y_label);
        for (const auto& curve : plot->curves) add(curve.name);
        for (const auto& stretch : plot->stretches) add(stretch.text);
      }
      if (const auto* map = std::get_if<HeatMap>(&block)) {
        add(map->title);
        add(map->x_label);
        add(map->y_label);
      }
    }
  }
  return all;
}

Report built(RichJob& rich, Language language) {
  auto report = build_report(rich.job(), language);
  EXPECT_TRUE(report.has_value()) << describe(report.error());
  return std::move(*report);
}

/// Of the machine, the cameras and the disk: what may happen in a run stands in its report.
std::vector<std::string> names_of_errors_in_a_run() {
  std::ifstream codes(std::string(ZERODRIFT_SOURCE_DIR) + "/core/base/error_codes.inc");
  static const std::regex code(R"(ZERODRIFT_ERROR\((\w+),)");
  std::vector<std::string> names;
  bool of_a_run = false;
  for (std::string line; std::getline(codes, line);) {
    if (line.starts_with("// ")) of_a_run = line == "// images and camera" || line == "// machine";
    std::smatch found;
    if (!of_a_run || !std::regex_search(line, found, code)) continue;
    names.push_back(std::regex_replace(found[1].str(), std::regex("_"), " "));
  }
  EXPECT_GT(names.size(), 40u);
  return names;
}

}  // namespace

TEST(ReportLanguage, EveryTextOfTheSourcesIsInTheCatalogue) {
  const std::regex said("(?:say|tell)\\(\\s*((?:" + literal + "\\s*)+)");
  int count = 0;
  for (const auto& entry :
       std::filesystem::recursive_directory_iterator(std::string(ZERODRIFT_SOURCE_DIR) + "/core/report")) {
    if (entry.path().extension() != ".cpp" || entry.path().parent_path().filename() == "text") continue;
    std::ifstream stream(entry.path());
    std::stringstream buffer;
    buffer << stream.rdbuf();
    const std::string source = buffer.str();
    for (std::sregex_iterator at(source.begin(), source.end(), said), end; at != end; ++at) {
      const std::string text = joined((*at)[1].str());
      ++count;
      EXPECT_TRUE(text.empty() || is_known(Language::chinese, text)) << entry.path().filename() << ": " << text;
    }
  }
  EXPECT_GT(count, 150);
}

TEST(ReportLanguage, WhatTheSearchForMissingPhysicsSaysIsInTheCatalogue) {
  for (const auto& text : diagnosis::sentence_texts()) EXPECT_TRUE(is_known(Language::chinese, text)) << text;
}

TEST(ReportLanguage, EntriesAgreeInPlaceholdersNumbersAndUnits) {
  std::set<std::string> keys;
  for (const auto& entry : text_entries()) {
    const std::string english = entry.english;
    const std::string chinese = entry.chinese;
    EXPECT_TRUE(keys.insert(english).second) << "twice: " << english;
    EXPECT_FALSE(chinese.empty()) << english;
    const auto names = [](const std::string& text) {
      auto found = all_of(text, R"(\{[^}]*\})");
      std::multiset<std::string> out;
      for (const auto& one : found) {
        out.insert(std::all_of(one.begin() + 1, one.end() - 1, [](char c) { return c >= '0' && c <= '9'; }) ? "{}"
                                                                                                            : one);
      }
      return out;
    };
    EXPECT_EQ(names(english), names(chinese)) << english;
    const auto bare = [](const std::string& text) { return std::regex_replace(text, std::regex(R"(\{[^}]*\})"), "_"); };
    // Numbers of standards and parts that one language writes in words are told apart by hand.
    const auto numbers = [&](const std::string& text) {
      return all_of(std::regex_replace(bare(text), std::regex(R"(GB/T 17421\.[0-9])"), ""), R"([0-9]+(\.[0-9]+)?)");
    };
    const bool in_words = english.find("One speed") == 0 || english == "{}, once" || english == "{} ({}), once";
    if (!in_words) {
      EXPECT_EQ(numbers(english), numbers(chinese)) << english;
    }
    for (const char* unit : {"µm", "°C", "rpm", "mm", "ms", "µrad", "%"}) {
      const std::regex alone(std::string("(^|[^A-Za-z])") + unit + "(?![A-Za-z])");
      const auto count = [&](const std::string& text) {
        return std::distance(std::sregex_iterator(text.begin(), text.end(), alone), std::sregex_iterator());
      };
      EXPECT_EQ(count(english), count(chinese)) << unit << " in " << english;
    }
  }
}

TEST(ReportLanguage, TheChineseReportHoldsNoEnglish) {
  RichJob rich({"VMC", "17", "Muster GmbH", "", ""});
  // Names of standards, methods, files and formats, and what the job's people entered.
  static const std::regex allowed(
      "Zerodrift|ISO|VDI|DGQ|GUM|JCGM|ETVE|SHA-?256?|UTC|CSV|LASSO|ARX|means|laser-x\\.csv|VIF|µrad|door "
      "opened|briefly|commission|"
      "engineer|kappa|rectangular|front|µm|urad|rpm|"
      "zerodrift_tests|[a-z_]*_tests|zerodrift [0-9.]+|[0-9a-f]{8,}|Muster GmbH|min");
  for (const auto& [place, text] : texts_of(built(rich, Language::chinese))) {
    const auto left = all_of(std::regex_replace(text, allowed, ""), "[A-Za-z]{3,}");
    EXPECT_TRUE(left.empty()) << place << ": " << text << " (" << (left.empty() ? "" : *left.begin()) << ")";
  }
}

TEST(ReportLanguage, BothLanguagesSayTheSameFigures) {
  RichJob rich({"VMC", "17", "Muster GmbH", "A. Keller", ""});
  const Report english = built(rich, Language::english);
  const Report chinese = built(rich, Language::chinese);
  const auto first = all_figures(english);
  const auto second = all_figures(chinese);
  ASSERT_EQ(first.size(), second.size());
  EXPECT_GT(first.size(), 120u);
  for (std::size_t i = 0; i < first.size(); ++i) {
    EXPECT_EQ(first[i].id, second[i].id);
    EXPECT_EQ(first[i].unit, second[i].unit);
    EXPECT_EQ(all_of(first[i].value, R"([-0-9.]+)"), all_of(second[i].value, R"([-0-9.]+)")) << first[i].id;
    EXPECT_EQ(first[i].verdict, second[i].verdict) << first[i].id;
  }
  ASSERT_EQ(english.sections.size(), chinese.sections.size());
  for (std::size_t s = 0; s < english.sections.size(); ++s) {
    EXPECT_EQ(english.sections[s].id, chinese.sections[s].id);
    ASSERT_EQ(english.sections[s].blocks.size(), chinese.sections[s].blocks.size()) << english.sections[s].id;
    for (std::size_t b = 0; b < english.sections[s].blocks.size(); ++b) {
      const auto* here = std::get_if<Plot>(&english.sections[s].blocks[b]);
      const auto* there = std::get_if<Plot>(&chinese.sections[s].blocks[b]);
      ASSERT_EQ(here == nullptr, there == nullptr);
      if (here == nullptr) continue;
      ASSERT_EQ(here->curves.size(), there->curves.size()) << here->id;
      for (std::size_t c = 0; c < here->curves.size(); ++c) EXPECT_EQ(here->curves[c].x, there->curves[c].x);
    }
  }
}

TEST(ReportLanguage, SentencesThatCoreComposedAreSaid) {
  const auto said = [](const char* text) { return translated(Language::chinese, text); };
  EXPECT_EQ(said("sensor stuck (T2_C), 2 times"), "传感器卡死（T2_C），2 次");
  EXPECT_EQ(said("measuring stretched (every 120 s instead of 60 s), once"),
            "测量周期延长（每 120 s 一次，而非每 60 s 一次），1 次");
  for (const std::string& name : names_of_errors_in_a_run()) EXPECT_TRUE(is_known(Language::chinese, name)) << name;
  for (const char* name : {"sensor spiking", "sensor jumped", "sensor swapped", "camera silent", "target refused"}) {
    EXPECT_TRUE(is_known(Language::chinese, name)) << name;
  }
  EXPECT_EQ(said("T2_C stopped during the run (no samples from 3000 s); it is not used"),
            "T2_C 在运行中停止（自 3000 s 起无采样）；未采用");
  EXPECT_EQ(said("target refused (camera front: too blurred), 3 times"), "靶标被拒绝（相机 前方：图像模糊），3 次");
  EXPECT_EQ(
      said("ridge on 8 sensors leaves 0.51 um rms with each of 3 cycles in turn left out; with the noise of their "
           "sensors mlr on 8 sensors is to leave 0.55 um and this one 0.58 um: not clearly worse, and steadier "
           "where the sensors rise together"),
      "岭回归，8 个传感器（留出：依次留出 3 个循环中的每一个）残差均方根为 0.51 "
      "um；计入传感器噪声，预期多元线性回归，8 个传感器为 0.55 um，本方法为 0.58 um："
      "并无明显劣势，且在各传感器同步升温时更稳定");
  EXPECT_EQ(said("a sentence of nobody"), "a sentence of nobody");
  EXPECT_FALSE(is_known(Language::chinese, "a sentence of nobody"));
  EXPECT_FALSE(language_from("fr").has_value());
  EXPECT_EQ(*language_from("zh_CN"), Language::chinese);
}

}  // namespace zerodrift::report
