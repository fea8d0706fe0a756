#include "ui/plots/report_plot.h"

#include <QBuffer>
#include <QSvgGenerator>
#include <cmath>

#include "ui/plots/custom_plot.h"

namespace zerodrift::ui {
namespace {

constexpr int most_in_legend_row = 7;

// Six hues that stay apart in print and for colour-blind readers when combined with the legend's order.
const QVector<QColor>& curveColours() {
  static const QVector<QColor> colours = {QColor(0x0F6CBD), QColor(0xC4314B), QColor(0x2E8B57),
                                          QColor(0xC77700), QColor(0x6B4FA0), QColor(0x1C7C8C)};
  return colours;
}

QFont paperFont(int pixels) {
  QFont font(QStringLiteral("Inter"));
  font.setFamilies({QStringLiteral("Inter"), QStringLiteral("Noto Sans CJK SC"), QStringLiteral("DejaVu Sans")});
  font.setPixelSize(pixels);
  font.setStyleStrategy(QFont::PreferNoShaping);  // so that numbers keep their signs when they are copied
  return font;
}

void styleAxis(QCPAxis* axis, const QString& label) {
  axis->setLabel(label);
  axis->setLabelFont(paperFont(11));
  axis->setTickLabelFont(paperFont(10));
  axis->setBasePen(QPen(QColor(0x5F6E7C), 1));
  axis->setTickPen(QPen(QColor(0x5F6E7C), 1));
  axis->setSubTicks(false);
  axis->grid()->setPen(QPen(QColor(0xE2E7EC), 0.7));
}

void addCurve(QCustomPlot& plot, const ReportCurve& curve, int index) {
  QCPGraph* graph = plot.addGraph();
  const QColor colour = curveColours()[index % curveColours().size()];
  QPen pen(colour, 1.2);
  if (index >= curveColours().size()) pen.setStyle(Qt::DashLine);
  graph->setPen(pen);
  graph->setName(curve.name);
  graph->setData(curve.x, curve.y);
  if (curve.points) {
    graph->setLineStyle(QCPGraph::lsNone);
    graph->setScatterStyle(QCPScatterStyle(QCPScatterStyle::ssDisc, 3.5));
  }
}

void fill(QCustomPlot& plot, const ReportPlotData& data) {
  plot.setAntialiasedElements(QCP::aeAll);
  styleAxis(plot.xAxis, data.xLabel);
  styleAxis(plot.yAxis, data.yLabel);
  for (int i = 0; i < data.curves.size(); ++i) addCurve(plot, data.curves[i], i);
  plot.rescaleAxes();
  plot.yAxis->scaleRange(1.1);
  if (plot.yAxis->range().size() <= 0) plot.yAxis->setRange(plot.yAxis->range().center(), 2, Qt::AlignCenter);
  if (data.curves.size() < 2) return;
  auto* below = new QCPLayoutGrid;
  plot.plotLayout()->addElement(1, 0, below);
  below->addElement(0, 0, plot.legend);
  plot.plotLayout()->setRowStretchFactor(1, 0.001);
  plot.legend->setVisible(true);
  plot.legend->setWrap(most_in_legend_row);
  plot.legend->setFillOrder(QCPLegend::foColumnsFirst, true);
  plot.legend->setBorderPen(Qt::NoPen);
  plot.legend->setFont(paperFont(10));
  plot.legend->setIconSize(16, 8);
}

}  // namespace

std::unique_ptr<QPainter> makeVectorPainter(QPaintDevice* device) {
  auto painter = std::make_unique<QCPPainter>(device);
  painter->setMode(QCPPainter::pmVectorized);
  painter->setMode(QCPPainter::pmNoCaching);
  return painter;
}

void drawReportPlot(QPainter& painter, const QRectF& place, const ReportPlotData& data) {
  QCustomPlot plot;
  fill(plot, data);
  painter.save();
  painter.translate(place.topLeft());
  plot.toPainter(static_cast<QCPPainter*>(&painter), int(std::lround(place.width())), int(std::lround(place.height())));
  painter.restore();
}

QByteArray reportPlotSvg(const ReportPlotData& data, const QSize& size) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  QSvgGenerator generator;
  generator.setOutputDevice(&buffer);
  generator.setSize(size);
  generator.setResolution(96);
  generator.setViewBox(QRect(QPoint(0, 0), size));
  {
    const auto painter = makeVectorPainter(&generator);
    drawReportPlot(*painter, QRectF(QPointF(0, 0), size), data);
  }
  return bytes.mid(bytes.indexOf("<svg"));
}

}  // namespace zerodrift::ui
