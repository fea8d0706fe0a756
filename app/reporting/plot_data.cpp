#include "app/reporting/plot_data.h"

#include "ui/widgets/paper_colors.h"

namespace zerodrift::reporting {
namespace {

QColor colour_of_hue(report::Hue hue) {
  switch (hue) {
    case report::Hue::x:
      return ui::paperAxisColor(0);
    case report::Hue::y:
      return ui::paperAxisColor(1);
    case report::Hue::z:
      return ui::paperAxisColor(2);
    case report::Hue::room:
      return {0x1C, 0x25, 0x30};
    case report::Hue::muted:
      return {0x7A, 0x88, 0x95};
    case report::Hue::order:
      break;
  }
  return {};
}

}  // namespace

ui::ReportPlotData plot_data(const report::Plot& plot) {
  ui::ReportPlotData data{QString::fromStdString(plot.x_label), QString::fromStdString(plot.y_label), {}};
  for (const auto& curve : plot.curves) {
    ui::ReportCurve made{QString::fromStdString(curve.name), QVector<double>(curve.x.begin(), curve.x.end()),
                         QVector<double>(curve.y.begin(), curve.y.end()), curve.points, colour_of_hue(curve.hue)};
    if (curve.stroke == report::Stroke::dashed) made.style = Qt::DashLine;
    if (curve.stroke == report::Stroke::thin) made.width = 0.6;
    data.curves.append(std::move(made));
  }
  for (const auto& one : plot.stretches) {
    data.stretches.append({one.from, one.to, one.strength, QString::fromStdString(one.text)});
  }
  for (const auto& one : plot.marks) data.marks.append({one.x, QString::fromStdString(one.text)});
  data.limit = plot.limit;
  return data;
}

ui::ReportMapData map_data(const report::HeatMap& map) {
  ui::ReportMapData data{QString::fromStdString(map.x_label),
                         QString::fromStdString(map.y_label),
                         QString::fromStdString(map.unit),
                         map.x_from,
                         map.x_to,
                         map.y_from,
                         map.y_to,
                         {}};
  for (const auto& row : map.rows) data.rows.append(QVector<double>(row.begin(), row.end()));
  for (const auto& [at, name] : map.ticks) data.ticks.append({at, QString::fromStdString(name)});
  return data;
}

}  // namespace zerodrift::reporting
