#include "app/desktop/pin_dialog.h"

#include <QApplication>
#include <QCoreApplication>
#include <QDialog>
#include <QDialogButtonBox>
#include <QEvent>
#include <QLabel>
#include <QLineEdit>
#include <QPointer>
#include <QPushButton>
#include <QTimer>
#include <QVBoxLayout>
#include <thread>

#include "app/desktop/workbench.h"
#include "app/text/error_text.h"

namespace zerodrift::desktop {
namespace {

constexpr int idle_look_ms = 2000;

struct PinText {
  Q_DECLARE_TR_FUNCTIONS(zerodrift::desktop::PinDialog)
};

/// One or more lines to type into, a deed, and what came of it. The deed runs beside the window.
class PinDialog : public QDialog {
 public:
  using Deed = std::function<Status(const std::vector<std::string>& typed)>;

  PinDialog(const QString& heading, const QString& text, const QStringList& lines, const QString& button, Deed deed,
            QWidget* parent)
      : QDialog(parent), m_deed(std::move(deed)) {
    setWindowTitle(heading);
    auto* column = new QVBoxLayout(this);
    auto* title = new QLabel(heading, this);
    title->setProperty("heading", true);
    column->addWidget(title);
    auto* note = new QLabel(text, this);
    note->setWordWrap(true);
    column->addWidget(note);
    for (const QString& line : lines) {
      auto* edit = new QLineEdit(this);
      edit->setEchoMode(QLineEdit::Password);
      edit->setPlaceholderText(line);
      edit->setAccessibleName(line);
      edit->setMinimumHeight(44);  // for gloves
      column->addWidget(edit);
      m_edits.append(edit);
    }
    m_problem = new QLabel(this);
    m_problem->setWordWrap(true);
    column->addWidget(m_problem);
    auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
    m_button = buttons->addButton(button, QDialogButtonBox::AcceptRole);
    m_button->setProperty("primary", true);
    connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
    connect(buttons, &QDialogButtonBox::accepted, this, [this] { start(); });
    column->addWidget(buttons);
    setMinimumWidth(380);
  }

  ~PinDialog() override {
    if (m_thread.joinable()) m_thread.join();
  }

 private:
  void start() {
    if (m_thread.joinable()) return;
    std::vector<std::string> typed;
    for (const auto* edit : m_edits) typed.push_back(edit->text().toStdString());
    m_button->setEnabled(false);
    m_thread = std::thread([this, typed] {
      const Status done = m_deed(typed);
      QMetaObject::invokeMethod(
          this, [this, done] { finish(done); }, Qt::QueuedConnection);
    });
  }

  void finish(const Status& done) {
    m_thread.join();
    m_button->setEnabled(true);
    if (done) return accept();
    m_problem->setText(textOf(done.error()).sentence);
    for (auto* edit : m_edits) edit->clear();
    m_edits.front()->setFocus();
  }

  Deed m_deed;
  QVector<QLineEdit*> m_edits;
  QLabel* m_problem = nullptr;
  QPushButton* m_button = nullptr;
  std::thread m_thread;
};

/// Who had the right to write, and when, stands beside what was written.
void note(Workbench& bench, const char* action) {
  if (bench.job() == nullptr || bench.job()->read_only()) return;
  commissioning::AuditEntry entry;
  entry.action = action;
  entry.subject = "right to write";
  entry.result = "done";
  if (const auto kept = bench.job()->audit(entry); !kept) bench.log(LogKind::bad, lineOf(kept.error()));
}

}  // namespace

bool unlock(Workbench& bench, QWidget* parent, const QString& why) {
  PinDialog dialog(
      PinText::tr("The engineer's PIN"), why, {PinText::tr("PIN")}, PinText::tr("Unlock"),
      [&bench](const auto& typed) { return bench.access().unlock(typed[0]); }, parent);
  if (dialog.exec() != QDialog::Accepted) return false;
  bench.log(LogKind::note, PinText::tr("Unlocked: the engineer may write to the machine"));
  note(bench, "unlock");
  Q_EMIT bench.accessChanged();
  return true;
}

std::optional<access::Permit> permit_for(Workbench& bench, QWidget* parent, const QString& operation) {
  auto permit = bench.access().permit(operation.toStdString());
  if (!permit) {
    if (!unlock(bench, parent, textOf(permit.error()).sentence)) return std::nullopt;
    permit = bench.access().permit(operation.toStdString());
  }
  if (!permit) return std::nullopt;
  return *permit;
}

void lock(Workbench& bench, const QString& why) {
  bench.access().lock();
  bench.log(LogKind::note, why);
  note(bench, "lock");
  Q_EMIT bench.accessChanged();
}

void change_pin(Workbench& bench, QWidget* parent) {
  const bool has = bench.access().has_pin();
  QStringList lines;
  if (has) lines << PinText::tr("PIN until now");
  lines << (has ? PinText::tr("New PIN (empty: none any more)") : PinText::tr("New PIN"))
        << PinText::tr("New PIN again");
  const auto deed = [&bench, has](const std::vector<std::string>& typed) -> Status {
    const std::string old_pin = has ? typed[0] : std::string();
    const std::string& first = typed[has ? 1 : 0];
    if (first != typed[has ? 2 : 1]) {
      return fail(ErrorCode::data_does_not_fit,
                  {{"what", "The PIN"}, {"found", "two different ones"}, {"expected", "the same twice"}});
    }
    return has && first.empty() ? bench.access().clear_pin(old_pin) : bench.access().set_pin(old_pin, first);
  };
  PinDialog dialog(
      PinText::tr("PIN of this computer"),
      PinText::tr("With a PIN everybody may look, and only who knows it may write to a machine. After a while "
                  "without a touch it is asked for again."),
      lines, PinText::tr("Set"), deed, parent);
  if (dialog.exec() != QDialog::Accepted) return;
  bench.log(LogKind::note, bench.access().has_pin() ? PinText::tr("A PIN is set") : PinText::tr("No PIN any more"));
  Q_EMIT bench.accessChanged();
}

IdleLock::IdleLock(Workbench& bench, QObject* parent) : QObject(parent), m_bench(bench) {
  qApp->installEventFilter(this);
  auto* look = new QTimer(this);
  connect(look, &QTimer::timeout, this, [this] {
    // What runs goes on: it took its right when it began.
    if (m_bench.access().lock_when_idle()) desktop::lock(m_bench, PinText::tr("Locked: nobody has touched the window"));
  });
  look->start(idle_look_ms);
}

bool IdleLock::eventFilter(QObject*, QEvent* event) {
  switch (event->type()) {
    case QEvent::KeyPress:
    case QEvent::MouseButtonPress:
    case QEvent::MouseMove:
    case QEvent::Wheel:
    case QEvent::TouchBegin:
      if (event->spontaneous()) m_bench.access().touch();
      break;
    default:
      break;
  }
  return false;
}

}  // namespace zerodrift::desktop
