#pragma once
// Simulation against recording (P1 to P7): where heat is missing, which effect explains it, what would decide between
// rivals. Nothing is claimed that the state does not say.

#include <QStringList>
#include <limits>

#include "ui/pages/page.h"
#include "ui/plots/heat_map.h"
#include "ui/widgets/component_drawing.h"

class QLabel;
class QPushButton;
class QScrollArea;
class QStackedWidget;
class QVBoxLayout;

namespace zerodrift::ui {

class Card;
class ChannelTable;
class DataTable;
class ExplanationCard;
class LegendRow;
class LivePlot;
class ToggleSegment;

/// A channel simulated and recorded.
struct SimulatedChannel {
  QString id{};
  QString tag{};
  QString unit{};       // of differences
  QString valueUnit{};  // of the values
  QVector<double> time_s{};
  QVector<double> recorded{};
  QVector<double> simulated{};
  QVector<double> refined{};  // with the adopted effects; empty: none adopted
  double rmse = std::numeric_limits<double>::quiet_NaN();
  double noise = std::numeric_limits<double>::quiet_NaN();
};

struct Explanation {
  QString id{};             // of the effect
  QString name{};           // in words
  QString sentence{};       // what was left out, where, how large
  QString magnitude{};      // "36.1 ± 2.0 W"
  QString place{};          // "spindle, 172 mm"
  double confidence = 0.0;  // 0..1
  bool adopted = false;
  bool rejected = false;
  QString channel{};         // the most telling one, of which the curves and their rms are: "T1"
  QVector<double> before{};  // its residual
  QVector<double> refit{};   // after a plain re-fit without the effect
  QVector<double> after{};
  double rmseBefore = 0.0;  // of that channel alone
  double rmseRefit = 0.0;
  double rmseAfter = 0.0;
  QString unit = "K";
  QString rivals{};       // "cannot be told from: contact resistance at 170 mm"
  QString couldDetect{};  // "would have shown down to 8 W"
};

/// A channel of the run that is watched in a blind trial.
struct TrialCurve {
  QString tag{};
  QVector<double> time_s{};
  QVector<double> recorded{};
  QVector<double> simulated{};
  QVector<double> refined{};  // with the answer
};

enum class TrialStage {
  none,
  sealed,  // an effect is hidden, its name promised; the run is watched
  searching,
  answered,
  opened,
};

struct BlindTrial {
  TrialStage stage = TrialStage::none;
  QString seal{};  // SHA-256
  QVector<TrialCurve> curves{};
  double shown = 1.0;  // share of the run that has been watched
  QString answer{};
  QString hidden{};
  bool right = false;
  bool kept = true;  // the opened answer fits the promise
};

struct TrialScore {
  QString effect{};  // concealed
  QString answer{};
  bool right = false;
  double improvement_percent = 0.0;
};

enum class PhysicsVerdict {
  none,  // not asked yet
  consistent,
  missingEffect,
  unexplained,
};

struct PhysicsState {
  QString blocked{};
  bool undescribed = false;  // nobody has said what the machine is: there is nothing to simulate yet
  QString description{};     // where what is simulated comes from
  PhysicsVerdict verdict = PhysicsVerdict::none;
  QString verdictSentence{};
  QVector<DrawnComponent> components{};
  int component = 0;
  HeatMapData missingHeat{};  // of the chosen component
  QVector<SimulatedChannel> channels{};
  QVector<Explanation> explanations{};
  QString nextExperiment{};     // one sentence; empty: none needed
  bool nextIsWarmupRun = true;  // can go into the plan editor; else it is done by hand
  QVector<TrialScore> trials{};
  BlindTrial trial{};
  double rmse_K = std::numeric_limits<double>::quiet_NaN();
  double noise_K = std::numeric_limits<double>::quiet_NaN();
  double missing_W = std::numeric_limits<double>::quiet_NaN();
  double held_K = std::numeric_limits<double>::quiet_NaN();  // on data not used for the search, as rmse_K
  bool adopted = false;                                      // figures, map and curves are with what was found
  QString region{};                                          // where a sensor belongs, in a sentence; empty: not asked
};

class PhysicsPage : public Page {
  Q_OBJECT

 public:
  explicit PhysicsPage(QWidget* parent = nullptr);
  void setState(const PhysicsState& state);
  const PhysicsState& state() const { return m_state; }
  /// 0 missing heat, 1 simulation over recording, 2 blind trial.
  void showView(int index);

  QString title() const override;
  QString sentence() const override;
  /// Find what is missing; afterwards Go on.
  PageAction primary() const override;
  /// "describe", "lumps": what is simulated; "open" the seal of an answered trial, "trial", "region", "find" again.
  QVector<PageAction> secondary() const override;

 Q_SIGNALS:
  void componentChosen(int index);
  void adopted(const QString& effectId, bool adopt);
  void rejected(const QString& effectId);
  void experimentRequested();  // put the proposed run into the plan editor

 protected:
  void render() override;

 private:
  QWidget* makeWhere();
  QWidget* makeCompare();
  QWidget* makeTrial();
  QWidget* makeExplanations();
  QWidget* makeExperiment();
  void renderMap();
  void renderChannels();
  void renderChannel();
  void renderExplanations();
  void renderTrials();
  void renderTrial();
  void renderTrialCurves();
  QVector<Figure> figures() const;

  PhysicsState m_state;
  Card* m_mapCard;
  Card* m_sideCard;
  ToggleSegment* m_view;
  ToggleSegment* m_component;
  QStackedWidget* m_views;
  ComponentDrawing* m_drawing;
  HeatMap* m_map;
  LivePlot* m_channelPlot;
  LivePlot* m_residualPlot;
  LegendRow* m_channelLegend;
  ChannelTable* m_channelTable;
  DataTable* m_trials;
  QLabel* m_trialWords;
  LivePlot* m_trialPlot;
  LegendRow* m_trialLegend;
  QVector<QLabel*> m_trialSteps;
  QLabel* m_region;
  QLabel* m_verdict;
  QScrollArea* m_scroll;
  QVBoxLayout* m_explanationLayout;
  QVector<ExplanationCard*> m_cards;
  Card* m_experiment;
  QLabel* m_experimentText;
  QPushButton* m_experimentButton;
};

}  // namespace zerodrift::ui
