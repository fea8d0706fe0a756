#pragma once
// Which sensors matter (S1, S2): clusters, correlations, the price of each choice, the budget curve.

#include <QStringList>
#include <limits>

#include "ui/pages/page.h"

class QGridLayout;
class QLabel;
class QSpinBox;
class QStackedWidget;

namespace zerodrift::ui {

class Card;
class DataTable;
class MatrixView;
class ToggleSegment;
class XyPlot;

struct SensorRow {
  QString id{};
  QString tag{};
  QString label{};
  int cluster = 0;  // -1: none
  bool kept = false;
  QVector<double> r{0.0, 0.0, 0.0};  // correlation with each error
  double sum = 0.0;                  // as published, with sign, or of absolute values
  double lag_s = std::numeric_limits<double>::quiet_NaN();
  double vif = std::numeric_limits<double>::quiet_NaN();
  // change of the error on unseen stretches when this sensor, kept, is dropped or, left, is added
  double price_um = std::numeric_limits<double>::quiet_NaN();
  double pc1 = 0.0;  // place in the plane of the first two components
  double pc2 = 0.0;
  QString note{};  // why it is not proposed; such a sensor is in no cluster and has no figures
};

struct SensorsState {
  QString blocked{};
  QStringList errors{"X", "Y", "Z"};
  QVector<SensorRow> sensors{};
  int clusters = 5;
  int suggestedClusters = 5;
  QString proposal{};     // why so many are proposed; empty: chosen by hand
  bool automatic = true;  // number of clusters suggested, not set
  bool absolute = false;  // sum of absolute correlations
  double explained1_percent = std::numeric_limits<double>::quiet_NaN();
  double explained2_percent = std::numeric_limits<double>::quiet_NaN();
  QVector<double> budgetCount{};     // number of sensors
  QVector<double> budgetError_um{};  // error on unseen stretches with so many
  double error_um = std::numeric_limits<double>::quiet_NaN();
  double errorLimit_um = 5.0;
  double lost_percent = std::numeric_limits<double>::quiet_NaN();  // against all sensors
  double lostLimit_percent = 10.0;
  double lostLimit_um = 0.2;  // less is harmless, whatever its share
  double condition = std::numeric_limits<double>::quiet_NaN();
  double conditionLimit = 30.0;
  QVector<double> time_s{};                 // for the small multiples
  QVector<QVector<double>> temperatures{};  // one a sensor, standardised, same order
  bool pricing = false;                     // figures of the last change are being computed
};

class SensorsPage : public Page {
  Q_OBJECT

 public:
  explicit SensorsPage(QWidget* parent = nullptr);
  void setState(const SensorsState& state);
  const SensorsState& state() const { return m_state; }

  QString title() const override;
  QString sentence() const override;
  PageAction primary() const override;
  /// "suggest": back to the proposed choice.
  QVector<PageAction> secondary() const override;

 Q_SIGNALS:
  void keptChanged(const QString& sensorId, bool kept);
  void clustersChosen(int clusters);  // 0: suggested
  void absoluteChosen(bool absolute);

 protected:
  void render() override;

 private:
  Card* makePlots();
  Card* makeChoice();
  void connectParts();
  void renderClusters();
  void renderSeries();
  void renderMatrix();
  void renderBudget();
  void renderTable();
  void toggle(int row, bool kept);
  QVector<Figure> figures() const;
  int keptCount() const;

  SensorsState m_state;
  Card* m_plotCard;
  Card* m_tableCard;
  ToggleSegment* m_view;
  QStackedWidget* m_views;
  XyPlot* m_clusterPlot;
  QWidget* m_seriesPanel;
  QGridLayout* m_seriesGrid;
  QVector<XyPlot*> m_seriesPlots;
  MatrixView* m_matrix;
  XyPlot* m_budget;
  QLabel* m_plotNote;
  QLabel* m_clusterName;
  QSpinBox* m_clusters;
  ToggleSegment* m_sum;
  DataTable* m_table;
  QLabel* m_priceNote;
  bool m_filling = false;
};

}  // namespace zerodrift::ui
