#include "ui/widgets/step_list.h"

#include "ui/widgets/colors.h"
#include "ui/widgets/fitted_text.h"

namespace zerodrift::ui {
namespace {

constexpr int tallest_row = 24;
constexpr int lowest_row = 17;

}  // namespace

StepList::StepList(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Preferred);
}

QSize StepList::sizeHint() const {
  return {280, tallest_row * static_cast<int>(m_stages.size())};
}

QSize StepList::minimumSizeHint() const {
  return {180, lowest_row * static_cast<int>(m_stages.size())};
}

void StepList::setStages(const QVector<Stage>& stages) {
  m_stages = stages;
  QStringList words;
  for (const Stage& stage : stages) {
    const QString state = stage.state == StageState::done      ? tr("done")
                          : stage.state == StageState::running ? tr("running")
                          : stage.state == StageState::failed  ? tr("failed")
                          : stage.state == StageState::skipped ? tr("skipped")
                                                               : tr("waiting");
    words.append(stage.text + ": " + state + (stage.detail.isEmpty() ? QString() : ", " + stage.detail));
  }
  setAccessibleName(words.join("; "));
  setToolTip(words.join("\n"));
  updateGeometry();
  update();
}

void StepList::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
  const Colors& c = colors();
  // In a low window the rows move together.
  const int rows = std::max(1, static_cast<int>(m_stages.size()));
  const int rowHeight = std::clamp(height() / rows, lowest_row, tallest_row);
  for (int i = 0; i < m_stages.size(); ++i) {
    const Stage& stage = m_stages[i];
    const QPointF centre(8, rowHeight * (i + 0.5));
    if (i + 1 < m_stages.size()) {
      painter.setPen(QPen(stage.state == StageState::done ? c.ok : c.line, 1.5));
      painter.drawLine(centre + QPointF(0, 8), centre + QPointF(0, rowHeight - 8));
    }
    const QRectF disc(centre.x() - 7, centre.y() - 7, 14, 14);
    if (stage.state == StageState::done) {
      drawJudgement(painter, disc, Judgement::ok);
    } else if (stage.state == StageState::failed) {
      drawJudgement(painter, disc, Judgement::bad);
    } else {
      const bool now = stage.state == StageState::running;
      painter.setPen(QPen(now ? c.accent : mix(c.line, c.muted, 0.5), now ? 3.0 : 1.5));
      painter.setBrush(Qt::NoBrush);
      painter.drawEllipse(disc.adjusted(1, 1, -1, -1));
    }
    const bool live = stage.state == StageState::running || stage.state == StageState::failed;
    painter.setFont(uiFont(13, live ? QFont::DemiBold : QFont::Normal));
    painter.setPen(stage.state == StageState::waiting || stage.state == StageState::skipped ? c.muted
                   : stage.state == StageState::failed                                      ? c.badText
                                                                                            : c.text);
    painter.drawText(QRectF(26, rowHeight * i, width() - 26, rowHeight), Qt::AlignVCenter,
                     fittedText(painter.fontMetrics(), stage.text, width() - 26, toolTip()));
    const int used = 26 + painter.fontMetrics().horizontalAdvance(stage.text) + 12;
    painter.setFont(uiFont(12));
    painter.setPen(c.muted);
    painter.drawText(QRectF(used, rowHeight * i, width() - used, rowHeight), Qt::AlignVCenter | Qt::AlignRight,
                     fittedText(painter.fontMetrics(), stage.detail, std::max(0, width() - used), toolTip()));
  }
}

}  // namespace zerodrift::ui
