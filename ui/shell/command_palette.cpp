#include "ui/shell/command_palette.h"

#include "ui/widgets/colors.h"
#include "ui/widgets/fitted_text.h"

namespace zerodrift::ui {
namespace {

class CommandPainter : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QSize sizeHint(const QStyleOptionViewItem&, const QModelIndex&) const override { return {100, 40}; }

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const Colors& c = colors();
    const bool enabled = index.data(Qt::UserRole + 3).toBool();
    painter->save();
    if (option.state & QStyle::State_Selected) painter->fillRect(option.rect, c.soft(c.accent));
    const QRect inside = option.rect.adjusted(16, 0, -16, 0);
    painter->setFont(uiFont(13));
    painter->setPen(enabled ? c.text : c.muted);
    painter->drawText(inside.adjusted(76, 0, 0, 0), Qt::AlignVCenter, index.data(Qt::DisplayRole).toString());
    painter->setFont(uiFont(12));
    painter->setPen(c.muted);
    painter->drawText(inside, Qt::AlignVCenter, index.data(Qt::UserRole + 1).toString());
    const QString hint = fittedText(painter->fontMetrics(), index.data(Qt::UserRole + 2).toString(), 260,
                                    index.data(Qt::ToolTipRole).toString());
    painter->drawText(inside, Qt::AlignVCenter | Qt::AlignRight, hint);
    painter->restore();
  }
};

}  // namespace

int matchScore(const QString& search, const QString& text) {
  if (search.isEmpty()) return 0;
  const auto whole = text.indexOf(search, 0, Qt::CaseInsensitive);
  if (whole >= 0) return 1000 - static_cast<int>(whole);
  int score = 500;
  qsizetype at = -1;
  for (const QChar letter : search) {
    if (letter.isSpace()) continue;
    const auto next = text.indexOf(letter, at + 1, Qt::CaseInsensitive);
    if (next < 0) return -1;
    score -= static_cast<int>(next - at - 1);
    at = next;
  }
  return std::max(0, score);
}

CommandPalette::CommandPalette(QWidget* parent) : QWidget(parent) {
  m_box = new QFrame(this);
  m_box->setObjectName("paletteBox");
  m_search = new QLineEdit(m_box);
  m_search->setObjectName("paletteSearch");
  m_search->setMinimumHeight(40);
  m_search->installEventFilter(this);
  m_list = new QListWidget(m_box);
  m_list->setObjectName("paletteList");
  m_list->setItemDelegate(new CommandPainter(m_list));
  m_list->setFocusPolicy(Qt::NoFocus);
  m_list->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* inside = new QVBoxLayout(m_box);
  inside->setContentsMargins(8, 8, 8, 8);
  inside->addWidget(m_search);
  inside->addWidget(m_list);
  connect(m_search, &QLineEdit::textChanged, this, &CommandPalette::filter);
  connect(m_list, &QListWidget::itemClicked, this, &CommandPalette::choose);
  hide();
}

void CommandPalette::open(const QVector<Command>& commands) {
  m_commands = commands;
  m_search->setPlaceholderText(tr("Find a step, a sensor or an action"));
  m_search->setAccessibleName(m_search->placeholderText());
  setGeometry(parentWidget()->rect());
  m_box->setGeometry((width() - 620) / 2, 88, 620, 400);
  m_search->clear();
  filter();
  show();
  raise();
  m_search->setFocus();
}

void CommandPalette::filter() {
  QVector<QPair<int, int>> found;
  for (int i = 0; i < m_commands.size(); ++i) {
    const int score = matchScore(m_search->text(), m_commands[i].text);
    if (score >= 0) found.append({-score, i});
  }
  std::stable_sort(found.begin(), found.end());
  m_list->clear();
  for (const auto& [score, i] : found) {
    const Command& command = m_commands[i];
    auto* item = new QListWidgetItem(command.text, m_list);
    item->setData(Qt::UserRole, command.id);
    item->setData(Qt::UserRole + 1, command.group);
    item->setData(Qt::UserRole + 2, command.hint);
    item->setData(Qt::UserRole + 3, command.enabled);
    item->setToolTip(command.hint);
  }
  if (m_list->count() > 0) m_list->setCurrentRow(0);
}

void CommandPalette::choose() {
  const QListWidgetItem* item = m_list->currentItem();
  if (item == nullptr || !item->data(Qt::UserRole + 3).toBool()) return;
  hide();
  Q_EMIT chosen(item->data(Qt::UserRole).toString());
}

bool CommandPalette::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() != QEvent::KeyPress) return QWidget::eventFilter(watched, event);
  switch (static_cast<QKeyEvent*>(event)->key()) {
    case Qt::Key_Escape:
      hide();
      return true;
    case Qt::Key_Return:
    case Qt::Key_Enter:
      choose();
      return true;
    case Qt::Key_Down:
      m_list->setCurrentRow(std::min(m_list->currentRow() + 1, m_list->count() - 1));
      return true;
    case Qt::Key_Up:
      m_list->setCurrentRow(std::max(m_list->currentRow() - 1, 0));
      return true;
    default:
      return QWidget::eventFilter(watched, event);
  }
}

void CommandPalette::mousePressEvent(QMouseEvent*) {
  hide();
}

void CommandPalette::paintEvent(QPaintEvent*) {
  QPainter(this).fillRect(rect(), QColor(10, 14, 18, 90));
}

}  // namespace zerodrift::ui
