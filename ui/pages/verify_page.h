#pragma once
// The proof (C2): a compensated run, what was there without it, what is left, and the correction of the model.

#include <limits>

#include "ui/pages/page.h"
#include "ui/pages/run_view.h"
#include "ui/pages/verify_result.h"

class QDoubleSpinBox;
class QLabel;
class QStackedWidget;

namespace zerodrift::ui {

class Card;
class DataTable;
class LegendRow;
class ToggleSegment;
class XyPlot;

enum class VerifyPhase {
  ready,
  running,
  paused,
  interrupted,  // found in the job after a crash or a lost connection: can be resumed
  finished,
};

/// The proposed correction of one axis.
struct AxisCorrection {
  QString axis{};
  double kappa = 1.0;  // correction coefficient of the model's temperatures
  double kappaSigma = 0.0;
  double offset_um = 0.0;
  QString evidence{};                                               // "31 measurements, t = 12.4"
  double peakBefore_um = std::numeric_limits<double>::quiet_NaN();  // residual as measured
  double peakAfter_um = std::numeric_limits<double>::quiet_NaN();   // with the correction, predicted
  bool proposed = false;
  QVector<double> time_s{};
  QVector<double> residual_um{};
  QVector<double> corrected_um{};
};

/// An axis that the version before would have left less of, over the same run.
struct WorseThanBefore {
  QString axis{};
  double before_um = 0.0;  // rms
  double now_um = 0.0;
};

struct VerifyState {
  QString blocked{};
  VerifyPhase phase = VerifyPhase::ready;
  QString silentSince{};    // of the controller of the run; empty: it answers
  bool keptBefore = false;  // beside the interrupted run there is one that was ended
  bool leftAsItIs = false;  // the engineer has seen what is left over the limit and goes on with it
  double peakBefore_um = std::numeric_limits<double>::quiet_NaN();
  double peakAfter_um = std::numeric_limits<double>::quiet_NaN();
  double peakLimit_um = 5.0;
  QString beforeAxis{};  // of peakBefore_um
  QString afterAxis{};
  QVector<AxisResult> results{};
  bool sameRun = false;   // "without" is the same run less what was applied; else the warm-up run
  int versionBefore = 0;  // of the table that was active before this one; 0: none is known
  QVector<WorseThanBefore> worseThanBefore{};
  bool runsDisagree = false;   // an earlier run found that version worse than this one
  QString offline{};           // why no run can be started now; empty: it can
  QStringList outsideRange{};  // sensors beyond the model's range in this run, in words
  QString switchedOff{};       // the same, when the compensation is off
  QString notHeld{};           // the same, when the machine does not hold the job's table: said on the page, too
  double compared_s = std::numeric_limits<double>::quiet_NaN();
  QString noCorrection{};  // why none could be computed of a finished run; empty: it could
  double promised_um = std::numeric_limits<double>::quiet_NaN();  // what the fit said would be left at most
  double promiseReach = 1.25;  // single measurements may be so many times the means that the fit speaks of
  bool promiseBroken() const { return peakAfter_um > promiseReach * promised_um; }
  double rmsBefore_um = std::numeric_limits<double>::quiet_NaN();
  double rmsAfter_um = std::numeric_limits<double>::quiet_NaN();
  double removedTarget_percent = 85.0;
  double frameLimit_s = 120.0;  // longer without a measurement is too long
  double lastGoodFrame_s = std::numeric_limits<double>::quiet_NaN();
  double threshold_um = 3.0;  // part error above which a correction is proposed
  QVector<AxisCorrection> corrections{};
  bool correctionProposed = false;
  bool compensationOn = false;
};

class VerifyPage : public Page {
  Q_OBJECT

 public:
  explicit VerifyPage(QWidget* parent = nullptr);
  void setState(const VerifyState& state);
  const VerifyState& state() const { return m_state; }
  RunView* run() const { return m_run; }
  /// 0 the run, 1 result, 2 correction.
  void showView(int index);

  QString title() const override;
  QString sentence() const override;
  /// Start verification, Pause, Apply correction, Go on.
  PageAction primary() const override;
  /// "finish", "abort", "again", "skip", "correct", "rollback", "drop", "goOn".
  QVector<PageAction> secondary() const override;
  bool steersWork() const override { return true; }
  /// The proposed correction is the next step: an axis is over its limit or worse than with the version before.
  bool correctionNeeded() const;
  /// What is left is too much, and no correction of this run mends it.
  bool furtherRunNeeded() const;
  bool verifyAgainNeeded() const;
  bool rollbackNeeded() const;

 Q_SIGNALS:
  void thresholdChanged(double threshold_um);
  void noteRequested(double time_s);

 protected:
  void render() override;

 private:
  QWidget* makeCorrection();
  void renderCorrection();
  void renderResiduals();
  QVector<Figure> figures() const;
  Figure removedFigure() const;
  QStringList words() const;
  QStringList axesOverLimit() const;
  bool fallenShort() const;
  QString finishedSentence() const;

  VerifyState m_state;
  ToggleSegment* m_view;
  QStackedWidget* m_views;
  RunView* m_run;
  VerifyResult* m_result;
  Card* m_tableCard;
  Card* m_plotCard;
  DataTable* m_table;
  XyPlot* m_plot;
  LegendRow* m_legend;
  QLabel* m_thresholdName;
  QDoubleSpinBox* m_threshold;
  QLabel* m_words;
  bool m_filling = false;
};

}  // namespace zerodrift::ui
