#include "ui/widgets/copy_rows.h"

#include <QAbstractItemView>
#include <QClipboard>
#include <QGuiApplication>
#include <QShortcut>

namespace zerodrift::ui {

QString rowsText(const QAbstractItemView& table) {
  const QAbstractItemModel* model = table.model();
  const QItemSelectionModel* selection = table.selectionModel();
  QStringList cells;
  for (int c = 0; c < model->columnCount(); ++c) cells << model->headerData(c, Qt::Horizontal).toString();
  QStringList lines{cells.join(QLatin1Char('\t'))};
  const bool all = !selection->hasSelection();
  for (int r = 0; r < model->rowCount(); ++r) {
    if (!all && !selection->rowIntersectsSelection(r)) continue;
    cells.clear();
    for (int c = 0; c < model->columnCount(); ++c) cells << model->index(r, c).data().toString();
    lines << cells.join(QLatin1Char('\t'));
  }
  return lines.join(QLatin1Char('\n'));
}

void copyRows(QAbstractItemView* table) {
  auto* copy = new QShortcut(QKeySequence::Copy, table);
  copy->setContext(Qt::WidgetWithChildrenShortcut);
  QObject::connect(copy, &QShortcut::activated, table,
                   [table] { QGuiApplication::clipboard()->setText(rowsText(*table)); });
}

}  // namespace zerodrift::ui
