#include "ui/widgets/whole_rows.h"

#include <QHeaderView>
#include <QTableView>

namespace zerodrift::ui {

WholeRows::WholeRows(QWidget* parent, QTableView* table) : QVBoxLayout(parent), m_table(table) {
  setContentsMargins(0, 0, 0, 0);
  addWidget(table);
}

void WholeRows::setGeometry(const QRect& area) {
  const auto* model = m_table->model();
  const int rows = model == nullptr ? 0 : model->rowCount();
  const int row = rows > 0 ? m_table->rowHeight(0) : 0;
  const int room = area.height() - m_table->horizontalHeader()->height();
  const bool scrolls = row > 0 && room > row && rows * row > room;
  QVBoxLayout::setGeometry(scrolls ? area.adjusted(0, 0, 0, -(room % row)) : area);
}

}  // namespace zerodrift::ui
