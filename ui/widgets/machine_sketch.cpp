#include "ui/widgets/machine_sketch.h"

#include <QMouseEvent>
#include <QPainter>
#include <QPainterPath>
#include <algorithm>

#include "ui/widgets/colors.h"

namespace zerodrift::ui {
namespace {

constexpr double row_height = 82.0;
constexpr double name_width = 120.0;
constexpr double right_margin = 60.0;
constexpr double lump_width = 130.0;

}  // namespace

MachineSketch::MachineSketch(QWidget* parent) : QWidget(parent) {
  setMinimumWidth(420);
}

void MachineSketch::setSketch(const Sketch& sketch) {
  m_sketch = sketch;
  setMinimumHeight(static_cast<int>(row_height * std::max<double>(1.0, static_cast<double>(sketch.parts.size()))) + 8);
  QStringList words;
  for (const SketchPart& part : sketch.parts) words << part.name;
  setAccessibleName(words.join(QStringLiteral(", ")));
  updateGeometry();
  update();
}

QSize MachineSketch::sizeHint() const {
  return {640, minimumHeight()};
}

QRectF MachineSketch::bodyOf(int part) const {
  const SketchPart& one = m_sketch.parts[part];
  const double y = row_height * part;
  if (one.lump) return {name_width, y + 22, lump_width, 36};
  double longest = 1.0;
  double thickest = 1.0;
  for (const SketchPart& other : m_sketch.parts) {
    if (other.lump) continue;
    longest = std::max(longest, other.length_mm);
    thickest = std::max(thickest, other.outer_mm);
  }
  const double width_px = (width() - name_width - right_margin) * std::clamp(one.length_mm / longest, 0.02, 1.0);
  const double height_px = std::clamp(36.0 * one.outer_mm / thickest, 8.0, 36.0);
  return {name_width, y + 40 - height_px / 2.0, width_px, height_px};
}

double MachineSketch::px(int part, double position_mm) const {
  const QRectF body = bodyOf(part);
  const SketchPart& one = m_sketch.parts[part];
  if (one.lump || one.length_mm <= 0.0) return body.center().x();
  return body.left() + body.width() * std::clamp(position_mm / one.length_mm, 0.0, 1.0);
}

void MachineSketch::paintPart(QPainter& painter, int number) const {
  const Colors& c = colors();
  const SketchPart& part = m_sketch.parts[number];
  const QRectF body = bodyOf(number);
  const bool current = number == m_sketch.current;
  painter.setFont(uiFont(12, current ? QFont::DemiBold : QFont::Normal));
  painter.setPen(c.text);
  const QString name = painter.fontMetrics().elidedText(part.name, Qt::ElideRight, static_cast<int>(name_width) - 24);
  painter.drawText(QRectF(4, body.center().y() - 10, name_width - 20, 20), Qt::AlignVCenter | Qt::AlignLeft, name);
  if (!part.lump) {
    painter.setPen(QPen(c.muted, 1.6));
    painter.drawLine(QPointF(body.left(), body.top() - 6), QPointF(body.left(), body.bottom() + 6));
    painter.setPen(QPen(c.muted, 1));
    for (double y = body.top() - 4; y < body.bottom() + 4; y += 7) {
      painter.drawLine(QPointF(body.left(), y), QPointF(body.left() - 6, y + 6));
    }
  }
  painter.setPen(QPen(current ? c.accent : mix(c.panel, c.muted, 0.7), current ? 2.0 : 1.4));
  painter.setBrush(mix(c.panel, c.muted, c.dark ? 0.3 : 0.16));
  painter.drawRoundedRect(body, part.lump ? 6 : 0, part.lump ? 6 : 0);
  painter.setFont(uiFont(11));
  double labelEnd = -1e9;
  for (const SketchMark& source : part.sources) {
    QRectF heat(px(number, source.from_mm), body.top() + 1,
                std::max(3.0, px(number, source.to_mm) - px(number, source.from_mm)), body.height() - 2);
    if (part.lump) heat = body.adjusted(1, 1, -1, -1);
    painter.setPen(Qt::NoPen);
    painter.setBrush(mix(c.panel, QColor("#E2602F"), c.dark ? 0.55 : 0.45));
    painter.drawRect(heat);
    const double w = painter.fontMetrics().horizontalAdvance(source.label);
    const double x = std::max(body.left(), heat.center().x() - w / 2.0);
    if (x < labelEnd) continue;  // two sources at one place: the first is named
    labelEnd = x + w + 8.0;
    painter.setPen(c.text);
    painter.drawText(QPointF(x, body.top() - 6), source.label);
  }
  painter.setFont(uiFont(11, QFont::Medium));
  double tagEnd = -1e9;
  int n = 0;
  for (const SketchMark& sensor : part.sensors) {
    const double share = (n + 1.0) / (static_cast<double>(part.sensors.size()) + 1.0);
    const double x = part.lump ? body.left() + body.width() * share : px(number, sensor.from_mm);
    ++n;
    painter.setPen(QPen(c.panel, 1.5));
    painter.setBrush(c.accent);
    painter.drawEllipse(QPointF(x, body.bottom()), 4.5, 4.5);
    const double w = painter.fontMetrics().horizontalAdvance(sensor.label);
    if (x - w / 2.0 < tagEnd) continue;
    tagEnd = x + w / 2.0 + 4.0;
    painter.setPen(c.text);
    painter.drawText(QRectF(x - 40, body.bottom() + 5, 80, 14), Qt::AlignCenter, sensor.label);
  }
}

void MachineSketch::paintCoupling(QPainter& painter, const SketchCoupling& coupling) const {
  const auto known = [&](int part) { return part >= 0 && part < m_sketch.parts.size(); };
  if (!known(coupling.first) || !known(coupling.second) || coupling.first == coupling.second) return;
  const int upper = std::min(coupling.first, coupling.second);
  const int lower = std::max(coupling.first, coupling.second);
  const double upper_mm = upper == coupling.first ? coupling.first_mm : coupling.second_mm;
  const double lower_mm = upper == coupling.first ? coupling.second_mm : coupling.first_mm;
  const QPointF from(px(upper, upper_mm), bodyOf(upper).bottom());
  const QPointF to(px(lower, lower_mm), bodyOf(lower).top());
  painter.setPen(QPen(colors().muted, 1.6, Qt::DashLine));
  painter.drawLine(from, to);
  painter.setFont(uiFont(11));
  painter.setPen(colors().muted);
  painter.drawText(QPointF((from.x() + to.x()) / 2.0 + 6.0, (from.y() + to.y()) / 2.0 + 12.0), coupling.label);
}

void MachineSketch::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  for (const SketchCoupling& coupling : m_sketch.couplings) paintCoupling(painter, coupling);
  for (int i = 0; i < m_sketch.parts.size(); ++i) paintPart(painter, i);
}

void MachineSketch::mousePressEvent(QMouseEvent* event) {
  const int part = static_cast<int>(event->position().y() / row_height);
  if (part >= 0 && part < m_sketch.parts.size()) Q_EMIT partClicked(part);
}

}  // namespace zerodrift::ui
