#include "ui/widgets/level_bar.h"

#include <cmath>

#include "ui/widgets/fitted_text.h"

namespace zerodrift::ui {

LevelBar::LevelBar(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

QSize LevelBar::sizeHint() const {
  return {220, 36};
}

QSize LevelBar::minimumSizeHint() const {
  return {120, 36};
}

void LevelBar::setLevel(const QString& label, double level, double goodFrom, double goodTo, const QString& word,
                        Judgement judgement) {
  m_label = label;
  m_level = level;
  m_goodFrom = goodFrom;
  m_goodTo = goodTo;
  m_word = word;
  m_judgement = judgement;
  setAccessibleName(label + ", " + word);
  setToolTip(accessibleName());
  update();
}

void LevelBar::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  const Colors& c = colors();
  painter.setFont(uiFont(12));
  painter.setPen(c.muted);
  const int wordWidth = QFontMetrics(uiFont(12, QFont::DemiBold)).horizontalAdvance(m_word);
  painter.drawText(QRect(0, 0, width(), 18), Qt::AlignVCenter,
                   fittedText(painter.fontMetrics(), m_label, width() - wordWidth - 24, toolTip()));
  painter.setPen(c.ink(m_judgement));
  painter.setFont(uiFont(12, QFont::DemiBold));
  painter.drawText(QRect(0, 0, width(), 18), Qt::AlignVCenter | Qt::AlignRight, m_word);
  if (!m_word.isEmpty()) drawJudgement(painter, QRectF(width() - wordWidth - 18, 3, 12, 12), m_judgement);
  const QRectF track(0, 24, width(), 6);
  painter.setPen(Qt::NoPen);
  painter.setBrush(c.grid);
  painter.drawRoundedRect(track, 3, 3);
  painter.setBrush(mix(c.panel, c.ok, 0.35));
  painter.drawRoundedRect(QRectF(m_goodFrom * width(), 24, (m_goodTo - m_goodFrom) * width(), 6), 3, 3);
  if (std::isnan(m_level)) return;
  const double at = std::clamp(m_level, 0.0, 1.0) * (width() - 6.0);
  painter.setBrush(c.text);
  painter.drawRoundedRect(QRectF(at, 20, 5, 14), 2.5, 2.5);
}

}  // namespace zerodrift::ui
