#pragma once
// From the report's plots to the drawing's.

#include "core/report/report.h"
#include "ui/plots/report_plot.h"

namespace zerodrift::reporting {

ui::ReportPlotData plot_data(const report::Plot& plot);
ui::ReportMapData map_data(const report::HeatMap& map);

}  // namespace zerodrift::reporting
