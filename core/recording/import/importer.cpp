#include "core/recording/import/importer.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "core/base/file.h"
#include "core/recording/import/cell_words.h"
#include "core/recording/import/clock_text.h"
#include "core/recording/import/column_names.h"
#include "core/recording/import/units.h"
#include "core/recording/unit_suspicion.h"

namespace zerodrift::recording {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

/// What the cells of a column are, over all rows that are kept.
struct CellKinds {
  std::size_t numbers = 0;
  std::size_t switches = 0;
  std::size_t words = 0;
  std::size_t clocks = 0;
  std::optional<std::size_t> first_word;    // row
  std::optional<std::size_t> first_switch;  // row
  bool word_like_number = false;            // "12:30a", "0x1F": may be meant as a number
  std::map<std::string, int> missing;
};

/// Twelve significant digits, which every measured number survives: 0.00042 mm are 0.42 um, not 0.42000000000000004.
double without_rounding_residue(double value) {
  const std::string text = fmt::format("{:.12g}", value);
  double rounded = value;
  std::from_chars(text.data(), text.data() + text.size(), rounded);
  return rounded;
}

bool equals_ignoring_case(std::string_view a, std::string_view b) {
  return a.size() == b.size() && std::equal(a.begin(), a.end(), b.begin(), [](char x, char y) {
           return std::tolower(static_cast<unsigned char>(x)) == std::tolower(static_cast<unsigned char>(y));
         });
}

/// Reads one file; a column after the other.
class Importer {
 public:
  Importer(SourceTable table, const HeaderMap& map) : m_table(std::move(table)), m_map(map) {}

  Result<Imported> run() {
    find_labels();
    ZD_CHECK(check_map());
    Imported out;
    ZD_TRY(out.time, read_time(m_table, m_map, m_labels));
    out.form = m_table.form;
    out.recording.name = m_table.form.file;
    out.recording.time_s = out.time.time_s;
    out.warnings = m_table.remarks;
    out.warnings.insert(out.warnings.end(), out.time.warnings.begin(), out.time.warnings.end());
    for (std::size_t column = 0; column < m_table.columns(); ++column) {
      ZD_CHECK(read_column(column, out));
    }
    ZD_CHECK(check_channels(out));
    ZD_CHECK(check_axes(out));
    suspect_units(out);
    return out;
  }

 private:
  /// "CH1, FRONT BRG, TEMP, ..." in the block: what the logger calls the column, and its unit.
  void find_labels() {
    m_labels.resize(m_table.columns());
    m_block_units.resize(m_table.columns());
    std::map<std::string_view, std::size_t> columns;
    for (std::size_t c = 0; c < m_table.columns(); ++c) columns.emplace(m_table.names[c], c);
    for (std::size_t row = 0; row < m_table.block_end; ++row) {
      const auto column = columns.find(m_table.cells.at(row, 0));
      if (column == columns.end() || m_table.cells.at(row, 0).empty()) continue;
      const std::string_view label = m_table.cells.at(row, 1);
      if (!label.empty() && !looks_like_number(label) && label.size() < 60) m_labels[column->second] = label;
      std::set<std::string> units;
      for (std::size_t cell = 2; cell < m_table.cells.columns(row); ++cell) {
        const std::string_view text = m_table.cells.at(row, cell);
        // One letter may be the kind of a thermocouple.
        if (text.size() > 1 && is_unit_word(text)) units.emplace(text);
      }
      if (units.size() == 1) m_block_units[column->second] = *units.begin();
    }
  }

  Status check_map() const {
    if (!m_table.has_header && m_map.columns.empty()) {
      return fail(ErrorCode::table_no_header, {{"file", m_table.form.file}, {"line", std::to_string(m_table.line(0))}});
    }
    const auto lost = m_map.names_without_column(m_table.names, m_labels);
    if (lost.empty()) return {};
    std::string available;
    for (std::size_t c = 0; c < m_table.columns(); ++c) available += (c == 0 ? "" : ", ") + m_table.name_of(c);
    return fail(ErrorCode::map_column_missing,
                {{"file", m_table.form.file}, {"column", lost.front()}, {"available", available}});
  }

  bool is_missing(std::string_view cell) const {
    return means_missing(cell) || std::any_of(m_map.missing.begin(), m_map.missing.end(),
                                              [&](const auto& word) { return equals_ignoring_case(cell, word); });
  }

  CellKinds kinds_of(std::size_t column, const std::vector<std::size_t>& rows) const {
    CellKinds kinds;
    for (const std::size_t row : rows) {
      const std::string_view cell = m_table.cell(row, column);
      if (cell.empty()) continue;
      if (is_missing(cell)) {
        if (kinds.missing.size() < 100) ++kinds.missing[std::string(cell)];
      } else if (m_table.form.numbers.number(cell)) {
        ++kinds.numbers;
      } else if (switch_value(cell)) {
        ++kinds.switches;
        if (!kinds.first_switch) kinds.first_switch = row;
      } else {
        ++kinds.words;
        if (!kinds.first_word) kinds.first_word = row;
        const bool clock = read_clock_text(cell).has_value();
        kinds.clocks += clock;
        const bool sign = std::string_view("+-.,0123456789").find(cell.front()) != std::string_view::npos;
        kinds.word_like_number = kinds.word_like_number || (sign && !clock);
      }
    }
    return kinds;
  }

  StatedUnit stated_unit(std::size_t column) const {
    if (is_unit_word(m_table.units[column])) return {m_table.units[column], "units-row"};
    if (split_unit(m_table.names[column]).unit.empty() && !m_block_units[column].empty()) {
      return {m_block_units[column], "block"};
    }
    return {};
  }

  tl::unexpected<Error> bad_cell(std::size_t row, std::size_t column) const {
    return fail(ErrorCode::csv_bad_number, {{"file", m_table.form.file},
                                            {"line", std::to_string(m_table.line(row))},
                                            {"column", m_table.name_of(column)},
                                            {"found", shortened(std::string(m_table.cell(row, column)))}});
  }

  Status read_column(std::size_t column, Imported& out) {
    ColumnFate fate;
    fate.place = column + 1;
    fate.name = m_table.names[column];
    fate.label = m_labels[column];
    if (std::find(out.time.columns.begin(), out.time.columns.end(), column) != out.time.columns.end()) {
      fate.fate = "time";
      out.columns.push_back(std::move(fate));
      return {};
    }
    const auto* rule = m_map.rule_for(fate.name, fate.label, column);
    if (rule != nullptr && !*rule) {
      fate.fate = "dropped";
      out.columns.push_back(std::move(fate));
      return {};
    }
    const CellKinds kinds = kinds_of(column, out.time.rows);
    fate.missing = kinds.missing;
    if (rule == nullptr && leave_out(kinds, column, out.time.rows, fate)) {
      out.columns.push_back(std::move(fate));
      return {};
    }
    if (rule == nullptr) ZD_CHECK(no_factor(column, fate));
    ZD_CHECK(rule != nullptr ? name_by_map(**rule, column, fate) : name_by_itself(column, fate));
    fate.fate = "channel";
    ZD_TRY(std::vector<double> values, values_of(kinds, column, out.time.rows, fate));
    tell(kinds, column, values, rule != nullptr, fate, out.warnings);
    out.recording.channels.push_back({fate.channel, std::move(values)});
    out.columns.push_back(std::move(fate));
    return {};
  }

  /// Columns that are no channel by themselves: no sample, words beside the numbers, a counter, alarms, a second clock.
  bool leave_out(const CellKinds& kinds, std::size_t column, const std::vector<std::size_t>& rows,
                 ColumnFate& fate) const {
    const bool contract = kind_of(fate.name) != ChannelKind::input;
    if (contract) return false;
    const std::string lower = lowered(fate.name);
    if (kinds.numbers + kinds.switches + kinds.words == 0) {
      fate.fate = "empty";
    } else if (kinds.words > 0 && kinds.words == kinds.clocks && kinds.numbers + kinds.switches == 0) {
      fate.fate = "second-time";
    } else if (kinds.words > 0 && kinds.numbers == 0 && !kinds.word_like_number && stated_unit(column).unit.empty()) {
      fate.fate = "words";
    } else if (lower.starts_with("alarm")) {
      fate.fate = "alarm";
    } else if (is_counter(lower, column, rows)) {
      fate.fate = "counter";
    }
    return !fate.fate.empty();
  }

  static std::string lowered(std::string_view text) {
    std::string out(text);
    for (char& c : out) c = c == ' ' ? '_' : static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return out;
  }

  /// A number of the row, by its name and because it goes up by one.
  bool is_counter(const std::string& lower, std::size_t column, const std::vector<std::size_t>& rows) const {
    static const std::set<std::string> names = {
        "",     "#",     "no",     "no.",         "nr",           "nr.", "number", "scan", "row", "record",
        "idx",  "index", "sample", "count",       "point",        "n",   "id",     "seq",  "lfd", "lfd.",
        "序号", "编号",  "rn",     "scan_number", "sample_number"};
    if (!names.contains(lower) || rows.size() < 2) return false;
    double before = not_there;
    for (const std::size_t row : rows) {
      const auto value = m_table.form.numbers.number(m_table.cell(row, column));
      if (!value || (!std::isnan(before) && *value <= before) || std::floor(*value) < *value) return false;
      before = *value;
    }
    return true;
  }

  /// A factor in the heading changes every value of the column; whether the logger has applied it nobody knows.
  Status no_factor(std::size_t column, const ColumnFate& fate) const {
    for (const std::string& heading : {fate.name, m_table.units[column], fate.label}) {
      const std::string factor = factor_in(heading);
      if (factor.empty()) continue;
      return fail(ErrorCode::column_unclear, {{"file", m_table.form.file},
                                              {"line", std::to_string(header_line())},
                                              {"column", m_table.name_of(column)},
                                              {"found", fmt::format("a factor ({}) in the heading", factor)},
                                              {"expected", "a heading without one, or \"scale\" in a column map"}});
    }
    return {};
  }

  int header_line() const {
    const std::size_t row = m_table.block_end < m_table.cells.rows() ? m_table.block_end : 0;
    return m_table.cells.line(row);
  }

  Status name_by_map(const ColumnRule& rule, std::size_t column, ColumnFate& fate) const {
    fate.channel = rule.channel;
    fate.axis = rule.axis;
    fate.location = rule.location;
    const StatedUnit stated = stated_unit(column);
    fate.unit = !rule.unit.empty() ? rule.unit : !stated.unit.empty() ? stated.unit : split_unit(fate.name).unit;
    fate.unit_from = !rule.unit.empty() ? "map" : !stated.unit.empty() ? stated.from : !fate.unit.empty() ? "name" : "";
    const auto from = unit_from(fate.unit);
    const auto to = unit_of_channel(rule.channel);
    if (from && to && from->quantity != Quantity::other && from->quantity != to->quantity && !rule.scale) {
      return fail(ErrorCode::unit_conflict, {{"file", m_table.form.file},
                                             {"column", m_table.name_of(column)},
                                             {"found", fate.unit},
                                             {"expected", rule.channel}});
    }
    if (from && to && from->quantity == to->quantity) {
      fate.scale = from->scale / to->scale;
      fate.offset = (from->offset - to->offset) / to->scale;
    }
    if (rule.scale) {
      const bool said_twice = !rule.unit.empty() && from && to && from->quantity == to->quantity;
      if (said_twice && std::abs(*rule.scale / fate.scale - 1.0) > 1e-3) {
        return fail(ErrorCode::unit_conflict, {{"file", m_table.form.file},
                                               {"column", m_table.name_of(column)},
                                               {"found", fmt::format("{}, scale {:g}", fate.unit, *rule.scale)},
                                               {"expected", fmt::format("{}, scale {:g}", rule.channel, fate.scale)}});
      }
      fate.scale = *rule.scale;
      fate.offset = 0.0;
    }
    fate.offset += rule.offset.value_or(0.0);
    return {};
  }

  Status name_by_itself(std::size_t column, ColumnFate& fate) const {
    const StatedUnit stated = stated_unit(column);
    fate.unit = !stated.unit.empty() ? stated.unit : split_unit(fate.name).unit;
    fate.unit_from = !stated.unit.empty() ? stated.from : fate.unit.empty() ? "" : "name";
    ZD_TRY(const NamedChannel named, channel_from(fate.name, fate.label, stated, fate.place, m_table.form.file));
    fate.channel = named.channel;
    fate.scale = named.scale;
    fate.offset = named.offset;
    fate.proposal = proposal_for(fate.name, fate.label, fate.channel, unit_from(fate.unit));
    if (fate.proposal == fate.channel) fate.proposal.clear();
    return {};
  }

  /// ON and OFF where all is ON and OFF and the channel has no unit; numbers elsewhere.
  Result<std::vector<double>> values_of(const CellKinds& kinds, std::size_t column,
                                        const std::vector<std::size_t>& rows, const ColumnFate& fate) const {
    const ChannelKind kind = kind_of(fate.channel);
    const bool may_switch = kind == ChannelKind::coolant || kind == ChannelKind::input;
    if (kinds.first_word) return bad_cell(*kinds.first_word, column);
    if (kinds.first_switch && (!may_switch || kinds.numbers > 0)) return bad_cell(*kinds.first_switch, column);
    std::vector<double> values;
    values.reserve(rows.size());
    const bool as_it_is = fate.scale == 1.0 && fate.offset == 0.0;
    for (const std::size_t row : rows) {
      const std::string_view cell = m_table.cell(row, column);
      double value = not_there;
      if (is_missing(cell)) {
      } else if (const auto number = m_table.form.numbers.number(cell)) {
        value = as_it_is ? *number : without_rounding_residue(fate.scale * *number + fate.offset);
      } else if (const auto on = switch_value(cell)) {
        value = *on;
      }
      if (std::isinf(value)) return bad_cell(row, column);  // beyond what a number can be, in the channel's unit
      values.push_back(value);
    }
    return values;
  }

  void tell(const CellKinds& kinds, std::size_t column, const std::vector<double>& values, bool by_map,
            const ColumnFate& fate, std::vector<Error>& warnings) const {
    const std::string name = m_table.name_of(column);
    if (!kinds.missing.empty()) {
      std::string words;
      for (const auto& [word, count] : kinds.missing) {
        words += fmt::format("{}{} x {}", words.empty() ? "" : ", ", count, shortened(word));
      }
      warnings.push_back({ErrorCode::samples_missing, {{"column", name}, {"words", words}}});
    }
    if (by_map) return;
    if (!fate.proposal.empty()) {
      warnings.push_back(
          {ErrorCode::column_proposed, {{"column", name}, {"channel", fate.channel}, {"proposal", fate.proposal}}});
    } else if (fate.scale != 1.0 || fate.offset != 0.0) {
      warnings.push_back(
          {ErrorCode::column_converted, {{"column", name}, {"unit", fate.unit}, {"channel", fate.channel}}});
    }
    if (kind_of(fate.channel) != ChannelKind::temperature && kind_of(fate.channel) != ChannelKind::ambient) return;
    static const std::array<double, 10> sentinels{-999, -9999, -99999, -999.9, -9999.9,
                                                  9999, 99999, -32768, 32767,  65535};
    for (const double sentinel : sentinels) {
      const auto count = std::count(values.begin(), values.end(), sentinel);
      if (count == 0) continue;
      warnings.push_back(
          {ErrorCode::sentinel_suspected,
           {{"column", name}, {"found", fmt::format("{:g}", sentinel)}, {"count", std::to_string(count)}}});
    }
  }

  /// Temperatures that are taken as degrees Celsius and look like another unit: a warning, no value is changed.
  void suspect_units(Imported& out) const {
    std::vector<std::size_t> places;
    std::vector<std::vector<double>> values;
    for (std::size_t i = 0; i < out.columns.size(); ++i) {
      const ChannelKind kind = kind_of(out.columns[i].channel);
      const bool temperature = kind == ChannelKind::temperature || kind == ChannelKind::ambient;
      if (out.columns[i].fate != "channel" || !temperature) continue;
      places.push_back(i);
      values.push_back(out.recording.channels[channel_number(out, i)].values);
    }
    for (const auto& one : suspected_units(values)) {
      const ColumnFate& fate = out.columns[places[one.channel]];
      const char* unit = one.kelvin ? "kelvin" : "degrees Fahrenheit";
      out.warnings.push_back({ErrorCode::unit_conflict,
                              {{"file", m_table.form.file},
                               {"column", m_table.name_of(fate.place - 1)},
                               {"found", fmt::format("{}, by their size ({:.4g} at the start)", unit, one.start_C)},
                               {"expected", fate.channel}}});
    }
  }

  /// One channel for each axis.
  Status check_axes(const Imported& out) const {
    std::map<std::string, std::string> column_of;
    for (const ColumnFate& fate : out.columns) {
      const bool named = fate.channel.size() == 5 && fate.channel.starts_with("d") && fate.channel.ends_with("_um");
      const std::string axis = fate.axis.empty() && named ? fate.channel.substr(1, 1) : fate.axis;
      if (axis.empty() || column_of.emplace(axis, fate.name).second) continue;
      return fail(ErrorCode::data_does_not_fit, {{"what", m_table.form.file},
                                                 {"column", fate.name},
                                                 {"found", "axis " + axis + ", as column " + column_of[axis]},
                                                 {"expected", "one column for each axis"}});
    }
    return {};
  }

  /// A name of its own for each channel; columns of the same name but for what their units carried get their place.
  Status check_channels(Imported& out) const {
    std::map<std::string, std::vector<std::size_t>> columns;
    for (std::size_t i = 0; i < out.columns.size(); ++i) {
      if (out.columns[i].fate == "channel") columns[out.columns[i].channel].push_back(i);
    }
    for (const auto& [channel, places] : columns) {
      if (places.size() < 2) continue;
      std::set<std::string> headers;
      bool by_map = false;
      for (const std::size_t i : places) {
        headers.insert(out.columns[i].name);
        by_map = by_map || m_map.rule_for(out.columns[i].name, out.columns[i].label, i) != nullptr;
      }
      if (by_map || headers.size() < places.size() || headers.contains(channel)) {
        return fail(ErrorCode::csv_bad_header, {{"file", m_table.form.file},
                                                {"column", std::to_string(out.columns[places[1]].place)},
                                                {"found", channel + " (a second time)"},
                                                {"expected", "a name of its own for each column"}});
      }
      const auto unit = split_unit(channel);
      for (const std::size_t i : places) {
        ColumnFate& fate = out.columns[i];
        const std::string suffix = channel.substr(unit.name.size());
        const std::string apart = fmt::format("{}_{}{}", unit.name, fate.place, suffix);
        const auto at = channel_number(out, i);
        out.recording.channels[at].name = fate.channel = apart;
      }
    }
    for (const Channel& one : out.recording.channels) {
      if (!one.name.empty() && one.name != "time_s") continue;
      return fail(ErrorCode::csv_bad_header, {{"file", m_table.form.file},
                                              {"column", one.name},
                                              {"found", one.name.empty() ? "(no name)" : one.name},
                                              {"expected", "a name of its own for each column"}});
    }
    return {};
  }

  /// Of the column with this fate among the channels.
  static std::size_t channel_number(const Imported& out, std::size_t fate) {
    std::size_t number = 0;
    for (std::size_t i = 0; i < fate; ++i) number += out.columns[i].fate == "channel";
    return number;
  }

  SourceTable m_table;
  const HeaderMap& m_map;
  std::vector<std::string> m_labels;
  std::vector<std::string> m_block_units;
};

/// Times in another unit than seconds would make each simulated step thousands of steps, and every time constant wrong.
Status check_times(const Recording& recording, const std::string& file) {
  constexpr double longest_period_s = 3600.0;
  constexpr double longest_s = 100.0 * 86400.0;
  if (recording.rows() < 2) return {};
  std::vector<double> periods_s(recording.rows() - 1);
  for (std::size_t k = 0; k < periods_s.size(); ++k) periods_s[k] = recording.time_s[k + 1] - recording.time_s[k];
  const auto middle = periods_s.begin() + std::ssize(periods_s) / 2;
  std::nth_element(periods_s.begin(), middle, periods_s.end());
  const double whole_s = recording.time_s.back() - recording.time_s.front();
  if (*middle <= longest_period_s && whole_s <= longest_s) return {};
  return fail(ErrorCode::data_does_not_fit,
              {{"what", file + ", column time_s"},
               {"found", fmt::format("a row each {:g} s, {:g} s in all", *middle, whole_s)},
               {"expected",
                "seconds: a row an hour at least, 100 days at most (is it in milliseconds, or is one time wrong?)"}});
}

}  // namespace

Result<Imported> import_recording(std::string_view bytes, const std::string& file, const HeaderMap& map) {
  ZD_TRY(SourceTable table, parse_source_table(bytes, file, map.table));
  ZD_TRY(Imported out, Importer(std::move(table), map).run());
  ZD_CHECK(check_times(out.recording, file));
  return out;
}

Result<Imported> import_file(const std::filesystem::path& path, const HeaderMap& map) {
  ZD_TRY(const std::string bytes, read_file(path));
  return import_recording(bytes, path.string(), map);
}

nlohmann::json map_of(const Imported& imported, const HeaderMap& given) {
  HeaderMap map = given;
  map.columns.clear();
  map.time.columns.clear();
  nlohmann::json proposals = nlohmann::json::object();
  std::map<std::string, int> times_named;
  for (const ColumnFate& fate : imported.columns) ++times_named[fate.name];
  const auto key_of = [&](const ColumnFate& fate) {
    return fate.name.empty() || times_named[fate.name] > 1 ? fmt::format("#{}", fate.place) : fate.name;
  };
  for (const std::size_t column : imported.time.columns) {
    if (map.time.columns.size() < 2 && imported.columns[column].name != "ms") {
      map.time.columns.push_back(key_of(imported.columns[column]));
    }
  }
  if (map.time.unit.empty() && imported.time.rule != "clock") map.time.unit = imported.time.unit;
  for (const ColumnFate& fate : imported.columns) {
    if (fate.fate == "time") continue;
    std::optional<ColumnRule>& rule = map.columns[key_of(fate)];
    if (fate.fate != "channel") continue;
    rule = ColumnRule{fate.channel, {}, {}, {}, fate.axis, fate.location};
    if (fate.scale != 1.0) rule->scale = fate.scale;
    if (fate.offset != 0.0) rule->offset = fate.offset;
    if (fate.offset != 0.0 && !rule->scale) rule->scale = fate.scale;
    if (!fate.proposal.empty()) proposals[key_of(fate)] = {{"channel", fate.proposal}};
  }
  nlohmann::json out = to_json(map);
  if (!proposals.empty()) out["proposals"] = std::move(proposals);
  return out;
}

Assigned assigned_in(const nlohmann::json& kept) {
  Assigned out;
  if (!kept.is_object()) return out;
  for (const auto& column : kept.value("columns", nlohmann::json::array())) {
    const std::string channel = column.value("channel", "");
    if (channel.empty()) continue;
    out.channels.push_back(channel);
    if (column.contains("axis")) out.axes[channel] = column.value("axis", "");
    if (column.contains("location")) out.locations[channel] = column.value("location", "");
  }
  return out;
}

nlohmann::json to_json(const Imported& imported) {
  nlohmann::json columns = nlohmann::json::array();
  nlohmann::json all_missing = nlohmann::json::object();
  for (const ColumnFate& fate : imported.columns) {
    nlohmann::json one = {{"place", fate.place}, {"name", fate.name}, {"fate", fate.fate}};
    if (!fate.label.empty()) one["label"] = fate.label;
    if (fate.fate == "channel") {
      one["channel"] = fate.channel;
      one["scale"] = fate.scale;
      one["offset"] = fate.offset;
      if (!fate.axis.empty()) one["axis"] = fate.axis;
      if (!fate.location.empty()) one["location"] = fate.location;
    }
    if (!fate.unit.empty()) {
      one["unit"] = fate.unit;
      one["unit_from"] = fate.unit_from;
    }
    if (!fate.proposal.empty()) one["proposal"] = fate.proposal;
    if (!fate.missing.empty()) one["missing"] = fate.missing;
    for (const auto& [word, count] : fate.missing) all_missing[word] = all_missing.value(word, 0) + count;
    columns.push_back(std::move(one));
  }
  nlohmann::json time = {{"rule", imported.time.rule}, {"columns", nlohmann::json::array()}};
  for (const std::size_t column : imported.time.columns) time["columns"].push_back(imported.columns[column].name);
  if (!imported.time.unit.empty()) time["unit"] = imported.time.unit;
  if (!imported.time.order.empty()) time["order"] = imported.time.order;
  if (!imported.time.start.empty()) time["start"] = imported.time.start;
  nlohmann::json out = {
      {"file", imported.form.file},           {"encoding", imported.form.encoding},
      {"separator", imported.form.separator}, {"decimal", std::string(1, imported.form.numbers.decimal)},
      {"rows", imported.recording.rows()},    {"time", std::move(time)},
      {"columns", std::move(columns)},        {"missing", std::move(all_missing)}};
  if (imported.form.numbers.grouped) out["thousands"] = imported.form.numbers.decimal == '.' ? "," : ".";
  if (!imported.form.sheet.empty()) out["sheet"] = imported.form.sheet;
  return out;
}

}  // namespace zerodrift::recording
