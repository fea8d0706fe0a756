#include "ui/shell/lamp.h"

#include "ui/widgets/fitted_text.h"

namespace zerodrift::ui {

Lamp::Lamp(const QString& id, QWidget* parent) : QAbstractButton(parent) {
  setObjectName("lamp-" + id);
  setProperty("elides", true);
  setFocusPolicy(Qt::TabFocus);
  setSizePolicy(QSizePolicy::Preferred, QSizePolicy::Fixed);
}

void Lamp::setState(const QString& text, Judgement judgement, bool strong) {
  if (text == this->text() && judgement == m_judgement && strong == m_strong) return;
  m_judgement = judgement;
  m_strong = strong;
  setText(text);
  setAccessibleName(text);
  setToolTip(text);
  updateGeometry();
  update();
}

QSize Lamp::sizeHint() const {
  const QFontMetrics metrics(uiFont(13, m_strong ? QFont::DemiBold : QFont::Normal));
  return {metrics.horizontalAdvance(text()) + 30, 40};
}

QSize Lamp::minimumSizeHint() const {
  return {70, 40};
}

void Lamp::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  const Colors& c = colors();
  const QPointF centre(9, height() / 2.0);
  const QColor color = c.fill(m_judgement);
  painter.setPen(Qt::NoPen);
  painter.setBrush(mix(c.panel, color, 0.28));
  painter.drawEllipse(centre, 7, 7);
  if (m_judgement == Judgement::bad) {
    drawJudgement(painter, QRectF(centre.x() - 6, centre.y() - 6, 12, 12), m_judgement);
  } else if (m_judgement == Judgement::none) {
    painter.setBrush(c.panel);
    painter.setPen(QPen(color, 1.5));
    painter.drawEllipse(centre, 3.6, 3.6);
  } else {
    painter.setBrush(color);
    painter.drawEllipse(centre, 4.2, 4.2);
  }
  painter.setFont(uiFont(13, m_strong ? QFont::DemiBold : QFont::Normal));
  painter.setPen(m_strong || m_judgement == Judgement::bad
                     ? (m_judgement == Judgement::none ? c.text : c.ink(m_judgement))
                     : c.muted);
  const QRect inside = rect().adjusted(24, 0, -2, 0);
  painter.drawText(inside, Qt::AlignVCenter, fittedText(painter.fontMetrics(), text(), inside.width(), toolTip()));
  if (hasFocus()) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(c.accent, 2));
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 4, -1, -4), 4, 4);
  }
}

}  // namespace zerodrift::ui
