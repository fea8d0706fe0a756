// Every format against the same suite: what is written, read back and evaluated, differs from the table by no more than
// the loss the export has declared.

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/noise.h"
#include "core/controller/exports/export_format.h"

namespace zerodrift::controller {
namespace {

using compensation::Approach;
using compensation::AxisTable;
using compensation::Table;
using compensation::Temperatures;

struct Case {
  Table table;
  Temperatures state;
};

Case random_case(std::uint64_t seed) {
  Noise noise(seed);
  Case out;
  AxisTable axis;
  const bool equal_steps = noise.uniform() < 0.5;
  const auto count = static_cast<int>(2 + noise.index(noise.uniform() < 0.05 ? 500 : 40));
  double x = std::round(noise.uniform(-500.0, 200.0));
  const double step = std::round(noise.uniform(1.0, 50.0));
  double error = noise.uniform(-5.0, 5.0);
  for (int i = 0; i < count; ++i) {
    const double reversal = noise.uniform() < 0.5 ? 0.0 : noise.uniform(-3.0, 3.0);
    axis.points.push_back({x, error, error - reversal, noise.uniform() < 0.3 ? noise.uniform(-0.2, 0.2) : 0.0});
    x += equal_steps ? step : std::round(noise.uniform(1.0, 60.0) * 10.0) / 10.0;
    error += noise.uniform(-4.0, 4.0);
  }
  axis.terms = {{"T1_C", noise.uniform(-3.0, 3.0), 20.0, noise.uniform(-12.0, 12.0)}};
  axis.reference_position_mm = noise.uniform(-100.0, 100.0);
  axis.offset_um = noise.uniform(-10.0, 10.0);
  axis.max_um = 1e5;
  out.table.axes[std::string(1, "XYZ"[noise.index(3)])] = axis;
  if (noise.uniform() < 0.5) out.state = {{"T1_C", noise.uniform(15.0, 40.0)}};
  return out;
}

Temperatures full_state(const Case& one) {
  Temperatures state = one.state;
  state.try_emplace("T1_C", 20.0);
  return state;
}

double worst_difference(const Case& one, const Table& rebuilt, std::uint64_t seed, bool two_directions) {
  Noise noise(seed);
  const auto& [name, axis] = *one.table.axes.begin();
  const auto state = full_state(one);
  double worst = 0.0;
  for (int i = 0; i < 60; ++i) {
    const double x = noise.uniform(axis.points.front().position_mm, axis.points.back().position_mm);
    for (const Approach approach : {Approach::up, Approach::down}) {
      const double wanted = error_um(axis, x, approach, state).value();
      const double written = error_um(rebuilt.axes.at(name), x, approach, state).value();
      worst = std::max(worst, std::abs(wanted - written));
    }
  }
  static_cast<void>(two_directions);
  return worst;
}

Table one_axis(std::vector<compensation::TablePoint> points) {
  Table table;
  table.axes["X"].points = std::move(points);
  return table;
}

}  // namespace

class Conformance : public testing::TestWithParam<std::string> {};

TEST_P(Conformance, LosesNoMoreThanDeclared) {
  const ExportFormat& format = **export_format(GetParam());
  double largest = 0.0;
  for (std::uint64_t seed = 1; seed <= 2000; ++seed) {
    const Case one = random_case(seed);
    ExportOptions options;
    options.temperatures = one.state;
    options.axis = one.table.axes.begin()->first;
    options.linuxcnc_type = static_cast<int>(seed % 2);
    options.sinumerik_cec = seed % 3 == 0;
    const auto exported = format.write(one.table, options);
    ASSERT_TRUE(exported) << "seed " << seed << ": " << describe(exported.error());
    ExportOptions at_state = options;
    at_state.temperatures = full_state(one);
    const auto rebuilt = format.read(exported->files.front().text, at_state);
    ASSERT_TRUE(rebuilt) << "seed " << seed << ": " << describe(rebuilt.error());
    const double worst = worst_difference(one, *rebuilt, seed, format.capabilities.two_directions);
    ASSERT_LE(worst, exported->loss_um + 1e-6) << "seed " << seed;
    largest = std::max(largest, exported->loss_um);
  }
  RecordProperty("largest_declared_um", std::to_string(largest));
}

INSTANTIATE_TEST_SUITE_P(Formats, Conformance,
                         testing::Values("linuxcnc", "sinumerik-thermal", "sinumerik-leadscrew", "fanuc",
                                         "heidenhain"));

TEST(Exports, EveryFormatStatesItsSignAndRefusesNonsense) {
  EXPECT_EQ(export_formats().size(), 5U);
  for (const auto& format : export_formats()) {
    EXPECT_FALSE(format.capabilities.sign.empty());
    EXPECT_FALSE(format.read("nonsense\n", {})) << format.id;
    EXPECT_FALSE(format.read("", {})) << format.id;
  }
  EXPECT_EQ(export_format("mach4").error().code, ErrorCode::bad_argument);
}

// A file that claims points without end, numbers beyond any type, or half a line is refused and takes no time.
TEST(Exports, HostileNumbersAreRefused) {
  const auto* fanuc = *export_format("fanuc");
  const auto file = [](const std::string& reference, const std::string& lowest, const std::string& highest) {
    return "N03620 Q1 A1 P" + reference + "\nN03621 Q1 A1 P" + lowest + "\nN03622 Q1 A1 P" + highest +
           "\nN03624 Q1 A1 P50000\nN10041 Q0 P2\n";
  };
  EXPECT_TRUE(fanuc->read(file("40", "41", "41"), {}));
  EXPECT_FALSE(fanuc->read(file("40", "-2000000000", "2000000000"), {}));
  EXPECT_FALSE(fanuc->read(file("40", "41", "900000000"), {}));
  EXPECT_FALSE(fanuc->read(file("2147483647", "41", "42"), {}));
  for (const char* number : {"1e300", "nan", "inf", "0.5", "", "99999999999999999999"}) {
    EXPECT_FALSE(fanuc->read(file("40", "41", number), {})) << number;
    EXPECT_FALSE(fanuc->read(file("40", "41", "41") + "N10042 Q0 P" + number + "\n", {})) << number;
  }
  const auto* thermal = *export_format("sinumerik-thermal");
  EXPECT_FALSE(thermal->read("; R800 =", {}));
  ExportOptions warm;
  warm.temperatures = {{"T1_C", 20.0}};
  const std::string slope = "$SA_TEMP_COMP_SLOPE[X1]=0.1+1*(R800-20)\n";
  EXPECT_TRUE(thermal->read("; R800 = T1_C\n" + slope, warm));
  EXPECT_FALSE(thermal->read("; Rnan = T1_C\n; R1e300 = T1_C\n" + slope, warm));
  EXPECT_FALSE((*export_format("linuxcnc"))->read("0 nan 0\n1 1 1\n", {}));
  EXPECT_FALSE((*export_format("linuxcnc"))->read("10 10 10\n0 0 0\n", {}));
  const auto* leadscrew = *export_format("sinumerik-leadscrew");
  EXPECT_FALSE(leadscrew->read("$AA_ENC_COMP[0,99999999999999999999,X1]=0.001\n$AA_ENC_COMP[0,7,X1]=0.1\n", {}));
  EXPECT_TRUE(leadscrew->read("$AN_CEC[1,0]=0.001\n$AN_CEC_DIRECTION[1]=1e300\n$AN_CEC_INPUT_AXIS[1]=(X1)\n", {}));
}

TEST(Exports, WhatTheTablesOwnLimitCutsIsTold) {
  Table table = one_axis({{0.0, 0.0, 0.0, 0.0}, {100.0, 500.0, 500.0, 0.0}, {200.0, 0.0, 0.0, 0.0}});
  for (const char* name : {"linuxcnc", "sinumerik-leadscrew", "fanuc", "heidenhain"}) {
    const auto exported = (*export_format(name))->write(table, {});
    ASSERT_TRUE(exported) << name;
    EXPECT_NEAR(exported->loss_um, 300.0, 1.0) << name;
    const bool told = std::any_of(exported->losses.begin(), exported->losses.end(), [](const std::string& loss) {
      return loss.find("beyond the table's own limit of 200 um") != std::string::npos;
    });
    EXPECT_TRUE(told) << name;
  }
}

TEST(Exports, LinuxCncHasNothingThatEndsReading) {
  const auto out = (*export_format("linuxcnc"))->write(one_axis({{0, 0, 0, 0}, {100, 10, 12, 0}}), {});
  ASSERT_TRUE(out) << describe(out.error());
  EXPECT_EQ(out->files.front().text, "0.000000 0.000000 0.000000\n100.000000 100.010000 100.012000\n");
  ExportOptions trims;
  trims.linuxcnc_type = 1;
  const auto trimmed = (*export_format("linuxcnc"))->write(one_axis({{0, 0, 0, 0}, {100, 10, 12, 0}}), trims);
  EXPECT_EQ(trimmed->files.front().text, "0.000000 -0.000000 -0.000000\n100.000000 -0.010000 -0.012000\n");
}

// The published increments (+2 +1 +1 -2 0 -1) are the differences of the compensation, interval by interval.
TEST(Exports, FanucIncrementsAreCarried) {
  std::vector<compensation::TablePoint> points;
  const std::vector<double> compensation_um = {0, 2, 3, 4, 2, 2, 1};
  for (std::size_t i = 0; i < compensation_um.size(); ++i) {
    points.push_back({50.0 * static_cast<double>(i), -compensation_um[i], -compensation_um[i], 0.0});
  }
  const auto out = (*export_format("fanuc"))->write(one_axis(points), {});
  ASSERT_TRUE(out) << describe(out.error());
  EXPECT_NE(out->files.front().text.find("N03620 Q1 A1 P40\n"), std::string::npos);
  EXPECT_NE(out->files.front().text.find("N03624 Q1 A1 P50000\n"), std::string::npos);
  EXPECT_NE(out->files.front().text.find(
                "N10041 Q0 P2\nN10042 Q0 P1\nN10043 Q0 P1\nN10044 Q0 P-2\nN10045 Q0 P0\nN10046 Q0 P-1\n"),
            std::string::npos);
  EXPECT_DOUBLE_EQ(out->loss_um, 0.0);
  // Thirds of a unit: each rounded for itself would lose a third at every point.
  std::vector<compensation::TablePoint> thirds;
  for (int i = 0; i <= 30; ++i) thirds.push_back({10.0 * i, i / 3.0, i / 3.0, 0.0});
  const auto carried = (*export_format("fanuc"))->write(one_axis(thirds), {});
  EXPECT_LE(carried->loss_um, 0.5);
}

// The published Siemens case: 270 um/m at 42 C, none at 23 C; at 32.3 C the slope is 0.000132.
TEST(Exports, SiemensSlope) {
  Table table;
  AxisTable& x = table.axes["X"];
  x.terms = {{"T1_C", 0.0, 23.0, 270.0 / (42.0 - 23.0)}};
  ExportOptions options;
  options.temperatures = {{"T1_C", 32.3}};
  const ExportFormat& format = **export_format("sinumerik-thermal");
  const auto out = format.write(table, options);
  ASSERT_TRUE(out) << describe(out.error());
  const auto back = format.read(out->files.front().text, options);
  ASSERT_TRUE(back) << describe(back.error());
  const auto& points = back->axes.at("X").points;
  const double slope =
      1e-3 * (points[1].error_up_um - points[0].error_up_um) / (points[1].position_mm - points[0].position_mm);
  EXPECT_NEAR(slope, 0.000132, 0.5e-6);
  EXPECT_NEAR(slope, 270e-6 * 9.3 / 19.0, 1e-9);
}

TEST(Exports, NothingButZerosIsRefused) {
  // Points without temperature terms: the thermal file would be a line of zeros.
  const Table points = one_axis({{0, 2, 2, 0}, {300, 9, 9, 0}});
  const auto thermal = write_table(**export_format("sinumerik-thermal"), points, {});
  ASSERT_FALSE(thermal);
  EXPECT_EQ(thermal.error().code, ErrorCode::not_enough_data);
  EXPECT_TRUE(write_table(**export_format("heidenhain"), points, {}));
  const Table zeros = one_axis({{0, 0, 0, 0}, {300, 0, 0, 0}});
  for (const auto& format : export_formats()) EXPECT_FALSE(write_table(format, zeros, {})) << format.id;
  Table terms = zeros;
  terms.axes["X"].terms = {{"T1_C", 2.0, 20.0, 0.0}};
  EXPECT_TRUE(write_table(**export_format("sinumerik-thermal"), terms, {}));
}

// The published Heidenhain case: 300 mm, 40 K more, 11.5e-6 per K: 0.138 mm.
TEST(Exports, HeidenhainExpansion) {
  Table table = one_axis({{0, 0, 0, 0}, {300, 0, 0, 0}});
  table.axes["X"].terms = {{"T1_C", 0.0, 20.0, 11.5}};
  ExportOptions options;
  options.temperatures = {{"T1_C", 60.0}};
  const auto out = (*export_format("heidenhain"))->write(table, options);
  ASSERT_TRUE(out) << describe(out.error());
  EXPECT_NE(out->files.front().text.find("1 +300.0000 +0.0000 +0.1380 +0.0000 +0.0000\n"), std::string::npos)
      << out->files.front().text;
}

// What its BACKLASH column means to the control is known from no source: it is written 0 and told as a loss, and a file
// that has something there is refused instead of being read as if it had not.
TEST(Exports, HeidenhainBacklashIsDeclared) {
  const auto& format = **export_format("heidenhain");
  const auto out = format.write(one_axis({{0, 2, 0, 0}, {300, 9, 5, 0}}), {});
  ASSERT_TRUE(out) << describe(out.error());
  EXPECT_NEAR(out->loss_um, 2.0, 1e-9);  // half of the largest difference
  const auto told = std::any_of(out->losses.begin(), out->losses.end(), [](const std::string& loss) {
    return loss.find("4.00 um") != std::string::npos && loss.find("BACKLASH is written 0") != std::string::npos;
  });
  EXPECT_TRUE(told);
  std::string text = out->files.front().text;
  ASSERT_TRUE(format.read(text, {}));
  const std::size_t second = text.find("\n1 +300.0000 ") + std::string("\n1 +300.0000 ").size();
  text.replace(second, 7, "+0.0040");
  const auto back = format.read(text, {});
  ASSERT_FALSE(back);
  EXPECT_EQ(back.error().code, ErrorCode::wrong_format);
}

TEST(Exports, SiemensLeadscrewForm) {
  const auto out = (*export_format("sinumerik-leadscrew"))->write(one_axis({{0, 3, 3, 0}, {100, 10, 10, 0}}), {});
  ASSERT_TRUE(out) << describe(out.error());
  const std::string& text = out->files.front().text;
  for (const char* line :
       {"%_N_AX_EEC_INI\nCHANDATA(1)\n", "$AA_ENC_COMP[0,0,X1]=0.003000\n", "$AA_ENC_COMP[0,1,X1]=0.010000\n",
        "$AA_ENC_COMP_STEP[0,X1]=100.000000\n", "$AA_ENC_COMP_MIN[0,X1]=0.000000\n",
        "$AA_ENC_COMP_MAX[0,X1]=100.000000\n", "$AA_ENC_COMP_IS_MODULO[0,X1]=0\n", "M17\n"}) {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
  EXPECT_DOUBLE_EQ(out->loss_um, 0.0);
}

// What is loaded first where the sign is not certain: one place moves by -5 um, the rest stays.
TEST(Exports, OnePointOfEveryFormat) {
  Table table;
  for (int i = 0; i <= 10; ++i) table.axes["X"].points.push_back({50.0 * i, 3.0 * i, 2.0 * i, 0.1});
  table.axes["X"].terms = {{"T1_C", 2.0, 20.0, 5.0}};
  for (const auto& format : export_formats()) {
    ExportOptions options;
    options.temperatures = {{"T1_C", 35.0}};
    const auto out = write_one_point(format, table, options);
    ASSERT_TRUE(out) << format.id << ": " << describe(out.error());
    ASSERT_EQ(out->confirm.size(), 1U);
    EXPECT_NE(out->confirm.front().find("-5.0 um"), std::string::npos);
    const auto back = format.read(out->files.front().text, options);
    ASSERT_TRUE(back) << format.id;
    const auto at = [&](double x) { return error_um(back->axes.at("X"), x, Approach::up, {}).value(); };
    EXPECT_NEAR(at(250.0), 5.0, 1e-6) << format.id;
    if (!format.capabilities.temperature) {
      EXPECT_NEAR(at(200.0), 0.0, 1e-6) << format.id;
      EXPECT_NEAR(at(500.0), 0.0, 1e-6) << format.id;
    }
  }
}

}  // namespace zerodrift::controller
