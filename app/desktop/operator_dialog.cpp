#include "app/desktop/operator_dialog.h"

#include <QHBoxLayout>
#include <QInputDialog>
#include <QKeyEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QVBoxLayout>

#include "app/text/operator_text.h"

namespace zerodrift::desktop {
namespace {

constexpr int touch_height_px = 48;  // for gloves
constexpr int width_px = 460;

using controller::OperatorAct;

bool takes_check(OperatorAct act) {
  return act == OperatorAct::load_table || act == OperatorAct::check_table;
}

}  // namespace

OperatorDialog::OperatorDialog(std::shared_ptr<OperatorQuestions> questions, QWidget* parent)
    : QDialog(parent), m_questions(std::move(questions)) {
  setModal(false);
  auto* column = new QVBoxLayout(this);
  m_text = new QLabel(this);
  m_text->setProperty("heading", true);
  m_text->setWordWrap(true);
  column->addWidget(m_text);
  m_typed = new QLineEdit(this);
  m_typed->setMinimumHeight(touch_height_px);
  column->addWidget(m_typed);
  auto* row = new QHBoxLayout;
  m_cannot = new QPushButton(this);
  m_off = new QPushButton(this);
  m_done = new QPushButton(this);
  m_done->setProperty("primary", true);
  m_done->setDefault(true);
  for (QPushButton* button : {m_cannot, m_off, m_done}) {
    button->setMinimumHeight(touch_height_px);
    row->addWidget(button);
  }
  column->addLayout(row);
  setMinimumWidth(width_px);
  connect(m_done, &QPushButton::clicked, this, &OperatorDialog::done);
  connect(m_off, &QPushButton::clicked, this, [this] { m_questions->answer({false, {}}); });
  connect(m_cannot, &QPushButton::clicked, this, &OperatorDialog::giveUp);
  connect(m_typed, &QLineEdit::textChanged, this, [this](const QString& text) {
    if (m_typed->isVisible()) m_done->setEnabled(!text.trimmed().isEmpty());
  });
  // From a step's thread: the question may be answered by the time it is shown.
  connect(m_questions.get(), &OperatorQuestions::changed, this, &OperatorDialog::update, Qt::QueuedConnection);
}

void OperatorDialog::update() {
  const auto request = m_questions->open();
  if (!request) return hide();
  setWindowTitle(tr("At the control"));
  m_text->setText(operatorText(*request));
  const bool state = request->act == OperatorAct::state;
  m_typed->setVisible(takes_check(request->act));
  m_typed->clear();
  m_typed->setAccessibleName(tr("Check value"));
  m_off->setVisible(state);
  m_off->setText(tr("It is off"));
  m_done->setText(state ? tr("It is on") : tr("Done"));
  m_done->setEnabled(!takes_check(request->act));
  m_cannot->setVisible(!state);
  m_cannot->setText(tr("Cannot be done"));
  show();
  raise();
  activateWindow();
  (takes_check(request->act) ? static_cast<QWidget*>(m_typed) : m_done)->setFocus();
}

void OperatorDialog::done() {
  const auto request = m_questions->open();
  if (!request) return;
  controller::OperatorAnswer answer;
  if (request->act == OperatorAct::state) answer.compensation_on = true;
  if (takes_check(request->act)) answer.check = m_typed->text().trimmed().toLower().toStdString();
  m_done->setEnabled(false);
  m_questions->answer(answer);
}

void OperatorDialog::giveUp() {
  bool given = false;
  const QString reason =
      QInputDialog::getText(this, tr("Cannot be done"), tr("Why not?"), QLineEdit::Normal, QString(), &given);
  if (given) m_questions->decline(reason.isEmpty() ? tr("no reason given") : reason);
}

/// Escape must not hide a question that a step waits for.
void OperatorDialog::keyPressEvent(QKeyEvent* event) {
  if (event->key() == Qt::Key_Escape) return giveUp();
  QDialog::keyPressEvent(event);
}

}  // namespace zerodrift::desktop
