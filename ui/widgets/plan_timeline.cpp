#include "ui/widgets/plan_timeline.h"

#include <cmath>

#include "ui/widgets/colors.h"
#include "ui/widgets/on_language.h"
#include "ui/widgets/progress_strip.h"

namespace zerodrift::ui {
namespace {

constexpr double reach_px = 7.0;
constexpr double durationStep_s = 300.0;  // dragging snaps to five minutes
constexpr double speedStep_rpm = 100.0;

double snapped(double value, double step, double low, double high) {
  return std::clamp(step * std::round(value / step), low, high);
}

}  // namespace

PlanTimeline::PlanTimeline(QWidget* parent) : QWidget(parent) {
  setMouseTracking(true);
  setFocusPolicy(Qt::StrongFocus);
  onLanguage(this, [this] { setAccessibleName(tr("Plan: steps over time")); });
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Expanding);
}

QSize PlanTimeline::sizeHint() const {
  return {600, 200};
}

QSize PlanTimeline::minimumSizeHint() const {
  return {300, 120};
}

void PlanTimeline::setSteps(const QVector<PlanStepRow>& steps) {
  m_steps = steps;
  m_selected = std::clamp(m_selected, 0, std::max(0, static_cast<int>(steps.size()) - 1));
  update();
}

void PlanTimeline::setFastest(double speed_rpm) {
  m_fastest_rpm = std::max(100.0, speed_rpm);
  update();
}

void PlanTimeline::setMeasurePeriod(double period_s) {
  m_measurePeriod_s = period_s;
  update();
}

void PlanTimeline::setReadOnly(bool readOnly) {
  m_readOnly = readOnly;
  update();
}

void PlanTimeline::setNow(double time_s) {
  m_now_s = time_s;
  update();
}

void PlanTimeline::selectStep(int index) {
  if (index < 0 || index >= m_steps.size()) return;
  m_selected = index;
  update();
  Q_EMIT selectionChanged(index);
}

double PlanTimeline::total() const {
  double sum = 0.0;
  for (const PlanStepRow& step : m_steps) sum += step.duration_s;
  return std::max(sum, 60.0);
}

QRectF PlanTimeline::field() const {
  return QRectF(rect()).adjusted(56, 14, -18, -28);
}

QRectF PlanTimeline::block(int index) const {
  double start = 0.0;
  for (int i = 0; i < index; ++i) start += m_steps[i].duration_s;
  const QRectF f = field();
  const double scale = f.width() / total();
  // Rest keeps a low block, so that it can be seen and gripped.
  const double height = std::max(18.0, f.height() * m_steps[index].speed_rpm / m_fastest_rpm);
  return {f.x() + start * scale, f.bottom() - height, m_steps[index].duration_s * scale, height};
}

PlanTimeline::Grip PlanTimeline::gripAt(const QPointF& at, int* index) const {
  for (int i = 0; i < m_steps.size(); ++i) {
    const QRectF b = block(i);
    *index = i;
    if (std::abs(at.x() - b.right()) < reach_px && at.y() > b.top() - reach_px && at.y() < field().bottom()) {
      return Grip::duration;
    }
    if (at.x() > b.left() && at.x() < b.right() && std::abs(at.y() - b.top()) < reach_px) return Grip::speed;
  }
  for (int i = 0; i < m_steps.size(); ++i) {
    *index = i;
    if (block(i).contains(at)) return Grip::none;
  }
  *index = -1;
  return Grip::none;
}

void PlanTimeline::paintScale(QPainter& painter) const {
  const Colors& c = colors();
  const QRectF f = field();
  painter.setFont(uiFont(11));
  for (int k = 0; k <= 4; ++k) {
    const double y = f.bottom() - f.height() * k / 4.0;
    painter.setPen(c.grid);
    painter.drawLine(QPointF(f.left(), y), QPointF(f.right(), y));
    painter.setPen(c.muted);
    painter.drawText(QRectF(0, y - 8, 48, 16), Qt::AlignRight | Qt::AlignVCenter,
                     QString::number(std::lround(m_fastest_rpm * k / 4.0)));
  }
  static constexpr double steps_s[] = {300, 600, 900, 1800, 3600, 7200, 14400, 28800};
  double step = steps_s[7];
  for (const double candidate : steps_s) {
    if (total() / candidate <= 9.0) {
      step = candidate;
      break;
    }
  }
  for (int k = 0; k * step <= total() + 1.0; ++k) {
    const double x = f.left() + f.width() * k * step / total();
    painter.setPen(c.muted);
    const auto minutes = static_cast<int>(std::lround(k * step / 60.0));
    painter.drawText(QRectF(x - 30, f.bottom() + 10, 60, 16), Qt::AlignCenter,
                     QStringLiteral("%1:%2").arg(minutes / 60).arg(minutes % 60, 2, 10, QChar('0')));
  }
  if (m_measurePeriod_s <= 0.0 || f.width() * m_measurePeriod_s / total() < 3.0) return;
  painter.setPen(QPen(c.accent, 1.5));
  for (int k = 1; k * m_measurePeriod_s <= total() + 1.0; ++k) {
    const double x = f.left() + f.width() * k * m_measurePeriod_s / total();
    painter.drawLine(QPointF(x, f.bottom() + 2), QPointF(x, f.bottom() + 7));
  }
}

void PlanTimeline::paintBlock(QPainter& painter, int index) const {
  const Colors& c = colors();
  const PlanStepRow& step = m_steps[index];
  const QRectF b = block(index).adjusted(1, 0, -1, 0);
  const bool chosen = index == m_selected && !m_readOnly;
  painter.setPen(chosen ? QPen(c.accent, 2) : QPen(mix(c.line, c.muted, 0.4), 1));
  painter.setBrush(mix(c.panel, chosen ? c.accent : c.muted, 0.10 + 0.20 * step.speed_rpm / m_fastest_rpm));
  painter.drawRoundedRect(b, 3, 3);
  if (step.coolant) {
    painter.setPen(Qt::NoPen);
    painter.setBrush(c.accent);
    painter.drawRect(QRectF(b.left() + 1, b.bottom() - 5, b.width() - 2, 4));
  }
  painter.save();
  painter.setClipRect(b);
  painter.setPen(c.text);
  painter.setFont(uiFont(12, QFont::DemiBold));
  const QString speed = step.speed_rpm > 0.0 ? tr("%1 rpm").arg(step.speed_rpm, 0, 'f', 0) : tr("rest");
  const bool tall = b.height() > 40;
  painter.drawText(b.adjusted(8, tall ? 6 : 0, -4, 0), tall ? Qt::AlignTop : Qt::AlignVCenter, speed);
  if (tall) {
    painter.setFont(uiFont(11));
    painter.setPen(c.muted);
    const QString motion = step.cycle ? tr("axes run") : tr("axes stand");
    painter.drawText(b.adjusted(8, 24, -4, 0), Qt::AlignTop,
                     durationText(step.duration_s) + QStringLiteral(", ") + motion);
  }
  painter.restore();
}

void PlanTimeline::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  paintScale(painter);
  for (int i = 0; i < m_steps.size(); ++i) paintBlock(painter, i);
  if (m_now_s >= 0.0) {
    const double x = field().left() + field().width() * std::min(1.0, m_now_s / total());
    painter.setPen(QPen(colors().bad, 2));
    painter.drawLine(QPointF(x, field().top() - 6), QPointF(x, field().bottom()));
  }
  if (hasFocus()) {
    painter.setBrush(Qt::NoBrush);
    painter.setPen(QPen(colors().accent, 2));
    painter.drawRoundedRect(QRectF(rect()).adjusted(1, 1, -1, -1), 4, 4);
  }
}

void PlanTimeline::mousePressEvent(QMouseEvent* event) {
  int index = -1;
  const Grip grip = gripAt(event->position(), &index);
  if (index < 0) return;
  selectStep(index);
  if (m_readOnly) return;
  m_grip = grip;
  m_gripped = index;
  m_gripStart = event->position();
  m_gripStep = m_steps[index];
  // The scale of the moment counts, else the block would run away from the pointer as the total grows.
  m_gripScale_s_per_px = total() / field().width();
}

void PlanTimeline::mouseMoveEvent(QMouseEvent* event) {
  int index = -1;
  if (m_grip == Grip::none) {
    const Grip over = m_readOnly ? Grip::none : gripAt(event->position(), &index);
    setCursor(over == Grip::duration ? Qt::SizeHorCursor : over == Grip::speed ? Qt::SizeVerCursor : Qt::ArrowCursor);
    return;
  }
  PlanStepRow& step = m_steps[m_gripped];
  const QPointF moved = event->position() - m_gripStart;
  if (m_grip == Grip::duration) {
    step.duration_s =
        snapped(m_gripStep.duration_s + moved.x() * m_gripScale_s_per_px, durationStep_s, durationStep_s, 48 * 3600.0);
  } else {
    step.speed_rpm =
        snapped(m_gripStep.speed_rpm - moved.y() * m_fastest_rpm / field().height(), speedStep_rpm, 0.0, m_fastest_rpm);
  }
  update();
}

void PlanTimeline::mouseReleaseEvent(QMouseEvent*) {
  if (m_grip == Grip::none) return;
  const bool changed = !(m_steps[m_gripped] == m_gripStep);
  m_grip = Grip::none;
  if (changed) Q_EMIT edited();
}

void PlanTimeline::keyPressEvent(QKeyEvent* event) {
  const bool change = event->modifiers() & Qt::ShiftModifier;
  if (m_steps.isEmpty() || (m_readOnly && change)) return QWidget::keyPressEvent(event);
  PlanStepRow& step = m_steps[m_selected];
  const int sign = event->key() == Qt::Key_Right || event->key() == Qt::Key_Up ? 1 : -1;
  switch (event->key()) {
    case Qt::Key_Left:
    case Qt::Key_Right:
      if (!change) return selectStep(m_selected + sign);
      step.duration_s = snapped(step.duration_s + sign * durationStep_s, durationStep_s, durationStep_s, 48 * 3600.0);
      break;
    case Qt::Key_Up:
    case Qt::Key_Down:
      if (m_readOnly) return;
      step.speed_rpm = snapped(step.speed_rpm + sign * speedStep_rpm, speedStep_rpm, 0.0, m_fastest_rpm);
      break;
    default:
      return QWidget::keyPressEvent(event);
  }
  update();
  Q_EMIT edited();
}

}  // namespace zerodrift::ui
