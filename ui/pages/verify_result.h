#pragma once
// What the compensation gained, axis by axis: the same stretch without and with it, drawn over one another and as
// figures.

#include <QString>
#include <QVector>
#include <QWidget>
#include <limits>

class QLabel;

namespace zerodrift::ui {

class Card;
class DataTable;
class LegendRow;
class XyPlot;

struct AxisResult {
  QString axis{};
  double before_um = std::numeric_limits<double>::quiet_NaN();  // largest |error| of the compared minutes
  double after_um = std::numeric_limits<double>::quiet_NaN();
  double removed_percent = std::numeric_limits<double>::quiet_NaN();  // negative: worse
  double endBefore_um = std::numeric_limits<double>::quiet_NaN();     // mean |error| of their last tenth
  double endAfter_um = std::numeric_limits<double>::quiet_NaN();
  QVector<double> beforeTime_s{};
  QVector<double> before{};
  QVector<double> afterTime_s{};
  QVector<double> after{};

  bool worse() const { return after_um > before_um; }
  bool worseAtTheEnd() const { return endAfter_um > endBefore_um; }
};

class VerifyResult : public QWidget {
  Q_OBJECT

 public:
  explicit VerifyResult(QWidget* parent = nullptr);
  /// `same_run`: without is the run itself less what was applied, else the warm-up run. `words`: what must be said
  /// about the figures, one sentence a line.
  void setResults(const QVector<AxisResult>& results, double compared_s, double limit_um, bool same_run,
                  const QStringList& words);

 private:
  void renderTable();
  void renderPlot();

  QVector<AxisResult> m_results;
  double m_compared_s = 0.0;
  double m_limit_um = 0.0;
  bool m_sameRun = false;
  Card* m_plotCard;
  Card* m_tableCard;
  LegendRow* m_legend;
  XyPlot* m_plot;
  DataTable* m_table;
  QLabel* m_words;
};

}  // namespace zerodrift::ui
