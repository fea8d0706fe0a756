#include "ui/widgets/machine_drawing.h"

#include <cmath>

#include "ui/widgets/machine_scene.h"
#include "ui/widgets/on_language.h"

namespace zerodrift::ui {
namespace {

constexpr double largestRadius_px = 10.0;

/// Cool to warm, for the discs; the figure itself stands in the table.
QColor warmthColor(double warmth) {
  const Colors& c = colors();
  return mix(c.dark ? QColor("#2F6CA3") : QColor("#3D7DB8"), c.dark ? QColor("#D9603F") : QColor("#C8402A"),
             std::clamp(warmth, 0.0, 1.0));
}

}  // namespace

MachineDrawing::MachineDrawing(QWidget* parent) : QWidget(parent) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
  onLanguage(this, [this] { setAccessibleName(tr("Machine with its sensors")); });
}

QSize MachineDrawing::sizeHint() const {
  return {520, 460};
}

QSize MachineDrawing::minimumSizeHint() const {
  return {260, 150};
}

void MachineDrawing::setSensors(const QVector<SensorSpot>& sensors) {
  const bool same = std::equal(sensors.begin(), sensors.end(), m_sensors.begin(), m_sensors.end(),
                               [](const SensorSpot& a, const SensorSpot& b) {
                                 return a.id == b.id && a.place == b.place && a.along == b.along;
                               });
  m_sensors = sensors;
  if (!same) place();
  update();
}

void MachineDrawing::place() {
  m_places.clear();
  QHash<QString, int> total;
  QHash<QString, int> used;
  const auto group = [](const SensorSpot& s) { return stretchOf(s.place).known ? s.place : QString("?"); };
  for (const SensorSpot& sensor : m_sensors) {
    if (sensor.along < 0.0) ++total[group(sensor)];
  }
  for (const SensorSpot& sensor : m_sensors) {
    const Stretch stretch = stretchOf(sensor.place);
    double share = sensor.along;
    if (share < 0.0) {
      // A screw has its support bearing at the fixed end and its nut on the way; several share the stretch evenly.
      const int n = total[group(sensor)];
      const int i = used[group(sensor)]++;
      share = n == 1 ? 0.5 : 1.0 - static_cast<double>(i) / (n - 1);
    }
    const auto between = [share](double a, double b) { return a + share * (b - a); };
    m_places.append(project({between(stretch.fixed.x, stretch.free.x), between(stretch.fixed.d, stretch.free.d),
                             between(stretch.fixed.z, stretch.free.z)}));
  }
}

void MachineDrawing::select(const QString& id) {
  if (id == m_selected) return;
  m_selected = id;
  update();
}

void MachineDrawing::setConnected(bool connected) {
  m_connected = connected;
  update();
}

QTransform MachineDrawing::toScreen() const {
  const QRectF bounds = machineBounds();
  const double scale = std::min(width() / bounds.width(), height() / bounds.height());
  QTransform view;
  view.translate(width() / 2.0, height() / 2.0);
  view.scale(scale, scale);
  view.translate(-bounds.center().x(), -bounds.center().y());
  return view;
}

int MachineDrawing::spotAt(const QPointF& at) const {
  const QTransform view = toScreen();
  double best = 16.0;
  int found = -1;
  for (int i = 0; i < m_places.size(); ++i) {
    const QPointF away = view.map(m_places[i]) - at;
    const double distance = std::hypot(away.x(), away.y());
    if (distance >= best) continue;
    best = distance;
    found = i;
  }
  return found;
}

void MachineDrawing::paintSpot(QPainter& painter, int index, const QPointF& at, bool marked) const {
  const Colors& c = colors();
  const SensorSpot& sensor = m_sensors[index];
  const bool ill = sensor.judgement == Judgement::warn || sensor.judgement == Judgement::bad;
  QColor fill = sensor.warmth >= 0.0 ? warmthColor(sensor.warmth) : c.panel;
  const double radius_px = std::clamp(24.0 * toScreen().m11(), 7.0, largestRadius_px);
  if (marked) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(mix(c.panel, c.accent, 0.45));
    painter.drawEllipse(at, radius_px + 5, radius_px + 5);
  }
  painter.setPen(QPen(ill ? c.fill(sensor.judgement) : sensor.warmth >= 0.0 ? c.panel : c.muted, ill ? 3.0 : 1.6));
  painter.setBrush(fill);
  painter.drawEllipse(at, radius_px, radius_px);
  painter.setPen(sensor.warmth >= 0.0 ? QColor(Qt::white) : c.text);
  painter.setFont(uiFont(radius_px < 9.0 ? 9 : 11, QFont::DemiBold));
  painter.drawText(QRectF(at.x() - 12, at.y() - 9, 24, 18), Qt::AlignCenter, sensor.tag);
  if (ill) drawJudgement(painter, QRectF(at.x() + 4, at.y() - 16, 13, 13), sensor.judgement);
}

void MachineDrawing::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  const QTransform view = toScreen();
  painter.setTransform(view);
  paintMachine(painter, m_connected ? 1.0 : 0.5);
  painter.resetTransform();
  int marked = m_hovered;
  for (int i = 0; i < m_places.size(); ++i) {
    const bool chosen = m_sensors[i].id == m_selected;
    paintSpot(painter, i, view.map(m_places[i]), chosen || i == m_hovered);
    if (chosen && marked < 0) marked = i;
  }
  if (hasFocus()) {
    painter.setPen(QPen(colors().accent, 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 4, 4);
  }
  if (marked < 0 || marked >= m_places.size()) return;
  // The name and value beside the disc, always inside the widget.
  const SensorSpot& sensor = m_sensors[marked];
  const QString text = sensor.label + QStringLiteral("   ") + sensor.value;
  painter.setFont(uiFont(12, QFont::Medium));
  QRectF box = QRectF(painter.fontMetrics().boundingRect(text)).adjusted(-8, -5, 8, 5);
  const QPointF at = view.map(m_places[marked]);
  box.moveCenter(QPointF(at.x() + 18 + box.width() / 2.0, at.y()));
  if (box.right() > width() - 4) box.moveRight(at.x() - 18);
  box.moveLeft(std::max(4.0, box.left()));
  painter.setPen(QPen(mix(colors().line, colors().muted, 0.4)));
  painter.setBrush(colors().panel);
  painter.drawRoundedRect(box, 4, 4);
  painter.setPen(colors().text);
  painter.drawText(box, Qt::AlignCenter, text);
}

void MachineDrawing::mouseMoveEvent(QMouseEvent* event) {
  const int over = spotAt(event->position());
  if (over == m_hovered) return;
  m_hovered = over;
  setCursor(over >= 0 ? Qt::PointingHandCursor : Qt::ArrowCursor);
  update();
  Q_EMIT hovered(over >= 0 ? m_sensors[over].id : QString());
}

void MachineDrawing::leaveEvent(QEvent* event) {
  m_hovered = -1;
  update();
  Q_EMIT hovered({});
  QWidget::leaveEvent(event);
}

void MachineDrawing::mousePressEvent(QMouseEvent* event) {
  const int at = spotAt(event->position());
  m_selected = at >= 0 ? m_sensors[at].id : QString();
  update();
  Q_EMIT selected(m_selected);
}

void MachineDrawing::keyPressEvent(QKeyEvent* event) {
  const bool forward = event->key() == Qt::Key_Right || event->key() == Qt::Key_Down;
  const bool backward = event->key() == Qt::Key_Left || event->key() == Qt::Key_Up;
  if ((!forward && !backward) || m_sensors.isEmpty()) return QWidget::keyPressEvent(event);
  const auto count = static_cast<int>(m_sensors.size());
  int now = -1;
  for (int i = 0; i < count; ++i) {
    if (m_sensors[i].id == m_selected) now = i;
  }
  now = now < 0 ? 0 : (now + (forward ? 1 : count - 1)) % count;
  m_selected = m_sensors[now].id;
  update();
  Q_EMIT selected(m_selected);
}

void MachineDrawing::changeEvent(QEvent* event) {
  if (event->type() == QEvent::PaletteChange) update();
  QWidget::changeEvent(event);
}

}  // namespace zerodrift::ui
