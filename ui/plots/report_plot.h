#pragma once
// Plots for paper: drawn as vectors by QCustomPlot on any paint device, without a window.

#include <QByteArray>
#include <QPainter>
#include <QRectF>
#include <QString>
#include <QVector>
#include <memory>

namespace zerodrift::ui {

struct ReportCurve {
  QString name;
  QVector<double> x;
  QVector<double> y;  // NaN: gap
  bool points = false;
};

struct ReportPlotData {
  QString xLabel;
  QString yLabel;
  QVector<ReportCurve> curves;
};

/// A painter that keeps QCustomPlot's drawing vectorised; use it for everything on that device.
std::unique_ptr<QPainter> makeVectorPainter(QPaintDevice* device);
/// Draws into the rectangle (in the painter's logical pixels of 1/96 inch); the painter is one of makeVectorPainter.
void drawReportPlot(QPainter& painter, const QRectF& place, const ReportPlotData& data);
/// The same as a stand-alone SVG element.
QByteArray reportPlotSvg(const ReportPlotData& data, const QSize& size);

}  // namespace zerodrift::ui
