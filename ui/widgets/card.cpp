#include "ui/widgets/card.h"

#include "ui/widgets/fitted_text.h"

namespace zerodrift::ui {
namespace {

/// Gives way when the heading is crowded, with an ellipsis instead of a cut letter.
class ElidedLabel : public QLabel {
 public:
  using QLabel::QLabel;
  QSize minimumSizeHint() const override { return {0, QLabel::minimumSizeHint().height()}; }

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setPen(palette().color(QPalette::WindowText));
    painter.drawText(rect(), Qt::AlignVCenter, fittedText(fontMetrics(), text(), width(), toolTip()));
  }
};

}  // namespace

Card::Card(QWidget* parent) : QFrame(parent) {
  setProperty("card", true);
  m_title = new QLabel(this);
  m_title->setProperty("role", "cardTitle");
  m_subtitle = new ElidedLabel(this);
  m_subtitle->setProperty("role", "caption");
  m_subtitle->setProperty("elides", true);
  m_title->hide();
  m_subtitle->hide();
  m_tools = new QHBoxLayout;
  m_tools->setSpacing(8);

  auto* heading = new QHBoxLayout;
  heading->setContentsMargins(16, 8, 12, 0);
  heading->setSpacing(8);
  heading->addWidget(m_title);
  heading->addWidget(m_subtitle);
  heading->addStretch();
  heading->addLayout(m_tools);

  m_body = new QVBoxLayout;
  m_body->setContentsMargins(16, 4, 16, 12);
  m_body->setSpacing(8);

  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(4);
  all->addLayout(heading);
  all->addLayout(m_body, 1);
}

void Card::setTitle(const QString& title) {
  m_title->setText(title);
  m_title->setVisible(!title.isEmpty());
  m_title->setMinimumHeight(24);
  setAccessibleName(title);
}

void Card::setSubtitle(const QString& subtitle) {
  m_subtitle->setText(subtitle);
  m_subtitle->setToolTip(subtitle);
  m_subtitle->setVisible(!subtitle.isEmpty());
}

void Card::setBodyMargins(int left, int top, int right, int bottom) {
  m_body->setContentsMargins(left, top, right, bottom);
}

}  // namespace zerodrift::ui
