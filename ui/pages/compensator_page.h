#pragma once
// The host compensator (C1) at work: what the model predicts, what the controller applies, what is left - live.

#include <QStringList>
#include <array>
#include <limits>

#include "ui/pages/page.h"
#include "ui/plots/live_plot.h"

namespace zerodrift::ui {

class Card;
class DataTable;
class LegendRow;
class ToggleSegment;
class WrapLabel;

enum class CompensatorPhase {
  ready,
  running,
  stopping,  // the offset runs to 0
};

/// One direction of the nose, in um. NaN: not known.
struct CompensatorAxis {
  double predicted_um = std::numeric_limits<double>::quiet_NaN();  // error = actual - commanded
  double applied_um = std::numeric_limits<double>::quiet_NaN();    // compensation
  double left_um = std::numeric_limits<double>::quiet_NaN();       // measured
  double largestLeft_um = 0.0;                                     // of this session; 0: never measured
};

struct CompensatorState {
  QString blocked{};
  QString notNow{};  // the page stands, but nothing can be started
  CompensatorPhase phase = CompensatorPhase::ready;
  std::array<CompensatorAxis, 3> axes{};
  QString doing{};        // "compensating", "held at the edge of the training range"
  bool good = true;       // plainly following
  QStringList reasons{};  // why not
  QString notMeasured{};  // why nothing is measured now
  double running_s = 0.0;
  long turns = 0;
  long lostTurns = 0;
  double latest_ms = std::numeric_limits<double>::quiet_NaN();  // largest delay of a turn
  double limit_um = 200.0;
  QString summary{};  // of the last session, in a sentence
};

class CompensatorPage : public Page {
  Q_OBJECT

 public:
  explicit CompensatorPage(QWidget* parent = nullptr);
  void setState(const CompensatorState& state);
  const CompensatorState& state() const { return m_state; }
  void clear();
  /// One turn, in seconds since the start; what is left only when it was measured anew.
  void append(double time_s, const std::array<CompensatorAxis, 3>& axes, bool measured);

  QString title() const override;
  QString sentence() const override;
  /// Start compensating, Stop.
  PageAction primary() const override;
  bool steersWork() const override { return true; }

 protected:
  void render() override;
  void changeEvent(QEvent* event) override;

 private:
  void setCurves();

  CompensatorState m_state;
  ToggleSegment* m_span;
  Card* m_plotCard;
  Card* m_tableCard;
  LegendRow* m_legend;
  std::array<LivePlot*, 3> m_plots{};
  DataTable* m_table;
  WrapLabel* m_words;
};

}  // namespace zerodrift::ui
