#pragma once
// The compensation model (S4): measured against predicted, honest residuals, methods compared, what will be left.

#include <QStringList>
#include <limits>

#include "ui/pages/page.h"
#include "ui/plots/plot_widget.h"

class QLabel;
class QStackedWidget;

namespace zerodrift::ui {

class Card;
class DataTable;
class LegendRow;
class ToggleSegment;
class XyPlot;

/// One direction of the error over the whole recording.
struct FitSeries {
  QString name{};  // "X"
  QVector<double> time_s{};
  QVector<double> measured_um{};
  QVector<double> predicted_um{};
  QVector<double> low_um{};  // prediction band
  QVector<double> high_um{};
  QVector<double> temperature_C{};  // of the leading sensor, for residuals over temperature
};

struct MethodRow {
  QString id{};
  QString name{};
  double unseen_um = std::numeric_limits<double>::quiet_NaN();  // rms on unseen stretches
  double peak_um = std::numeric_limits<double>::quiet_NaN();
  double coverage_percent = std::numeric_limits<double>::quiet_NaN();
  bool onController = false;  // static and linear: the controller can compute it itself
  QString why{};
};

struct FitStretch {
  double from_s = 0.0;
  double to_s = 0.0;
  bool training = true;
};

enum class FitStanding {
  none,   // nothing was fitted yet, or the fit failed
  stale,  // what it was fitted from has changed since
  current,
};

struct FitState {
  QString blocked{};
  FitStanding standing = FitStanding::none;
  QString changed{};  // stale: what
  QVector<FitSeries> series{};
  QVector<FitStretch> stretches{};
  QVector<MethodRow> methods{};
  QString method{};       // id of the chosen one
  QString proposed{};     // id of the one that the validation prefers
  QStringList sensors{};  // tags of the inputs
  double attainablePeak_um = std::numeric_limits<double>::quiet_NaN();
  double attainableLimit_um = 5.0;
  double attainable90_um = std::numeric_limits<double>::quiet_NaN();  // NaN: a model of an earlier version
  bool oneCycle = false;                                              // nothing was left out that is like another speed
  double attainableRms_um = std::numeric_limits<double>::quiet_NaN();
  double removed_percent = std::numeric_limits<double>::quiet_NaN();
  double removedTarget_percent = 85.0;
  double coverage_percent = std::numeric_limits<double>::quiet_NaN();
  double coverageTarget_percent = 85.0;
  QString validity{};        // "18 to 41 °C"
  QString validityLimits{};  // "0 to 6000 rpm"
  QStringList advice{};      // about the run and the model, one sentence each
  QString updatedBy{};       // the newer run that corrected the model
};

class FitPage : public Page {
  Q_OBJECT

 public:
  explicit FitPage(QWidget* parent = nullptr);
  void setState(const FitState& state);
  const FitState& state() const { return m_state; }

  QString title() const override;
  QString sentence() const override;
  PageAction primary() const override;
  /// "update": correct the model by a short newer run.
  QVector<PageAction> secondary() const override;

 Q_SIGNALS:
  void methodChosen(const QString& methodId);

 protected:
  void render() override;

 private:
  void renderPrediction(const FitSeries& series);
  void renderResiduals(const FitSeries& series);
  void renderHistogram(const QVector<double>& residuals);
  void renderMethods();
  void renderWords();
  QVector<Figure> figures() const;
  QVector<Span> spans() const;

  FitState m_state;
  Card* m_plotCard;
  Card* m_methodCard;
  Card* m_wordCard;
  ToggleSegment* m_direction;
  ToggleSegment* m_view;
  QStackedWidget* m_views;
  LegendRow* m_legend;
  XyPlot* m_prediction;
  XyPlot* m_overTime;
  XyPlot* m_overTemperature;
  XyPlot* m_histogram;
  DataTable* m_methods;
  QLabel* m_headline;
  QLabel* m_why;
  QLabel* m_advice;
};

}  // namespace zerodrift::ui
