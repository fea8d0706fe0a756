#pragma once
// Everything that is not a run growing with time: measured against predicted, tables over position, budget curves,
// histograms, residual clouds, sensors in the plane of two components. Parts are named by an id and replaced by it.

#include <QHash>
#include <QMap>
#include <QStringList>

#include "ui/plots/plot_widget.h"

class QCPAbstractPlottable;
class QCPItemText;

namespace zerodrift::ui {

struct PartStyle {
  QString tag{};   // for the value under the pointer
  QString unit{};  // of y
  QColor color{};
  double width = 1.4;
  bool dashed = false;
  bool line = true;
  bool points = false;
  bool hollow = false;     // of points
  double pointSize = 6.0;  // px
  int decimals = 2;
};

class XyPlot : public PlotWidget {
  Q_OBJECT

 public:
  explicit XyPlot(QWidget* parent = nullptr);
  ~XyPlot() override;

  /// A line and/or points in the order given (x need not ascend). labels, if any, stand beside the points.
  void setPart(const QString& id, const QVector<double>& x, const QVector<double>& y, const PartStyle& style,
               const QStringList& labels = {});
  void setBand(const QString& id, const QVector<double>& x, const QVector<double>& low, const QVector<double>& high,
               const QColor& color);
  void setBars(const QString& id, const QVector<double>& x, const QVector<double>& heights, double width,
               const QColor& color);
  void removePart(const QString& id);
  void clear();
  void setPartVisible(const QString& id, bool visible);
  /// Words instead of figures at these places of the abscissa.
  void setTickWords(const QVector<double>& at, const QStringList& words);
  /// One unit is as long on both axes: fields of view, residual vectors.
  void setEqualScale(bool equal);
  void setIncludeZero(bool include) { m_includeZero = include; }
  void setYRange(double low, double high);
  void setXRange(double low, double high);
  void setIntegerX(bool integer);
  void flush();

 public Q_SLOTS:
  void fit() override;

 Q_SIGNALS:
  void pointClicked(const QString& id, int index);

 protected:
  Near nearest(const QPointF& pixel) const override;
  QString csv() const override;
  void restyle() override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  struct Part;
  void styleLabels();
  void placeLabels();
  int nearestPoint(const QPointF& pixel, QString* id) const;

  QMap<QString, Part*> m_parts;
  bool m_equal = false;
  bool m_includeZero = false;
  bool m_fixedX = false;
  bool m_fixedY = false;
  double m_xLow = 0.0, m_xHigh = 1.0, m_yLow = 0.0, m_yHigh = 1.0;
};

}  // namespace zerodrift::ui
