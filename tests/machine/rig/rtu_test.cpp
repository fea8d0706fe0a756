// The rig's temperature modules and probe amplifier, down to the bytes on their lines. CRCs here are not computed by
// the product: "01 04 00 00 00 08 F1 CC" is the usual example of the literature, the others come from mbpoll and
// pymodbus.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "app/machine/compensation_table.h"
#include "app/machine/rig/rig_registers.h"
#include "app/machine/rig/serial_line.h"

namespace zerodrift::machine {
namespace {

using Bytes = std::vector<std::uint8_t>;

/// Bit by bit from the other side: the generator polynomial x^16 + x^15 + x^2 + 1, reflected.
Bytes with_crc(Bytes frame) {
  unsigned crc = 0xFFFF;
  for (const std::uint8_t byte : frame) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      const bool carry = ((crc ^ (byte >> bit)) & 1U) != 0;
      crc = crc >> 1U ^ (carry ? 0xA001U : 0U);
    }
  }
  frame.push_back(static_cast<std::uint8_t>(crc));
  frame.push_back(static_cast<std::uint8_t>(crc >> 8U));
  return frame;
}

/// Units 1 and 2 with eight registers: 100 * unit + address.
RtuUnits two_units() {
  const auto unit = [](int number) -> RegisterReader {
    return [number](int address, int count) -> controller::RegisterReply {
      if (address + count > 8) return tl::unexpected(controller::ModbusException::illegal_address);
      std::vector<std::uint16_t> words;
      for (int i = 0; i < count; ++i) words.push_back(static_cast<std::uint16_t>(100 * number + address + i));
      return words;
    };
  };
  return RtuUnits({{1, unit(1)}, {2, unit(2)}});
}

TEST(RtuUnits, AnswersItsUnitWithTheRightCrc) {
  EXPECT_EQ(with_crc({1, 4, 0, 0, 0, 8}), (Bytes{1, 4, 0, 0, 0, 8, 0xF1, 0xCC})) << "the test's own CRC";
  const RtuUnits units = two_units();
  EXPECT_EQ(units.answer(Bytes{1, 4, 0, 0, 0, 2, 0x71, 0xCB}), with_crc({1, 4, 4, 0, 100, 0, 101}));
  EXPECT_EQ(units.answer(with_crc({2, 4, 0, 6, 0, 2})), with_crc({2, 4, 4, 0, 206, 0, 207}));
  EXPECT_EQ(units.answer(with_crc({2, 3, 0, 0, 0, 1})), with_crc({2, 3, 2, 0, 200})) << "function 3 alike";
}

TEST(RtuUnits, IsSilentToWhatIsNotItsOwn) {
  const RtuUnits units = two_units();
  EXPECT_TRUE(units.answer(with_crc({3, 4, 0, 0, 0, 8})).empty()) << "another unit";
  EXPECT_TRUE(units.answer(with_crc({0, 4, 0, 0, 0, 8})).empty()) << "broadcast";
  EXPECT_TRUE(units.answer(Bytes{1, 4, 0, 0, 0, 8, 0xF1, 0xCD}).empty()) << "wrong CRC";
  EXPECT_TRUE(units.answer(Bytes{1, 4, 0, 0, 0, 8, 0xF1}).empty()) << "cut off";
  EXPECT_TRUE(units.answer(Bytes{}).empty());
}

TEST(RtuUnits, RefusesWithTheStandardsExceptions) {
  const RtuUnits units = two_units();
  EXPECT_EQ(units.answer(with_crc({1, 1, 0, 0, 0, 1})), with_crc({1, 0x81, 1})) << "coils";
  EXPECT_EQ(units.answer(with_crc({1, 6, 0, 0, 0, 1})), with_crc({1, 0x86, 1})) << "writing";
  EXPECT_EQ(units.answer(with_crc({1, 4, 0, 4, 0, 8})), with_crc({1, 0x84, 2})) << "beyond the last register";
  EXPECT_EQ(units.answer(with_crc({1, 4, 0, 0, 0, 0})), with_crc({1, 0x84, 3})) << "none";
  EXPECT_EQ(units.answer(with_crc({1, 4, 0, 0, 0, 126})), with_crc({1, 0x84, 3})) << "too many";
  EXPECT_EQ(units.answer(with_crc({1, 3, 0, 0, 0})), with_crc({1, 0x83, 3})) << "a request that is too short";
}

/// A host's end of the line.
class Port {
 public:
  explicit Port(const std::string& path) : m_handle(::open(path.c_str(), O_RDWR | O_NOCTTY)) {}
  ~Port() { ::close(m_handle); }
  Port(const Port&) = delete;
  Port& operator=(const Port&) = delete;

  void send(const Bytes& bytes) const { ASSERT_EQ(::write(m_handle, bytes.data(), bytes.size()), bytes.size()); }
  /// What comes until nothing more has come for a while.
  Bytes hear(int wait_ms = 150) const {
    Bytes heard;
    pollfd wait{m_handle, POLLIN, 0};
    while (::poll(&wait, 1, heard.empty() ? wait_ms : 20) > 0) {
      std::uint8_t byte = 0;
      if (::read(m_handle, &byte, 1) != 1) break;
      heard.push_back(byte);
    }
    return heard;
  }
  Bytes ask(const Bytes& request) const {
    send(request);
    return hear();
  }

 private:
  int m_handle;
};

TEST(SerialLine, TwoUnitsShareALine) {
  const auto line = SerialLine::open(two_units());
  ASSERT_TRUE(line);
  const Port port((*line)->path());
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(port.ask(with_crc({1, 4, 0, 0, 0, 1})), with_crc({1, 4, 2, 0, 100}));
    EXPECT_EQ(port.ask(with_crc({2, 4, 0, 0, 0, 1})), with_crc({2, 4, 2, 0, 200}));
  }
  EXPECT_TRUE(port.ask(with_crc({3, 4, 0, 0, 0, 1})).empty());
}

TEST(SerialLine, HearsTheNextRequestAfterASpoiltOne) {
  const auto line = SerialLine::open(two_units());
  ASSERT_TRUE(line);
  const Port port((*line)->path());
  EXPECT_TRUE(port.ask({1, 4, 0, 0}).empty()) << "half a request, then silence";
  EXPECT_EQ(port.ask(with_crc({1, 4, 0, 0, 0, 1})), with_crc({1, 4, 2, 0, 100}));
}

TEST(SerialLine, OutlivesItsHosts) {
  const auto line = SerialLine::open(two_units());
  ASSERT_TRUE(line);
  for (int i = 0; i < 3; ++i) {
    const Port port((*line)->path());
    EXPECT_EQ(port.ask(with_crc({2, 4, 0, 1, 0, 1})), with_crc({2, 4, 2, 0, 201})) << "host " << i;
  }
}

class RigRegistersTest : public ::testing::Test {
 protected:
  LiveMachine machine{build_machine(7), 1, {}, RegisterScope::control_alone};
};

TEST_F(RigRegistersTest, ModulesHoldTheSensorsInHundredths) {
  const auto first = read_temperature_module(machine, 1, 0, 8);
  const auto second = read_temperature_module(machine, 9, 0, 8);
  ASSERT_TRUE(first && second);
  machine.with([&](const Machine& now) {
    for (int i = 0; i < 8; ++i) {
      EXPECT_NEAR((*first)[i] * 0.01, now.raw_temperature(1 + i) / 16.0, 0.0051);
      EXPECT_NEAR((*second)[i] * 0.01, now.raw_temperature(9 + i) / 16.0, 0.0051);
    }
  });
  EXPECT_EQ(read_temperature_module(machine, 1, 7, 1)->size(), 1U);
  EXPECT_EQ(read_temperature_module(machine, 1, 7, 2).error(), controller::ModbusException::illegal_address);
}

TEST_F(RigRegistersTest, ADeadSensorIsAnOpenChannel) {
  machine.set_sensor_fault({SensorFault::Kind::dead, true, 10});
  machine.with([](Machine& now) { now.advance_to(2.0); });
  const auto module = read_temperature_module(machine, 9, 0, 3);
  ASSERT_TRUE(module);
  EXPECT_EQ((*module)[1], 0x8000);
  EXPECT_NE((*module)[0], 0x8000);
  EXPECT_NE((*module)[2], 0x8000);
}

TEST_F(RigRegistersTest, TheAmplifierMeasuresAtTheNestAlone) {
  const auto value = [](const std::vector<std::uint16_t>& words, int probe) {
    return float_of(words[2 + 2 * probe], words[3 + 2 * probe]);
  };
  const auto near = read_probe_amplifier(machine, 0, 12);
  ASSERT_TRUE(near);
  EXPECT_EQ((*near)[0], 1);
  machine.with([&](const Machine& now) {
    for (int i = 0; i < 5; ++i) EXPECT_FLOAT_EQ(value(*near, i), static_cast<float>(now.probes_um()[i]));
  });
  machine.with([](Machine& now) {
    now.motion().move_to({50.0, 0.0, 0.0});
    now.advance_to(now.time_s() + 2.0);
  });
  const auto far = read_probe_amplifier(machine, 0, 12);
  ASSERT_TRUE(far);
  EXPECT_EQ((*far)[0], 0);
  for (int i = 0; i < 5; ++i) EXPECT_TRUE(std::isnan(value(*far, i)));
  EXPECT_FALSE(read_probe_amplifier(machine, 0, 13));
}

TEST_F(RigRegistersTest, TheControlAloneHasNoTemperaturesAndNoProbes) {
  using controller::ModbusException;
  for (const int address : {96, 100, 119, 127, 160, 162, 171}) {
    EXPECT_EQ(machine.read(address, 1).error(), ModbusException::illegal_address) << address;
  }
  EXPECT_EQ(machine.read(90, 10).error(), ModbusException::illegal_address) << "across the border";
  EXPECT_EQ(machine.read(2, 1)->front(), 0b0111) << "no probes";
  for (const int address : {0, 30, 95, 140, 147, 200, 1000, 4000}) EXPECT_TRUE(machine.read(address, 1)) << address;
}

}  // namespace
}  // namespace zerodrift::machine
