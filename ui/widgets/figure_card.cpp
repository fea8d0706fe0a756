#include "ui/widgets/figure_card.h"

#include <cmath>

#include "ui/widgets/fitted_text.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::ui {
namespace {

QString words(const char* text) {
  return QCoreApplication::translate("Figure", text);
}

Figure judged(Figure figure, double value, double excess) {
  if (std::isnan(value)) {
    figure.word = words(QT_TRANSLATE_NOOP("Figure", "not yet"));
  } else if (excess <= 1.0) {
    figure.judgement = Judgement::ok;
    figure.word = words(QT_TRANSLATE_NOOP("Figure", "good"));
  } else if (excess <= 1.25) {
    figure.judgement = Judgement::warn;
    figure.word = words(QT_TRANSLATE_NOOP("Figure", "just outside"));
  } else {
    figure.judgement = Judgement::bad;
    figure.word = words(QT_TRANSLATE_NOOP("Figure", "outside"));
  }
  return figure;
}

}  // namespace

Figure figureOf(const QString& label, double value, int decimals, const QString& unit, const QString& note) {
  Figure figure;
  figure.label = label;
  if (!std::isnan(value)) figure.value = fixedText(value, decimals);
  figure.unit = unit;
  figure.limit = note;
  return figure;
}

Figure figureAtMost(const QString& label, double value, int decimals, const QString& unit, double limit) {
  Figure figure = figureOf(label, value, decimals, unit);
  figure.limit = words(QT_TRANSLATE_NOOP("Figure", "limit %1 %2")).arg(limit).arg(unit);
  return judged(figure, value, std::abs(value) / std::max(limit, 1e-12));
}

Figure figureAtLeast(const QString& label, double value, int decimals, const QString& unit, double limit) {
  Figure figure = figureOf(label, value, decimals, unit);
  figure.limit = words(QT_TRANSLATE_NOOP("Figure", "at least %1 %2")).arg(limit).arg(unit);
  return judged(figure, value, value > 0.0 ? limit / value : 1e9);
}

FigureCard::FigureCard(QWidget* parent) : QFrame(parent) {
  setProperty("card", true);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

QSize FigureCard::sizeHint() const {
  return {180, 84};
}

QSize FigureCard::minimumSizeHint() const {
  return {116, 84};
}

void FigureCard::setFigure(const Figure& figure) {
  if (figure == m_figure) return;
  m_figure = figure;
  const QString value = figure.value.isEmpty() ? tr("no value yet") : figure.value + ' ' + figure.unit;
  QStringList parts = {figure.label, value, figure.word, figure.limit};
  parts.removeAll(QString());
  setAccessibleName(listText(parts));
  // Whole here, should the card be too small for it.
  setToolTip(figure.tip.isEmpty() ? accessibleName() : accessibleName() + "\n" + figure.tip);
  update();
}

void FigureCard::paintEvent(QPaintEvent* event) {
  QFrame::paintEvent(event);
  QPainter painter(this);
  painter.setRenderHint(QPainter::TextAntialiasing);
  const Colors& c = colors();
  const QRect inside = rect().adjusted(16, 0, -12, 0);
  const auto elided = [&](const QString& text, int width) {
    return fittedText(painter.fontMetrics(), text, width, toolTip());
  };

  painter.setFont(uiFont(12));
  painter.setPen(c.muted);
  painter.drawText(QRect(inside.x(), 10, inside.width(), 18), Qt::AlignVCenter, elided(m_figure.label, inside.width()));

  const bool known = !m_figure.value.isEmpty();
  const QString value = known ? m_figure.value : QStringLiteral("–");
  int pixels = 22;
  painter.setFont(uiFont(pixels, QFont::DemiBold));
  // A long value (a date, a range) gets smaller before it is cut.
  while (pixels > 14 && painter.fontMetrics().horizontalAdvance(value) > inside.width() - 24) {
    painter.setFont(uiFont(--pixels, QFont::DemiBold));
  }
  painter.setPen(known ? c.text : c.muted);
  const QString shown = elided(value, inside.width());
  const int baseline = 52;
  painter.drawText(inside.x(), baseline, shown);
  const int after = inside.x() + painter.fontMetrics().horizontalAdvance(shown) + 6;
  painter.setFont(uiFont(12));
  painter.setPen(c.muted);
  painter.drawText(after, baseline, elided(m_figure.unit, inside.right() - after));

  int left = inside.x();
  const int bottom = 72;
  if (!m_figure.word.isEmpty()) {
    drawJudgement(painter, QRectF(left, bottom - 10.5, 12, 12), m_figure.judgement);
    left += 18;
    painter.setFont(uiFont(12, QFont::DemiBold));
    painter.setPen(c.ink(m_figure.judgement));
    const QString word = elided(m_figure.word, inside.right() - left);
    painter.drawText(left, bottom, word);
    left += painter.fontMetrics().horizontalAdvance(word) + 8;
  }
  painter.setFont(uiFont(12));
  painter.setPen(c.muted);
  if (inside.right() - left > 24) painter.drawText(left, bottom, elided(m_figure.limit, inside.right() - left));
}

FigureRow::FigureRow(QWidget* parent) : QWidget(parent) {
  m_layout = new QHBoxLayout(this);
  m_layout->setContentsMargins(0, 0, 0, 0);
  m_layout->setSpacing(16);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void FigureRow::setFigures(const QVector<Figure>& figures) {
  while (m_cards.size() < figures.size()) {
    auto* card = new FigureCard(this);
    m_layout->addWidget(card, 1);
    m_cards.append(card);
  }
  while (m_cards.size() > figures.size()) delete m_cards.takeLast();
  for (int i = 0; i < figures.size(); ++i) m_cards[i]->setFigure(figures[i]);
  setVisible(!figures.isEmpty());
}

}  // namespace zerodrift::ui
