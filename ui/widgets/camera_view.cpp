#include "ui/widgets/camera_view.h"

#include <cmath>

#include "ui/widgets/icons.h"
#include "ui/widgets/on_language.h"

namespace zerodrift::ui {
namespace {

// On a camera image the theme does not help: marks carry a dark edge so that they show on any grey.
void strokeOnImage(QPainter& painter, const QColor& color, double width, const QPainterPath& path,
                   Qt::PenStyle style = Qt::SolidLine) {
  painter.setBrush(Qt::NoBrush);
  painter.setPen(QPen(QColor(0, 0, 0, 150), width + 2.0));
  painter.drawPath(path);
  painter.setPen(QPen(color, width, style));
  painter.drawPath(path);
}

void label(QPainter& painter, const QPointF& at, const QString& text, const QColor& color) {
  painter.setFont(uiFont(12, QFont::Medium));
  const QRectF box = QRectF(painter.fontMetrics().boundingRect(text)).adjusted(-6, -3, 6, 3);
  const QRectF placed = box.translated(at - box.topLeft());
  painter.setPen(Qt::NoPen);
  painter.setBrush(QColor(10, 14, 18, 190));
  painter.drawRoundedRect(placed, 3, 3);
  painter.setPen(color);
  painter.drawText(placed, Qt::AlignCenter, text);
}

const QColor targetColor("#5CC8FF");
const QColor referenceColor("#FFC857");
const QColor lostColor("#FF9DA9");
const QColor trailColor("#7CF2B0");

}  // namespace

CameraView::CameraView(QWidget* parent) : QWidget(parent) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  onLanguage(this, [this] { setAccessibleName(tr("Camera image")); });
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

QSize CameraView::sizeHint() const {
  return {640, 480};
}

QSize CameraView::minimumSizeHint() const {
  return {200, 150};
}

void CameraView::setImage(const QImage& image) {
  m_image = image;
  update();
}

void CameraView::setMarks(const CameraMarks& marks) {
  m_marks = marks;
  setAccessibleDescription(marks.message);
  update();
}

void CameraView::setPlaceholder(const QString& text) {
  m_placeholder = text;
  update();
}

void CameraView::setDrawing(Drawing drawing) {
  m_drawing = drawing;
  setCursor(drawing == Drawing::none ? Qt::ArrowCursor : Qt::CrossCursor);
}

void CameraView::fit() {
  m_zoom = 1.0;
  m_centre = {};
  update();
}

QTransform CameraView::toScreen() const {
  const QSizeF image = m_image.isNull() ? QSizeF(640, 480) : QSizeF(m_image.size());
  const double scale = m_zoom * std::min(width() / image.width(), height() / image.height());
  QTransform view;
  view.translate(width() / 2.0, height() / 2.0);
  view.scale(scale, scale);
  view.translate(-image.width() / 2.0 - m_centre.x(), -image.height() / 2.0 - m_centre.y());
  return view;
}

void CameraView::zoomAbout(const QPointF& screen, double factor) {
  const QPointF before = toScreen().inverted().map(screen);
  m_zoom = std::clamp(m_zoom * factor, 1.0, 40.0);
  if (m_zoom == 1.0) m_centre = {};
  const QPointF after = toScreen().inverted().map(screen);
  if (m_zoom > 1.0) m_centre += before - after;
  update();
}

void CameraView::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  QPainterPath frame;
  frame.addRoundedRect(QRectF(rect()), 4, 4);
  painter.setClipPath(frame);
  painter.fillRect(rect(), QColor("#0B0F13"));
  if (m_image.isNull()) {
    drawIcon(painter, QRectF(width() / 2.0 - 20, height() / 2.0 - 44, 40, 40), Icon::camera, QColor("#76879A"));
    painter.setFont(uiFont(13));
    painter.setPen(QColor("#A9B6C2"));
    painter.drawText(QRectF(16, height() / 2.0 + 4, width() - 32, 60), Qt::AlignHCenter | Qt::TextWordWrap,
                     m_placeholder.isEmpty() ? tr("No image from the camera") : m_placeholder);
    return;
  }
  const QTransform view = toScreen();
  // Smooth when shrunk, true pixels when magnified far enough to judge the target by eye.
  painter.setRenderHint(QPainter::SmoothPixmapTransform, view.m11() < 4.0);
  painter.setTransform(view);
  painter.drawImage(0, 0, m_image);
  painter.resetTransform();
  paintRegions(painter, view);
  paintTrail(painter, view);
  paintTarget(painter, view);
  if (!m_marks.message.isEmpty()) {
    const QColor ink = m_marks.judgement == Judgement::bad    ? QColor("#FF9DA9")
                       : m_marks.judgement == Judgement::warn ? QColor("#FFD083")
                                                              : QColor("#E8EDF2");
    label(painter, {10, 10}, m_marks.message, ink);
  }
  if (hasFocus()) {
    painter.setPen(QPen(colors().accent, 2));
    painter.setBrush(Qt::NoBrush);
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 4, 4);
  }
}

void CameraView::paintRegions(QPainter& painter, const QTransform& view) const {
  const auto box = [&](const QRectF& region, const QColor& color, const QString& name) {
    if (region.isEmpty()) return;
    QPainterPath path;
    path.addRect(view.mapRect(region));
    strokeOnImage(painter, color, 1.4, path, Qt::DashLine);
    // In a thumbnail the words would cover what they name.
    if (width() > 360) label(painter, view.mapRect(region).bottomLeft() + QPointF(0, 4), name, color);
  };
  const qsizetype count = m_marks.references.size();
  for (qsizetype k = 0; k < count; ++k) {
    const ReferenceMark& mark = m_marks.references[k];
    const QString name = count == 1 ? tr("Reference") : tr("Reference %1").arg(k + 1);
    box(mark.region, mark.lost ? lostColor : referenceColor, mark.lost ? tr("%1: not seen").arg(name) : name);
  }
  const bool drawing = !m_drawn.isEmpty();
  const QRectF drawn = view.inverted().mapRect(m_drawn);
  if (drawing && m_drawing == Drawing::reference) box(drawn, referenceColor, tr("Reference %1").arg(count + 1));
  box(drawing && m_drawing == Drawing::target ? drawn : m_marks.targetRegion, targetColor, tr("Target"));
}

void CameraView::paintTrail(QPainter& painter, const QTransform& view) const {
  if (m_marks.trail.size() < 2) return;
  const QPointF origin = m_marks.trail.first();
  QPainterPath path;
  for (int i = 0; i < m_marks.trail.size(); ++i) {
    const QPointF at = view.map(origin + (m_marks.trail[i] - origin) * m_marks.trailEnlargement);
    if (i == 0) {
      path.moveTo(at);
    } else {
      path.lineTo(at);
    }
  }
  strokeOnImage(painter, trailColor, 1.6, path);
  painter.setPen(Qt::NoPen);
  painter.setBrush(trailColor);
  painter.drawEllipse(path.currentPosition(), 3.5, 3.5);
  if (m_marks.trailEnlargement > 1.0) {
    // In a thumbnail the marks stand near the foot.
    const bool at_head = width() <= 360 && m_marks.message.isEmpty();
    label(painter, {10, at_head ? 10.0 : height() - 30.0}, tr("drift × %1").arg(m_marks.trailEnlargement), trailColor);
  }
}

void CameraView::paintTarget(QPainter& painter, const QTransform& view) const {
  if (!m_marks.outline.isEmpty()) {
    QPainterPath path;
    path.addPolygon(view.map(m_marks.outline));
    path.closeSubpath();
    strokeOnImage(painter, targetColor, 1.6, path);
  }
  const auto cross = [&](const QPointF& image, const QColor& color) {
    const QPointF at = view.map(image);
    QPainterPath path;
    path.moveTo(at - QPointF(9, 0));
    path.lineTo(at + QPointF(9, 0));
    path.moveTo(at - QPointF(0, 9));
    path.lineTo(at + QPointF(0, 9));
    strokeOnImage(painter, color, 1.4, path);
  };
  for (const ReferenceMark& mark : m_marks.references) {
    if (mark.at) cross(*mark.at, referenceColor);
  }
  if (!m_marks.target) return;
  cross(*m_marks.target, targetColor);
  if (m_marks.sigmaMajor_px <= 0.0) return;
  const double scale = view.m11() * m_marks.enlargement;
  QTransform place;
  place.translate(view.map(*m_marks.target).x(), view.map(*m_marks.target).y());
  place.rotate(m_marks.sigmaAngle_deg);
  QPainterPath ellipse;
  ellipse.addEllipse(QPointF(), m_marks.sigmaMajor_px * scale, m_marks.sigmaMinor_px * scale);
  strokeOnImage(painter, QColor("#FFFFFF"), 1.4, place.map(ellipse));
  if (width() <= 360) return;
  const QPointF beside = m_marks.targetRegion.isEmpty() ? view.map(*m_marks.target) + QPointF(14, -34)
                                                        : view.mapRect(m_marks.targetRegion).topLeft() - QPointF(0, 28);
  label(painter, beside, tr("± %1 px, drawn %2 ×").arg(m_marks.sigmaMajor_px, 0, 'f', 4).arg(m_marks.enlargement),
        Qt::white);
}

void CameraView::wheelEvent(QWheelEvent* event) {
  zoomAbout(event->position(), std::pow(1.2, event->angleDelta().y() / 120.0));
  event->accept();
}

void CameraView::mousePressEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton) return;
  m_pressed = event->position();
  m_centrePressed = m_centre;
  m_dragging = false;
}

void CameraView::mouseMoveEvent(QMouseEvent* event) {
  if (!(event->buttons() & Qt::LeftButton)) return;
  const QPointF moved = event->position() - m_pressed;
  if (moved.manhattanLength() > 4) m_dragging = true;
  if (!m_dragging) return;
  if (m_drawing != Drawing::none) {
    m_drawn = QRectF(m_pressed, event->position()).normalized();
  } else if (m_zoom > 1.0) {
    m_centre = m_centrePressed - moved / toScreen().m11();
  }
  update();
}

void CameraView::mouseReleaseEvent(QMouseEvent* event) {
  if (event->button() != Qt::LeftButton || m_image.isNull()) return;
  const QTransform toImage = toScreen().inverted();
  if (m_drawing != Drawing::none && !m_drawn.isEmpty()) {
    const QRectF region = toImage.mapRect(m_drawn).intersected(QRectF(m_image.rect()));
    m_drawn = {};
    if (region.width() >= 8 && region.height() >= 8) Q_EMIT regionDrawn(region);
  } else if (!m_dragging) {
    Q_EMIT pointPicked(toImage.map(event->position()));
  }
  m_dragging = false;
  update();
}

void CameraView::mouseDoubleClickEvent(QMouseEvent*) {
  fit();
}

void CameraView::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Plus) return zoomAbout(rect().center(), 1.25);
  if (event->key() == Qt::Key_Minus) return zoomAbout(rect().center(), 0.8);
  if (event->key() == Qt::Key_0) return fit();
  QWidget::keyPressEvent(event);
}

}  // namespace zerodrift::ui
