#pragma once
// Axis errors (C4): a laser report becomes segments; published rule against the optimum; ISO 230-2 and VDI 3441.

#include <QStringList>
#include <limits>

#include "ui/pages/page.h"

class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QSpinBox;
class QStackedWidget;

namespace zerodrift::ui {

class Card;
class DataTable;
class LegendRow;
class ToggleSegment;
class XyPlot;

/// One run over the targets in one direction.
struct LaserRun {
  bool upwards = true;
  QVector<double> position_mm{};
  QVector<double> error_um{};
};

struct AxisSegment {
  double from_mm = 0.0, to_mm = 0.0;
  double a = 1.0, b_mm = 0.0;  // measured = a * commanded + b
  double r = std::numeric_limits<double>::quiet_NaN();
  int points = 0;
  double largestResidual_um = 0.0;
};

/// A standard's figure: A, E, R, B, M or P, Pa, Ps, U.
struct StandardFigure {
  QString symbol{};
  QString name{};
  double value_um = std::numeric_limits<double>::quiet_NaN();
};

enum class SegmentCriterion {
  coordinates,
  errors,
  tolerance,
};

struct AxisState {
  QString axis{};  // "X"; empty: no file loaded
  QStringList axes{};
  int chosenAxis = 0;
  QString file{};
  QString fileNotes{};  // "Renishaw .rtl, 5 runs, 13 targets"
  QVector<LaserRun> runs{};
  QVector<double> position_mm{};
  QVector<double> meanUp_um{}, meanDown_um{};
  QVector<double> mean_um{};  // of both directions: what is cut into segments
  QVector<double> sigmaUp_um{}, sigmaDown_um{};
  QVector<StandardFigure> iso{};
  QVector<StandardFigure> vdi{};
  SegmentCriterion criterion = SegmentCriterion::tolerance;
  double threshold = 0.98;
  int startPoints = 10;
  double tolerance_um = 1.0;
  QVector<AxisSegment> published{};
  QVector<AxisSegment> optimal{};
  bool useOptimal = true;
  double roundTrip_nm = std::numeric_limits<double>::quiet_NaN();  // forward(inverse(p)) - p, largest
  bool monotonic = true;
  bool columnsAsked = false;                                    // the file's columns can be told anew
  double before_um = std::numeric_limits<double>::quiet_NaN();  // bidirectional accuracy now
  double after_um = std::numeric_limits<double>::quiet_NaN();   // expected with the table
  QStringList formats{};
  int format = 0;
  QString formatLoss{};  // what the format cannot hold
  double formatLoss_um = std::numeric_limits<double>::quiet_NaN();
  QString formatConfirm{};  // what is to be confirmed on one point first
};

class AxisPage : public Page {
  Q_OBJECT

 public:
  explicit AxisPage(QWidget* parent = nullptr);
  void setState(const AxisState& state);
  const AxisState& state() const { return m_state; }
  /// 0 measurement, 1 segmentation.
  void showView(int index);

  QString title() const override;
  QString sentence() const override;
  /// Upload.
  PageAction primary() const override;
  /// "open", "columns", "onePoint", "export".
  QVector<PageAction> secondary() const override;

 Q_SIGNALS:
  void axisChosen(int index);
  void segmentationChanged(int criterion, double threshold, int startPoints, double tolerance_um);
  void ruleChosen(bool optimal);
  void formatChosen(int index);

 protected:
  void render() override;

 private:
  Card* makePlotCard();
  Card* makeRuleCard();
  Card* makeExportCard();
  void renderRule();
  void renderRivals();
  void renderExport();
  void renderLimits();
  void renderLegend();
  void renderMeasurement();
  void renderSegments();
  void renderTables();
  const QVector<AxisSegment>& segments() const;
  QVector<Figure> figures() const;

  AxisState m_state;
  Card* m_plotCard;
  Card* m_figureCard;
  Card* m_ruleCard;
  Card* m_exportCard;
  ToggleSegment* m_axis;
  ToggleSegment* m_view;
  QStackedWidget* m_views;
  LegendRow* m_legend;
  XyPlot* m_measurement;
  XyPlot* m_segmentPlot;
  ToggleSegment* m_standard;
  DataTable* m_standardTable;
  DataTable* m_segmentTable;
  QStackedWidget* m_tables;
  DataTable* m_rivals;
  QComboBox* m_criterion;
  QDoubleSpinBox* m_limit;
  QSpinBox* m_start;
  QComboBox* m_format;
  QVector<QLabel*> m_names;
  QLabel* m_check;
  QLabel* m_blind;
  bool m_filling = false;
};

}  // namespace zerodrift::ui
