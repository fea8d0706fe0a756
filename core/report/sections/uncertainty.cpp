// The uncertainty budgets of what was measured and of what the compensation leaves.

#include "core/report/uncertainty.h"

#include <fmt/format.h>

#include <cmath>

#include "core/report/build.h"
#include "core/report/pieces.h"

namespace zerodrift::report {
namespace {

Table table_of(const Source& source, const Budget& budget, const std::string& id, const std::string& title) {
  Table table;
  table.id = id;
  table.title = title;
  table.header = {source.say("contribution"), source.say("type"), source.say("rests on"), "X, µm", "Y, µm", "Z, µm"};
  const auto value = [&](const std::map<std::string, double>& of, const char* axis) {
    const auto at = of.find(axis);
    return at == of.end() ? std::nan("") : at->second;
  };
  for (const auto& part : budget.parts) {
    std::vector<Cell> row = {part.what, std::string(1, part.type), part.basis};
    for (const char* axis : {"X", "Y", "Z"}) {
      row.push_back(cell(value(part.u_um, axis), 3, fmt::format("{}_{}_{}_um", id, part.id, axis), part.trace));
    }
    table.rows.push_back(std::move(row));
  }
  const auto combined = budget.combined_um();
  Trace whole = budget.parts.front().trace;
  whole.detail = "root of the sum of squares of the rows above";
  std::vector<Cell> sum = {source.say("Combined standard uncertainty"), "", source.say("root of the sum of squares")};
  std::vector<Cell> expanded = {source.tell("Expanded uncertainty U (k = {})", shown(coverage_factor, 0)), "",
                                source.say("about 95 %")};
  for (const char* axis : {"X", "Y", "Z"}) {
    sum.push_back(cell(value(combined, axis), 3, fmt::format("{}_combined_{}_um", id, axis), whole));
    expanded.push_back(
        cell(coverage_factor * value(combined, axis), 2, fmt::format("{}_expanded_{}_um", id, axis), whole));
  }
  table.rows.push_back(std::move(sum));
  table.rows.push_back(std::move(expanded));
  return table;
}

}  // namespace

std::optional<Section> uncertainty_section(const Source& source) {
  Section section{"uncertainty", source.say("Measurement uncertainty"), {}};
  const auto measurement = budget_of_measurement(source);
  const auto compensation = budget_of_compensation(source);
  if (measurement.parts.empty() && compensation.parts.empty()) return std::nullopt;
  if (measurement.parts.empty()) {
    section.blocks.emplace_back(Text{source.say("The errors were not measured with calibrated cameras of this program: "
                                                "the uncertainty of their measurement cannot be stated."),
                                     true});
  } else {
    section.blocks.emplace_back(
        Text{source.say("Budget by GUM (JCGM 100:2008) with the contributions of ISO/TR 230-9, at the largest drift of "
                        "the run. How the machine follows its room is part of what is measured, not of the "
                        "uncertainty. Lines that begin with \"assumed\" were not measured here."),
             false});
    section.blocks.emplace_back(table_of(source, measurement, "u_measured", source.say("Measured error at the nose")));
  }
  if (!compensation.parts.empty()) {
    section.blocks.emplace_back(
        table_of(source, compensation, "u_compensated", source.say("Position with the compensation on")));
  }
  return section;
}

}  // namespace zerodrift::report
