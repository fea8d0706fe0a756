#pragma once
// From the report's plots to the drawing's.

#include "core/report/report.h"
#include "ui/plots/report_plot.h"

namespace zerodrift::reporting {

inline ui::ReportPlotData plot_data(const report::Plot& plot) {
  ui::ReportPlotData data{QString::fromStdString(plot.x_label), QString::fromStdString(plot.y_label), {}};
  for (const auto& curve : plot.curves) {
    data.curves.append({QString::fromStdString(curve.name), QVector<double>(curve.x.begin(), curve.x.end()),
                        QVector<double>(curve.y.begin(), curve.y.end()), curve.points});
  }
  return data;
}

}  // namespace zerodrift::reporting
