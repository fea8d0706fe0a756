#pragma once
// What all plots share: the look, wheel zoom about the pointer, drag to pan, double click to fit, the value under the
// pointer, and a context menu that exports what is seen as PNG, SVG or CSV.

#include <QColor>
#include <QString>
#include <QVector>
#include <QWidget>
#include <memory>

#include "ui/widgets/colors.h"

class QCPAxis;
class QCPAxisTicker;
class QCPAxisRect;
class QCPItemRect;
class QCPItemStraightLine;
class QCPItemText;
class QCPItemTracer;
class QCustomPlot;
class QMouseEvent;

namespace zerodrift::ui {

/// "1:05:30" of seconds since the start.
QString elapsedText(double seconds);

/// A stretch of x shown behind the curves: a regime, a training run, a mismatch.
struct Span {
  double from = 0.0;
  double to = 0.0;
  QColor color{};
  QString label{};  // written at the top of the span
};

/// A horizontal line: a limit, a threshold.
struct Limit {
  double value = 0.0;
  QString label{};
  Judgement judgement = Judgement::bad;
};

/// A vertical line with a word: an event, a pause, a note.
struct Mark {
  double at = 0.0;
  QString text{};
  Judgement judgement = Judgement::none;
};

class PlotWidget : public QWidget {
  Q_OBJECT

 public:
  explicit PlotWidget(QWidget* parent = nullptr);
  ~PlotWidget() override;

  void setAxisLabels(const QString& x, const QString& y);
  /// x in seconds since the start, shown as h:mm.
  void setTimeAxis(bool time);
  void setSpans(const QVector<Span>& spans);
  void setLimits(const QVector<Limit>& limits);
  void setMarks(const QVector<Mark>& marks);
  /// Shown in the middle while there is nothing to draw.
  void setPlaceholder(const QString& text);
  /// A double click then asks for a note instead of fitting.
  void setNotesWanted(bool wanted) { m_notesWanted = wanted; }
  void setVerticalZoom(bool vertical);

  bool savePng(const QString& path) const;
  bool saveSvg(const QString& path) const;
  /// What is visible, one column a curve.
  bool saveCsv(const QString& path) const;
  QImage image(int width, int height) const;
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 public Q_SLOTS:
  virtual void fit();

 Q_SIGNALS:
  void hovered(const QString& id, double x, double y);  // id empty: nothing near
  void clicked(const QString& id, double x, double y);
  void noteRequested(double x);
  void viewChanged(double from, double to);  // by the user

 protected:
  struct Near {
    QString id;
    QString text;  // "T3  24.31 °C"
    double x = 0.0;
    double y = 0.0;
    double distance_px = 1e9;
    QColor color;
  };
  /// The curve or point nearest to this place of the widget.
  virtual Near nearest(const QPointF& pixel) const = 0;
  virtual QString csv() const = 0;
  /// Colours of curves and the plot's own words after a change of theme or language.
  virtual void restyle() {}
  QCustomPlot* plot() const { return m_plot; }
  QCPAxis* xAxis() const;
  QCPAxis* yAxis() const;
  QString xText(double x) const;
  static QCPAxisTicker* elapsedTicker();
  bool isTimeAxis() const { return m_time; }
  void replot();
  void showPlaceholder(bool shown);
  const QVector<Limit>& limits() const { return m_limits; }
  bool hasSpanLabels() const { return !m_spanTexts.isEmpty(); }
  bool hasMarkTexts() const { return !m_markTexts.isEmpty(); }
  void changeEvent(QEvent* event) override;
  void resizeEvent(QResizeEvent* event) override;
  bool event(QEvent* event) override;

 private:
  void styleFrame();
  void placeSpanTexts();
  void placeMarkTexts();
  void showHover(const QPointF& pixel);
  void hideHover();
  void openMenu(const QPoint& at);
  void exportAs(const QString& kind);

  QCustomPlot* m_plot;
  QCPItemText* m_hoverText;
  QCPItemTracer* m_hoverPoint;
  QCPItemText* m_placeholder;
  QVector<QCPItemRect*> m_spanItems;
  QVector<QCPItemText*> m_spanTexts;
  QVector<QCPItemStraightLine*> m_lines;
  QVector<QCPItemText*> m_lineTexts;
  QVector<QCPItemText*> m_markTexts;  // those of them that belong to marks
  QVector<Span> m_spans;
  QVector<Limit> m_limits;
  QVector<Mark> m_marks;
  bool m_time = false;
  bool m_notesWanted = false;
  bool m_queued = false;
  QPoint m_pressed;
};

}  // namespace zerodrift::ui
