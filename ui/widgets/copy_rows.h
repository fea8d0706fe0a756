#pragma once
// Tables can be copied: Ctrl+C puts the selected rows, or all where none is, into the clipboard, with the header and
// tabs between the cells, as a spreadsheet takes them.

#include <QString>

class QAbstractItemView;

namespace zerodrift::ui {

void copyRows(QAbstractItemView* table);
QString rowsText(const QAbstractItemView& table);

}  // namespace zerodrift::ui
