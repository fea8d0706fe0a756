#include "ui/widgets/signature_pad.h"

#include "ui/widgets/colors.h"
#include "ui/widgets/on_language.h"

namespace zerodrift::ui {

SignaturePad::SignaturePad(QWidget* parent) : QWidget(parent) {
  setCursor(Qt::CrossCursor);
  onLanguage(this, [this] {
    setAccessibleName(tr("Signature"));
    setToolTip(tr("Sign here. Double click clears."));
  });
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void SignaturePad::clear() {
  m_strokes.clear();
  update();
  Q_EMIT drawn({});
}

QImage SignaturePad::image() const {
  if (m_strokes.isEmpty()) return {};
  QImage picture(size() * 2, QImage::Format_ARGB32_Premultiplied);
  picture.fill(Qt::transparent);
  QPainter painter(&picture);
  painter.setRenderHint(QPainter::Antialiasing);
  painter.scale(2, 2);
  painter.setPen(QPen(Qt::black, 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  for (const auto& stroke : m_strokes) painter.drawPolyline(QPolygonF(stroke));
  return picture;
}

void SignaturePad::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const Colors& c = colors();
  painter.setPen(QPen(mix(c.line, c.muted, 0.45)));
  painter.setBrush(c.panel);
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 4, 4);
  painter.setPen(QPen(c.line, 1, Qt::DashLine));
  painter.drawLine(12, height() - 18, width() - 12, height() - 18);
  if (m_strokes.isEmpty()) {
    painter.setPen(c.muted);
    painter.setFont(uiFont(12));
    painter.drawText(rect().adjusted(14, 0, -14, -22), Qt::AlignBottom, tr("Sign here"));
  }
  painter.setPen(QPen(c.text, 1.8, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  for (const auto& stroke : m_strokes) painter.drawPolyline(QPolygonF(stroke));
}

void SignaturePad::mousePressEvent(QMouseEvent* event) {
  m_strokes.append({event->position()});
}

void SignaturePad::mouseMoveEvent(QMouseEvent* event) {
  if (m_strokes.isEmpty()) return;
  m_strokes.last().append(event->position());
  update();
}

void SignaturePad::mouseReleaseEvent(QMouseEvent*) {
  if (!m_strokes.isEmpty() && m_strokes.last().size() < 2) m_strokes.removeLast();
  Q_EMIT drawn(image());
}

void SignaturePad::mouseDoubleClickEvent(QMouseEvent*) {
  clear();
}

}  // namespace zerodrift::ui
