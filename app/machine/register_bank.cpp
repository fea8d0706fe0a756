#include "app/machine/register_bank.h"

#include <algorithm>
#include <cmath>

#include "app/machine/nominal.h"

namespace zerodrift::machine {
namespace {

using controller::ModbusException;

constexpr int image_size = 220;
constexpr int staging_first = 1000;
constexpr int active_first = 4000;

struct Block {
  int first;
  int last;
};
constexpr Block staging{staging_first, staging_first + table_capacity - 1};
constexpr Block active{active_first, active_first + table_capacity - 1};
constexpr std::array whole_machine{Block{0, 127}, Block{140, 175}, Block{200, 219}, staging, active};
constexpr std::array control_alone{Block{0, 95}, Block{140, 159}, Block{200, 219}, staging, active};
constexpr int can_probe = 0b1000;  // capability bit

/// Puts values into the image in the map's order of words.
class ImageWriter {
 public:
  explicit ImageWriter(std::vector<std::uint16_t>& words) : m_words(words) {}
  void word(int address, int value) { m_words[address] = static_cast<std::uint16_t>(value); }
  void number(int address, double value) {
    const auto words = words_of(static_cast<float>(value));
    m_words[address] = words[0];
    m_words[address + 1] = words[1];
  }
  void wide(int address, std::uint32_t value) {
    m_words[address] = static_cast<std::uint16_t>(value >> 16U);
    m_words[address + 1] = static_cast<std::uint16_t>(value);
  }

 private:
  std::vector<std::uint16_t>& m_words;
};

void write_state(ImageWriter& out, const Machine& machine) {
  const Motion& motion = machine.motion();
  const Compensator& compensator = machine.compensator();
  out.word(16, (motion.cycling() ? 1 : 0) | (motion.moving() ? 2 : 0) | 4);
  out.word(17, compensator.is_on() ? 1 : 0);
  out.word(18, machine.coolant_on() ? 1 : 0);
  for (int axis = 0; axis < linear_axes; ++axis) {
    out.number(20 + 2 * axis, motion.position_mm()[axis]);
    out.number(34 + 2 * axis, motion.mean_feed_mm_min(axis));
    out.number(40 + 2 * axis, compensator.applied_um(axis));
    out.number(140 + 2 * axis, compensator.offset_um(axis));
  }
  out.number(26, motion.rotation_deg(0));
  out.number(28, motion.rotation_deg(1));
  out.number(30, machine.speed_rpm());
  out.number(32, machine.spindle_load_W());
  out.word(70, motion.moving() ? 1 : 0);
  out.number(72, machine.commanded_rpm());
  out.word(74, machine.coolant_on() ? 1 : 0);
  out.word(75, motion.cycling() ? 1 : 0);
  out.word(76, compensator.is_on() ? 1 : 0);
  out.word(96, machine.raw_temperature(0));
  for (int sensor = 1; sensor <= sensor_count; ++sensor) out.word(99 + sensor, machine.raw_temperature(sensor));
  out.word(146, static_cast<int>(compensator.watchdog_s));
  out.word(147, static_cast<int>(compensator.offset_state()));
  const bool nest = machine.at_nest();
  out.word(160, nest ? 1 : 0);
  const auto probes = machine.probes_um();
  for (int i = 0; i < 5; ++i) out.number(162 + 2 * i, nest ? probes[i] : 0.0);
}

void write_table(ImageWriter& out, const TableStore& store, double ramp) {
  out.word(200, store.count);
  out.word(201, store.scale);
  out.wide(202, store.crc);
  out.word(204, store.sequence);
  out.word(205, store.pending());
  out.word(206, static_cast<int>(store.status()));
  out.word(207, store.status_sequence());
  out.wide(208, store.active_crc());
  out.word(210, store.active_count());
  out.word(211, store.active_sequence());
  out.word(212, static_cast<int>(store.reason()));
  out.word(213, static_cast<int>(std::lround(ramp * 100.0)));
}

double number_of(std::span<const std::uint16_t> words) {
  return float_of(words[0], words[1]);
}

bool is_switch(std::uint16_t word) {
  return word <= 1;
}

}  // namespace

/// One writable value: what it takes, and what it does.
struct RegisterBank::Field {
  int address;
  int words;
  std::optional<ModbusException> (*refuse)(const RegisterBank&, std::span<const std::uint16_t>);
  void (*apply)(RegisterBank&, std::span<const std::uint16_t>);
};

namespace {

using Words = std::span<const std::uint16_t>;
using Refusal = std::optional<ModbusException>;

Refusal when(bool bad) {
  return bad ? Refusal(ModbusException::illegal_value) : std::nullopt;
}

}  // namespace

std::span<const RegisterBank::Field> RegisterBank::fields() {
  using Bank = RegisterBank;
  static constexpr auto anything = [](const Bank&, Words) -> Refusal { return std::nullopt; };
  static constexpr auto zero_or_one = [](const Bank&, Words w) { return when(!is_switch(w[0])); };
  static constexpr auto target = []<int axis>(const Bank&, Words w) -> Refusal {
    return when(!(std::abs(number_of(w)) <= travel_mm[axis]));
  };
  static constexpr auto offset = []<int axis>(const Bank& b, Words w) -> Refusal {
    if (!b.m_machine.compensator().is_on()) return ModbusException::device_failure;
    return when(!b.m_machine.compensator().offset_allowed(axis, number_of(w)));
  };
  static constexpr std::array table{
      Field{11, 1, anything,
            [](Bank& b, Words w) {
              if (w[0] != b.m_host_beat) b.m_machine.compensator().host_beat();
              b.m_host_beat = w[0];
            }},
      Field{64, 2, [](const Bank& b, Words w) { return target.operator()<0>(b, w); },
            [](Bank& b, Words w) { b.m_target_mm[0] = number_of(w); }},
      Field{66, 2, [](const Bank& b, Words w) { return target.operator()<1>(b, w); },
            [](Bank& b, Words w) { b.m_target_mm[1] = number_of(w); }},
      Field{68, 2, [](const Bank& b, Words w) { return target.operator()<2>(b, w); },
            [](Bank& b, Words w) { b.m_target_mm[2] = number_of(w); }},
      Field{70, 1, zero_or_one,
            [](Bank& b, Words w) {
              if (w[0] == 1) b.m_machine.motion().move_to(b.m_target_mm);
            }},
      Field{72, 2,
            [](const Bank&, Words w) { return when(!(number_of(w) >= 0.0 && number_of(w) <= nominal::top_speed_rpm)); },
            [](Bank& b, Words w) { b.m_machine.command_speed(number_of(w)); }},
      Field{74, 1, zero_or_one, [](Bank& b, Words w) { b.m_machine.command_coolant(w[0] == 1); }},
      Field{75, 1, zero_or_one,
            [](Bank& b, Words w) {
              if (w[0] == 1) {
                b.m_machine.motion().start_cycle();
              } else if (b.m_machine.motion().cycling()) {
                b.m_machine.motion().stop();
              }
            }},
      Field{76, 1, zero_or_one, [](Bank& b, Words w) { b.m_machine.compensator().switch_to(w[0] == 1); }},
      Field{140, 2, [](const Bank& b, Words w) { return offset.operator()<0>(b, w); },
            [](Bank& b, Words w) { b.m_machine.compensator().write_offset(0, number_of(w)); }},
      Field{142, 2, [](const Bank& b, Words w) { return offset.operator()<1>(b, w); },
            [](Bank& b, Words w) { b.m_machine.compensator().write_offset(1, number_of(w)); }},
      Field{144, 2, [](const Bank& b, Words w) { return offset.operator()<2>(b, w); },
            [](Bank& b, Words w) { b.m_machine.compensator().write_offset(2, number_of(w)); }},
      Field{146, 1, [](const Bank&, Words w) { return when(w[0] == 0); },
            [](Bank& b, Words w) { b.m_machine.compensator().watchdog_s = w[0]; }},
      Field{200, 1, anything, [](Bank& b, Words w) { b.m_machine.table_store().count = w[0]; }},
      Field{201, 1, anything, [](Bank& b, Words w) { b.m_machine.table_store().scale = w[0]; }},
      Field{202, 2, anything,
            [](Bank& b, Words w) { b.m_machine.table_store().crc = static_cast<std::uint32_t>(w[0]) << 16U | w[1]; }},
      Field{204, 1, anything, [](Bank& b, Words w) { b.m_machine.table_store().sequence = w[0]; }},
      Field{205, 1, anything, [](Bank& b, Words w) { b.m_machine.table_store().commit(w[0]); }},
  };
  return table;
}

RegisterBank::RegisterBank(Machine& machine, std::uint32_t serial, int time_factor, RegisterScope scope)
    : m_machine(machine), m_serial(serial), m_time_factor(time_factor), m_scope(scope) {}

bool RegisterBank::holds(int address, int count) const {
  const auto& blocks = m_scope == RegisterScope::whole_machine ? whole_machine : control_alone;
  return std::any_of(blocks.begin(), blocks.end(),
                     [&](const Block& block) { return address >= block.first && address + count - 1 <= block.last; });
}

std::vector<std::uint16_t> RegisterBank::image() const {
  std::vector<std::uint16_t> words(image_size, 0);
  ImageWriter out(words);
  out.word(0, 0x5A44);
  out.word(1, 1);
  out.word(2, 0b0111 | (m_scope == RegisterScope::whole_machine ? can_probe : 0));
  out.word(3, table_capacity);
  out.wide(4, m_serial);
  out.word(6, sensor_count);
  out.word(7, 5);
  out.wide(8, static_cast<std::uint32_t>(static_cast<std::uint64_t>(m_machine.time_s() * 100.0)));
  out.word(10, static_cast<int>(static_cast<std::uint64_t>(m_machine.time_s()) & 0xFFFFU));
  out.word(11, m_host_beat);
  out.word(12, m_time_factor);
  for (int axis = 0; axis < linear_axes; ++axis) out.number(64 + 2 * axis, m_target_mm[axis]);
  write_state(out, m_machine);
  write_table(out, m_machine.table_store(), m_machine.compensator().ramp());
  return words;
}

controller::RegisterReply RegisterBank::read(int address, int count) const {
  if (!holds(address, count)) return tl::unexpected(ModbusException::illegal_address);
  std::vector<std::uint16_t> words(static_cast<std::size_t>(count));
  if (address < image_size) {
    const auto all = image();
    std::copy_n(all.begin() + address, count, words.begin());
    return words;
  }
  for (int i = 0; i < count; ++i) {
    words[i] = address >= active_first ? m_machine.table_store().active(address - active_first + i)
                                       : m_machine.table_store().staged(address - staging_first + i);
  }
  return words;
}

const RegisterBank::Field* RegisterBank::field_at(int address) {
  const auto all = fields();
  const auto at = std::find_if(all.begin(), all.end(), [&](const Field& field) {
    return address >= field.address && address < field.address + field.words;
  });
  return at == all.end() ? nullptr : &*at;
}

Refusal RegisterBank::check(int address, Words words) const {
  for (std::size_t i = 0; i < words.size();) {
    const int at = address + static_cast<int>(i);
    const Field* field = field_at(at);
    if (field == nullptr) return ModbusException::illegal_address;
    // half a number is no number
    if (field->address != at || words.size() - i < static_cast<std::size_t>(field->words)) {
      return ModbusException::illegal_value;
    }
    if (const Refusal refused = field->refuse(*this, words.subspan(i))) return refused;
    i += static_cast<std::size_t>(field->words);
  }
  return std::nullopt;
}

Refusal RegisterBank::write(int address, Words words) {
  const int count = static_cast<int>(words.size());
  if (!holds(address, count)) return ModbusException::illegal_address;
  if (address >= active_first) return ModbusException::illegal_address;
  if (address >= staging_first) {
    if (m_machine.compensator().is_on()) return ModbusException::device_failure;
    for (int i = 0; i < count; ++i) m_machine.table_store().stage(address - staging_first + i, words[i]);
    return std::nullopt;
  }
  if (const Refusal refused = check(address, words)) return refused;
  for (std::size_t i = 0; i < words.size();) {
    const Field* field = field_at(address + static_cast<int>(i));
    field->apply(*this, words.subspan(i));
    i += static_cast<std::size_t>(field->words);
  }
  return std::nullopt;
}

}  // namespace zerodrift::machine
