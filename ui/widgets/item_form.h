#pragma once
// A document as a guided form: what it consists of at the left, the fields of the selected one at the right. Knows no
// meaning: which items and fields there are, what is offered and what is wrong is given to it. Shared by the
// description of a machine and the set-up of a rig.

#include <QString>
#include <QStringList>
#include <QVector>
#include <QWidget>

class QFormLayout;
class QLabel;
class QMenu;
class QPushButton;
class QScrollArea;
class QTreeWidget;
class QVBoxLayout;

namespace zerodrift::ui {

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
  int depth = 0;  // 0: a heading or the whole; 1: a part; 2: a part of it
  bool heading = false;
  bool removable = false;
  int part = -1;  // of a drawing
  QVector<FormField> fields{};
};

/// A title in the list, with nothing to enter.
inline FormItem headingItem(const QString& title) {
  FormItem item;
  item.title = title;
  item.heading = true;
  return item;
}

/// What can be added.
struct FormOffer {
  QString kind{};
  QString label{};
  bool enabled = true;
};

struct FormState {
  QVector<FormItem> items{};
  QString current{};  // path
  QVector<FormOffer> offers{};
  bool canUndo = false;
};

class ItemForm : public QWidget {
  Q_OBJECT

 public:
  explicit ItemForm(QWidget* parent = nullptr);
  void setState(const FormState& state);
  /// Off where the form is a part of something that has it.
  void setUndoShown(bool shown);
  /// Below the fields.
  QVBoxLayout* right() const { return m_right; }
  /// Builds the fields and says all texts again.
  void retranslate();

 Q_SIGNALS:
  void selected(const QString& path);
  void edited(const QString& path, const QString& key, const QString& value);
  void addRequested(const QString& kind);
  void removeRequested(const QString& path);
  void undoRequested();

 private:
  void fillTree();
  void fillFields();
  void fillField(const FormField& field);
  QWidget* makeField(const FormField& field);
  const FormItem* current() const;

  FormState m_state;
  bool m_filling = false;
  QString m_built;  // which fields are on screen
  QTreeWidget* m_tree;
  QLabel* m_title;
  QScrollArea* m_scroll;
  QFormLayout* m_form = nullptr;
  QVBoxLayout* m_right;
  QPushButton* m_add;
  QMenu* m_offers;
  QPushButton* m_remove;
  QPushButton* m_undo;
};

}  // namespace zerodrift::ui
