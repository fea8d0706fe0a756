#pragma once
// A layout that gives a table only as much height as whole rows take: no row is cut in half where more follow.

#include <QVBoxLayout>

class QTableView;

namespace zerodrift::ui {

/// Holds the table alone, without margins. All rows of the table have the same height.
class WholeRows : public QVBoxLayout {
 public:
  WholeRows(QWidget* parent, QTableView* table);
  void setGeometry(const QRect& area) override;

 private:
  QTableView* m_table;
};

}  // namespace zerodrift::ui
