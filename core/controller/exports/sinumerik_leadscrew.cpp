// SINUMERIK 840D sl leadscrew error compensation: $AA_ENC_COMP[encoder, point, axis] in mm on a fixed step, one value
// for both directions; a positive value moves the axis in the negative direction, so +error is written. First and last
// value stay active outside. Two directions: a pair of CEC tables with input = output axis and directions 1 and -1
// (the published pattern; no source at hand for the sign of CEC, taken as that of ENC_COMP).

#include <fmt/format.h>

#include <cmath>

#include "core/controller/exports/export_tools.h"
#include "core/controller/exports/formats.h"

namespace zerodrift::controller::exports {
namespace {

using compensation::Table;

constexpr const char* header_note =
    "; error = actual - commanded; written +error: a positive value moves the axis in the negative direction\n";

std::string axis_word(const std::string& name) {
  return name + "1";
}

std::string number(double mm) {
  return fmt::format("{:.6f}", mm);
}

void write_enc(const std::string& name, const Grid& grid, const Curve& curve, int encoder, std::string& text) {
  const std::string axis = axis_word(name);
  for (std::size_t i = 0; i < curve.x_mm.size(); ++i) {
    text += fmt::format("$AA_ENC_COMP[{},{},{}]={}\n", encoder, i, axis, number(1e-3 * curve.mean(i)));
  }
  text += fmt::format("$AA_ENC_COMP_STEP[{},{}]={}\n", encoder, axis, number(grid.step_mm));
  text += fmt::format("$AA_ENC_COMP_MIN[{},{}]={}\n", encoder, axis, number(grid.start_mm));
  text += fmt::format("$AA_ENC_COMP_MAX[{},{}]={}\n", encoder, axis,
                      number(grid.start_mm + grid.step_mm * (grid.count - 1)));
  text += fmt::format("$AA_ENC_COMP_IS_MODULO[{},{}]=0\n", encoder, axis);
}

void write_cec(const std::string& name, const Grid& grid, const std::vector<double>& error_um, int table, int direction,
               std::string& text) {
  const std::string axis = axis_word(name);
  for (std::size_t i = 0; i < error_um.size(); ++i) {
    text += fmt::format("$AN_CEC[{},{}]={}\n", table, i, number(1e-3 * error_um[i]));
  }
  text += fmt::format("$AN_CEC_INPUT_AXIS[{}]=({})\n$AN_CEC_OUTPUT_AXIS[{}]=({})\n", table, axis, table, axis);
  text += fmt::format("$AN_CEC_STEP[{}]={}\n$AN_CEC_MIN[{}]={}\n", table, number(grid.step_mm), table,
                      number(grid.start_mm));
  text += fmt::format("$AN_CEC_MAX[{}]={}\n", table, number(grid.start_mm + grid.step_mm * (grid.count - 1)));
  text += fmt::format("$AN_CEC_DIRECTION[{}]={}\n$AN_CEC_MULT_BY_TABLE[{}]=0\n$AN_CEC_IS_MODULO[{}]=0\n", table,
                      direction, table, table);
}

/// One compensation table of the file, of either kind.
struct Block {
  std::string axis;
  double step = 0.0;
  double start = 0.0;
  int direction = 0;
  std::map<int, double> mm;
};

void take(Block& block, std::string_view name, std::string_view line, int point) {
  const double value = number_after(line, "=").value_or(0.0);
  if (name.ends_with("_STEP"))
    block.step = value;
  else if (name.ends_with("_MIN"))
    block.start = value;
  else if (name.ends_with("_DIRECTION"))
    block.direction = value > 0.0 ? 1 : value < 0.0 ? -1 : 0;
  else if (name == "$AA_ENC_COMP" || name == "$AN_CEC")
    block.mm[point] = value;
}

std::vector<std::string> fields_of(std::string_view inside) {
  std::vector<std::string> fields(1);
  for (const char c : inside) {
    if (c == ',')
      fields.emplace_back();
    else if (c != ' ')
      fields.back() += c;
  }
  return fields;
}

Result<Table> read_sinumerik_leadscrew(std::string_view text, const ExportOptions&) {
  std::map<std::string, Block> blocks;  // by axis, or by CEC table number
  for (const std::string_view line : lines_of(text)) {
    const auto open = line.find('[');
    const auto close = line.find(']');
    if (!line.starts_with("$A") || open == std::string_view::npos || close == std::string_view::npos) continue;
    const std::string_view name = line.substr(0, open);
    const auto fields = fields_of(line.substr(open + 1, close - open - 1));
    const bool cec = name.starts_with("$AN_CEC");
    Block& block = blocks[cec ? fields.front() : fields.back()];
    if (!cec) block.axis = fields.back();
    if (name == "$AN_CEC_INPUT_AXIS") block.axis = std::string(line.substr(line.find('(') + 1, 2));
    take(block, name, line, fields.size() > 1 ? whole_after(fields[1], "").value_or(0) : 0);
  }
  Table table;
  for (const auto& [id, block] : blocks) {
    if (block.axis.empty() || block.mm.empty()) return unreadable("sinumerik-leadscrew", id, "values and an axis");
    auto& axis = table.axes[block.axis.substr(0, 1)];
    axis.max_um = 1e6;
    axis.points.resize(block.mm.size());
    for (const auto& [i, mm] : block.mm) {
      if (i < 0 || i >= static_cast<int>(axis.points.size()))
        return unreadable("sinumerik-leadscrew", id, "points from 0");
      auto& point = axis.points[static_cast<std::size_t>(i)];
      point.position_mm = block.start + block.step * i;
      if (block.direction >= 0) point.error_up_um = 1000.0 * mm;
      if (block.direction <= 0) point.error_down_um = 1000.0 * mm;
    }
  }
  if (table.axes.empty()) return unreadable("sinumerik-leadscrew", text.substr(0, 40), "$AA_ENC_COMP or $AN_CEC");
  return checked("sinumerik-leadscrew", std::move(table));
}

Result<Exported> write_sinumerik_leadscrew(const Table& table, const ExportOptions& options) {
  const ExportFormat self = sinumerik_leadscrew();
  const auto state = state_of(table, options);
  Exported out;
  std::string text = options.sinumerik_cec ? "%_N_NC_CEC_INI\n" : "%_N_AX_EEC_INI\nCHANDATA(1)\n";
  text += header_note;
  std::vector<std::string> written;
  int cec_table = options.sinumerik_first_table;
  for (const auto& [name, axis] : table.axes) {
    if (axis.points.size() < 2 || (!options.axis.empty() && options.axis != name)) continue;
    ZD_TRY(const auto knots, knots_of(name, axis));
    const Grid grid = grid_for(knots, limit_of(self, options));
    ZD_TRY(const Curve curve, curve_at(axis, grid.positions(), state));
    if (options.sinumerik_cec) {
      write_cec(name, grid, curve.up_um, cec_table++, 1, text);
      write_cec(name, grid, curve.down_um, cec_table++, -1, text);
    } else {
      write_enc(name, grid, curve, options.sinumerik_encoder, text);
      tell_directions(curve, name, "MD32450", out);
    }
    tell_temperature(axis, name, state, out);
    written.push_back(name);
  }
  if (written.empty()) {
    return fail(ErrorCode::not_enough_data, {{"what", "axes with position points"}, {"found", "0"}, {"needed", "1"}});
  }
  out.files.push_back({"", text + "M17\n"});
  out.confirm.emplace_back("axis names X1, Y1, Z1; compensation works after power-on, homing and MD32700 = 1");
  if (options.sinumerik_cec) out.confirm.emplace_back("the sign of CEC tables");
  ZD_CHECK(measure_loss(self, table, options, written, out));
  return out;
}

}  // namespace

ExportFormat sinumerik_leadscrew() {
  return {"sinumerik-leadscrew",
          {.equidistant = true,
           .two_directions = false,
           .max_points = 200,
           .resolution_um = 0.001,
           .sign = "+error (a positive value moves the axis in the negative direction)"},
          write_sinumerik_leadscrew,
          read_sinumerik_leadscrew};
}

}  // namespace zerodrift::controller::exports
