#include "ui/widgets/item_form.h"

#include <QComboBox>
#include <QFormLayout>
#include <QHBoxLayout>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QScrollArea>
#include <QTreeWidget>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/widgets/colors.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

constexpr int path_role = Qt::UserRole;
constexpr int tree_row_height = 24;

QString fieldName(const QString& key) {
  return QStringLiteral("field:") + key;
}

/// "45 (steel)" is taken as 45; a name with brackets of its own is a whole.
QString chosenValue(const QString& choice) {
  const auto bracket = choice.indexOf(QStringLiteral("  ("));
  return (bracket < 0 ? choice : choice.left(bracket)).trimmed();
}

QTreeWidget* treeOfParts(QWidget* parent) {
  auto* tree = new QTreeWidget(parent);
  tree->setObjectName("machineParts");
  tree->setHeaderHidden(true);
  tree->setRootIsDecorated(false);
  tree->setItemsExpandable(false);
  tree->setIndentation(14);
  tree->setStyleSheet(QStringLiteral("QTreeView::branch { image: none; border: 0; }"));  // nothing folds
  return tree;
}

}  // namespace

ItemForm::ItemForm(QWidget* parent) : QWidget(parent) {
  m_tree = treeOfParts(this);
  m_add = new QPushButton(this);
  m_add->setObjectName("addPart");
  m_offers = new QMenu(m_add);
  m_add->setMenu(m_offers);
  m_remove = new QPushButton(this);
  m_remove->setObjectName("removePart");
  m_undo = new QPushButton(this);
  m_undo->setObjectName("undoForm");
  auto* tools = new QHBoxLayout;
  tools->setSpacing(8);
  for (QPushButton* button : {m_add, m_remove, m_undo}) {
    button->setAutoDefault(false);  // Enter ends a field
    tools->addWidget(button);
  }
  auto* left = new QVBoxLayout;
  left->setSpacing(8);
  left->addWidget(m_tree, 1);
  left->addLayout(tools);
  m_title = new QLabel(this);
  m_title->setProperty("role", "cardTitle");
  m_scroll = new QScrollArea(this);
  m_scroll->setWidgetResizable(true);
  m_scroll->setFrameShape(QFrame::NoFrame);
  // On whatever it is put: a card or a dialog.
  m_scroll->setStyleSheet(QStringLiteral("QScrollArea, QScrollArea > QWidget > QWidget { background: transparent; }"));
  m_right = new QVBoxLayout;
  m_right->setSpacing(8);
  m_right->addWidget(m_title);
  m_right->addWidget(m_scroll, 1);
  auto* all = new QHBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(16);
  all->addLayout(left, 2);
  all->addLayout(m_right, 3);
  connect(m_tree, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (m_filling || item == nullptr) return;
    const QString path = item->data(0, path_role).toString();
    if (!path.isEmpty() && path != m_state.current) Q_EMIT selected(path);
  });
  connect(m_remove, &QPushButton::clicked, this, [this] { Q_EMIT removeRequested(m_state.current); });
  connect(m_undo, &QPushButton::clicked, this, &ItemForm::undoRequested);
  retranslate();
}

const FormItem* ItemForm::current() const {
  for (const FormItem& item : m_state.items) {
    if (item.path == m_state.current && !item.heading) return &item;
  }
  return nullptr;
}

void ItemForm::setState(const FormState& state) {
  m_state = state;
  m_filling = true;
  fillTree();
  fillFields();
  m_offers->clear();
  for (const FormOffer& offer : state.offers) {
    if (offer.kind.isEmpty()) {
      m_offers->addSection(offer.label);
      continue;
    }
    QAction* action = m_offers->addAction(offer.label, this, [this, kind = offer.kind] { Q_EMIT addRequested(kind); });
    action->setObjectName(QStringLiteral("add:") + offer.kind);
    action->setEnabled(offer.enabled);
  }
  const FormItem* item = current();
  m_remove->setEnabled(item != nullptr && item->removable);
  m_undo->setEnabled(state.canUndo);
  m_filling = false;
}

void ItemForm::fillTree() {
  m_tree->clear();
  QTreeWidgetItem* above[2] = {nullptr, nullptr};
  QTreeWidgetItem* now = nullptr;
  for (const FormItem& item : std::as_const(m_state.items)) {
    const int depth = std::clamp(item.depth, 0, 2);
    auto* made =
        depth == 0 || above[depth - 1] == nullptr ? new QTreeWidgetItem(m_tree) : new QTreeWidgetItem(above[depth - 1]);
    made->setText(0, item.title);
    made->setSizeHint(0, QSize(0, tree_row_height));
    const bool wrong = std::any_of(item.fields.begin(), item.fields.end(),
                                   [](const FormField& field) { return !field.problem.isEmpty(); });
    if (wrong) {
      made->setText(0, item.title + QStringLiteral("  !"));
      made->setForeground(0, colors().badText);
    }
    if (item.heading) {
      made->setFlags(Qt::ItemIsEnabled);
      made->setForeground(0, colors().muted);
    } else {
      made->setData(0, path_role, item.path);
      if (item.path == m_state.current) now = made;
    }
    if (depth < 2) above[depth] = made;
    if (depth == 0) above[1] = nullptr;
  }
  m_tree->expandAll();
  if (now != nullptr) m_tree->setCurrentItem(now);
}

QWidget* ItemForm::makeField(const FormField& field) {
  auto* row = new QWidget;
  auto* all = new QVBoxLayout(row);
  all->setContentsMargins(0, 0, 8, 0);
  all->setSpacing(2);
  auto* line = new QHBoxLayout;
  line->setSpacing(8);
  all->addLayout(line);
  const auto tell = [this, key = field.key](const QString& value) {
    if (!m_filling) Q_EMIT edited(m_state.current, key, chosenValue(value));
  };
  if (field.choices.isEmpty()) {
    auto* edit = new QLineEdit(row);
    edit->setObjectName(fieldName(field.key));
    line->addWidget(edit, 1);
    connect(edit, &QLineEdit::editingFinished, this, [edit, tell] {
      if (edit->isModified()) tell(edit->text());
    });
  } else {
    auto* box = new QComboBox(row);
    box->setObjectName(fieldName(field.key));
    box->setEditable(!field.closed);
    box->setInsertPolicy(QComboBox::NoInsert);
    box->addItems(field.choices);
    line->addWidget(box, 1);
    connect(box, &QComboBox::activated, this, [box, tell](int index) { tell(box->itemText(index)); });
    if (!field.closed) {
      connect(box->lineEdit(), &QLineEdit::editingFinished, this, [box, tell] {
        if (box->lineEdit()->isModified()) tell(box->currentText());
      });
    }
  }
  auto* unit = new QLabel(field.unit, row);
  unit->setProperty("role", "muted");
  unit->setFixedWidth(74);
  line->addWidget(unit);
  auto* problem = new WrapLabel(row);
  problem->setObjectName(QStringLiteral("problem:") + field.key);
  problem->setProperty("role", "bad");
  all->addWidget(problem);
  return row;
}

/// The editors stay where the same fields are on screen: the one that is being typed in keeps its focus.
void ItemForm::fillFields() {
  const FormItem* item = current();
  QStringList signature{m_state.current, locale().name()};
  if (item != nullptr) {
    for (const FormField& field : item->fields) signature << field.key << field.label << field.choices;
  }
  m_title->setText(item == nullptr ? QString() : item->title);
  if (signature.join(QLatin1Char('\n')) != m_built) {
    m_built = signature.join(QLatin1Char('\n'));
    const QString focus = focusWidget() == nullptr ? QString() : focusWidget()->objectName();
    auto* page = new QWidget;
    m_form = new QFormLayout(page);
    m_form->setContentsMargins(0, 0, 0, 0);
    m_form->setVerticalSpacing(6);
    m_form->setLabelAlignment(Qt::AlignLeft | Qt::AlignVCenter);
    if (item != nullptr) {
      for (const FormField& field : item->fields) m_form->addRow(field.label, makeField(field));
    }
    if (QWidget* old = m_scroll->takeWidget()) old->deleteLater();  // one of its editors may be telling this
    m_scroll->setWidget(page);
    if (auto* again = focus.isEmpty() ? nullptr : page->findChild<QWidget*>(focus)) again->setFocus();
  }
  if (item == nullptr) return;
  for (const FormField& field : item->fields) fillField(field);
}

void ItemForm::fillField(const FormField& field) {
  QWidget* page = m_scroll->widget();
  auto* editor = page->findChild<QWidget*>(fieldName(field.key));
  editor->setToolTip(field.tip);
  editor->setAccessibleName(field.label);
  QLineEdit* edit = qobject_cast<QLineEdit*>(editor);
  if (auto* box = qobject_cast<QComboBox*>(editor)) {
    edit = box->lineEdit();
    for (int i = 0; i < box->count(); ++i) {
      if (chosenValue(box->itemText(i)) == field.value) box->setCurrentIndex(i);
    }
  }
  if (edit != nullptr) {
    edit->setText(field.value);
    edit->setModified(false);
    edit->setPlaceholderText(field.empty);
  }
  auto* problem = page->findChild<QLabel*>(QStringLiteral("problem:") + field.key);
  problem->setText(field.problem);
  problem->setVisible(!field.problem.isEmpty());
}

void ItemForm::setUndoShown(bool shown) {
  m_undo->setVisible(shown);
}

void ItemForm::retranslate() {
  m_built.clear();
  m_add->setText(tr("Add"));
  m_remove->setText(tr("Remove"));
  m_undo->setText(tr("Undo"));
}

}  // namespace zerodrift::ui
