#include "core/compensation/laser_words.h"

#include <algorithm>
#include <array>
#include <vector>

#include "core/compensation/laser_parts.h"

namespace zerodrift::compensation::laser_parts {
namespace {

using Words = std::initializer_list<std::string_view>;

bool is_one_of(std::string_view text, Words words) {
  return std::find(words.begin(), words.end(), text) != words.end();
}

bool begins_with_one_of(std::string_view text, Words stems) {
  return std::any_of(stems.begin(), stems.end(), [&](std::string_view stem) { return text.starts_with(stem); });
}

bool ends_with_one_of(std::string_view text, Words ends) {
  return std::any_of(ends.begin(), ends.end(), [&](std::string_view end) { return text.ends_with(end); });
}

bool holds_one_of(std::string_view text, Words parts) {
  return std::any_of(parts.begin(), parts.end(),
                     [&](std::string_view part) { return text.find(part) != std::string_view::npos; });
}

bool is_letter(char c) {
  return c >= 'a' && c <= 'z';
}
bool is_figure(char c) {
  return c >= '0' && c <= '9';
}
bool is_other_script(char c) {
  return static_cast<unsigned char>(c) >= 0x80;
}

/// Letters, figures, characters of other scripts, and single signs; "_" and blanks part them.
std::vector<std::string> tokens_of(std::string_view text) {
  std::vector<std::string> tokens;
  for (std::size_t i = 0; i < text.size();) {
    const auto run = [&](auto belongs) {
      std::size_t end = i;
      while (end < text.size() && belongs(text[end])) ++end;
      tokens.emplace_back(text.substr(i, end - i));
      i = end;
    };
    if (is_letter(text[i])) {
      run(is_letter);
    } else if (is_figure(text[i])) {
      run(is_figure);
    } else if (is_other_script(text[i])) {
      run(is_other_script);
    } else {
      if (text[i] == '+' || text[i] == '-') {
        // A hyphen between words is none of the axis's directions.
        const bool hyphen = i > 0 && i + 1 < text.size() && is_letter(text[i - 1]) && is_letter(text[i + 1]);
        tokens.emplace_back(hyphen ? "~" : std::string(1, text[i]));
      }
      ++i;
    }
  }
  return tokens;
}

constexpr std::string_view up_arrows[] = {"→", "↑", "⇒", "⇑", "➔", "➜", "➡", "⟶", "▲", "►", "▶", "↗"};
constexpr std::string_view down_arrows[] = {"←", "↓", "⇐", "⇓", "⬅", "⟵", "▼", "◄", "◀", "↙"};

template <std::size_t N>
bool holds_arrow(std::string_view text, const std::string_view (&arrows)[N]) {
  return std::any_of(std::begin(arrows), std::end(arrows),
                     [&](std::string_view arrow) { return text.find(arrow) != std::string_view::npos; });
}

/// "->", "==>", "<<": which way it points.
std::optional<Approach> arrow_of_ascii(std::string_view text) {
  if (text.empty() || text.find_first_not_of("-=<>") != std::string_view::npos) return std::nullopt;
  const bool right = text.find('>') != std::string_view::npos;
  const bool left = text.find('<') != std::string_view::npos;
  if (right == left) return std::nullopt;
  return right ? Approach::up : Approach::down;
}

/// Clear wherever they stand.
std::optional<Approach> clear_direction(std::string_view token) {
  if (is_one_of(token, {"up",        "upward",    "upwards",     "forward",   "forwards", "fwd",     "fw",
                        "fwrd",      "vorwaerts", "vorwarts",    "vorlauf",   "vor",      "hin",     "hinweg",
                        "hinfahrt",  "hinlauf",   "positive",    "positiv",   "plus",     "+",       "increasing",
                        "ascending", "steigend",  "aufsteigend", "aufwaerts", "aufwarts", "outbound"}) ||
      begins_with_one_of(token, {"vorwaertsr", "vorwaertsf", "vorwaertsb", "positivr"})) {
    return Approach::up;
  }
  if (is_one_of(token, {"down",       "downward",   "downwards",  "backward",  "backwards", "bwd",      "bkwd",
                        "bckwd",      "bw",         "reverse",    "reversed",  "rev",       "rwd",      "rueckwaerts",
                        "ruckwarts",  "rueckwarts", "ruckwaerts", "ruecklauf", "rueck",     "rueckweg", "rueckfahrt",
                        "zurueck",    "zuruck",     "negative",   "negativ",   "minus",     "-",        "decreasing",
                        "descending", "fallend",    "absteigend", "abwaerts",  "abwarts",   "inbound"}) ||
      begins_with_one_of(token, {"rueckwaertsr", "rueckwaertsf", "rueckwaertsb", "negativr"})) {
    return Approach::down;
  }
  if (token.empty() || !is_other_script(token.front())) return std::nullopt;
  const bool up =
      holds_arrow(token, up_arrows) ||
      holds_one_of(token, {"正向", "正方向", "正程", "去程", "往程", "向前", "前进", "上行", "上升", "递增", "前向"});
  const bool down = holds_arrow(token, down_arrows) ||
                    holds_one_of(token, {"反向", "负向", "负方向", "反方向", "反程", "负程", "回程", "返程", "返回",
                                         "向后", "后退", "下行", "下降", "递减", "逆向", "后向"});
  if (up == down) return std::nullopt;
  return up ? Approach::up : Approach::down;
}

/// Words that mean a direction only where nothing else can stand.
std::optional<DirectionWord> direction_as_cell(std::string_view token) {
  if (is_one_of(token, {"u", "f", "pos", "正", "去", "往", "进", "上", "前"}))
    return DirectionWord{Approach::up, false};
  if (is_one_of(token, {"d", "b", "r", "neg", "back", "return", "her", "负", "反", "回", "返", "退", "下", "后"})) {
    return DirectionWord{Approach::down, false};
  }
  if (is_one_of(token, {"cw", "clockwise", "right", "rechts", "out", "1", "a", "顺时针", "右"})) {
    return DirectionWord{Approach::up, true};
  }
  if (is_one_of(token,
                {"ccw", "counterclockwise", "anticlockwise", "acw", "left", "links", "0", "2", "逆时针", "左"})) {
    return DirectionWord{Approach::down, true};
  }
  return std::nullopt;
}

/// Words that stand beside a direction and say nothing of it.
bool is_filler(std::string_view token) {
  return is_one_of(token,
                   {"direction", "directional", "dir",     "richtung", "fahrtrichtung", "approach", "approaching",
                    "data",      "travel",      "move",    "movement", "motion",        "moving",   "run",
                    "axis",      "achse",       "in",      "the",      "from",          "x",        "y",
                    "z",         "fahrt",       "anfahrt", "方向",     "运动",          "测量",     "移动",
                    "~"});
}

std::string bare(std::string_view text) {
  std::string out = normalised(text);
  const auto first = out.find_first_not_of(" .:'\"");
  if (first == std::string::npos) return {};
  return out.substr(first, out.find_last_not_of(" .:'\"") - first + 1);
}

struct NameTokens {
  std::string text;  // normalised, without unit
  std::vector<std::string> tokens;

  bool has(Words words) const {
    return std::any_of(tokens.begin(), tokens.end(), [&](const auto& token) { return is_one_of(token, words); });
  }
  bool begins(Words stems) const {
    return std::any_of(tokens.begin(), tokens.end(),
                       [&](const auto& token) { return begins_with_one_of(token, stems); });
  }
  bool ends(Words ends) const {
    return std::any_of(tokens.begin(), tokens.end(), [&](const auto& token) { return ends_with_one_of(token, ends); });
  }
  bool holds(Words parts) const { return holds_one_of(text, parts); }
};

bool is_statistic(const NameTokens& n) {
  return n.has({"std",      "stdev",   "stddev",        "stdabw", "sd",       "sigma",    "min",        "max",
                "minimum",  "maximum", "range",         "span",   "spread",   "limit",    "limits",     "tolerance",
                "tol",      "spec",    "repeatability", "repeat", "reversal", "backlash", "hysteresis", "uncertainty",
                "variance", "rms",     "lost"}) ||
         n.begins({"standardabw", "streu", "wiederholgen", "wiederholb", "umkehr", "toleranz", "grenz", "unsicher",
                   "spann", "hyster", "uncert"}) ||
         n.holds({"标准差", "重复", "反向间隙", "反向差", "最大", "最小", "公差", "不确定", "极限", "σ"});
}

bool is_surrounding(const NameTokens& n) {
  return n.begins({"temp",    "luft",   "werkst",     "humid",    "feucht",   "press",   "druck",  "luftdruck",
                   "signal",  "beam",   "strahl",     "strength", "staerk",   "intens",  "pegel",  "qualit",
                   "zeit",    "datum",  "uhr",        "vorschub", "geschw",   "veloc",   "drehz",  "remark",
                   "comment", "bemerk", "komment",    "notiz",    "operator", "bedien",  "serien", "serial",
                   "pitch",   "yaw",    "roll",       "straight", "gerad",    "squaren", "rechtw", "weather",
                   "abbe",    "amplit", "laserleist", "timestamp"}) ||
         n.ends({"temperatur", "temperature", "druck", "signal", "pegel"}) ||
         n.has({"air", "time", "date", "feed", "feedrate", "speed", "note", "notes", "user", "name", "file", "co", "rh",
                "gain", "agc", "power", "zeitstempel", "elapsed"}) ||
         n.holds({"温度", "气温", "湿度", "气压", "信号", "光强", "强度", "时间", "日期", "备注", "速度", "进给",
                  "操作", "俯仰", "偏摆", "滚转", "直线度", "机床", "质量"});
}

bool is_row_number(const NameTokens& n) {
  if (n.text == "#" || n.text == "i" || n.text == "j" || n.text == "n") return true;
  return n.has({"no", "nr", "index", "idx", "row", "zeile", "id", "num", "lfd", "sample", "count", "item", "messpunkt",
                "number", "nummer", "seq"}) ||
         n.text == "point" || n.text == "points" || n.text == "punkt" || n.text == "pt" || n.text == "line" ||
         n.holds({"序号", "编号", "点号", "测点", "点数"});
}

bool is_validity(const NameTokens& n) {
  return n.has({"status", "valid", "ok", "flag", "flags", "check"}) || n.begins({"gueltig", "valid"}) ||
         n.holds({"状态", "有效"});
}

bool is_target_word(std::string_view token) {
  return is_one_of(token, {"soll", "target", "tgt", "nominal", "command", "commanded", "cmd", "setpoint", "demand",
                           "sollwert", "sollposition", "sollpos", "ziel", "zielposition", "programmed"});
}

bool is_measured_word(std::string_view token) {
  return is_one_of(token, {"ist", "actual", "act", "measured", "meas", "ref", "reference", "laser", "istwert",
                           "istposition", "istpos", "reading", "readings", "gemessen", "messwert", "interferometer"});
}

bool is_target(const NameTokens& n) {
  return std::any_of(n.tokens.begin(), n.tokens.end(), is_target_word) ||
         n.has({"position", "positions", "pos", "coordinate", "coord", "location", "messposition"}) ||
         n.begins({"soll", "position", "koordin", "nenn", "zielpos"}) || n.text == "x" || n.text == "y" ||
         n.text == "z" || n.holds({"目标", "位置", "指令", "理论", "名义", "坐标", "标称"});
}

bool is_measured(const NameTokens& n) {
  return std::any_of(n.tokens.begin(), n.tokens.end(), is_measured_word) ||
         n.begins({"istw", "istp", "istl", "gemess", "messwert"}) ||
         n.holds({"实际", "实测", "测量值", "测得", "激光"});
}

bool is_error(const NameTokens& n) {
  return n.has({"error", "errors", "err", "dev", "deviation", "deviations", "devn", "diff", "difference", "delta",
                "abw", "combined"}) ||
         n.begins({"abweich", "fehler", "differenz", "deviat"}) ||
         n.ends({"abweichung", "abweichungen", "fehler", "error"}) || n.holds({"误差", "偏差", "差值", "δ", "Δ"});
}

bool is_compensation(const NameTokens& n) {
  return n.begins({"compens", "kompens", "correct", "korrekt"}) || n.has({"comp", "corr", "offset"}) ||
         n.holds({"补偿", "修正", "校正"});
}

/// "Temperature compensated error": an error still, beside which another one is another reading.
bool is_corrected(const NameTokens& n) {
  return n.begins({"compensated", "corrected", "kompensiert", "korrigiert", "bereinigt"});
}

/// "soll - ist", "target-actual": commanded - actual, true; "ist - soll": false; nothing where none is taken from
/// other.
std::optional<bool> target_less_actual(const NameTokens& n) {
  for (std::size_t i = 1; i + 1 < n.tokens.size(); ++i) {
    if (!is_one_of(n.tokens[i], {"-", "~", "minus"})) continue;
    if (is_target_word(n.tokens[i - 1]) && is_measured_word(n.tokens[i + 1])) return true;
    if (is_measured_word(n.tokens[i - 1]) && is_target_word(n.tokens[i + 1])) return false;
  }
  return std::nullopt;
}

bool is_run_word(std::string_view token) {
  return is_one_of(token, {"run",    "runs",         "cycle",     "cycles",   "pass",      "series",  "lauf",
                           "zyklus", "durchgang",    "durchlauf", "messlauf", "messreihe", "messung", "measurement",
                           "reihe",  "wiederholung", "loop",      "r",        "test",      "第",      "轮次",
                           "循环",   "次数",         "测量次数",  "循环次数", "遍数",      "轮"});
}

/// "x10", "x 10", "/10", "10^-3", "e-3" in a name whose unit is taken out already.
bool has_factor(std::string_view name) {
  for (std::size_t i = 0; i < name.size(); ++i) {
    std::size_t after = i + 1;
    const bool cross = name.substr(i).starts_with("×");
    if (cross) after = i + std::string_view("×").size();
    const bool letter_before = i > 0 && is_letter(name[i - 1]);
    const bool mark = cross || name[i] == '*' || name[i] == '/' || name[i] == '^' || (name[i] == 'x' && !letter_before);
    if (!mark) continue;
    while (after < name.size() && name[after] == ' ') ++after;
    if (after < name.size() && (is_figure(name[after]) || name[after] == '.')) return true;
  }
  return false;
}

bool names_sign(const NameTokens& n) {
  return n.has({"sign", "signs", "inverted", "invert", "inverse", "vorzeichen", "invertiert"}) ||
         n.holds({"正负号", "取反"}) || (n.tokens.size() > 1 && is_one_of(n.tokens[0], {"-", "minus"}));
}

ColumnRole role_of(const NameTokens& n, ColumnName& column) {
  if (n.text.empty()) return ColumnRole::unknown;
  if (is_statistic(n)) return ColumnRole::remark;
  const bool error = is_error(n);
  const bool measured = is_measured(n);
  const bool target = is_target(n);
  if (error && is_corrected(n)) return ColumnRole::error;
  if (is_surrounding(n)) return ColumnRole::remark;
  if (is_validity(n)) return ColumnRole::validity;
  if (is_compensation(n)) return ColumnRole::compensation;
  if (const auto turned = target_less_actual(n)) {
    column.negated = *turned;
    return ColumnRole::error;
  }
  if (error) return ColumnRole::error;
  const bool direction = n.has({"direction", "dir", "richtung", "approach", "sense", "anfahrt"}) ||
                         n.ends({"richtung", "anfahrrichtung"}) || n.holds({"方向"});
  if (direction && !column.approach && !column.both_directions) return ColumnRole::direction;
  if (measured) return ColumnRole::measured;
  if (target && !is_row_number(n)) return ColumnRole::target;
  const bool run = std::any_of(n.tokens.begin(), n.tokens.end(),
                               [&](const auto& t) { return is_run_word(t) && (t != "r" || column.run); }) ||
                   n.holds({"次数", "循环", "轮次"});
  if (run && !column.run && !column.approach) return ColumnRole::run;
  if (is_row_number(n)) return ColumnRole::remark;
  if (n.text == "axis" || n.text == "achse" || n.text == "轴" || n.text == "轴名") return ColumnRole::axis;
  if (column.approach || (run && column.run) || column.mean) {
    column.value = true;
    return ColumnRole::error;
  }
  return ColumnRole::unknown;
}

}  // namespace

std::optional<DirectionWord> direction_word(std::string_view given) {
  const std::string word = bare(given);
  if (const auto arrow = arrow_of_ascii(word)) return DirectionWord{*arrow, false};
  if (const auto whole = direction_as_cell(word)) return whole;
  std::optional<DirectionWord> found;
  const auto take = [&](DirectionWord one) {
    if (found && found->approach != one.approach) return false;
    found = one;
    return true;
  };
  const std::vector<std::string> tokens = tokens_of(word);
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const std::string& token = tokens[i];
    if (is_filler(token)) continue;
    const bool signed_one = token == "1" && i > 0 && is_one_of(tokens[i - 1], {"+", "-"});  // +1, -1
    if (signed_one) continue;
    if (const auto clear = clear_direction(token)) {
      if (!take({*clear, false})) return std::nullopt;
    } else if (const auto convention = direction_as_cell(token); convention && !is_figure(token.front())) {
      if (!take(*convention)) return std::nullopt;
    } else {
      return std::nullopt;
    }
  }
  return found;
}

bool means_both_directions(std::string_view text) {
  const std::string name = normalised(text);
  const NameTokens n{name, tokens_of(name)};
  return n.has({"bidirectional", "bidir", "both", "beide", "bi", "beidseitig"}) || n.begins({"bidirekt"}) ||
         n.holds({"双向", "往返"});
}

std::optional<Approach> direction_in_name(std::string_view name) {
  const std::string text = normalised(name);
  const std::vector<std::string> tokens = tokens_of(text);
  std::optional<Approach> found;
  for (std::size_t i = 0; i < tokens.size(); ++i) {
    const auto one = clear_direction(tokens[i]);
    if (!one) continue;
    if (tokens[i] == "-" && i > 0 && i + 1 < tokens.size()) continue;  // "Soll - Ist", "Run - 1"
    if (tokens[i] == "minus" && i > 0) continue;
    if (found && *found != *one) return std::nullopt;
    found = one;
  }
  return found;
}

bool says_sign_or_factor(std::string_view given) {
  const std::string text = normalised(given);
  const NameTokens n{text, tokens_of(text)};
  if (target_less_actual(n) == true) return true;
  const bool factor = n.has({"scale", "factor", "faktor", "multiplier", "scaling"}) || n.begins({"skalier"}) ||
                      n.holds({"系数", "比例", "倍率"});
  const bool figure =
      std::any_of(n.tokens.begin(), n.tokens.end(), [](const auto& token) { return is_figure(token[0]); });
  const bool one = n.tokens.size() > 1 && n.tokens.back() == "1" && !is_figure(n.tokens[n.tokens.size() - 2][0]);
  if (factor && figure && !one) return true;
  return n.has({"sign", "vorzeichen"}) &&
         (n.has({"inverted", "inverse", "reversed", "negative", "minus", "-", "invertiert", "negativ"}));
}

std::optional<int> run_in_cell(std::string_view cell) {
  const std::string text = normalised(cell);
  std::optional<int> run;
  for (const std::string& token : tokens_of(text)) {
    if (is_figure(token.front())) {
      const auto value = number_from(token);
      if (run || !value) return std::nullopt;
      run = run_number(*value);
    } else if (!is_run_word(token) && !is_one_of(token, {"no", "nr", "次", "遍"})) {
      return std::nullopt;
    }
  }
  return run;
}

std::optional<int> run_in_name(std::string_view name) {
  const std::string text = normalised(name);
  const std::vector<std::string> tokens = tokens_of(text);
  const auto number = [](const std::string& token) -> std::optional<int> {
    const auto value = number_from(token);
    return value ? run_number(*value) : std::nullopt;
  };
  for (std::size_t i = 0; i + 1 < tokens.size(); ++i) {
    if (!is_run_word(tokens[i])) continue;
    for (std::size_t k = i + 1; k < std::min(i + 3, tokens.size()); ++k) {
      if (is_figure(tokens[k].front())) return number(tokens[k]);
    }
  }
  if (!tokens.empty() && is_figure(tokens.back().front())) return number(tokens.back());
  return std::nullopt;
}

ColumnName column_name(std::string_view text) {
  ColumnName column;
  column.text = std::string(text);
  NameAndUnit split = split_unit(text);
  column.unit = std::move(split.unit);
  const NameTokens n{split.name, tokens_of(split.name)};
  column.both_directions = means_both_directions(split.name);
  column.mean = n.has({"avg", "average", "mean", "mittel", "mittelwert", "mw"}) || n.begins({"gemittelt", "mittel"}) ||
                n.holds({"平均", "均值"});
  if (!column.both_directions) column.approach = direction_in_name(split.name);
  column.run = run_in_name(split.name);
  column.role = role_of(n, column);
  const bool number =
      column.role == ColumnRole::error || column.role == ColumnRole::measured || column.role == ColumnRole::target;
  column.sign_or_factor = number && (has_factor(split.name) || names_sign(n));
  // Of a column that only has another unit than a length or an angle nobody reads a position or an error.
  if (column.role == ColumnRole::unknown && column.unit && column.unit->kind == UnitKind::other) {
    column.role = ColumnRole::remark;
  }
  const bool reading = column.role == ColumnRole::error || column.role == ColumnRole::measured;
  if (!reading) {
    column.approach.reset();
    column.run.reset();
    column.both_directions = column.mean = false;
  }
  return column;
}

}  // namespace zerodrift::compensation::laser_parts
