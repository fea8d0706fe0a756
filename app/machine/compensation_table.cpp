#include "app/machine/compensation_table.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "app/machine/motion.h"

namespace zerodrift::machine {
namespace {

/// Words in order; running past the end or a number that is none makes the whole table bad.
class WordReader {
 public:
  explicit WordReader(std::span<const std::uint16_t> words) : m_words(words) {}

  int word() {
    if (m_at >= m_words.size()) {
      m_bad = true;
      return 0;
    }
    return m_words[m_at++];
  }
  double number() {
    const auto high = static_cast<std::uint16_t>(word());
    const auto low = static_cast<std::uint16_t>(word());
    const double value = float_of(high, low);
    if (!std::isfinite(value)) m_bad = true;
    return m_bad ? 0.0 : value;
  }
  bool bad() const { return m_bad; }
  bool at_end() const { return m_at == m_words.size(); }

 private:
  std::span<const std::uint16_t> m_words;
  std::size_t m_at = 0;
  bool m_bad = false;
};

AxisRecord read_record(WordReader& reader, bool& bad) {
  AxisRecord record;
  record.axis = reader.word();
  const int terms = reader.word();
  const int points = reader.word();
  if (reader.word() != 0 || record.axis >= linear_axes) bad = true;
  record.offset_um = reader.number();
  record.reference_mm = reader.number();
  record.largest_um = reader.number();
  record.rate_um_s = reader.number();
  for (int i = 0; i < terms && !reader.bad(); ++i) {
    TableTerm term;
    term.sensor = reader.word();
    term.um_per_K = reader.number();
    term.reference_C = reader.number();
    term.um_per_m_K = reader.number();
    if (term.sensor > 20) bad = true;
    record.terms.push_back(term);
  }
  for (int i = 0; i < points && !reader.bad(); ++i) {
    TablePoint point;
    point.position_mm = reader.number();
    point.up_um = reader.number();
    point.down_um = reader.number();
    point.um_per_K = reader.number();
    if (!record.points.empty() && point.position_mm <= record.points.back().position_mm) bad = true;
    record.points.push_back(point);
  }
  return record;
}

bool beyond_limits(const AxisRecord& record) {
  if (record.largest_um < 0.0 || record.largest_um > largest_compensation_um || record.rate_um_s <= 0.0) return true;
  const double farthest_m = (travel_mm[record.axis] + std::abs(record.reference_mm)) / 1000.0;
  const bool term = std::any_of(record.terms.begin(), record.terms.end(), [&](const TableTerm& one) {
    return std::abs(one.um_per_K) + std::abs(one.um_per_m_K) * farthest_m > largest_slope_um_per_K;
  });
  return term || std::any_of(record.points.begin(), record.points.end(), [](const TablePoint& one) {
           return std::abs(one.um_per_K) > largest_slope_um_per_K || std::abs(one.up_um) > largest_compensation_um ||
                  std::abs(one.down_um) > largest_compensation_um;
         });
}

double points_um(const AxisRecord& record, double position_mm, bool upwards, double first_difference_K) {
  const auto value = [&](const TablePoint& point) {
    return (upwards ? point.up_um : point.down_um) + point.um_per_K * first_difference_K;
  };
  const auto& points = record.points;
  if (points.empty()) return 0.0;
  if (position_mm <= points.front().position_mm) return value(points.front());
  if (position_mm >= points.back().position_mm) return value(points.back());
  const auto after = std::upper_bound(points.begin(), points.end(), position_mm,
                                      [](double at, const TablePoint& point) { return at < point.position_mm; });
  const TablePoint& low = *(after - 1);
  const double part = (position_mm - low.position_mm) / (after->position_mm - low.position_mm);
  return (1.0 - part) * value(low) + part * value(*after);
}

}  // namespace

float float_of(std::uint16_t high, std::uint16_t low) {
  return std::bit_cast<float>(static_cast<std::uint32_t>(high) << 16U | low);
}

std::array<std::uint16_t, 2> words_of(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  return {static_cast<std::uint16_t>(bits >> 16U), static_cast<std::uint16_t>(bits)};
}

tl::expected<CompensationTable, Rejection> decode_table(std::span<const std::uint16_t> words) {
  WordReader reader(words);
  bool bad = reader.word() != 1;
  const int records = reader.word();
  if (records > linear_axes) bad = true;
  CompensationTable table;
  for (int i = 0; i < records && !bad && !reader.bad(); ++i) {
    table.push_back(read_record(reader, bad));
    const auto same = [&](const AxisRecord& other) { return other.axis == table.back().axis; };
    if (std::count_if(table.begin(), table.end(), same) > 1) bad = true;
  }
  if (bad || reader.bad() || !reader.at_end()) return tl::unexpected(Rejection::format);
  if (std::any_of(table.begin(), table.end(), beyond_limits)) return tl::unexpected(Rejection::limit);
  return table;
}

double evaluate(const AxisRecord& record, double position_mm, bool upwards, const TableTemperatures& temperature_C) {
  double sum_um = record.offset_um;
  double first_difference_K = 0.0;
  for (std::size_t i = 0; i < record.terms.size(); ++i) {
    const TableTerm& term = record.terms[i];
    const double difference_K = temperature_C[term.sensor] - term.reference_C;
    if (i == 0) first_difference_K = difference_K;
    sum_um += (term.um_per_K + term.um_per_m_K * (position_mm - record.reference_mm) / 1000.0) * difference_K;
  }
  sum_um += points_um(record, position_mm, upwards, first_difference_K);
  return std::clamp(sum_um, -record.largest_um, record.largest_um);
}

}  // namespace zerodrift::machine
