#pragma once
// Writing the table into the controller (C5): old and new side by side, difference against limits, sign check, the
// transaction's states as they pass, history with rollback. The question before writing is asked outside the page.

#include <QStringList>
#include <limits>
#include <optional>

#include "ui/pages/page.h"
#include "ui/widgets/sign_check.h"
#include "ui/widgets/step_list.h"

class QLabel;
class QPushButton;
class QStackedWidget;

namespace zerodrift::ui {

class Card;
class DataTable;
class LegendRow;
class ToggleSegment;
class XyPlot;

/// Of the predicted error (actual - commanded).
struct TableTerm {
  QString name{};                                            // "T3 front bearing", "offset", "point 120 mm"
  QString unit{};                                            // "µm/K"
  double before = std::numeric_limits<double>::quiet_NaN();  // NaN: not in the old table
  double after = std::numeric_limits<double>::quiet_NaN();
};

/// Old and new compensation of one axis over what they depend on, and what is allowed.
struct AxisTable {
  QString axis{};
  QVector<TableTerm> terms{};
  QString abscissa{};  // "time of the run / h", "position / mm"
  bool overTime = false;
  QVector<double> x{};
  QVector<double> before_um{};
  QVector<double> after_um{};
  double limit_um = 200.0;
};

/// One table that was active in the machine at some time.
struct TableVersion {
  QString id{};
  int version = 0;
  QString when{};
  QString who{};
  QString how{};   // "upload", "rollback to 2"
  QString what{};  // "X Y Z, 48 registers"
  QString note{};  // more to know about it
  bool active = false;
  bool proposed = false;  // what one goes back to when nothing else is chosen
  QString blocked{};      // why it cannot be brought back; empty: it can
};

struct UploadState {
  QString blocked{};
  QString machineName{};
  std::optional<int> oldVersion{};  // in the machine before; 0: none was there
  std::optional<int> newVersion{};  // nothing while the machine was not read yet
  QVector<AxisTable> axes{};
  QStringList lost{};      // what the controller cannot express
  QStringList warnings{};  // of the transaction, whole sentences
  QString expressed{};     // "temperature terms and points; 412 of 2000 registers"
  double largestChange_um = std::numeric_limits<double>::quiet_NaN();
  double changeLimit_um = 200.0;
  double steepest_um_per_K = std::numeric_limits<double>::quiet_NaN();
  double steepestLimit_um_per_K = 50.0;
  double registers = std::numeric_limits<double>::quiet_NaN();
  double capacity = 2000.0;
  double ramp_percent = std::numeric_limits<double>::quiet_NaN();
  QVector<Stage> stages{};
  QString stagesNote{};  // "dry run 10:32"
  SignCheckResult sign{};
  QVector<TableVersion> history{};  // newest first
  QString rollbackBlocked{};        // why nothing can be brought back now
  QString offline{};                // why nothing can be written or tried now; empty: connected
  QString asOf{};                   // written, but away from the machine: when this was so
  bool writtenEmpty = false;        // what is written compensates nothing: gone back to before the first table
  bool proved = false;              // the verification run with what is written is done
  bool compensationOn = false;
  bool writing = false;
  bool written = false;
};

class UploadPage : public Page {
  Q_OBJECT

 public:
  explicit UploadPage(QWidget* parent = nullptr);
  void setState(const UploadState& state);
  const UploadState& state() const { return m_state; }
  /// The history, with the newest entry of this version chosen.
  void showHistory(int version);

  QString title() const override;
  QString sentence() const override;
  PageAction primary() const override;
  /// "dryRun", "sign", "export".
  QVector<PageAction> secondary() const override;

 Q_SIGNALS:
  void rollbackRequested(const QString& id);

 protected:
  void render() override;

 private:
  Card* makeTable();
  Card* makeWriting();
  Card* makeSign();
  void renderAxis();
  void renderTransaction();
  void renderHistory();
  void renderRollback();
  int proposedRow() const;
  QVector<Figure> figures() const;

  UploadState m_state;
  Card* m_tableCard;
  Card* m_writeCard;
  Card* m_signCard;
  ToggleSegment* m_axis;
  ToggleSegment* m_side;
  XyPlot* m_curves;
  LegendRow* m_legend;
  DataTable* m_terms;
  QLabel* m_loss;
  QStackedWidget* m_sides;
  StepList* m_stages;
  DataTable* m_history;
  QPushButton* m_rollback;
  QLabel* m_rollbackHint;
  QString m_chosen{};  // id in the history
  SignCheck* m_sign;
};

}  // namespace zerodrift::ui
