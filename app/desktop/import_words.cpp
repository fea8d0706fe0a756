#include "app/desktop/import_words.h"

#include <QCoreApplication>
#include <algorithm>
#include <cmath>

#include "app/text/error_text.h"
#include "core/flow/steps/import_step.h"
#include "core/recording/import/column_names.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/progress_strip.h"

namespace zerodrift::desktop {

using recording::ChannelKind;
using recording::HeaderMap;
using ui::ImportColumn;
using ui::ImportRole;

namespace {

struct ImportWords {
  Q_DECLARE_TR_FUNCTIONS(ImportWords)
};

constexpr std::size_t rows_shown = 6;
constexpr std::size_t examples = 3;

ImportRole role_of(ChannelKind kind) {
  switch (kind) {
    case ChannelKind::temperature:
      return ImportRole::temperature;
    case ChannelKind::ambient:
      return ImportRole::room;
    case ChannelKind::error:
      return ImportRole::displacement;
    case ChannelKind::tilt:
      return ImportRole::tilt;
    case ChannelKind::speed:
      return ImportRole::speed;
    case ChannelKind::coolant:
      return ImportRole::coolant;
    case ChannelKind::load:
      return ImportRole::load;
    case ChannelKind::feed:
    case ChannelKind::input:
      break;
  }
  return ImportRole::input;
}

/// What the channel's name ends with, "" where the name is the role's own or free.
std::string suffix_of(ImportRole role) {
  switch (role) {
    case ImportRole::temperature:
      return "_C";
    case ImportRole::displacement:
      return "_um";
    case ImportRole::tilt:
      return "_urad";
    default:
      return "";
  }
}

/// The name that the role alone asks for.
std::string own_name_of(ImportRole role) {
  switch (role) {
    case ImportRole::room:
      return "ambient_C";
    case ImportRole::speed:
      return "spindle_rpm";
    case ImportRole::coolant:
      return "coolant_on";
    case ImportRole::load:
      return "spindle_load_W";
    default:
      return "";
  }
}

std::string without_suffix(const std::string& channel) {
  for (const char* suffix : {"_C", "_um", "_urad", "_rpm", "_W", "_on"}) {
    if (channel.ends_with(suffix)) return channel.substr(0, channel.size() - std::string(suffix).size());
  }
  return channel;
}

std::string channel_for(ImportRole role, const std::string& wanted) {
  if (const std::string own = own_name_of(role); !own.empty()) return own;
  const std::string base = without_suffix(wanted);
  const std::string suffix = suffix_of(role);
  if (!suffix.empty()) return base + suffix;
  return recording::kind_of(base) == ChannelKind::input ? base : base + "_input";
}

QString fate_words(const recording::ColumnFate& fate) {
  if (fate.fate == "words") return ImportWords::tr("holds words");
  if (fate.fate == "empty") return ImportWords::tr("holds nothing");
  if (fate.fate == "counter") return ImportWords::tr("counts the rows");
  if (fate.fate == "alarm") return ImportWords::tr("alarms of the logger");
  if (fate.fate == "second-time") return ImportWords::tr("a second time");
  if (!fate.proposal.empty()) return ImportWords::tr("perhaps %1").arg(QString::fromStdString(fate.proposal));
  return QString::fromStdString(fate.label);
}

QString number(double value) {
  return QString::number(value, 'g', 12);
}

void fill_from_rule(const HeaderMap& map, const ImportReading& reading, std::size_t at, ImportColumn& column) {
  const auto* rule = map.rule_for(reading.names[at], {}, at);
  if (rule == nullptr || !*rule) return;
  if ((*rule)->scale) column.scale = number(*(*rule)->scale);
  if (!(*rule)->unit.empty()) column.unit = QString::fromStdString((*rule)->unit);
  column.axis = QString::fromStdString((*rule)->axis);
  column.location = QString::fromStdString((*rule)->location);
}

/// When the file could not be read with this map: what the map says, else what the names say.
void fill_unread(const HeaderMap& map, const ImportReading& reading, std::size_t at, ImportColumn& column) {
  const auto& times = map.time.columns;
  const auto* rule = map.rule_for(reading.names[at], {}, at);
  const bool read = std::find(reading.times.begin(), reading.times.end(), at) != reading.times.end();
  if (read || std::find(times.begin(), times.end(), reading.keys[at]) != times.end()) {
    column.role = ImportRole::time;
  } else if (rule != nullptr && *rule) {
    column.channel = QString::fromStdString((*rule)->channel);
    column.role = role_of(recording::kind_of((*rule)->channel));
  } else if (rule == nullptr && !reading.names[at].empty()) {
    const auto named = recording::channel_from(reading.names[at], {}, {}, at + 1, reading.form.file);
    if (!named || named->channel == "time_s") return;
    const ChannelKind kind = recording::kind_of(named->channel);
    if (kind == ChannelKind::input) return;
    column.channel = QString::fromStdString(named->channel);
    column.role = role_of(kind);
  }
}

QString decimal_words(char decimal) {
  return decimal == ',' ? ImportWords::tr("decimal comma") : ImportWords::tr("decimal point");
}

QString separator_words(const std::string& separator) {
  if (separator == "," || separator == "comma") return ImportWords::tr("comma");
  if (separator == ";" || separator == "semicolon") return ImportWords::tr("semicolon");
  if (separator == "tab") return ImportWords::tr("tab");
  if (separator == "blanks") return ImportWords::tr("blanks");
  return QString::fromStdString(separator);
}

QString time_words(const recording::TimeReading& time) {
  const QString unit = QString::fromStdString(time.unit);
  const QString start = QString::fromStdString(time.start);
  if (time.rule == "elapsed") return ImportWords::tr("time in %1 from the start").arg(unit);
  if (time.rule == "epoch") return ImportWords::tr("time in %1 since 1970, from %2").arg(unit, start);
  if (time.rule == "interval") return ImportWords::tr("no time column: rows come evenly");
  if (time.rule == "time-of-day") return ImportWords::tr("time of day");
  if (time.order.empty()) return ImportWords::tr("date and time, from %1").arg(start);
  return ImportWords::tr("date and time as %1, from %2").arg(QString::fromStdString(time.order), start);
}

QString form_words(const ImportReading& reading) {
  QStringList parts{QString::fromStdString(reading.form.encoding)};
  if (!reading.form.sheet.empty()) {
    parts << ImportWords::tr("sheet %1").arg(QString::fromStdString(reading.form.sheet));
  }
  if (!reading.form.separator.empty()) {
    parts << ImportWords::tr("separated by %1").arg(separator_words(reading.form.separator));
  }
  parts << decimal_words(reading.form.numbers.decimal);
  if (!reading.imported) return ui::listText(parts);
  const auto& run = reading.imported->recording;
  parts << time_words(reading.imported->time);
  if (run.rows() > 0) {
    parts << ImportWords::tr("%1 rows over %2")
                 .arg(run.rows())
                 .arg(ui::durationText(run.time_s.back() - run.time_s.front()));
  }
  return ui::listText(parts);
}

}  // namespace

ImportReading read_for_import(const std::string& bytes, const std::string& file, const HeaderMap& map) {
  ImportReading reading;
  reading.form.file = file;
  auto table = recording::parse_source_table(bytes, file, map.table);
  if (!table) {
    reading.problem = table.error();
    return reading;
  }
  reading.form = table->form;
  for (std::size_t c = 0; c < table->columns(); ++c) {
    const bool once =
        !table->names[c].empty() && std::count(table->names.begin(), table->names.end(), table->names[c]) == 1;
    reading.names.push_back(table->names[c]);
    reading.keys.push_back(once ? table->names[c] : "#" + std::to_string(c + 1));
  }
  for (std::size_t r = 0; r < std::min(rows_shown, table->rows.size()); ++r) {
    std::vector<std::string> row;
    for (std::size_t c = 0; c < table->columns(); ++c) row.emplace_back(table->cell(r, c));
    reading.rows.push_back(std::move(row));
  }
  if (const auto time = recording::read_time(*table, map, std::vector<std::string>(table->columns()))) {
    reading.times = time->columns;
  }
  auto imported = recording::import_recording(bytes, file, map);
  if (imported) {
    reading.imported = std::move(*imported);
    if (const Status fit = flow::fit_for_warmup(reading.imported->recording, file, false); !fit) {
      reading.problem = fit.error();
    }
  } else {
    reading.problem = imported.error();
  }
  return reading;
}

ui::ImportState import_state(const ImportReading& reading, const HeaderMap& map) {
  ui::ImportState state;
  state.form = form_words(reading);
  state.table.decimal = QString::fromStdString(map.table.decimal);
  state.table.separator = QString::fromStdString(map.table.separator);
  state.table.sheet = QString::fromStdString(map.table.sheet);
  for (const auto& word : map.missing) state.table.missing << QString::fromStdString(word);
  state.workbook = reading.form.encoding == "xlsx";
  std::string bad;
  if (reading.problem) {
    const ErrorText text = textOf(*reading.problem, Reader::window);
    state.sentence = text.sentence;
    state.remedy = text.remedy;
    const auto at = reading.problem->context.find("column");
    if (at != reading.problem->context.end()) bad = at->second;
  }
  state.ready = !reading.problem;
  for (const auto& row : reading.rows) {
    QStringList cells;
    for (const auto& cell : row) cells << QString::fromStdString(cell);
    state.rows.append(cells);
  }
  for (std::size_t c = 0; c < reading.names.size(); ++c) {
    ImportColumn column;
    const std::string place = std::to_string(c + 1);
    column.name = QString::fromStdString(reading.names[c].empty() ? "#" + place : reading.names[c]);
    QStringList values;
    for (std::size_t r = 0; r < std::min(examples, reading.rows.size()); ++r) {
      if (!reading.rows[r][c].empty()) values << QString::fromStdString(reading.rows[r][c]);
    }
    column.example = values.join(QStringLiteral("   "));
    if (reading.imported) {
      const auto& fate = reading.imported->columns[c];
      column.detail = fate_words(fate);
      if (fate.fate == "time") column.role = ImportRole::time;
      if (fate.fate == "channel") {
        column.role = role_of(recording::kind_of(fate.channel));
        column.channel = QString::fromStdString(fate.channel);
        column.unit = QString::fromStdString(fate.unit);
      }
    } else {
      fill_unread(map, reading, c, column);
    }
    fill_from_rule(map, reading, c, column);
    if (column.role == ImportRole::time) {
      column.unit = QString::fromStdString(!map.time.unit.empty() || !reading.imported ? map.time.unit
                                                                                       : reading.imported->time.unit);
      column.format = QString::fromStdString(map.time.format);
    }
    column.problem = !bad.empty() && (bad == reading.names[c] || bad == "#" + place || bad == place);
    state.heads << column.name;
    state.columns.append(column);
  }
  if (reading.imported) {
    for (const Error& warning : reading.imported->warnings) state.notes << lineOf(warning, Reader::window);
  }
  return state;
}

void change_map(HeaderMap& map, const std::string& key, const ImportColumn& before, const ImportColumn& column) {
  auto& times = map.time.columns;
  const bool other_role = column.role != before.role;
  if (column.role == ImportRole::time) {
    map.columns.erase(key);
    if (other_role) {
      if (times.size() == 2) times.pop_back();  // date and time of day are two
      times.push_back(key);
      return;
    }
    map.time.unit = column.unit.toStdString();
    map.time.format = column.format.toStdString();
    return;
  }
  std::erase(times, key);
  if (column.role == ImportRole::unused) {
    map.columns[key] = std::nullopt;
    return;
  }
  recording::ColumnRule rule;
  if (const auto at = map.columns.find(key); at != map.columns.end() && at->second) rule = *at->second;
  const std::string wanted = column.channel.isEmpty() ? key : column.channel.toStdString();
  rule.channel = channel_for(column.role, other_role && column.channel.isEmpty() ? key : wanted);
  if (column.unit != before.unit) rule.unit = column.unit.toStdString();
  if (other_role && column.unit == before.unit) rule.unit.clear();
  bool is_number = false;
  const double scale = column.scale.toDouble(&is_number);
  rule.scale = is_number && scale != 0.0 ? std::optional(scale) : std::nullopt;
  rule.axis = other_role ? std::string() : column.axis.toStdString();
  rule.location = column.location.toStdString();
  map.columns[key] = rule;
}

nlohmann::json how_imported(const recording::Imported& imported, const HeaderMap& map) {
  nlohmann::json how = recording::to_json(imported);
  how["map"] = recording::map_of(imported, map);
  return how;
}

}  // namespace zerodrift::desktop
