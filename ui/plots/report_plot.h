#pragma once
// Plots for paper: drawn as vectors by QCustomPlot on any paint device, without a window.

#include <QByteArray>
#include <QColor>
#include <QPainter>
#include <QRectF>
#include <QString>
#include <QVector>
#include <memory>
#include <utility>

class QCustomPlot;

namespace zerodrift::ui {

struct ReportCurve {
  QString name;  // empty: not in the legend
  QVector<double> x;
  QVector<double> y;  // NaN: gap
  bool points = false;
  QColor color{};  // invalid: one after the other
  Qt::PenStyle style = Qt::SolidLine;
  double width = 1.2;
};

/// A stretch behind the curves, the darker the stronger (0 to 1).
struct ReportStretch {
  double from = 0.0;
  double to = 0.0;
  double strength = 0.0;
  QString text{};
};

struct ReportMark {
  double x = 0.0;
  QString text{};
};

struct ReportPlotData {
  QString xLabel;
  QString yLabel;
  QVector<ReportCurve> curves;
  QVector<ReportStretch> stretches{};
  QVector<ReportMark> marks{};
  double limit = 0.0;  // a band from -limit to +limit; 0: none
};

/// Values over x (columns) and y (rows, the first at the bottom), coloured around zero.
struct ReportMapData {
  QString xLabel;
  QString yLabel;
  QString unit;
  double xFrom = 0.0, xTo = 1.0;
  double yFrom = 0.0, yTo = 1.0;
  QVector<QVector<double>> rows;
  QVector<std::pair<double, QString>> ticks{};  // along y
};

/// Ends a painter as what it was made as: QPainter's destructor is not virtual.
struct EndVectorPainter {
  void operator()(QPainter* painter) const;
};
using VectorPainter = std::unique_ptr<QPainter, EndVectorPainter>;
/// A painter that keeps QCustomPlot's drawing vectorised; use it for everything on that device.
VectorPainter makeVectorPainter(QPaintDevice* device);
/// Draws into the rectangle (in the painter's logical pixels of 1/96 inch); the painter is one of makeVectorPainter.
void drawReportPlot(QPainter& painter, const QRectF& place, const ReportPlotData& data);
/// The same bit by bit, where it is a picture that is painted on: to fill the lines of twenty long curves at once would
/// hold a window.
class ReportPlotDrawing {
 public:
  ReportPlotDrawing(const QRectF& place, const ReportPlotData& data);
  ~ReportPlotDrawing();
  /// The next of some upright strips; false when that was the last.
  bool step(QPainter& painter);

 private:
  QRectF m_place;
  std::unique_ptr<QCustomPlot> m_plot;
  int m_next = 0;
};
void drawReportMap(QPainter& painter, const QRectF& place, const ReportMapData& data);
/// The same as a stand-alone SVG element.
QByteArray reportPlotSvg(const ReportPlotData& data, const QSize& size);
QByteArray reportMapSvg(const ReportMapData& data, const QSize& size);

}  // namespace zerodrift::ui
