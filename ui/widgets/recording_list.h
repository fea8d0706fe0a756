#pragma once
// The recordings of a job: which one is shown, what each is called and what it serves for. All but the first can be
// renamed, given another role and removed.

#include <QStringList>

#include "ui/widgets/card.h"

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;

namespace zerodrift::ui {

class DataTable;

/// In the order of RecordingList::roleNames().
enum class RecordingUse {
  training,
  otherDay,
  cooling,
};

struct RecordingRow {
  QString name{};
  RecordingUse use = RecordingUse::training;
  QString words{};  // what the selected one says: length, channels, what it is used for
};

class RecordingList : public Card {
  Q_OBJECT

 public:
  explicit RecordingList(QWidget* parent = nullptr);
  /// The first is the warm-up run.
  void setRecordings(const QVector<RecordingRow>& rows, int shown);
  /// What a recording beside the first can serve as.
  static QStringList roleNames();
  void retranslate();

 Q_SIGNALS:
  void shown(int index);
  void renamed(int index, const QString& name);
  void roleChosen(int index, zerodrift::ui::RecordingUse use);
  void removeRequested(int index);

 private:
  void fill();

  QVector<RecordingRow> m_rows;
  int m_shown = 0;
  bool m_filling = false;
  DataTable* m_table;
  QLineEdit* m_name;
  QComboBox* m_role;
  QPushButton* m_remove;
  QLabel* m_words;
};

}  // namespace zerodrift::ui
