#include "ui/widgets/component_drawing.h"

#include "ui/widgets/on_language.h"

namespace zerodrift::ui {

ComponentDrawing::ComponentDrawing(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  onLanguage(this, [this] { setAccessibleName(tr("Component with heat sources and sensors")); });
}

QSize ComponentDrawing::sizeHint() const {
  return {480, 112};
}

QSize ComponentDrawing::minimumSizeHint() const {
  return {200, 112};
}

void ComponentDrawing::setComponent(const DrawnComponent& component) {
  m_component = component;
  update();
}

void ComponentDrawing::setScale(std::function<double(double)> toPixel) {
  m_toPixel = std::move(toPixel);
  update();
}

double ComponentDrawing::px(double position_mm) const {
  if (m_toPixel) return m_toPixel(position_mm);
  return 24.0 + (width() - 48.0) * position_mm / std::max(1.0, m_component.length_mm);
}

void ComponentDrawing::paintBody(QPainter& painter, const QRectF& body) const {
  const Colors& c = colors();
  // The wall of the fixed end, hatched as on a drawing of mechanics.
  painter.setPen(QPen(c.muted, 1.6));
  painter.drawLine(QPointF(body.left(), body.top() - 8), QPointF(body.left(), body.bottom() + 8));
  painter.setPen(QPen(c.muted, 1));
  const int strokes = static_cast<int>(std::ceil((body.height() + 12) / 7));
  for (int k = 0; k < strokes; ++k) {
    const double y = body.top() - 4 + 7 * k;
    painter.drawLine(QPointF(body.left(), y), QPointF(body.left() - 7, y + 7));
  }
  painter.setPen(QPen(mix(c.panel, c.muted, 0.7), 1.4));
  painter.setBrush(mix(c.panel, c.muted, c.dark ? 0.3 : 0.16));
  painter.drawRect(body);
  for (const DrawnSource& source : m_component.sources) {
    const QRectF heat(px(source.from_mm), body.top(), std::max(3.0, px(source.to_mm) - px(source.from_mm)),
                      body.height());
    painter.setPen(Qt::NoPen);
    painter.setBrush(mix(c.panel, QColor("#E2602F"), c.dark ? 0.55 : 0.45));
    painter.drawRect(heat.adjusted(0, 1, 0, -1));
    painter.setFont(uiFont(11));
    painter.setPen(c.text);
    painter.drawText(QRectF(heat.center().x() - 70, body.top() - 20, 140, 16), Qt::AlignCenter, source.label);
  }
  if (m_component.regionTo_mm > m_component.regionFrom_mm) {
    const double left = px(m_component.regionFrom_mm);
    const double right = px(m_component.regionTo_mm);
    painter.setPen(QPen(c.ok, 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(QRectF(left, body.top() - 3, right - left, body.height() + 6));
  }
  if (m_component.mismatchTo_mm > m_component.mismatchFrom_mm) {
    const double left = px(m_component.mismatchFrom_mm);
    const double right = px(m_component.mismatchTo_mm);
    painter.setPen(QPen(c.bad, 2, Qt::DashLine));
    painter.setBrush(Qt::NoBrush);
    painter.drawRect(QRectF(left, body.top() - 5, right - left, body.height() + 10));
  }
}

void ComponentDrawing::paintSensors(QPainter& painter, const QRectF& body) const {
  const Colors& c = colors();
  painter.setFont(uiFont(11, QFont::Medium));
  double lastRight[2] = {-1e9, -1e9};
  QVector<DrawnSensor> sensors = m_component.sensors;
  std::sort(sensors.begin(), sensors.end(),
            [](const DrawnSensor& a, const DrawnSensor& b) { return a.position_mm < b.position_mm; });
  for (const DrawnSensor& sensor : sensors) {
    const double x = px(sensor.position_mm);
    painter.setPen(QPen(c.panel, 1.5));
    painter.setBrush(sensor.judgement == Judgement::none ? c.accent : c.fill(sensor.judgement));
    painter.drawEllipse(QPointF(x, body.bottom()), 5, 5);
    // Two rows of names, so that neighbours do not cover each other.
    const double w = painter.fontMetrics().horizontalAdvance(sensor.tag) + 6.0;
    const int row = x - w / 2.0 > lastRight[0] ? 0 : 1;
    lastRight[row] = x + w / 2.0;
    painter.setPen(c.ink(sensor.judgement) == c.muted ? c.text : c.ink(sensor.judgement));
    painter.drawText(QRectF(x - 30, body.bottom() + 6 + 13 * row, 60, 14), Qt::AlignCenter, sensor.tag);
  }
}

void ComponentDrawing::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  const double left = px(0.0);
  const double right = px(m_component.length_mm);
  const QRectF body(left, 30, right - left, 40);
  paintBody(painter, body);
  paintSensors(painter, body);
  const auto legend = [&](const QColor& color, const QString& text, double x) {
    painter.setFont(uiFont(11));
    painter.setPen(color);
    painter.drawText(QRectF(x, 96, 300, 14), Qt::AlignVCenter, text);
    return x + painter.fontMetrics().horizontalAdvance(text) + 20.0;
  };
  constexpr double short_mm = 100.0;
  const auto mm = [&](double at_mm) { return QString::number(at_mm, 'f', m_component.length_mm < short_mm ? 1 : 0); };
  double x = left;
  if (m_component.regionTo_mm > m_component.regionFrom_mm) {
    x = legend(
        colors().okText,
        tr("recommended sensor region %1 to %2 mm").arg(mm(m_component.regionFrom_mm), mm(m_component.regionTo_mm)), x);
  }
  if (m_component.mismatchTo_mm > m_component.mismatchFrom_mm) {
    legend(colors().badText,
           tr("mismatch %1 to %2 mm").arg(mm(m_component.mismatchFrom_mm), mm(m_component.mismatchTo_mm)), x);
  }
}

}  // namespace zerodrift::ui
