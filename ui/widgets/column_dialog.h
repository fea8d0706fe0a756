#pragma once
// What are the columns of this table? The first rows as they are, a role over each column, units, and at once what
// would come of it.

#include <QDialog>
#include <QString>
#include <QStringList>
#include <QVector>

class QCheckBox;
class QComboBox;
class QLabel;
class QPushButton;
class QTableWidget;

namespace zerodrift::ui {

struct ColumnChoice {
  QVector<int> roles{};  // of each column, an index into ColumnDialog::roleNames()
  int positionUnit = 0;  // mm, µm, inch; -1: another
  int errorUnit = 0;     // µm, mm, inch, microinch, mil, 0.0001 inch; -1: another
  bool negated = false;
  bool order = false;  // the order of the rows tells the approach

  bool operator==(const ColumnChoice& other) const = default;
};

class ColumnDialog : public QDialog {
  Q_OBJECT

 public:
  ColumnDialog(const QStringList& names, const QVector<QStringList>& rows, const ColumnChoice& choice,
               QWidget* parent = nullptr);
  /// Ignored, position, error, error up, error down, measured, measured up, measured down, direction, run.
  static QStringList roleNames();
  ColumnChoice choice() const;
  /// What comes of the choice; only a good one can be taken.
  void setVerdict(const QString& text, bool good);

 Q_SIGNALS:
  void changed();

 private:
  QTableWidget* m_table;
  QVector<QComboBox*> m_roles;
  QComboBox* m_positionUnit;
  QComboBox* m_errorUnit;
  QCheckBox* m_negated;
  QCheckBox* m_order;
  QLabel* m_verdict;
  QPushButton* m_take;
};

}  // namespace zerodrift::ui
