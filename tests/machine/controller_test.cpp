// The controller's behaviour by docs/register-map.md, read and written through the register bank alone.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>

#include "app/machine/faults.h"
#include "app/machine/register_bank.h"
#include "core/base/hash.h"

namespace zerodrift::machine {
namespace {

using controller::ModbusException;
using Words = std::vector<std::uint16_t>;

void put(Words& words, double value) {
  const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(value));
  words.push_back(static_cast<std::uint16_t>(bits >> 16U));
  words.push_back(static_cast<std::uint16_t>(bits & 0xFFFFU));
}

struct Term {
  int sensor;
  double um_per_K;
  double reference_C;
  double um_per_m_K;
};
struct Point {
  double mm;
  double up;
  double down;
  double um_per_K;
};

Words axis_words(int axis, double offset, double x0, double largest, double rate, const std::vector<Term>& terms,
                 const std::vector<Point>& points) {
  Words words{static_cast<std::uint16_t>(axis), static_cast<std::uint16_t>(terms.size()),
              static_cast<std::uint16_t>(points.size()), 0};
  for (const double value : {offset, x0, largest, rate}) put(words, value);
  for (const Term& term : terms) {
    words.push_back(static_cast<std::uint16_t>(term.sensor));
    for (const double value : {term.um_per_K, term.reference_C, term.um_per_m_K}) put(words, value);
  }
  for (const Point& point : points) {
    for (const double value : {point.mm, point.up, point.down, point.um_per_K}) put(words, value);
  }
  return words;
}

Words table_words(const std::vector<Words>& axes) {
  Words words{1, static_cast<std::uint16_t>(axes.size())};
  for (const Words& axis : axes) words.insert(words.end(), axis.begin(), axis.end());
  return words;
}

std::uint32_t crc_of(const Words& words) {
  std::string bytes;
  for (const std::uint16_t word : words) {
    bytes += static_cast<char>(word >> 8U);
    bytes += static_cast<char>(word & 0xFFU);
  }
  return crc32_of(bytes);
}

class ControllerTest : public ::testing::Test {
 protected:
  std::uint16_t word(int address) { return (*bank.read(address, 1))[0]; }
  double number(int address) {
    const auto words = *bank.read(address, 2);
    return std::bit_cast<float>(static_cast<std::uint32_t>(words[0]) << 16U | words[1]);
  }
  int write(int address, const Words& words) {
    const auto refused = bank.write(address, words);
    return refused ? static_cast<int>(*refused) : 0;
  }
  int write_number(int address, double value) {
    Words words;
    put(words, value);
    return write(address, words);
  }
  void wait(double seconds) { machine.advance_to(machine.time_s() + seconds); }
  void stage(const Words& words, std::uint16_t sequence, std::uint32_t crc) {
    for (std::size_t i = 0; i < words.size(); i += 64) {
      const Words block(words.begin() + i, words.begin() + std::min(i + 64, words.size()));
      ASSERT_EQ(write(1000 + static_cast<int>(i), block), 0);
    }
    ASSERT_EQ(write(200, {static_cast<std::uint16_t>(words.size()), 1000, static_cast<std::uint16_t>(crc >> 16U),
                          static_cast<std::uint16_t>(crc), sequence}),
              0);
  }
  /// 0 when the table became active, else the reason of register 212.
  int commit(const Words& words, std::uint16_t sequence) {
    stage(words, sequence, crc_of(words));
    return finish(sequence);
  }
  int finish(std::uint16_t sequence) {
    EXPECT_EQ(write(205, {sequence}), 0);
    EXPECT_EQ(word(206), 2) << "checking";
    wait(1.0);
    EXPECT_EQ(word(205), 0);
    EXPECT_EQ(word(207), sequence);
    return word(206) == 3 ? 0 : word(212);
  }

  Machine machine{build_machine(7)};
  RegisterBank bank{machine, 850007, 60};
};

TEST_F(ControllerTest, IdentifiesItself) {
  wait(100.25);
  EXPECT_EQ(*bank.read(0, 4), (Words{0x5A44, 1, 0b1111, 2000}));
  EXPECT_EQ(word(4) << 16 | word(5), 850007);
  EXPECT_EQ(*bank.read(6, 2), (Words{20, 5}));
  EXPECT_EQ(word(8) << 16 | word(9), 10025);
  EXPECT_EQ(word(10), 100);
  EXPECT_EQ(word(12), 60);
  EXPECT_EQ(word(16), 4) << "referenced, nothing moves";
}

TEST_F(ControllerTest, RefusesWhatIsOutsideTheMap) {
  for (const int address : {128, 139, 176, 199, 220, 999, 3000, 3999, 6000}) {
    EXPECT_EQ(bank.read(address, 1).error(), ModbusException::illegal_address) << address;
  }
  EXPECT_TRUE(bank.read(0, 125));
  EXPECT_TRUE(bank.read(5999, 1));
  EXPECT_EQ(bank.read(127, 2).error(), ModbusException::illegal_address);
  for (const int address : {0, 10, 12, 16, 17, 30, 71, 77, 96, 100, 119, 147, 160, 206, 208, 213, 214, 4000, 5999}) {
    EXPECT_EQ(write(address, {1}), 2) << address;
  }
  EXPECT_EQ(write(74, {1, 1, 0, 7}), 2) << "one bad register refuses the whole request";
  EXPECT_EQ(word(74), 0);
  EXPECT_EQ(word(75), 0);
  EXPECT_EQ(write(72, {0}), 3) << "half a number";
  EXPECT_EQ(write(73, {0}), 3);
}

TEST_F(ControllerTest, TurnsTheSpindleWithinItsRange) {
  EXPECT_EQ(write_number(72, 8000.5), 3);
  EXPECT_EQ(write_number(72, -1), 3);
  EXPECT_EQ(write_number(72, std::nan("")), 3);
  EXPECT_EQ(write_number(72, 3000), 0);
  EXPECT_EQ(number(72), 3000);
  EXPECT_LT(number(30), 3000);
  wait(10);
  EXPECT_EQ(number(30), 3000);
  EXPECT_GT(number(32), 100) << "load";
}

TEST_F(ControllerTest, RunsTheCycleAndComesBack) {
  EXPECT_EQ(write(75, {1}), 0);
  wait(60.3);
  EXPECT_EQ(word(16) & 3, 1);
  EXPECT_NEAR(number(34), 2400, 30);
  EXPECT_GT(number(38), 1000);
  EXPECT_EQ(write_number(64, 301), 3) << "beyond the travel";
  Words target;
  for (const double mm : {0.0, 0.0, 0.0}) put(target, mm);
  target.push_back(1);
  EXPECT_EQ(write(64, target), 0);
  EXPECT_EQ(word(70), 1);
  EXPECT_EQ(word(16) & 3, 2);
  wait(2.0);
  EXPECT_EQ(word(70), 0);
  EXPECT_EQ(number(20), 0);
  EXPECT_EQ(number(26), 0);
  EXPECT_EQ(number(28), 0);
  EXPECT_EQ(word(160), 1) << "at the nest";
  wait(11);
  EXPECT_EQ(number(34), 0) << "ten seconds after the last move";
}

TEST_F(ControllerTest, StartsWithAnEmptyTable) {
  EXPECT_EQ(word(210), 2);
  EXPECT_EQ(*bank.read(4000, 2), (Words{1, 0}));
  EXPECT_EQ(word(208) << 16 | word(209), static_cast<int>(crc_of({1, 0})));
  EXPECT_EQ(word(206), 0);
}

TEST_F(ControllerTest, AppliesTheTableAsTheMapSays) {
  const std::vector<Term> terms{{3, -2.0, 20.0, 4.0}, {0, 0.5, 19.0, 0.0}};
  const std::vector<Point> points{{-100, 3, 5, 0.1}, {0, 1, 2, 0.0}, {100, -4, -6, -0.2}};
  const Words words =
      table_words({axis_words(0, 1.5, 20.0, 150, 5, terms, points), axis_words(2, -7, 0, 5, 2, {}, {})});
  ASSERT_EQ(commit(words, 9), 0);
  EXPECT_EQ(*bank.read(4000, static_cast<int>(words.size())), words);
  EXPECT_EQ(word(211), 9);
  EXPECT_EQ(word(210), words.size());
  ASSERT_EQ(write(76, {1}), 0);
  ASSERT_EQ(write_number(64, 60.0), 0);
  ASSERT_EQ(write(70, {1}), 0);
  wait(10.0);
  EXPECT_GT(word(213), 40);
  EXPECT_LT(word(213), 60);
  wait(60.0);
  EXPECT_EQ(word(213), 100);
  // evaluated here from the truth; the controller sees readings of 0.1 C noise and a small offset, low-passed
  const double difference = machine.thermal().sensor_C()[2] - 20.0;
  const double room = machine.thermal().room_C() - 19.0;
  const double x = 60.0;
  double expected = 1.5 + (-2.0 + 4.0 * (x - 20.0) / 1000.0) * difference + 0.5 * room;
  expected += 0.4 * 1.0 + 0.6 * (-4.0 - 0.2 * difference);  // approached upwards
  EXPECT_NEAR(number(40), expected, 0.5);
  EXPECT_EQ(number(42), 0);
  EXPECT_EQ(number(44), -5) << "clamped";
  ASSERT_EQ(write_number(64, 80.0), 0);
  ASSERT_EQ(write(70, {1}), 0);
  wait(10.0);
  const double coming_up = number(40);
  ASSERT_EQ(write_number(64, 90.0), 0);
  ASSERT_EQ(write(70, {1}), 0);
  wait(5.0);
  ASSERT_EQ(write_number(64, 80.0), 0);
  ASSERT_EQ(write(70, {1}), 0);
  wait(10.0);
  EXPECT_NEAR(number(40) - coming_up, 0.2 * (2 - 1) + 0.8 * (-6 + 4), 0.3) << "the other direction's points";
  ASSERT_EQ(write(76, {0}), 0);
  wait(25.0);
  EXPECT_EQ(word(213), 0);
  EXPECT_EQ(number(40), 0);
}

TEST_F(ControllerTest, CompensationMovesTheNose) {
  const auto before = machine.true_error_um();
  ASSERT_EQ(commit(table_words({axis_words(2, 30, 0, 100, 5, {}, {})}), 1), 0);
  ASSERT_EQ(write(76, {1}), 0);
  wait(40.0);
  const auto after = machine.true_error_um();
  EXPECT_NEAR(after[2] - before[2], 30.0, 0.3);
  EXPECT_NEAR(machine.scene(View::side).target_up_um, after[2], 1e-9);
}

TEST_F(ControllerTest, KeepsTheRateLimit) {
  // 60 um over 40 mm of position: the move is over at once, the compensation follows at 2 um/s
  ASSERT_EQ(commit(table_words({axis_words(0, 0, 0, 100, 2, {}, {{0, 0, 0, 0}, {40, 60, 60, 0}})}), 1), 0);
  ASSERT_EQ(write(76, {1}), 0);
  wait(30.0);
  ASSERT_EQ(write_number(64, 40.0), 0);
  ASSERT_EQ(write(70, {1}), 0);
  const double start = machine.time_s();
  wait(10.0);
  EXPECT_NEAR(number(40), 2.0 * (machine.time_s() - start), 0.5);
  wait(30.0);
  EXPECT_NEAR(number(40), 60.0, 1e-6);
}

TEST_F(ControllerTest, RejectsBadTables) {
  const Words good = table_words({axis_words(2, 1, 0, 100, 2, {{1, -3, 20, 0}}, {})});
  stage(good, 5, crc_of(good) ^ 1U);
  EXPECT_EQ(finish(5), 1) << "CRC";
  ASSERT_EQ(write(200, {2001}), 0);
  EXPECT_EQ(finish(5), 2) << "count";
  Words longer = good;
  longer.push_back(0);
  EXPECT_EQ(commit(longer, 5), 3) << "words left over";
  EXPECT_EQ(commit({2, 0}, 5), 3) << "another format";
  EXPECT_EQ(commit(table_words({axis_words(3, 1, 0, 100, 2, {}, {})}), 5), 3) << "no such axis";
  EXPECT_EQ(commit(table_words({axis_words(0, 1, 0, 100, 2, {{21, 1, 20, 0}}, {})}), 5), 3) << "no such sensor";
  EXPECT_EQ(commit(table_words({axis_words(0, 1, 0, 100, 2, {}, {{5, 0, 0, 0}, {5, 1, 1, 0}})}), 5), 3) << "order";
  EXPECT_EQ(commit(table_words({axis_words(0, std::nan(""), 0, 100, 2, {}, {})}), 5), 3) << "not a number";
  EXPECT_EQ(commit(table_words({axis_words(0, 1, 0, 100, 2, {{1, 51, 20, 0}}, {})}), 5), 4) << "slope";
  EXPECT_EQ(commit(table_words({axis_words(0, 1, 0, 201, 2, {}, {})}), 5), 4) << "limit";
  stage(good, 5, crc_of(good));
  EXPECT_EQ(finish(6), 8) << "another sequence";
  stage(good, 0, crc_of(good));
  EXPECT_EQ(finish(0), 8) << "sequence 0";
  stage(good, 5, crc_of(good));
  ASSERT_EQ(write(201, {100}), 0);
  EXPECT_EQ(finish(5), 7) << "scale";
  ASSERT_EQ(write(75, {1}), 0);
  EXPECT_EQ(commit(good, 5), 6) << "axes move";
  ASSERT_EQ(write(75, {0}), 0);
  EXPECT_EQ(commit(good, 5), 0);
  EXPECT_EQ(word(212), 0);
  ASSERT_EQ(write(76, {1}), 0);
  EXPECT_EQ(write(1000, {1}), 4) << "staging while the switch is on";
  EXPECT_EQ(finish(5), 5) << "switch is on";
  EXPECT_EQ(word(211), 5) << "the active table stays";
}

TEST_F(ControllerTest, TakesHostOffsetsOnlyWhileOn) {
  EXPECT_EQ(write_number(144, 5), 4);
  ASSERT_EQ(write(76, {1}), 0);
  EXPECT_EQ(write_number(144, 21), 3) << "too large a step";
  EXPECT_EQ(write_number(144, 15), 0);
  EXPECT_EQ(write_number(144, 30), 0);
  EXPECT_EQ(write_number(144, -1), 3);
  EXPECT_EQ(word(147), 1);
  EXPECT_EQ(number(44), 30);
  for (std::uint16_t beat = 1; beat <= 30; ++beat) {
    ASSERT_EQ(write(11, {beat}), 0);
    wait(5.0);
  }
  EXPECT_EQ(word(147), 1) << "the heartbeat holds it";
  EXPECT_EQ(number(44), 30);
  wait(11.0);
  EXPECT_EQ(word(147), 2) << "the watchdog";
  EXPECT_LT(number(44), 30);
  EXPECT_GT(number(44), 10) << "it ramps, it does not jump";
  wait(20.0);
  EXPECT_EQ(number(44), 0);
  EXPECT_EQ(write(146, {0}), 3);
  EXPECT_EQ(write(146, {60}), 0);
  EXPECT_EQ(write_number(144, 10), 0);
  EXPECT_EQ(word(147), 1);
  wait(50.0);
  EXPECT_EQ(number(44), 10);
  ASSERT_EQ(write(76, {0}), 0);
  wait(25.0);
  EXPECT_EQ(number(44), 0) << "switched off";
  EXPECT_EQ(word(147), 0);
}

TEST_F(ControllerTest, ShowsDeadAndStuckSensors) {
  machine.set_sensor_fault({SensorFault::Kind::dead, true, 3});
  wait(5.0);
  EXPECT_EQ(word(102), 0x8000);
  EXPECT_NE(word(101), 0x8000);
  machine.set_sensor_fault({SensorFault::Kind::stuck, true, 1});
  wait(1.0);
  const auto held = word(100);
  int others = 0;
  for (int i = 0; i < 100; ++i) {
    const auto second = word(101);
    wait(1.0);
    EXPECT_EQ(word(100), held);
    others += word(101) != second ? 1 : 0;
  }
  EXPECT_GT(others, 30);
}

TEST_F(ControllerTest, RepeatsItselfExactly) {
  const auto history = [] {
    Machine own{build_machine(11)};
    own.command_speed(4000);
    own.motion().start_cycle();
    Words seen;
    for (int i = 1; i <= 200; ++i) {
      own.advance_to(i * 7.3);
      for (int s = 0; s <= sensor_count; ++s) seen.push_back(static_cast<std::uint16_t>(own.raw_temperature(s)));
    }
    return seen;
  };
  EXPECT_EQ(history(), history());
}

TEST(Faults, ComeNowAndThenOrAlways) {
  const auto named = [](const std::string& text) { return std::vector<Fault>{*parse_fault(text)}; };
  EXPECT_FALSE(parse_fault("busy:"));
  EXPECT_FALSE(parse_fault(""));
  ReplyFaults rare(named("drop"));
  int dropped = 0;
  for (int i = 0; i < 250; ++i) dropped += rare.next().kind == controller::ReplyFault::Kind::drop ? 1 : 0;
  EXPECT_EQ(dropped, 10);
  ReplyFaults steady(named("late:always"));
  EXPECT_EQ(steady.next().kind, controller::ReplyFault::Kind::late);
  EXPECT_GT(steady.next().delay.count(), 1000);
  EXPECT_EQ(sensor_fault(named("stuck-sensor")).kind, SensorFault::Kind::stuck);
  EXPECT_EQ(sensor_fault(named("busy")).kind, SensorFault::Kind::none);
  const CameraFault spell = camera_fault(named("camera-freeze"), 4000.0, std::nullopt);
  EXPECT_EQ(spell.kind, CameraFault::Kind::freeze);
  EXPECT_EQ(spell.from_machine_s, 5100.0);
  EXPECT_EQ(spell.until_machine_s, 5400.0);
  EXPECT_EQ(camera_fault(named("camera-freeze:always"), 4000.0, std::nullopt).from_machine_s, 0.0);
  EXPECT_EQ(camera_fault(named("camera-occluded"), 4000.0, std::nullopt).kind, CameraFault::Kind::none);
  EXPECT_EQ(camera_fault(named("camera-occluded"), 4000.0, 3600.0).from_machine_s, 5100.0);
  EXPECT_EQ(camera_fault(named("camera-occluded:always"), 4000.0, 3600.0).from_machine_s, 5100.0);
  EXPECT_EQ(camera_fault(named("mark-occluded"), 4000.0, std::nullopt).kind, CameraFault::Kind::none);
  EXPECT_EQ(camera_fault(named("mark-occluded"), 4000.0, 3600.0).kind, CameraFault::Kind::mark_occluded);
}

TEST(Motion, GeometricErrorIsZeroAtTheMeasuringPosition) {
  for (int axis = 0; axis < linear_axes; ++axis) {
    EXPECT_EQ(geometric_error_um(axis, 0.0, true), 0.0);
    EXPECT_EQ(geometric_error_um(axis, 0.0, false), 0.0);
    EXPECT_GT(std::abs(geometric_error_um(axis, 150.0, true) - geometric_error_um(axis, 150.0, false)), 1.0);
  }
}

}  // namespace
}  // namespace zerodrift::machine
