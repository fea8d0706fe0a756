#include "ui/widgets/sign_check.h"

#include <cmath>

#include "ui/widgets/fitted_text.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::ui {
namespace {

constexpr double row_height = 28.0;
constexpr double name_width = 18.0;
constexpr double text_width = 174.0;

void arrow(QPainter& painter, double from, double to, double y, const QColor& color, double width) {
  painter.setPen(QPen(color, width, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.drawLine(QPointF(from, y), QPointF(to, y));
  const double way = to - from;
  if (std::abs(way) < 5.0) return;
  const double back = way > 0 ? -5.0 : 5.0;
  painter.drawPolyline(QPolygonF({{to + back, y - 3.5}, {to, y}, {to + back, y + 3.5}}));
}

QString um(double value) {
  return (value > 0 ? "+" : "") + fixedText(value, 1);
}

}  // namespace

SignCheck::SignCheck(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void SignCheck::setResult(const SignCheckResult& result) {
  m_result = result;
  QStringList words;
  for (const SignCheckAxis& axis : result.axes) {
    words.append(axis.watched ? tr("%1 commanded %2, seen %3").arg(axis.axis, um(axis.commanded_um), um(axis.seen_um))
                              : tr("%1 not in view").arg(axis.axis));
  }
  setAccessibleName(tr("Sign check: %1. %2").arg(result.word, words.join(QStringLiteral("; "))));
  setToolTip(result.note);
  update();
}

void SignCheck::paintAxis(QPainter& painter, const SignCheckAxis& axis, const QRectF& row, double reach_um) const {
  const Colors& c = colors();
  painter.setFont(uiFont(13, QFont::DemiBold));
  painter.setPen(c.text);
  painter.drawText(row, Qt::AlignVCenter | Qt::AlignLeft, axis.axis);
  const QRectF field(row.left() + name_width, row.top() + 2, row.width() - name_width - text_width, row.height() - 4);
  painter.setPen(c.line);
  painter.setBrush(c.window);
  painter.drawRoundedRect(field, 3, 3);
  const double zero = field.center().x();
  painter.setPen(QPen(c.line, 1, Qt::DotLine));
  painter.drawLine(QPointF(zero, field.top()), QPointF(zero, field.bottom()));
  const QRectF text(field.right() + 10, row.top(), text_width - 10, row.height());
  painter.setFont(uiFont(12));
  if (!axis.watched) {
    painter.setPen(c.muted);
    painter.drawText(text, Qt::AlignVCenter, tr("not in view"));
    return;
  }
  const double scale = 0.46 * field.width() / reach_um;
  const QColor seen = m_result.judgement == Judgement::bad ? c.bad : c.ok;
  arrow(painter, zero, zero + axis.commanded_um * scale, field.center().y() - 5, c.accent, 3.0);
  arrow(painter, zero, zero + axis.seen_um * scale, field.center().y() + 5, seen, 2.0);
  painter.setPen(c.text);
  painter.drawText(
      text, Qt::AlignVCenter,
      QStringLiteral("%1 → %2 ± %3 µm")
          .arg(um(axis.commanded_um), um(axis.seen_um), fixedText(axis.sigma_um, axis.sigma_um < 0.1 ? 2 : 1)));
}

void SignCheck::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  const Colors& c = colors();
  if (!m_result.measured) {
    painter.setFont(uiFont(12));
    painter.setPen(c.muted);
    painter.drawText(
        QRectF(rect()).adjusted(2, 2, -2, -2), Qt::TextWordWrap,
        tr("Not checked yet. Before the table is written each axis is moved by a few micrometres, watched by "
           "the camera: a wrong sign or axis stops everything."));
    return;
  }
  double reach_um = 1e-6;
  for (const SignCheckAxis& axis : m_result.axes) {
    reach_um = std::max({reach_um, std::abs(axis.commanded_um), axis.watched ? std::abs(axis.seen_um) : 0.0});
  }
  double y = 0.0;
  for (const SignCheckAxis& axis : m_result.axes) {
    paintAxis(painter, axis, QRectF(0, y, width(), row_height), reach_um);
    y += row_height;
  }
  drawJudgement(painter, QRectF(0, y + 8, 13, 13), m_result.judgement);
  painter.setFont(uiFont(12, QFont::DemiBold));
  painter.setPen(c.ink(m_result.judgement));
  const QRectF line(20, y + 4, width() - 20, 22);
  painter.drawText(line, Qt::AlignVCenter, m_result.word);
  const int used = painter.fontMetrics().horizontalAdvance(m_result.word) + 12;
  painter.setFont(uiFont(12));
  painter.setPen(c.muted);
  painter.drawText(line.adjusted(used, 0, 0, 0), Qt::AlignVCenter | Qt::AlignRight,
                   fittedText(painter.fontMetrics(), m_result.note, std::max(0, width() - 20 - used), toolTip()));
}

}  // namespace zerodrift::ui
