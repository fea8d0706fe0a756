#pragma once
// Curves over time, growing while they are watched: any length of run, 24 curves, at most 30 redraws a second.
// Time in seconds since the start of the run. Several plots can share one time axis.

#include <QHash>
#include <QPointer>

#include "ui/plots/plot_widget.h"

class QCPGraph;

namespace zerodrift::ui {

struct Curve {
  QString id{};
  QString tag{};   // what the user calls it
  QString unit{};  // for the value under the pointer
  QColor color{};  // invalid: taken from curveColor in the order of the curves
  int decimals = 2;
  double width = 1.2;
  bool dashed = false;
  bool steps = false;   // holds from its sample to the next: speeds, switches
  bool points = false;  // few measurements: drawn as discs on the line
};

/// What the machine was doing, drawn behind the curves: the faster the darker; a blue strip at the foot: coolant.
struct Regime {
  double from_s = 0.0;
  double to_s = 0.0;
  double speed_rpm = 0.0;
  bool coolant = false;
};

class LivePlot : public PlotWidget {
  Q_OBJECT

 public:
  explicit LivePlot(QWidget* parent = nullptr);
  ~LivePlot() override;

  /// Data of curves whose id stays is kept.
  void setCurves(const QVector<Curve>& curves);
  void setData(const QString& id, const QVector<double>& time_s, const QVector<double>& values);
  void append(const QString& id, const QVector<double>& time_s, const QVector<double>& values);
  void clearData();
  /// A band behind a curve, for example its prediction's 95 %.
  void setBand(const QString& id, const QVector<double>& time_s, const QVector<double>& low,
               const QVector<double>& high);
  void setRegimes(const QVector<Regime>& regimes, double fastest_rpm, bool labels = true);
  void setCurveVisible(const QString& id, bool visible);
  /// Thicker than the others, which fade; empty: none.
  void highlight(const QString& id);
  /// Drawn thicker and always on top, for example a channel in alarm.
  void setEmphasis(const QString& id, bool strong);
  /// Shows the newest so many seconds and follows; 0: the whole run. Zooming by hand stops the following.
  void setTimeWindow(double seconds);
  /// Both plots show the same stretch of time from now on.
  void linkTime(LivePlot* other);
  /// The ordinate shows at least this much, so that noise at rest does not fill the plot.
  void setSmallestSpan(double span) { m_smallestSpan = span; }
  void setIncludeZero(bool include) { m_includeZero = include; }
  /// Everything drawn as soon as it is told, for pictures and tests.
  void flush();
  qsizetype sampleCount(const QString& id) const;

 public Q_SLOTS:
  void fit() override;

 protected:
  Near nearest(const QPointF& pixel) const override;
  QString csv() const override;
  void restyle() override;
  void resizeEvent(QResizeEvent* event) override;

 private:
  struct Entry;
  void showStretch(double from, double to);
  void schedule();
  void updateView();
  void scaleOrdinate();
  double newest() const;

  QVector<Entry*> m_entries;
  QHash<QString, Entry*> m_byId;
  QVector<QPointer<LivePlot>> m_linked;
  QVector<Regime> m_regimes;
  double m_fastest_rpm = 8000.0;
  bool m_regimeLabels = true;
  QString m_highlighted;
  double m_window_s = 0.0;
  double m_smallestSpan = 0.0;
  bool m_includeZero = false;
  bool m_following = true;
  bool m_scheduled = false;
};

}  // namespace zerodrift::ui
