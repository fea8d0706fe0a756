#include "ui/widgets/machine_dialog.h"

#include <QComboBox>
#include <QEvent>
#include <QFormLayout>
#include <QHeaderView>
#include <QKeySequence>
#include <QLineEdit>
#include <QMenu>
#include <QPushButton>
#include <QScrollArea>
#include <QShortcut>
#include <QTreeWidget>
#include <algorithm>

#include "ui/widgets/colors.h"
#include "ui/widgets/problem_banner.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

constexpr int path_role = Qt::UserRole;
constexpr int sketch_height = 230;
constexpr int tree_row_height = 24;

QString editorName(const QString& key) {
  return QStringLiteral("field:") + key;
}

/// "45 (steel)" is taken as 45; a name with brackets of its own is a whole.
QString valueOf(const QString& choice) {
  const auto bracket = choice.indexOf(QStringLiteral("  ("));
  return (bracket < 0 ? choice : choice.left(bracket)).trimmed();
}

}  // namespace

MachineDialog::MachineDialog(QWidget* parent) : QDialog(parent) {
  setObjectName("machineForm");
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(20, 16, 20, 16);
  all->setSpacing(10);
  makeTop(all);
  m_tree = new QTreeWidget(this);
  m_tree->setObjectName("machineParts");
  m_tree->setHeaderHidden(true);
  m_tree->setRootIsDecorated(false);
  m_tree->setItemsExpandable(false);
  m_tree->setIndentation(14);
  m_tree->setStyleSheet(QStringLiteral("QTreeView::branch { image: none; border: 0; }"));  // nothing folds
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
  for (QPushButton* button : {m_add, m_remove, m_undo}) tools->addWidget(button);
  auto* left = new QVBoxLayout;
  left->setSpacing(8);
  left->addWidget(m_tree, 1);
  left->addLayout(tools);
  m_title = new QLabel(this);
  m_title->setProperty("role", "cardTitle");
  m_scroll = new QScrollArea(this);
  m_scroll->setWidgetResizable(true);
  m_scroll->setFrameShape(QFrame::NoFrame);
  auto* right = new QVBoxLayout;
  right->setSpacing(8);
  right->addWidget(m_title);
  right->addWidget(m_scroll, 1);
  auto* middle = new QHBoxLayout;
  middle->setSpacing(16);
  middle->addLayout(left, 2);
  middle->addLayout(right, 3);
  all->addLayout(middle, 1);

  m_open = new QPushButton(this);
  m_open->setObjectName("openDescription");
  m_export = new QPushButton(this);
  m_export->setObjectName("exportDescription");
  m_cancel = new QPushButton(this);
  m_cancel->setObjectName("cancel");
  m_take = new QPushButton(this);
  m_take->setObjectName("take");
  m_take->setProperty("primary", true);
  auto* foot = new QHBoxLayout;
  foot->setSpacing(8);
  foot->addWidget(m_open);
  foot->addWidget(m_export);
  foot->addStretch();
  foot->addWidget(m_cancel);
  foot->addWidget(m_take);
  all->addLayout(foot);
  for (QPushButton* button : findChildren<QPushButton*>()) button->setAutoDefault(false);  // Enter ends a field

  connect(m_tree, &QTreeWidget::currentItemChanged, this, [this](QTreeWidgetItem* item) {
    if (m_filling || item == nullptr) return;
    const QString path = item->data(0, path_role).toString();
    if (!path.isEmpty() && path != m_state.current) Q_EMIT selected(path);
  });
  connect(m_sketch, &MachineSketch::partClicked, this, [this](int part) {
    for (const FormItem& item : std::as_const(m_state.items)) {
      if (item.part == part && item.depth == 1) return Q_EMIT selected(item.path);
    }
  });
  connect(m_remove, &QPushButton::clicked, this, [this] { Q_EMIT removeRequested(m_state.current); });
  connect(m_undo, &QPushButton::clicked, this, &MachineDialog::undoRequested);
  connect(m_open, &QPushButton::clicked, this, &MachineDialog::openRequested);
  connect(m_export, &QPushButton::clicked, this, &MachineDialog::exportRequested);
  connect(m_cancel, &QPushButton::clicked, this, &QDialog::reject);
  connect(m_take, &QPushButton::clicked, this, &QDialog::accept);
  connect(new QShortcut(QKeySequence::Undo, this), &QShortcut::activated, this, [this] {
    if (m_state.canUndo) Q_EMIT undoRequested();
  });
  resize(1040, 680);
  retranslate();
}

void MachineDialog::makeTop(QVBoxLayout* into) {
  m_lead = new WrapLabel(this);
  m_lead->setProperty("role", "muted");
  m_problem = new ProblemBanner(this);
  m_sketch = new MachineSketch(this);
  m_picture = new QScrollArea(this);
  m_picture->setWidgetResizable(true);
  m_picture->setWidget(m_sketch);
  into->addWidget(m_lead);
  into->addWidget(m_problem);
  into->addWidget(m_picture);
}

const FormItem* MachineDialog::current() const {
  for (const FormItem& item : m_state.items) {
    if (item.path == m_state.current && !item.heading) return &item;
  }
  return nullptr;
}

void MachineDialog::setState(const MachineFormState& state) {
  m_state = state;
  m_filling = true;
  if (state.sentence.isEmpty()) {
    m_problem->clear();
  } else {
    m_problem->setProblem({ProblemKind::warning, state.sentence, state.remedy, {}});
  }
  m_sketch->setSketch(state.sketch);
  m_picture->setFixedHeight(std::min(m_sketch->minimumHeight() + 4, sketch_height));
  fillTree();
  fillFields();
  m_offers->clear();
  for (const FormOffer& offer : state.offers) {
    QAction* action = m_offers->addAction(offer.label, this, [this, kind = offer.kind] { Q_EMIT addRequested(kind); });
    action->setObjectName(QStringLiteral("add:") + offer.kind);
    action->setEnabled(offer.enabled);
  }
  const FormItem* item = current();
  m_remove->setEnabled(item != nullptr && item->removable);
  m_undo->setEnabled(state.canUndo);
  m_take->setEnabled(state.sentence.isEmpty());
  m_export->setEnabled(state.sentence.isEmpty());
  m_take->setToolTip(state.sentence);
  m_filling = false;
}

void MachineDialog::fillTree() {
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

QWidget* MachineDialog::makeField(const FormField& field) {
  auto* row = new QWidget;
  auto* all = new QVBoxLayout(row);
  all->setContentsMargins(0, 0, 8, 0);
  all->setSpacing(2);
  auto* line = new QHBoxLayout;
  line->setSpacing(8);
  all->addLayout(line);
  const auto tell = [this, key = field.key](const QString& value) {
    if (!m_filling) Q_EMIT edited(m_state.current, key, valueOf(value));
  };
  if (field.choices.isEmpty()) {
    auto* edit = new QLineEdit(row);
    edit->setObjectName(editorName(field.key));
    line->addWidget(edit, 1);
    connect(edit, &QLineEdit::editingFinished, this, [edit, tell] {
      if (edit->isModified()) tell(edit->text());
    });
  } else {
    auto* box = new QComboBox(row);
    box->setObjectName(editorName(field.key));
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
void MachineDialog::fillFields() {
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
  for (const FormField& field : item->fields) {
    QWidget* page = m_scroll->widget();
    auto* editor = page->findChild<QWidget*>(editorName(field.key));
    editor->setToolTip(field.tip);
    editor->setAccessibleName(field.label);
    QLineEdit* edit = qobject_cast<QLineEdit*>(editor);
    if (auto* box = qobject_cast<QComboBox*>(editor)) {
      edit = box->lineEdit();
      for (int i = 0; i < box->count(); ++i) {
        if (valueOf(box->itemText(i)) == field.value) box->setCurrentIndex(i);
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
}

void MachineDialog::retranslate() {
  setWindowTitle(tr("Describe the machine"));
  m_lead->setText(
      tr("Enter what a drawing and the data sheets say. What is not known may stay empty where it says so."));
  m_add->setText(tr("Add"));
  m_remove->setText(tr("Remove"));
  m_undo->setText(tr("Undo"));
  m_open->setText(tr("Open machine.json"));
  m_export->setText(tr("Export"));
  m_export->setToolTip(tr("Saves the description as machine.json, for the command line and for another job"));
  m_cancel->setText(tr("Cancel"));
  m_take->setText(tr("Use this description"));
}

void MachineDialog::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) {
    m_built.clear();
    retranslate();
    Q_EMIT languageChanged();
  }
  QDialog::changeEvent(event);
}

}  // namespace zerodrift::ui
