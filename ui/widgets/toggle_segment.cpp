#include "ui/widgets/toggle_segment.h"

#include "ui/widgets/colors.h"

namespace zerodrift::ui {

ToggleSegment::ToggleSegment(QWidget* parent) : QWidget(parent) {
  m_layout = new QHBoxLayout(this);
  m_layout->setContentsMargins(0, 0, 0, 0);
  m_layout->setSpacing(0);
  m_group = new QButtonGroup(this);
  m_group->setExclusive(true);
  setSizePolicy(QSizePolicy::Fixed, QSizePolicy::Fixed);
  connect(m_group, &QButtonGroup::idToggled, this, [this](int id, bool down) {
    if (down) Q_EMIT currentChanged(id);
  });
}

ToggleSegment::ToggleSegment(const QStringList& items, QWidget* parent) : ToggleSegment(parent) {
  setItems(items);
}

void ToggleSegment::setItems(const QStringList& items) {
  const QSignalBlocker quiet(m_group);
  const int current = std::max(0, currentIndex());
  auto buttons = m_group->buttons();
  while (buttons.size() > items.size()) delete buttons.takeLast();
  while (buttons.size() < items.size()) {
    auto* button = new QPushButton(this);
    button->setCheckable(true);
    m_group->addButton(button, static_cast<int>(buttons.size()));
    m_layout->addWidget(button);
    buttons.append(button);
  }
  for (int i = 0; i < buttons.size(); ++i) {
    const bool first = i == 0;
    const bool last = i + 1 == buttons.size();
    const QString place = first && last ? "only" : first ? "first" : last ? "last" : "middle";
    if (buttons[i]->text() == items[i] && buttons[i]->property("segment") == place) continue;
    buttons[i]->setText(items[i]);
    buttons[i]->setProperty("segment", place);
    buttons[i]->style()->unpolish(buttons[i]);
    buttons[i]->style()->polish(buttons[i]);
    // The chosen one is set heavier: all get the room for that, so that nothing moves or is cut.
    buttons[i]->setMinimumWidth(QFontMetrics(uiFont(12, QFont::DemiBold)).horizontalAdvance(items[i]) + 28);
  }
  if (!buttons.isEmpty()) buttons[std::min<qsizetype>(current, buttons.size() - 1)]->setChecked(true);
}

int ToggleSegment::currentIndex() const {
  return m_group->checkedId();
}

void ToggleSegment::setCurrentIndex(int index) {
  if (auto* button = m_group->button(index)) button->setChecked(true);
}

}  // namespace zerodrift::ui
