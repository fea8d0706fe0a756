#pragma once
// The warm-up run (R2, R3): first the plan as a timeline that can be edited, then the run live.

#include <limits>

#include "ui/pages/page.h"
#include "ui/pages/run_view.h"
#include "ui/widgets/plan_timeline.h"
#include "ui/widgets/recording_list.h"

class QCheckBox;
class QComboBox;
class QDoubleSpinBox;
class QLabel;
class QPushButton;
class QSpinBox;

namespace zerodrift::ui {

class Card;
class XyPlot;

enum class RunPhase {
  planning,
  running,
  paused,
  interrupted,  // found in the job after a crash or a lost connection: can be resumed
  finished,
};

struct WarmupState {
  bool filesOnly = false;              // the job records nothing: its run is imported
  bool imported = false;               // the run that is shown comes from a file
  int temperatures = 0;                // of the imported run
  int errors = 0;                      // 0: it serves for the heat alone
  QVector<RecordingRow> recordings{};  // from files only: the run and those beside it
  int shownRecording = 0;
  QString offline{};  // why no run can be started now; empty: it can
  QString blocked{};  // why the page cannot be used yet; empty: it can
  RunPhase phase = RunPhase::planning;
  QString silentSince{};    // of the controller of the run; empty: it answers
  bool keptBefore = false;  // beside the interrupted run there is one that was ended
  QStringList presets{};
  int preset = -1;
  QVector<PlanStepRow> plan{};
  double samplePeriod_s = 10.0;
  double measurePeriod_s = 60.0;
  double fastest_rpm = 8000.0;
  // Expected drift over the plan, from the last job of this machine; empty when there is none.
  QVector<double> expectedTime_s{};
  QVector<double> expectedDrift_um{};
  QString expectedFrom{};

  double elapsed_s = 0.0;
  double timeLeft_s = std::numeric_limits<double>::quiet_NaN();
  double largestError_um = std::numeric_limits<double>::quiet_NaN();
  QString largestErrorAxis{};
  double slope_um_per_h = std::numeric_limits<double>::quiet_NaN();
  double slope_K_per_h = std::numeric_limits<double>::quiet_NaN();
  bool steady = false;
  QString steadyCriterion{};  // "under 1 µm/h and 0.5 K/h for 20 min"
  QString wallTimeLeft{};     // when the machine's time is not the wall's: "1 min on the wall"
  QString wallTimeTotal{};
  qint64 samplesLost = 0;
  qint64 samples = 0;
  double longestHole_s = 0.0;  // machine time without a sample
  double harmlessHole_s = 120.0;
  double worstHole_s = 600.0;
  double diskFree_GB = std::numeric_limits<double>::quiet_NaN();
  bool compensationOn = false;
};

class WarmupPage : public Page {
  Q_OBJECT

 public:
  explicit WarmupPage(QWidget* parent = nullptr);
  void setState(const WarmupState& state);
  const WarmupState& state() const { return m_state; }
  /// The live run: channels, samples, marks, picture.
  RunView* run() const { return m_run; }

  QString title() const override;
  QString sentence() const override;
  /// Start, Pause, Resume or Use this run, by the phase.
  PageAction primary() const override;
  /// "import"; "load", "save" of plans; "finish", "abort", "note", "again" of runs.
  QVector<PageAction> secondary() const override;
  bool steersWork() const override { return true; }

 Q_SIGNALS:
  void presetChosen(int index);
  void planEdited(const QVector<zerodrift::ui::PlanStepRow>& plan);
  void periodsEdited(double sample_s, double measure_s);
  void noteRequested(double time_s);
  void recordingShown(int index);
  void recordingRenamed(int index, const QString& name);
  void recordingRoleChosen(int index, zerodrift::ui::RecordingUse use);
  void recordingRemoved(int index);

 protected:
  void render() override;

 private:
  QWidget* makePlan();
  void makeStepEditor(QVBoxLayout* into);
  void renderPlan();
  void showStep();
  void stepEdited();
  void planTouched();
  QVector<Figure> planFigures() const;
  QVector<Figure> runFigures() const;
  Figure lostFigure() const;
  double planLength_s() const;

  WarmupState m_state;
  QWidget* m_plan;
  Card* m_timelineCard;
  Card* m_stepCard;
  Card* m_expectedCard;
  PlanTimeline* m_timeline;
  XyPlot* m_expected;
  QComboBox* m_presets;
  QPushButton* m_add;
  QPushButton* m_remove;
  QSpinBox* m_minutes;
  QSpinBox* m_speed;
  QCheckBox* m_coolant;
  QComboBox* m_motion;
  QDoubleSpinBox* m_sample;
  QDoubleSpinBox* m_measure;
  QVector<QLabel*> m_fieldNames;
  QLabel* m_hint;
  RunView* m_run;
  RecordingList* m_recordings;
  bool m_filling = false;
};

}  // namespace zerodrift::ui
