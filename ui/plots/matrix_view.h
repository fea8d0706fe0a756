#pragma once
// Correlations as coloured cells with their figures: rows sensors, columns errors or sensors. Values -1 .. 1.

#include <QString>
#include <QStringList>
#include <QVector>
#include <QWidget>

namespace zerodrift::ui {

class MatrixView : public QWidget {
  Q_OBJECT

 public:
  explicit MatrixView(QWidget* parent = nullptr);
  /// values row by row; NaN shows an empty cell.
  void setMatrix(const QStringList& rows, const QStringList& columns, const QVector<double>& values);
  void setSelectedRow(int row);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 Q_SIGNALS:
  void cellClicked(int row, int column);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  bool event(QEvent* event) override;

 private:
  QRectF cell(int row, int column) const;
  bool cellAt(const QPointF& at, int* row, int* column) const;

  QStringList m_rows;
  QStringList m_columns;
  QVector<double> m_values;
  int m_selectedRow = -1;
};

}  // namespace zerodrift::ui
