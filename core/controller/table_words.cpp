#include "core/controller/table_words.h"

#include <fmt/format.h>

#include "core/base/hash.h"
#include "core/compensation/sign.h"
#include "core/controller/register_map.h"

namespace zerodrift::controller {
namespace {

using compensation::AxisTable;
using compensation::Table;
using compensation::TablePoint;
using compensation::TemperatureTerm;

constexpr int words_format = 1;
const std::array<std::string, 3> axis_names = {"X", "Y", "Z"};

std::uint16_t word(std::size_t value) {
  return static_cast<std::uint16_t>(value);
}

void put(std::vector<std::uint16_t>& words, double value) {
  append_float(words, static_cast<float>(value));
}

/// An error becomes a compensation; -0 is written as 0, so that equal tables have equal words.
void put_negated(std::vector<std::uint16_t>& words, double error) {
  put(words, compensation::compensation_from_error_um(error) + 0.0);
}

Status encode_axis(std::size_t number, const AxisTable& axis, const Profile& profile,
                   std::vector<std::uint16_t>& words) {
  words.insert(words.end(), {word(number), word(axis.terms.size()), word(axis.points.size()), 0});
  put_negated(words, axis.offset_um);
  put(words, axis.reference_position_mm);
  put(words, axis.max_um);
  put(words, axis.max_um_per_s);
  for (const TemperatureTerm& term : axis.terms) {
    ZD_TRY(const int sensor, sensor_number(profile, term.sensor));
    words.push_back(word(static_cast<std::size_t>(sensor)));
    put_negated(words, term.um_per_K);
    put(words, term.reference_C);
    put_negated(words, term.slope_um_per_m_per_K);
  }
  for (const TablePoint& point : axis.points) {
    if (point.um_per_K != 0.0 && axis.terms.empty()) {
      return fail(ErrorCode::bad_argument, {{"what", "um_per_K of a point of axis " + axis_names[number]},
                                            {"found", fmt::format("{}", point.um_per_K)},
                                            {"expected", "0, because the axis has no temperature term"}});
    }
    put(words, point.position_mm);
    put_negated(words, point.error_up_um);
    put_negated(words, point.error_down_um);
    put_negated(words, point.um_per_K);
  }
  return {};
}

tl::unexpected<Error> not_a_table(const std::string& found, const std::string& expected) {
  return fail(ErrorCode::wrong_format, {{"file", "the controller's table"}, {"found", found}, {"expected", expected}});
}

/// Takes words one after another; never reads past the end.
class Reader {
 public:
  explicit Reader(std::span<const std::uint16_t> words) : m_words(words) {}
  bool has(std::size_t count) const { return m_at + count <= m_words.size(); }
  std::size_t number() { return m_words[m_at++]; }
  double real() {
    const double value = static_cast<double>(float_at(m_words, m_at));
    m_at += 2;
    return value;
  }
  double negated() { return -real() + 0.0; }
  std::size_t left() const { return m_words.size() - m_at; }

 private:
  std::span<const std::uint16_t> m_words;
  std::size_t m_at = 0;
};

Status decode_axis(Reader& reader, const Profile& profile, Table& table) {
  if (!reader.has(12)) return not_a_table("it ends early", "an axis record of 12 words");
  const std::size_t number = reader.number();
  const std::size_t terms = reader.number();
  const std::size_t points = reader.number();
  reader.number();
  if (number >= axis_names.size() || table.axes.contains(axis_names[number])) {
    return not_a_table(fmt::format("axis {}", number), "axes 0 to 2, each once");
  }
  AxisTable axis;
  axis.offset_um = reader.negated();
  axis.reference_position_mm = reader.real();
  axis.max_um = reader.real();
  axis.max_um_per_s = reader.real();
  if (!reader.has(7 * terms + 8 * points)) return not_a_table("it ends early", "all terms and points");
  for (std::size_t i = 0; i < terms; ++i) {
    TemperatureTerm term;
    ZD_TRY(term.sensor, sensor_channel(profile, static_cast<int>(reader.number())));
    term.um_per_K = reader.negated();
    term.reference_C = reader.real();
    term.slope_um_per_m_per_K = reader.negated();
    axis.terms.push_back(term);
  }
  for (std::size_t i = 0; i < points; ++i) {
    TablePoint point;
    point.position_mm = reader.real();
    point.error_up_um = reader.negated();
    point.error_down_um = reader.negated();
    point.um_per_K = reader.negated();
    axis.points.push_back(point);
  }
  table.axes[axis_names[number]] = std::move(axis);
  return {};
}

}  // namespace

Result<std::vector<std::uint16_t>> encode_table(const Table& table, const Profile& profile, int capacity) {
  ZD_CHECK(compensation::check(table));
  std::vector<std::uint16_t> words{word(words_format), word(table.axes.size())};
  for (std::size_t i = 0; i < axis_names.size(); ++i) {
    const auto at = table.axes.find(axis_names[i]);
    if (at != table.axes.end()) ZD_CHECK(encode_axis(i, at->second, profile, words));
  }
  if (static_cast<int>(words.size()) > capacity) {
    return fail(ErrorCode::limit_exceeded, {{"what", "the size of the table in registers"},
                                            {"found", std::to_string(words.size())},
                                            {"limit", std::to_string(capacity)}});
  }
  return words;
}

Result<Table> decode_table(std::span<const std::uint16_t> words, const Profile& profile) {
  Table table;
  table.machine = profile.name;
  table.serial = profile.serial;
  if (words.empty()) return table;
  Reader reader(words);
  if (!reader.has(2)) return not_a_table("1 word", "at least 2");
  const std::size_t format = reader.number();
  if (format != words_format) return not_a_table(fmt::format("format {}", format), "format 1");
  const std::size_t axes = reader.number();
  for (std::size_t i = 0; i < axes; ++i) ZD_CHECK(decode_axis(reader, profile, table));
  if (reader.left() != 0) return not_a_table(fmt::format("{} words too many", reader.left()), "the end");
  if (auto good = compensation::check(table); !good) return not_a_table(describe(good.error()), "a valid table");
  return table;
}

compensation::ModelTableOptions table_options(const Profile& profile) {
  return {profile.name, profile.serial, profile.max_um, profile.max_um_per_s, profile.max_um_per_K};
}

std::uint32_t crc_of_words(std::span<const std::uint16_t> words) {
  return crc32_of(bytes_of(words));
}

}  // namespace zerodrift::controller
