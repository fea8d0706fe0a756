#pragma once
// A compact table for figures: right-aligned numbers, state words with shapes, coloured cells, checkable rows.

#include <QColor>
#include <QString>
#include <QVector>
#include <QWidget>

#include "ui/widgets/colors.h"

class QTableWidget;
class QTableWidgetItem;

namespace zerodrift::ui {

struct DataColumn {
  QString title{};
  int width = 0;  // px; 0: takes the rest
  bool number = false;
  QString tip{};
};

struct DataCell {
  QString text{};
  Judgement judgement = Judgement::none;
  bool judged = false;  // shows the shape and colours the text
  QColor swatch{};      // a colour disc before the text
  QColor background{};  // for example a correlation
  bool checkable = false;
  bool checked = false;
  bool strong = false;
  QString tip{};
};

class DataTable : public QWidget {
  Q_OBJECT

 public:
  explicit DataTable(QWidget* parent = nullptr);
  void setColumns(const QVector<DataColumn>& columns);
  void setRows(const QVector<QVector<DataCell>>& rows);
  int rowCount() const;
  int currentRow() const;
  void selectRow(int row);
  void setRowHeight(int pixels);
  /// As high as its rows: for short tables that need no scroll bar.
  void setFitted(bool fitted);
  /// That shows all of them without a scroll bar.
  int heightOfRows() const;

 Q_SIGNALS:
  void rowSelected(int row);
  void rowHovered(int row);  // -1: none
  void rowActivated(int row);
  void checkChanged(int row, bool checked);

 protected:
  bool eventFilter(QObject* watched, QEvent* event) override;

 private:
  void fitHeight();

  QTableWidget* m_table;
  bool m_filling = false;
  bool m_fitted = false;
  int m_rowHeight = 24;
  int m_hovered = -1;
};

}  // namespace zerodrift::ui
