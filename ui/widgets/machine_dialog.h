#pragma once
// The guided form of a machine description: what it consists of at the left, the fields of the selected one at the
// right, the machine drawn above. It knows no physics: which items and fields there are, what is typical and what is
// wrong is given to it.

#include <QDialog>

#include "ui/widgets/item_form.h"
#include "ui/widgets/machine_sketch.h"

class QLabel;
class QPushButton;
class QScrollArea;

namespace zerodrift::ui {

class ProblemBanner;

struct MachineFormState {
  QVector<FormItem> items{};
  QString current{};  // path
  Sketch sketch{};
  QVector<FormOffer> offers{};
  QString sentence{};  // what is wrong with the description; empty: nothing
  QString remedy{};
  bool canUndo = false;
};

class MachineDialog : public QDialog {
  Q_OBJECT

 public:
  explicit MachineDialog(QWidget* parent = nullptr);
  void setState(const MachineFormState& state);
  const MachineFormState& state() const { return m_state; }

 Q_SIGNALS:
  void selected(const QString& path);
  void edited(const QString& path, const QString& key, const QString& value);
  void addRequested(const QString& kind);
  void removeRequested(const QString& path);
  void undoRequested();
  void openRequested();
  void exportRequested();
  /// What it is given must be said again.
  void languageChanged();

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void makeTop(class QVBoxLayout* into);
  void retranslate();

  MachineFormState m_state;
  MachineSketch* m_sketch;
  QScrollArea* m_picture;
  QLabel* m_lead;
  ProblemBanner* m_problem;
  ItemForm* m_form;
  QPushButton* m_open;
  QPushButton* m_export;
  QPushButton* m_cancel;
  QPushButton* m_take;
};

}  // namespace zerodrift::ui
