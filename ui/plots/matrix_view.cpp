#include "ui/plots/matrix_view.h"

#include <cmath>

#include "ui/widgets/colors.h"
#include "ui/widgets/fitted_text.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/on_language.h"

namespace zerodrift::ui {
namespace {

constexpr double labelWidth = 56.0;
constexpr double headHeight = 24.0;

}  // namespace

MatrixView::MatrixView(QWidget* parent) : QWidget(parent) {
  setMouseTracking(true);
  onLanguage(this, [this] { setAccessibleName(tr("Correlation matrix")); });
}

void MatrixView::setMatrix(const QStringList& rows, const QStringList& columns, const QVector<double>& values) {
  m_rows = rows;
  m_columns = columns;
  m_values = values;
  m_values.resize(rows.size() * columns.size());
  updateGeometry();
  update();
}

void MatrixView::setSelectedRow(int row) {
  m_selectedRow = row;
  update();
}

QSize MatrixView::sizeHint() const {
  return {static_cast<int>(labelWidth) + 44 * static_cast<int>(m_columns.size()),
          static_cast<int>(headHeight) + 22 * static_cast<int>(m_rows.size())};
}

QSize MatrixView::minimumSizeHint() const {
  return {160, static_cast<int>(headHeight) + 10 * static_cast<int>(m_rows.size())};
}

QRectF MatrixView::cell(int row, int column) const {
  const double w = (width() - labelWidth) / std::max<double>(1.0, static_cast<double>(m_columns.size()));
  const double h = std::min(26.0, (height() - headHeight) / std::max<double>(1.0, static_cast<double>(m_rows.size())));
  return {labelWidth + column * w, headHeight + row * h, w, h};
}

bool MatrixView::cellAt(const QPointF& at, int* row, int* column) const {
  for (*row = 0; *row < m_rows.size(); ++*row) {
    for (*column = 0; *column < m_columns.size(); ++*column) {
      if (cell(*row, *column).contains(at)) return true;
    }
  }
  return false;
}

void MatrixView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  const Colors& c = colors();
  painter.setFont(uiFont(11));
  for (int column = 0; column < m_columns.size(); ++column) {
    const QRectF top = cell(0, column);
    painter.setPen(c.muted);
    painter.drawText(QRectF(top.x(), 0, top.width(), headHeight), Qt::AlignCenter,
                     fittedText(painter.fontMetrics(), m_columns[column], static_cast<int>(top.width()), {}));
  }
  for (int row = 0; row < m_rows.size(); ++row) {
    const QRectF first = cell(row, 0);
    if (row == m_selectedRow) painter.fillRect(QRectF(0, first.y(), width(), first.height()), c.soft(c.accent));
    painter.setPen(row == m_selectedRow ? c.text : c.muted);
    painter.drawText(QRectF(0, first.y(), labelWidth - 8, first.height()), Qt::AlignVCenter | Qt::AlignRight,
                     m_rows[row]);
    for (int column = 0; column < m_columns.size(); ++column) {
      const QRectF box = cell(row, column).adjusted(1, 1, -1, -1);
      const double value = m_values[row * m_columns.size() + column];
      if (std::isnan(value)) {
        painter.fillRect(box, c.grid);
        continue;
      }
      const QColor fill = divergingColor(value);
      painter.fillRect(box, fill);
      if (box.width() < 30 || box.height() < 12) continue;
      // Whichever of the two text colours stands out from the cell.
      painter.setPen(fill.lightness() > 140 ? lightColors().text : QColor(Qt::white));
      painter.drawText(box, Qt::AlignCenter, fixedText(value, 2));
    }
  }
}

void MatrixView::mouseReleaseEvent(QMouseEvent* event) {
  int row = 0;
  int column = 0;
  if (cellAt(event->position(), &row, &column)) Q_EMIT cellClicked(row, column);
}

bool MatrixView::event(QEvent* event) {
  if (event->type() == QEvent::ToolTip) {
    int row = 0;
    int column = 0;
    const auto* help = static_cast<QHelpEvent*>(event);
    if (cellAt(help->pos(), &row, &column)) {
      QToolTip::showText(help->globalPos(), QStringLiteral("%1, %2: %3")
                                                .arg(m_rows[row], m_columns[column])
                                                .arg(m_values[row * m_columns.size() + column], 0, 'f', 3));
      return true;
    }
  }
  return QWidget::event(event);
}

}  // namespace zerodrift::ui
