#include "ui/pages/explanation_card.h"

#include "ui/widgets/sparkline.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

QLabel* wrapped(QWidget* parent, const char* role) {
  auto* label = new WrapLabel(parent);
  if (role != nullptr) label->setProperty("role", role);
  return label;
}

}  // namespace

ExplanationCard::ExplanationCard(QWidget* parent) : QFrame(parent) {
  setProperty("card", true);
  m_name = wrapped(this, "strong");
  m_confidence = new QLabel(this);
  m_sentence = wrapped(this, nullptr);
  m_facts = wrapped(this, "muted");
  m_rivals = wrapped(this, "caption");
  m_spark = new Sparkline(this);
  m_improvement = wrapped(this, "caption");
  m_adopt = new QPushButton(this);
  m_adopt->setObjectName("adopt");
  m_reject = new QPushButton(this);
  m_reject->setObjectName("reject");
  auto* head = new QHBoxLayout;
  head->addWidget(m_name, 1);
  head->addWidget(m_confidence);
  auto* proof = new QHBoxLayout;
  proof->setSpacing(12);
  proof->addWidget(m_spark, 1);
  proof->addWidget(m_improvement, 1);
  auto* buttons = new QHBoxLayout;
  buttons->setSpacing(8);
  buttons->addWidget(m_adopt);
  buttons->addWidget(m_reject);
  buttons->addStretch();
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(14, 10, 14, 12);
  all->setSpacing(6);
  all->addLayout(head);
  all->addWidget(m_sentence);
  all->addWidget(m_facts);
  all->addLayout(proof);
  all->addWidget(m_rivals);
  all->addLayout(buttons);
  connect(m_adopt, &QPushButton::clicked, this, [this] { Q_EMIT adoptClicked(!m_adopted); });
  connect(m_reject, &QPushButton::clicked, this, &ExplanationCard::rejectClicked);
}

void ExplanationCard::setExplanation(int rank, const Explanation& e) {
  m_id = e.id;
  m_adopted = e.adopted;
  m_name->setText(QStringLiteral("%1. %2").arg(rank).arg(e.name));
  const bool sure = e.confidence >= 0.9;
  m_confidence->setProperty("role", e.adopted || sure ? "ok" : e.confidence >= 0.6 ? "warn" : "muted");
  m_confidence->style()->unpolish(m_confidence);
  m_confidence->style()->polish(m_confidence);
  const QString word = e.adopted ? tr("adopted") : e.rejected ? tr("rejected") : sure ? tr("sure") : tr("possible");
  m_confidence->setText(tr("%1, %2 %").arg(word).arg(100.0 * e.confidence, 0, 'f', 0));
  m_sentence->setText(e.sentence);
  m_facts->setText(e.magnitude + (e.place.isEmpty() ? QString() : QStringLiteral("   ·   ") + e.place));
  m_spark->setCurves({e.before, e.refit, e.after}, {colors().bad, colors().warn, colors().ok});
  m_improvement->setText(
      tr("<span style='color:%1'>%8 before %2</span><br><span style='color:%3'>only re-fitted %4</span><br>"
         "<span style='color:%5'>with the effect %6 %7</span>")
          .arg(colors().badText.name())
          .arg(e.rmseBefore, 0, 'f', 2)
          .arg(colors().warnText.name())
          .arg(e.rmseRefit, 0, 'f', 2)
          .arg(colors().okText.name())
          .arg(e.rmseAfter, 0, 'f', 2)
          .arg(e.unit, e.channel.toHtmlEscaped()));
  QStringList notes = {e.rivals, e.couldDetect};
  notes.removeAll(QString());
  m_rivals->setText(notes.join('\n'));
  m_rivals->setVisible(!notes.isEmpty());
  m_adopt->setText(e.adopted ? tr("Take out again") : tr("Adopt"));
  m_reject->setText(tr("Reject"));
  m_reject->setEnabled(!e.rejected);
  setAccessibleName(e.name + ", " + m_confidence->text() + ": " + e.sentence);
}

}  // namespace zerodrift::ui
