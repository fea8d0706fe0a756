#include "ui/widgets/progress_strip.h"

#include "ui/widgets/fitted_text.h"

namespace zerodrift::ui {

QString durationText(double seconds) {
  const auto whole = static_cast<qint64>(std::llround(std::max(0.0, seconds)));
  if (whole < 90) return QCoreApplication::translate("Duration", "%1 s").arg(whole);
  const qint64 minutes = (whole + 30) / 60;
  if (minutes < 60) return QCoreApplication::translate("Duration", "%1 min").arg(minutes);
  return QCoreApplication::translate("Duration", "%1 h %2 min").arg(minutes / 60).arg(minutes % 60, 2, 10, QChar('0'));
}

ProgressStrip::ProgressStrip(QWidget* parent) : QFrame(parent) {
  m_left = new QLabel(this);
  m_left->setProperty("role", "caption");
  m_bar = new QProgressBar(this);
  m_bar->setTextVisible(false);
  m_bar->setFixedHeight(6);
  m_cancel = new QPushButton(tr("Cancel"), this);
  m_cancel->setObjectName("cancelWork");
  m_cancel->setProperty("big", true);
  connect(m_cancel, &QPushButton::clicked, this, &ProgressStrip::cancelRequested);

  auto* column = new QVBoxLayout;
  column->setSpacing(5);
  column->addStretch();
  column->addWidget(m_left);
  column->addWidget(m_bar);
  column->addStretch();
  auto* all = new QHBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(10);
  all->addLayout(column, 1);
  all->addWidget(m_cancel);
  m_bar->setFixedWidth(150);
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  hide();
}

void ProgressStrip::setProgress(const QString& phase, double fraction, std::optional<double> secondsLeft) {
  setToolTip(phase);
  if (fraction < 0.0) {
    m_bar->setRange(0, 0);
  } else {
    m_bar->setRange(0, 1000);
    m_bar->setValue(static_cast<int>(std::lround(1000.0 * std::min(1.0, fraction))));
  }
  QStringList words;
  if (fraction >= 0.0) words << tr("%1 %").arg(std::lround(100.0 * std::min(1.0, fraction)));
  if (secondsLeft) words << tr("%1 left").arg(durationText(*secondsLeft));
  const QString text = words.isEmpty() ? phase : words.join(QStringLiteral(" · "));
  m_left->setText(
      fittedText(m_left->fontMetrics(), text, m_bar->width(), toolTip() + words.join(QStringLiteral(" · "))));
  m_bar->setAccessibleName(phase);
  show();
}

void ProgressStrip::setWaiting(const QString& what) {
  m_left->setText(fittedText(m_left->fontMetrics(), what, m_bar->width(), what));
}

void ProgressStrip::setCancellable(bool cancellable) {
  m_cancel->setVisible(cancellable);
}

void ProgressStrip::clear() {
  hide();
}

void ProgressStrip::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) m_cancel->setText(tr("Cancel"));
  QFrame::changeEvent(event);
}

}  // namespace zerodrift::ui
