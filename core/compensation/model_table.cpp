#include "core/compensation/model_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "core/analysis/predict.h"
#include "core/recording/recording.h"

namespace zerodrift::compensation {
namespace {

/// "dZ_um" -> "Z"; empty for an error that is no direction of the nose.
std::string axis_of(const std::string& error) {
  for (const char* axis : {"X", "Y", "Z"}) {
    if (error == fmt::format("d{}_um", axis)) return axis;
  }
  return {};
}

void keep_limits(AxisTable& axis, const ModelTableOptions& machine) {
  axis.max_um = machine.max_um;
  axis.max_um_per_s = machine.max_um_per_s;
  axis.max_um_per_K = machine.max_um_per_K;
}

}  // namespace

Result<Table> table_from_model(const analysis::Model& model, const ModelTableOptions& options,
                               std::vector<std::string>* warnings) {
  const auto warn = [&](std::string text) {
    if (warnings != nullptr) warnings->push_back(std::move(text));
  };
  Table table;
  table.machine = options.machine;
  table.serial = options.serial;
  table.version = 1;
  for (const auto& error : model.table) {
    const std::string name = axis_of(error.error);
    if (name.empty()) {
      warn(fmt::format("the error {} is no axis of the table and is left out", error.error));
      continue;
    }
    AxisTable& axis = table.axes[name];
    axis.offset_um = error.offset_um;
    keep_limits(axis, options);
    for (const auto& term : error.terms) axis.terms.push_back({term.sensor, term.um_per_K, term.reference_C, 0.0});
  }
  if (table.axes.empty()) {
    return fail(ErrorCode::not_enough_data, {{"what", "the model's errors dX_um, dY_um, dZ_um with temperature terms"},
                                             {"found", "none"},
                                             {"needed", "1"}});
  }
  if (!model.is_static()) {
    warn(fmt::format("the model is dynamic; its static approximation in the table leaves {:.0f} % more error",
                     model.table_lost_percent));
  }
  for (std::size_t i = 0; i < model.domain.channels.size(); ++i) {
    const std::string& channel = model.domain.channels[i];
    const auto kind = recording::kind_of(channel);
    if (kind != recording::ChannelKind::temperature && kind != recording::ChannelKind::ambient) continue;
    table.valid[channel] = {model.domain.low[i], model.domain.high[i]};
  }
  ZD_CHECK(check(table));
  return table;
}

Predictor live_predictor(const analysis::Model& model) {
  auto predictor = std::make_shared<analysis::LivePredictor>(model);
  return [predictor](double time_s, const std::map<std::string, double>& channels) -> Result<std::array<double, 3>> {
    ZD_TRY(const auto sample, predictor->update(time_s, channels));
    std::array<double, 3> out{};
    for (const auto& value : sample.errors) {
      const std::string axis = axis_of(value.error);
      if (!axis.empty()) out[static_cast<std::size_t>(axis[0] - 'X')] = value.predicted_um;
    }
    return out;
  };
}

Status add_axis_table(Table& table, const Table& axis_table, const ModelTableOptions& machine) {
  for (const auto& [name, axis] : axis_table.axes) {
    const bool known = table.axes.contains(name);
    AxisTable& into = table.axes[name];
    if (!into.points.empty() && !axis.points.empty()) {
      return fail(ErrorCode::bad_argument, {{"what", "the axis tables"},
                                            {"found", "two with points for axis " + name},
                                            {"expected", "one table for each axis"}});
    }
    for (const auto& point : axis.points) {
      const double largest_um = std::max(std::abs(point.error_up_um), std::abs(point.error_down_um));
      if (largest_um <= machine.max_um) continue;
      return fail(ErrorCode::limit_exceeded,
                  {{"what", fmt::format("the error of axis {} at {:g} mm in the axis table", name, point.position_mm)},
                   {"found", fmt::format("{:.1f} um", largest_um)},
                   {"limit", fmt::format("{:g} um", machine.max_um)}});
    }
    if (!known) {
      into = axis;
      keep_limits(into, machine);
      continue;
    }
    if (!axis.points.empty()) into.points = axis.points;
    if (!axis.segments.empty()) into.segments = axis.segments;
    into.offset_um += axis.offset_um;
  }
  return {};
}

}  // namespace zerodrift::compensation
