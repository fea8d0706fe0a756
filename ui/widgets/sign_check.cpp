#include "ui/widgets/sign_check.h"

#include <cmath>

namespace zerodrift::ui {
namespace {

void arrow(QPainter& painter, const QPointF& from, const QPointF& to, const QColor& color, double width) {
  painter.setPen(QPen(color, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawLine(from, to);
  const QPointF way = to - from;
  const double length = std::hypot(way.x(), way.y());
  if (length < 4.0) return;
  const QPointF along = way / length;
  const QPointF across(-along.y(), along.x());
  painter.drawPolyline(QPolygonF({to - 9 * along + 5 * across, to, to - 9 * along - 5 * across}));
}

}  // namespace

SignCheck::SignCheck(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
}

void SignCheck::setResult(const SignCheckResult& result) {
  m_result = result;
  setAccessibleName(tr("Sign check: %1").arg(result.word));
  update();
}

void SignCheck::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  const Colors& c = colors();
  const double side = std::min(width() * 0.42, height() - 8.0);
  const QRectF field(4, (height() - side) / 2.0, side, side);
  painter.setPen(c.line);
  painter.setBrush(c.window);
  painter.drawRoundedRect(field, 4, 4);
  painter.setPen(QPen(c.line, 1, Qt::DotLine));
  painter.drawLine(QPointF(field.left(), field.center().y()), QPointF(field.right(), field.center().y()));
  painter.drawLine(QPointF(field.center().x(), field.top()), QPointF(field.center().x(), field.bottom()));
  painter.setFont(uiFont(11));
  painter.setPen(c.muted);
  painter.drawText(field.adjusted(0, 0, -4, -2), Qt::AlignRight | Qt::AlignBottom, m_result.axisRight);
  painter.drawText(field.adjusted(5, 2, 0, 0), Qt::AlignLeft | Qt::AlignTop, m_result.axisUp);
  const double reach = std::max({std::hypot(m_result.commandedRight_um, m_result.commandedUp_um),
                                 std::hypot(m_result.seenRight_um, m_result.seenUp_um), 1e-6});
  const double scale = 0.4 * side / reach;
  const auto tip = [&](double right, double up) { return field.center() + QPointF(right * scale, -up * scale); };
  const QColor seen = m_result.judgement == Judgement::bad ? c.bad : c.ok;
  if (m_result.measured) {
    arrow(painter, field.center(), tip(m_result.commandedRight_um, m_result.commandedUp_um), c.accent, 5);
    arrow(painter, field.center(), tip(m_result.seenRight_um, m_result.seenUp_um), seen, 2.2);
  }
  const double left = field.right() + 14;
  const double room = width() - left;
  double y = field.top() + 2;
  const auto line = [&](const QColor& color, const QString& text, bool strong) {
    painter.setFont(uiFont(12, strong ? QFont::DemiBold : QFont::Normal));
    painter.setPen(color);
    const QRectF box(left, y, room, 60);
    QRectF used;
    painter.drawText(box, Qt::TextWordWrap, text, &used);
    y += used.height() + 5;
  };
  if (!m_result.measured) {
    line(c.muted, tr("Not checked yet. A small test offset is written and watched by the camera before the table."),
         false);
    return;
  }
  const auto um = [](double value) { return QString::number(value, 'f', 1); };
  line(c.accent, tr("Commanded %1, %2 µm").arg(um(m_result.commandedRight_um), um(m_result.commandedUp_um)), false);
  line(seen, tr("Seen %1, %2 ± %3 µm").arg(um(m_result.seenRight_um), um(m_result.seenUp_um), um(m_result.sigma_um)),
       false);
  drawJudgement(painter, QRectF(left, y + 2, 13, 13), m_result.judgement);
  painter.setFont(uiFont(12, QFont::DemiBold));
  painter.setPen(c.ink(m_result.judgement));
  painter.drawText(QRectF(left + 20, y, room - 20, 40), Qt::TextWordWrap, m_result.word);
}

}  // namespace zerodrift::ui
