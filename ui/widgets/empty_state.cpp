#include "ui/widgets/empty_state.h"

#include "ui/widgets/colors.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

/// The icon in a soft ring, painted so that it follows the theme.
class RingIcon : public QLabel {
 public:
  using QLabel::QLabel;
  Icon icon = Icon::chart;

 protected:
  void paintEvent(QPaintEvent*) override {
    QPainter painter(this);
    painter.setRenderHint(QPainter::Antialiasing);
    painter.setPen(Qt::NoPen);
    painter.setBrush(colors().soft(colors().accent));
    painter.drawEllipse(rect());
    drawIcon(painter, QRectF(rect()).adjusted(16, 16, -16, -16), icon, colors().accent);
  }
};

}  // namespace

EmptyState::EmptyState(QWidget* parent) : QWidget(parent) {
  m_icon = new RingIcon(this);
  m_icon->setFixedSize(56, 56);
  m_heading = new QLabel(this);
  m_heading->setProperty("role", "heading");
  m_sentence = new WrapLabel(this);
  m_sentence->setProperty("role", "muted");
  m_sentence->setAlignment(Qt::AlignHCenter);
  m_sentence->setFixedWidth(460);
  m_action = new QPushButton(this);
  m_action->setObjectName("emptyAction");
  connect(m_action, &QPushButton::clicked, this, &EmptyState::actionTriggered);
  auto* all = new QVBoxLayout(this);
  all->setSpacing(8);
  all->addStretch();
  all->addWidget(m_icon, 0, Qt::AlignHCenter);
  all->addSpacing(4);
  all->addWidget(m_heading, 0, Qt::AlignHCenter);
  all->addWidget(m_sentence, 0, Qt::AlignHCenter);
  all->addSpacing(4);
  all->addWidget(m_action, 0, Qt::AlignHCenter);
  all->addStretch();
}

void EmptyState::setContent(Icon icon, const QString& heading, const QString& sentence, const QString& action) {
  static_cast<RingIcon*>(m_icon)->icon = icon;
  m_icon->update();
  m_heading->setText(heading);
  m_sentence->setText(sentence);
  m_action->setText(action);
  m_action->setVisible(!action.isEmpty());
}

}  // namespace zerodrift::ui
