#pragma once
// The guided form of a machine description: what it consists of at the left, the fields of the selected one at the
// right, the machine drawn above. It knows no physics: which items and fields there are, what is typical and what is
// wrong is given to it.

#include <QDialog>

#include "ui/widgets/machine_sketch.h"

class QFormLayout;
class QLabel;
class QMenu;
class QPushButton;
class QScrollArea;
class QTreeWidget;

namespace zerodrift::ui {

class ProblemBanner;

struct FormField {
  QString key{};
  QString label{};
  QString unit{};
  QString value{};
  QStringList choices{};  // typical values, a word in brackets behind each; closed: nothing else can be taken
  bool closed = false;
  QString empty{};  // shown where nothing is entered: "identified"
  QString tip{};
  QString problem{};  // what is expected instead
};

struct FormItem {
  QString path{};  // by which it is called in the signals
  QString title{};
  int depth = 0;  // 0: a heading or the machine; 1: a part; 2: its source
  bool heading = false;
  bool removable = false;
  int part = -1;  // of the sketch
  QVector<FormField> fields{};
};

/// What can be added.
struct FormOffer {
  QString kind{};
  QString label{};
  bool enabled = true;
};

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
  void fillTree();
  void fillFields();
  QWidget* makeField(const FormField& field);
  const FormItem* current() const;
  void retranslate();

  MachineFormState m_state;
  bool m_filling = false;
  QString m_built;  // which fields are on screen
  MachineSketch* m_sketch;
  QScrollArea* m_picture;
  QLabel* m_lead;
  ProblemBanner* m_problem;
  QTreeWidget* m_tree;
  QLabel* m_title;
  QScrollArea* m_scroll;
  QFormLayout* m_form = nullptr;
  QPushButton* m_add;
  QMenu* m_offers;
  QPushButton* m_remove;
  QPushButton* m_undo;
  QPushButton* m_open;
  QPushButton* m_export;
  QPushButton* m_cancel;
  QPushButton* m_take;
};

}  // namespace zerodrift::ui
