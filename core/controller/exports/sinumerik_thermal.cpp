// SINUMERIK 840D sl temperature compensation: K = SD43900 + SD43910 (P - SD43920), in mm and mm/mm, switched on by
// MD32750 bits 0 and 1. Only a straight line for each instant, so a subprogram refreshes it from R parameters into
// which the PLC writes the temperatures. It acts on the actual value, so +error is written (by inference from the 840C
// text).

#include <fmt/format.h>

#include <cmath>

#include "core/controller/exports/export_tools.h"
#include "core/controller/exports/formats.h"

namespace zerodrift::controller::exports {
namespace {

using compensation::AxisTable;
using compensation::Table;
using compensation::Temperatures;

constexpr double line_reach_mm = 1e6;  // how far a read line is laid out as two points

std::map<std::string, int> parameters_of(const Table& table, int first) {
  std::map<std::string, int> out;
  for (const auto& sensor : compensation::sensors_of(table)) out[sensor] = first++;
  return out;
}

/// "0.001+0.0021*(R800-20.0)" - value at the references and one product for each term.
std::string expression(double constant,
                       const std::vector<std::pair<double, const compensation::TemperatureTerm*>>& terms,
                       const std::map<std::string, int>& parameters) {
  std::string text = fmt::format("{:.12f}", constant);
  for (const auto& [coefficient, term] : terms) {
    text += fmt::format("{:+.12f}*(R{}-{:.6f})", coefficient, parameters.at(term->sensor), term->reference_C);
  }
  return text;
}

void write_axis(const std::string& name, const AxisTable& axis, const std::map<std::string, int>& parameters,
                std::string& text) {
  std::vector<std::pair<double, const compensation::TemperatureTerm*>> values;
  std::vector<std::pair<double, const compensation::TemperatureTerm*>> slopes;
  for (const auto& term : axis.terms) {
    values.emplace_back(1e-3 * term.um_per_K, &term);
    if (term.slope_um_per_m_per_K != 0.0) slopes.emplace_back(1e-6 * term.slope_um_per_m_per_K, &term);
  }
  text += fmt::format("$SA_TEMP_COMP_REF_POSITION[{}1]={:.6f} ; SD43920\n", name, axis.reference_position_mm);
  text += fmt::format("$SA_TEMP_COMP_ABS_VALUE[{}1]={} ; SD43900\n", name,
                      expression(1e-3 * axis.offset_um, values, parameters));
  text += fmt::format("$SA_TEMP_COMP_SLOPE[{}1]={} ; SD43910\n", name, expression(0.0, slopes, parameters));
}

/// Value of such an expression with temperatures in the R parameters.
std::optional<double> evaluate(std::string_view text, const std::map<int, double>& parameters) {
  const std::string copy(text);
  const char* at = copy.c_str();
  double value = 0.0;
  int used = 0;
  if (std::sscanf(at, "%lf%n", &value, &used) != 1) return std::nullopt;
  at += used;
  double coefficient = 0.0;
  double reference = 0.0;
  int number = 0;
  while (std::sscanf(at, "%lf*(R%d-%lf)%n", &coefficient, &number, &reference, &used) == 3) {
    const auto temperature = parameters.find(number);
    if (temperature == parameters.end()) return std::nullopt;
    value += coefficient * (temperature->second - reference);
    at += used;
  }
  return value;
}

struct Straight {
  double reference_mm = 0.0;
  double value_mm = 0.0;
  double slope = 0.0;
};

Result<Table> read_sinumerik_thermal(std::string_view text, const ExportOptions& options) {
  std::map<int, double> parameters;
  std::map<std::string, Straight> lines;
  for (const std::string_view line : lines_of(text)) {
    if (line.starts_with("; R")) {  // "; R800 = T3_C"
      const auto equals = line.find('=');
      if (equals == std::string_view::npos || equals + 2 > line.size()) continue;
      const auto temperature = options.temperatures.find(std::string(line.substr(equals + 2)));
      const auto number = whole_after(line, "; R");
      if (number && temperature != options.temperatures.end()) parameters[*number] = temperature->second;
    }
    const auto open = line.find('[');
    if (!line.starts_with("$SA_TEMP_COMP") || open == std::string_view::npos) continue;
    const auto value = evaluate(line.substr(line.find('=') + 1), parameters);
    if (!value) return unreadable("sinumerik-thermal", line, "numbers and temperatures of the R parameters");
    Straight& one = lines[std::string(line.substr(open + 1, 1))];
    if (line.starts_with("$SA_TEMP_COMP_REF")) one.reference_mm = *value;
    if (line.starts_with("$SA_TEMP_COMP_ABS")) one.value_mm = *value;
    if (line.starts_with("$SA_TEMP_COMP_SLOPE")) one.slope = *value;
  }
  if (lines.empty()) return unreadable("sinumerik-thermal", text.substr(0, 40), "$SA_TEMP_COMP_...");
  Table table;
  for (const auto& [name, one] : lines) {
    std::vector<double> x = {one.reference_mm - line_reach_mm, one.reference_mm + line_reach_mm};
    std::vector<double> um;
    for (const double position : x) um.push_back(1000.0 * (one.value_mm + one.slope * (position - one.reference_mm)));
    table.axes[name] = axis_from(x, um, um);
  }
  return checked("sinumerik-thermal", std::move(table));
}

/// The position points have no place in a straight line.
double points_lost_um(const AxisTable& axis, const Temperatures& state) {
  double first_K = 0.0;
  if (!axis.terms.empty()) first_K = state.at(axis.terms.front().sensor) - axis.terms.front().reference_C;
  double largest = 0.0;
  for (const auto& p : axis.points) {
    for (const double value : {p.error_up_um, p.error_down_um}) {
      largest = std::max(largest, std::abs(value + p.um_per_K * first_K));
    }
  }
  return largest;
}

Result<Exported> write_sinumerik_thermal(const Table& table, const ExportOptions& options) {
  const auto parameters = parameters_of(table, options.first_r_parameter);
  const auto state = state_of(table, options);
  Exported out;
  std::string text = "%_N_ZD_TEMP_SPF\n;$PATH=/_N_SPF_DIR\n";
  text += "; error = actual - commanded; written +error, in mm and mm/mm. Call it whenever the temperatures are new.\n";
  for (const auto& [sensor, number] : parameters) text += fmt::format("; R{} = {}\n", number, sensor);
  std::string machine_data;
  for (const auto& [name, axis] : table.axes) {
    if (!options.axis.empty() && options.axis != name) continue;
    write_axis(name, axis, parameters, text);
    machine_data += fmt::format("$MA_TEMP_COMP_TYPE[{}1]=3\n", name);
    const double lost_um = points_lost_um(axis, state);
    out.loss_um = std::max(out.loss_um, lost_um + 1e-3);
    if (lost_um > 0.0) {
      out.losses.push_back(
          fmt::format("axis {}: the position points (up to {:.2f} um) do not fit into a straight line; export "
                      "sinumerik-leadscrew beside",
                      name, lost_um));
    }
  }
  out.files.push_back({"", text + "STOPRE\nM17\n"});
  out.files.push_back({".MD.INI", machine_data + "M17\n"});
  out.confirm.emplace_back("the sign (written +error by inference: the value acts on the actual position)");
  out.confirm.emplace_back(
      "axis names X1, Y1, Z1, and that the PLC writes the temperatures into the R parameters named");
  return out;
}

}  // namespace

ExportFormat sinumerik_thermal() {
  return {"sinumerik-thermal",
          {.equidistant = false,
           .two_directions = false,
           .temperature = true,
           .max_points = 0,
           .resolution_um = 1e-6,
           .sign = "+error (acts on the actual value)"},
          write_sinumerik_thermal,
          read_sinumerik_thermal};
}

}  // namespace zerodrift::controller::exports
