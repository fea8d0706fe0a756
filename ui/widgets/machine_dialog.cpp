#include "ui/widgets/machine_dialog.h"

#include <QEvent>
#include <QHBoxLayout>
#include <QKeySequence>
#include <QLabel>
#include <QPushButton>
#include <QScrollArea>
#include <QShortcut>
#include <QVBoxLayout>
#include <algorithm>

#include "ui/widgets/problem_banner.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

constexpr int sketch_height = 230;

}  // namespace

MachineDialog::MachineDialog(QWidget* parent) : QDialog(parent) {
  setObjectName("machineForm");
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(20, 16, 20, 16);
  all->setSpacing(10);
  makeTop(all);
  m_form = new ItemForm(this);
  all->addWidget(m_form, 1);

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

  connect(m_form, &ItemForm::selected, this, &MachineDialog::selected);
  connect(m_form, &ItemForm::edited, this, &MachineDialog::edited);
  connect(m_form, &ItemForm::addRequested, this, &MachineDialog::addRequested);
  connect(m_form, &ItemForm::removeRequested, this, &MachineDialog::removeRequested);
  connect(m_form, &ItemForm::undoRequested, this, &MachineDialog::undoRequested);
  connect(m_sketch, &MachineSketch::partClicked, this, [this](int part) {
    for (const FormItem& item : std::as_const(m_state.items)) {
      if (item.part == part && item.depth == 1) return Q_EMIT selected(item.path);
    }
  });
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

void MachineDialog::setState(const MachineFormState& state) {
  m_state = state;
  if (state.sentence.isEmpty()) {
    m_problem->clear();
  } else {
    m_problem->setProblem({ProblemKind::warning, state.sentence, state.remedy, {}});
  }
  m_sketch->setSketch(state.sketch);
  m_picture->setFixedHeight(std::min(m_sketch->minimumHeight() + 4, sketch_height));
  m_form->setState({state.items, state.current, state.offers, state.canUndo});
  m_take->setEnabled(state.sentence.isEmpty());
  m_export->setEnabled(state.sentence.isEmpty());
  m_take->setToolTip(state.sentence);
}

void MachineDialog::retranslate() {
  setWindowTitle(tr("Describe the machine"));
  m_lead->setText(
      tr("Enter what a drawing and the data sheets say. What is not known may stay empty where it says so."));
  m_form->retranslate();
  m_open->setText(tr("Open machine.json"));
  m_export->setText(tr("Export"));
  m_export->setToolTip(tr("Saves the description as machine.json, for the command line and for another job"));
  m_cancel->setText(tr("Cancel"));
  m_take->setText(tr("Use this description"));
}

void MachineDialog::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) {
    retranslate();
    Q_EMIT languageChanged();
  }
  QDialog::changeEvent(event);
}

}  // namespace zerodrift::ui
