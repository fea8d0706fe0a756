#include "ui/widgets/legend_row.h"

#include "ui/widgets/colors.h"
#include "ui/widgets/fitted_text.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::ui {
namespace {

constexpr int legendIndent = 12;
constexpr int legendSwatch = 20;

}  // namespace

LegendRow::LegendRow(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

QSize LegendRow::sizeHint() const {
  return {300, 18};
}

void LegendRow::setItems(const QVector<LegendItem>& items) {
  m_items = items;
  QStringList names;
  for (const LegendItem& item : items) names.append(item.text);
  setAccessibleName(tr("Curves: %1").arg(listText(names)));
  setToolTip(listText(names));
  update();
}

void LegendRow::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  painter.setFont(uiFont(12));
  double x = legendIndent;
  const double y = height() / 2.0;
  for (const LegendItem& item : m_items) {
    QColor fill = item.color;
    if (item.band) {
      fill.setAlphaF(0.25F);
      painter.fillRect(QRectF(x, y - 5, legendSwatch, 10), fill);
    } else if (item.point) {
      painter.setPen(Qt::NoPen);
      painter.setBrush(item.color);
      painter.drawEllipse(QPointF(x + legendSwatch / 2.0, y), 4, 4);
    } else {
      painter.setPen(QPen(item.color, 2.4, item.dashed ? Qt::DashLine : Qt::SolidLine, Qt::FlatCap));
      painter.drawLine(QPointF(x, y), QPointF(x + legendSwatch, y));
    }
    x += legendSwatch + 6;
    painter.setPen(colors().muted);
    const double w = painter.fontMetrics().horizontalAdvance(item.text);
    painter.drawText(QRectF(x, 0, w + 4, height()), Qt::AlignVCenter,
                     fittedText(painter.fontMetrics(), item.text, static_cast<int>(width() - x), toolTip()));
    x += w + 20;
  }
}

}  // namespace zerodrift::ui
