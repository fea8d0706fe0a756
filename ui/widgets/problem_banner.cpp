#include "ui/widgets/problem_banner.h"

#include "ui/widgets/colors.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/on_language.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

Judgement judgementOf(ProblemKind kind) {
  switch (kind) {
    case ProblemKind::success:
      return Judgement::ok;
    case ProblemKind::stale:
    case ProblemKind::warning:
      return Judgement::warn;
    case ProblemKind::failure:
      return Judgement::bad;
    case ProblemKind::note:
      break;
  }
  return Judgement::none;
}

QColor colorOf(ProblemKind kind) {
  return kind == ProblemKind::note ? colors().accent : colors().fill(judgementOf(kind));
}

}  // namespace

ProblemBanner::ProblemBanner(QWidget* parent) : QFrame(parent) {
  setObjectName("problemBanner");
  m_sentence = new WrapLabel(this);
  m_sentence->setProperty("role", "strong");
  m_remedy = new WrapLabel(this);
  for (QLabel* label : {m_sentence, m_remedy}) {
    label->setTextInteractionFlags(Qt::TextSelectableByMouse);
  }
  m_action = new QPushButton(this);
  m_action->setObjectName("problemAction");
  m_close = new QPushButton(this);
  m_close->setFlat(true);
  m_close->setProperty("role", "tool");
  m_close->setIcon(lineIcon(Icon::cross));
  onLanguage(this, [this] {
    m_close->setAccessibleName(tr("Dismiss"));
    m_close->setToolTip(tr("Dismiss"));
  });
  connect(m_action, &QPushButton::clicked, this, &ProblemBanner::actionTriggered);
  connect(m_close, &QPushButton::clicked, this, [this] {
    clear();
    Q_EMIT dismissed();
  });

  auto* texts = new QVBoxLayout;
  texts->setSpacing(2);
  texts->addWidget(m_sentence);
  texts->addWidget(m_remedy);
  auto* all = new QHBoxLayout(this);
  all->setContentsMargins(48, 10, 8, 10);
  all->setSpacing(12);
  all->addLayout(texts, 1);
  all->addWidget(m_action);
  all->addWidget(m_close);
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
  hide();
}

void ProblemBanner::setProblem(const Problem& problem) {
  m_problem = problem;
  m_sentence->setText(problem.sentence);
  m_remedy->setText(problem.remedy);
  m_remedy->setVisible(!problem.remedy.isEmpty());
  m_action->setText(problem.action);
  m_action->setVisible(!problem.action.isEmpty());
  setAccessibleName(problem.sentence);
  setAccessibleDescription(problem.remedy);
  show();
  update();
}

void ProblemBanner::clear() {
  m_problem = {};
  hide();
}

void ProblemBanner::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  const QColor color = colorOf(m_problem.kind);
  painter.setPen(mix(colors().line, color, 0.55));
  painter.setBrush(colors().soft(color));
  painter.drawRoundedRect(QRectF(rect()).adjusted(0.5, 0.5, -0.5, -0.5), 6, 6);
  const QRectF shape(16, 12, 18, 18);
  if (m_problem.kind != ProblemKind::note) {
    drawJudgement(painter, shape, judgementOf(m_problem.kind));
    return;
  }
  painter.setPen(Qt::NoPen);
  painter.setBrush(color);
  painter.drawEllipse(shape);
  painter.setPen(colors().onAccent);
  painter.setFont(uiFont(13, QFont::Bold));
  painter.drawText(shape, Qt::AlignCenter, "i");
}

}  // namespace zerodrift::ui
