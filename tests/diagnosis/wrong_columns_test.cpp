// A recording that is not of what it says: no room, a column in another unit, a gauge that is dead, a clock that jumps,
// a cut of the same run. Each is named, and nothing else is.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <tuple>

#include "core/diagnosis/answer/explain.h"
#include "core/diagnosis/input/channels.h"
#include "tests/diagnosis/answered.h"
#include "tests/support/amount.h"

namespace zerodrift::diagnosis {

TEST(WrongColumns, WithoutTheRoomsColumnNothingIsInvented) {
  for (const auto& [seed, id] : {std::pair{301U, "none"}, std::pair{302U, "cutting_heat"}}) {
    proof::Case one = proof::make_case(seed, id);
    for (auto& run : one.recordings) {
      std::erase_if(run.channels, [](const auto& channel) { return channel.name == "ambient_C"; });
    }
    const auto answer = answer_with_details(one);
    ASSERT_TRUE(answer.has_value()) << describe(answer.error());
    EXPECT_TRUE(notes(*answer, "room_not_logged"));
    EXPECT_TRUE(says(*answer, "room_not_logged"));
    for (const FoundEffect& found : answer->effects) {
      EXPECT_EQ(found.id, id) << seed;
    }
  }
}

TEST(WrongColumns, WhatMovesADisplacementIsNotRuledOutWithoutItsColumn) {
  proof::Case one = proof::make_case(301, "structure_ambient");
  for (auto& run : one.recordings) {
    std::erase_if(run.channels, [](const auto& channel) { return channel.name == "dZ_um" || channel.name == "T3_C"; });
  }
  const auto answer = answer_with_details(one);
  ASSERT_TRUE(answer.has_value()) << describe(answer.error());
  EXPECT_EQ(answer->verdict, Verdict::consistent);
  EXPECT_TRUE(says(*answer, "verdict_consistent_in_part"));
  EXPECT_TRUE(says(*answer, "not_recorded"));
  EXPECT_TRUE(notes(*answer, "not_recorded:T3_C,dZ_um"));
}

TEST(WrongColumns, TheRoomsColumnAndASensorsExchangedAreRefusedByName) {
  proof::Case one = proof::make_case(302, "cutting_heat");
  ASSERT_TRUE(checked(one).has_value());
  for (auto& run : one.recordings) std::swap(run.find("ambient_C")->values, run.find("T3_C")->values);
  const auto answer = checked(one);
  ASSERT_FALSE(answer.has_value());
  EXPECT_NE(describe(answer.error()).find("columns ambient_C and T3_C"), std::string::npos) << describe(answer.error());
}

TEST(WrongColumns, SpeedsThatWereNotLoggedAreTold) {
  proof::Case one = proof::make_case(302, "cutting_heat");
  std::vector<double>& speeds = one.recordings[0].find("spindle_rpm")->values;
  for (std::size_t k = 3; k < speeds.size(); k += 10) speeds[k] = std::nan("");
  const auto answer = checked(one);
  ASSERT_TRUE(answer.has_value()) << describe(answer.error());
  EXPECT_TRUE(notes(answer->notes, "input_gaps:"));
}

TEST(WrongColumns, AColumnThatDrivesNothingIsLeftOutAndAFanIsNot) {
  proof::Case one = proof::make_case(302, "cutting_heat");
  one.recordings.resize(1);
  recording::Recording& run = one.recordings[0];
  recording::Channel sigma{"sigma_Z_nm", {}}, count{"row_counter", {}}, fan{"fan_on", {}};
  for (std::size_t k = 0; k < run.rows(); ++k) {
    sigma.values.push_back(k % 8 == 0 ? 100.0 + static_cast<double>(k % 7) : std::nan(""));
    count.values.push_back(static_cast<double>(k));
    fan.values.push_back(k > run.rows() / 2 ? 1.0 : 0.0);
  }
  for (auto* column : {&sigma, &count, &fan}) run.channels.push_back(*column);
  const auto runs = checked(one);
  ASSERT_TRUE(runs.has_value()) << describe(runs.error());
  EXPECT_EQ(runs->recordings[0].find("sigma_Z_nm"), nullptr);
  EXPECT_EQ(runs->recordings[0].find("row_counter"), nullptr);
  EXPECT_NE(runs->recordings[0].find("fan_on"), nullptr);
}

/// What switches between two rows has moved the machine by what nobody knows: that is no effect.
TEST(WrongColumns, ASoundMachineSeenSeldomIsNotAccused) {
  for (unsigned seed = 331; seed < 331U + amount(1, 2); ++seed) {
    proof::Case one = proof::make_case(seed, "none");
    for (auto& run : one.recordings) {
      const auto step = static_cast<std::size_t>(300.0 / (run.time_s[1] - run.time_s[0]));
      const auto seldom = [step](std::vector<double>& values) {
        std::size_t kept = 0;
        for (std::size_t k = 0; k < values.size(); k += step) values[kept++] = values[k];
        values.resize(kept);
      };
      seldom(run.time_s);
      for (auto& channel : run.channels) seldom(channel.values);
    }
    const auto answer = answer_with_details(one);
    ASSERT_TRUE(answer.has_value()) << describe(answer.error());
    EXPECT_TRUE(says(*answer, "coarse_rows")) << seed;
    for (const FoundEffect& found : answer->effects) EXPECT_LE(found.confidence, 0.5) << seed << found.id;
  }
}

TEST(WrongColumns, ASensorThatDriftsAloneIsUnexplainedAtThatSensor) {
  proof::Case one = proof::make_case(332, "none");
  one.recordings.resize(1);
  recording::Recording& run = one.recordings[0];
  std::vector<double>& values = run.find("T3_C")->values;
  for (std::size_t k = 0; k < values.size(); ++k) values[k] += 3.0 * std::pow(run.time_s[k] / run.time_s.back(), 4);
  const auto drifts = answer_with_details(one);
  ASSERT_TRUE(drifts.has_value()) << describe(drifts.error());
  EXPECT_EQ(drifts->verdict, Verdict::unexplained);
  EXPECT_EQ(drifts->mismatch.channels.front(), "T3_C");
}

TEST(WrongColumns, AClockThatJumpsIsNoEffectAndAPauseOfTheLoggerIsNoJump) {
  proof::Case one = proof::make_case(323, "none");
  one.recordings.resize(1);
  const recording::Recording whole = one.recordings[0];
  const std::size_t row = whole.rows() / 2;
  for (std::size_t k = row; k < whole.rows(); ++k) one.recordings[0].time_s[k] += 240.0;
  const auto jumped = answer_with_details(one);
  ASSERT_TRUE(jumped.has_value()) << describe(jumped.error());
  EXPECT_EQ(jumped->verdict, Verdict::consistent);
  EXPECT_TRUE(says(*jumped, "clock_jumped"));

  constexpr std::ptrdiff_t missed = 5;
  one.recordings[0] = whole;
  const auto take_out = [&](std::vector<double>& values) {
    const auto from = values.begin() + static_cast<std::ptrdiff_t>(row);
    values.erase(from, from + missed);
  };
  for (auto& channel : one.recordings[0].channels) take_out(channel.values);
  take_out(one.recordings[0].time_s);
  const auto paused = answer_with_details(one);
  ASSERT_TRUE(paused.has_value()) << describe(paused.error());
  EXPECT_EQ(paused->verdict, Verdict::consistent);
  EXPECT_FALSE(says(*paused, "clock_jumped"));
}

TEST(WrongColumns, SpeedsInThousandsAreRefusedByName) {
  proof::Case one = proof::make_case(324, "none");
  for (double& value : one.recordings[0].find("spindle_rpm")->values) value *= 0.001;
  const auto answer = checked(one);
  ASSERT_FALSE(answer.has_value());
  EXPECT_EQ(answer.error().code, ErrorCode::data_does_not_fit);
  EXPECT_NE(describe(answer.error()).find("column spindle_rpm"), std::string::npos) << describe(answer.error());
}

TEST(WrongColumns, SpeedsInPercentOrNotLoggedAreRefusedByName) {
  for (const double times : {0.0125, 0.0}) {
    proof::Case one = proof::make_case(324, "none");
    for (double& value : one.recordings[0].find("spindle_rpm")->values) value *= times;
    const auto answer = checked(one);
    ASSERT_FALSE(answer.has_value()) << times;
    EXPECT_EQ(answer.error().code, ErrorCode::data_does_not_fit);
    EXPECT_NE(describe(answer.error()).find("column spindle_rpm"), std::string::npos) << describe(answer.error());
  }
}

TEST(WrongColumns, SpeedsInAnotherUnitAreRefusedByName) {
  for (const auto& [times, unit] :
       {std::pair{1.0 / 60.0, "in 1/s"}, std::pair{0.10472, "in rad/s"}, std::pair{1000.0, "rated at"}}) {
    proof::Case one = proof::make_case(324, "none");
    for (double& value : one.recordings[0].find("spindle_rpm")->values) value *= times;
    const auto answer = checked(one);
    ASSERT_FALSE(answer.has_value()) << unit;
    EXPECT_EQ(answer.error().code, ErrorCode::data_does_not_fit);
    EXPECT_NE(describe(answer.error()).find("column spindle_rpm"), std::string::npos) << describe(answer.error());
    EXPECT_NE(describe(answer.error()).find(unit), std::string::npos) << describe(answer.error());
  }
}

TEST(WrongColumns, LoadsInAnotherUnitAreTold) {
  proof::Case one = proof::make_case(325, "cutting_heat");
  one.recordings.resize(1);
  const auto right = checked(one);
  ASSERT_TRUE(right.has_value()) << describe(right.error());
  EXPECT_FALSE(notes(right->notes, "load_in_other_unit"));
  auto& load_W = one.recordings[0].find("spindle_load_W")->values;
  const double rated_W = physics::machine_from_json(one.machine, one.name)->components[0].sources[0].rated_power_W;
  const std::vector<double> whole_W = load_W;
  const double most_W = *std::max_element(load_W.begin(), load_W.end());
  for (const auto& [unit, most] : {std::pair{"kW", 0.0001 * rated_W}, std::pair{"%", 0.04 * rated_W}}) {
    for (std::size_t k = 0; k < load_W.size(); ++k) load_W[k] = whole_W[k] * most / most_W;
    const auto runs = checked(one);
    ASSERT_TRUE(runs.has_value()) << describe(runs.error());
    const auto told = std::find_if(runs->notes.begin(), runs->notes.end(),
                                   [](const Note& note) { return note.code == NoteCode::load_in_other_unit; });
    ASSERT_NE(told, runs->notes.end()) << unit;
    EXPECT_NE(told->facts.at("unit").find(unit), std::string::npos) << told->facts.at("unit");
  }
}

TEST(WrongColumns, AProbeThatDropsOutIsNoBracketThatSlipped) {
  proof::Case one = proof::make_case(327, "none");
  auto& dZ = one.recordings[0].find("dZ_um")->values;
  const auto middle = dZ.begin() + static_cast<std::ptrdiff_t>(dZ.size() / 2);
  std::fill(middle, middle + 60, 0.0);
  const auto answer = answer_with_details(one);
  ASSERT_TRUE(answer.has_value()) << describe(answer.error());
  EXPECT_EQ(answer->verdict, Verdict::consistent);
  EXPECT_TRUE(says(*answer, "run_finding"));
}

TEST(WrongColumns, ACutOfTheFittedRunIsNoSecondOne) {
  proof::Case one = proof::make_case(308, "none");
  one.recordings.resize(1);
  one.recordings.push_back(recording::slice(one.recordings[0], 40, 60));
  one.recordings[1].name = "cut";
  for (double& t : one.recordings[1].time_s) t -= one.recordings[1].time_s.front();
  const auto answer = checked(one);
  ASSERT_FALSE(answer.has_value());
  EXPECT_EQ(answer.error().code, ErrorCode::bad_argument);
  EXPECT_NE(describe(answer.error()).find("cut"), std::string::npos);
  EXPECT_NE(describe(answer.error()).find("60 of its rows"), std::string::npos) << describe(answer.error());
}

/// What is too small is told by its movement, what is too large by its noise.
TEST(WrongColumns, OneDisplacementInAnotherUnitIsRefusedByName) {
  for (const auto& [channel, factor, unit] : {std::tuple{"dZ_um", 0.001, "mm"}, std::tuple{"dY_um", 1000.0, "nm"}}) {
    proof::Case one = proof::make_case(309, "none");
    for (double& value : one.recordings[0].find(channel)->values) value *= factor;
    const auto answer = checked(one);
    ASSERT_FALSE(answer.has_value()) << channel;
    EXPECT_EQ(answer.error().code, ErrorCode::data_does_not_fit);
    EXPECT_NE(describe(answer.error()).find(channel), std::string::npos);
    EXPECT_NE(describe(answer.error()).find(unit), std::string::npos);
  }
}

TEST(WrongColumns, AColumnSpeltOtherwiseIsNamedAndATakenOutOneIsNotCalledMissing) {
  proof::Case one = proof::make_case(310, "none");
  one.recordings.resize(1);
  for (auto& channel : one.recordings[0].channels) {
    if (channel.name == "T2_C") channel.name = "T99_C";
  }
  for (double& value : one.recordings[0].find("T1_C")->values) value *= 1000.0;
  const auto answer = checked(one);
  ASSERT_TRUE(answer.has_value()) << describe(answer.error());
  EXPECT_TRUE(notes(answer->notes, "unknown_columns:T99_C"));
  EXPECT_FALSE(notes(answer->notes, "missing_channel:T1_C"));
  EXPECT_EQ(answer->findings.size(), 1U);
}

TEST(WrongColumns, AGaugeThatNeverChangesIsToldAndNotUsed) {
  for (const double value : {0.0, 2.5}) {
    proof::Case one = proof::make_case(331, "coolant");
    for (auto& run : one.recordings) {
      auto& seen_um = run.find("dZ_um")->values;
      std::fill(seen_um.begin(), seen_um.end(), value);
    }
    const auto answer = checked(one);
    ASSERT_TRUE(answer.has_value()) << describe(answer.error());
    EXPECT_TRUE(notes(answer->notes, "never_changes:dZ_um"));
    EXPECT_FALSE(sentence_of(answer->notes.front()).id.empty());
    for (const auto& run : answer->recordings) EXPECT_EQ(run.find("dZ_um"), nullptr);
  }
}

/// The description moves nothing across, and one recording's gauge was dead: the other shows that it has noise.
TEST(WrongColumns, AGaugeThatReadsInOneRecordingAloneIsNotUsedInTheOther) {
  for (const std::size_t dead : {0U, 1U}) {
    proof::Case one = proof::make_case(334, "structure_bending");
    ASSERT_EQ(one.recordings.size(), 2U);
    auto& seen_um = one.recordings[dead].find("dY_um")->values;
    std::fill(seen_um.begin(), seen_um.end(), 0.0);
    const auto answer = checked(one);
    ASSERT_TRUE(answer.has_value()) << describe(answer.error());
    EXPECT_TRUE(notes(answer->notes, "never_changes:dY_um"));
    EXPECT_EQ(answer->recordings[dead].find("dY_um"), nullptr);
    EXPECT_NE(answer->recordings[1 - dead].find("dY_um"), nullptr);
  }
}

/// Nothing moves it as described, and nobody knows how coarse it is: told, and still used.
TEST(WrongColumns, AGaugeThatMayBeAtRestIsToldAndUsed) {
  proof::Case one = proof::make_case(330, "none");
  for (auto& run : one.recordings) {
    auto& seen_um = run.find("dY_um")->values;
    std::fill(seen_um.begin(), seen_um.end(), 0.0);
  }
  const auto answer = checked(one);
  ASSERT_TRUE(answer.has_value()) << describe(answer.error());
  EXPECT_TRUE(std::any_of(answer->findings.begin(), answer->findings.end(),
                          [](const RunFinding& found) { return found.finding.channel == "dY_um"; }));
  EXPECT_NE(answer->recordings[0].find("dY_um"), nullptr);
}

TEST(WrongColumns, SpikesAreCountedAndTwoSensorsAreSaidToBeFew) {
  proof::Case one = proof::make_case(333, "none");
  one.recordings.resize(1);
  auto& sensors = one.machine["sensors"];
  for (std::size_t i = sensors.size(); i-- > 0;) {
    const std::string channel = sensors[i]["channel"];
    if (channel != "T1_C" && channel != "T3_C" && channel != "ambient_C") sensors.erase(i);
  }
  std::vector<double>& seen_C = one.recordings[0].find("T1_C")->values;
  for (std::size_t k = 1; k <= 7; ++k) seen_C[k * seen_C.size() / 8] += 25.0;
  const auto answer = checked(one);
  ASSERT_TRUE(answer.has_value()) << describe(answer.error());
  const auto machine = physics::machine_from_json(one.machine, one.name);
  EXPECT_TRUE(notes(limits_of(*machine, answer->recordings),
                    "few_sensors:" + one.machine["components"][0]["id"].get<std::string>() + ":2"));
  const auto spikes = std::find_if(answer->findings.begin(), answer->findings.end(), [](const RunFinding& found) {
    return found.finding.kind == analysis::FindingKind::spikes;
  });
  ASSERT_NE(spikes, answer->findings.end());
  EXPECT_EQ(spikes->finding.channel, "T1_C");
  // A sample beside one of them may go with it.
  EXPECT_GE(std::stoi(spikes->finding.detail), 7);
  EXPECT_LE(std::stoi(spikes->finding.detail), 8);
}
}  // namespace zerodrift::diagnosis
