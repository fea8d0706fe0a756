#include "app/desktop/application.h"

#include <QApplication>
#include <QCloseEvent>
#include <QFile>
#include <QFileInfo>
#include <QSettings>
#include <algorithm>

#include "app/desktop/ask.h"
#include "app/desktop/file_opener.h"
#include "app/desktop/operator_dialog.h"
#include "app/desktop/pin_dialog.h"
#include "app/desktop/registry.h"
#include "app/desktop/steps/compensator_presenter.h"
#include "app/desktop/steps/machine_presenter.h"
#include "app/desktop/steps/physics_presenter.h"
#include "app/desktop/steps/upload_presenter.h"
#include "app/desktop/steps/verify_presenter.h"
#include "app/desktop/steps/warmup_presenter.h"
#include "app/text/error_text.h"
#include "core/flow/rollback_and_switch.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/progress_strip.h"

namespace zerodrift::desktop {
namespace {

const QString english = QStringLiteral("en");
const QString chinese = QStringLiteral("zh_CN");
const QString language_key = QStringLiteral("language");
constexpr int lamp_period_ms = 1000;
constexpr int unseen_after_ms = 10000;  // without a word from the controller

ui::Judgement judgement_of(LogKind kind) {
  switch (kind) {
    case LogKind::good:
      return ui::Judgement::ok;
    case LogKind::warning:
      return ui::Judgement::warn;
    case LogKind::bad:
      return ui::Judgement::bad;
    case LogKind::note:
      break;
  }
  return ui::Judgement::none;
}

}  // namespace

Application::Application(ui::Theme& theme)
    : m_theme(theme),
      m_bench(std::make_unique<Workbench>()),
      m_demo(std::make_unique<DemoMachine>()),
      m_window(std::make_unique<ui::MainWindow>()),
      m_opener(new FileOpener(*this)) {
  m_presenters = makePages(*m_bench, *m_window, *m_demo);
  new OperatorDialog(m_bench->questions(), m_window.get());  // the window's; it comes with a question
  setLanguage(english);                                      // its plurals are translations too
  wire();
  openPage(m_presenters.front()->id());
  updateSteps();
  updateLamps();
}

Application::~Application() {
  // The task ends before what it uses: the pages go first, and it calls them.
  m_window->hide();
  m_bench->tasks().end();
}

void Application::wire() {
  connect(m_window.get(), &ui::MainWindow::stepRequested, this, &Application::openPage);
  connect(m_window.get(), &ui::MainWindow::backRequested, this, &Application::openBack);
  connect(m_window.get(), &ui::MainWindow::undoRequested, this, &Application::undo);
  connect(m_window.get(), &ui::MainWindow::filesDropped, this, &Application::openFiles);
  connect(m_window.get(), &ui::MainWindow::openRequested, this, [this] { runCommand(QStringLiteral("open")); });
  connect(m_window.get(), &ui::MainWindow::paletteOpening, this, &Application::offerCommands);
  connect(m_window.get(), &ui::MainWindow::commandRequested, this, &Application::runCommand);
  connect(m_window.get(), &ui::MainWindow::closing, this, &Application::mayClose);
  connect(m_window.get(), &ui::MainWindow::jobRequested, this, [this] { openPage(m_presenters.front()->id()); });
  connect(m_window.get(), &ui::MainWindow::languageRequested, this, [this] {
    setLanguage(m_language == chinese ? english : chinese);
    QSettings().setValue(language_key, m_language);
  });
  connect(m_window.get(), &ui::MainWindow::themeRequested, this, [this] {
    m_theme.setMode(m_theme.isDark() ? ui::ThemeMode::light : ui::ThemeMode::dark);
    QSettings().setValue(QStringLiteral("dark"), m_theme.isDark());
  });
  connect(&m_theme, &ui::Theme::changed, this, [this] {
    for (auto* presenter : m_presenters) presenter->themeChanged();
  });
  connect(m_bench.get(), &Workbench::logged, this, [this](const QDateTime& time, LogKind kind, const QString& text) {
    m_window->appendLog(time, judgement_of(kind), text);
  });
  const auto changed = [this] {
    for (auto* presenter : m_presenters) {
      if (presenter->id() == m_open) presenter->refresh();
    }
    updateSteps();
    updateLamps();
  };
  // The one place that empties the pages: nothing of the job before is seen in the next one.
  connect(m_bench.get(), &Workbench::jobLeft, this, [this] {
    for (auto* presenter : m_presenters) {
      presenter->forget();
      presenter->refresh();
    }
  });
  connect(m_bench.get(), &Workbench::jobChanged, this, [this] {
    for (auto* presenter : m_presenters) presenter->page()->clearProblem();  // they were of the job before
  });
  connect(m_bench.get(), &Workbench::jobChanged, this, changed);
  connect(m_bench.get(), &Workbench::artefactsChanged, this, changed);
  connect(m_bench.get(), &Workbench::profileChanged, this, changed);
  connect(m_bench.get(), &Workbench::machineStateChanged, this, changed);
  connect(m_bench.get(), &Workbench::machineSeen, this, &Application::updateLamps);
  connect(m_bench.get(), &Workbench::machineLost, this, &Application::updateLamps);
  connect(m_bench.get(), &Workbench::accessChanged, this, &Application::updateLamps);
  connect(m_bench.get(), &Workbench::heldTableChanged, this, &Application::updateSteps);
  new IdleLock(*m_bench, this);
  // Said when the job has been opened and its page stands.
  connect(m_bench.get(), &Workbench::jobChanged, this, &Application::sayInterrupted, Qt::QueuedConnection);
  connect(m_bench.get(), &Workbench::disconnectedFor, this, &Application::sayDisconnected, Qt::QueuedConnection);
  connect(m_bench.get(), &Workbench::jobDamaged, this, &Application::sayDamaged);
  connect(m_bench.get(), &Workbench::controllerTold, this, &Application::updateLamps);
  connect(&m_lampTimer, &QTimer::timeout, this, &Application::updateLamps);
  m_lampTimer.start(lamp_period_ms);
  const auto worked = [this] {
    paceVirtualMachine();
    updateLamps();
    updateSteps();
  };
  connect(&m_bench->tasks(), &TaskRunner::started, this, worked);
  connect(&m_bench->tasks(), &TaskRunner::finished, this, worked);
  connect(m_demo.get(), &DemoMachine::ready, this, &Application::paceVirtualMachine);
  connect(m_bench.get(), &Workbench::jobChanged, this, &Application::paceVirtualMachine);
  connect(m_bench.get(), &Workbench::profileChanged, this, &Application::paceVirtualMachine);
  for (auto* presenter : m_presenters) {
    connect(presenter, &Presenter::nextRequested, this, [this, presenter] { openNext(presenter->id()); });
    connect(presenter->page(), &ui::Page::goOnTriggered, this, [this, presenter] { openNext(presenter->id()); });
    connect(presenter, &Presenter::pageRequested, this, &Application::openPage);
    connect(presenter, &Presenter::standingChanged, this, &Application::updateSteps);
  }
  wireSteps();
}

void Application::wireSteps() {
  const auto find = [this](const char* id) { return presenter(QString::fromLatin1(id)); };
  auto* warmup = qobject_cast<WarmupPresenter*>(find("warmup"));
  auto* physics = qobject_cast<PhysicsPresenter*>(find("physics"));
  auto* upload = qobject_cast<UploadPresenter*>(find("upload"));
  auto* verify = qobject_cast<VerifyPresenter*>(find("verify"));
  auto* machine = qobject_cast<MachinePresenter*>(find("machine"));
  connect(machine, &MachinePresenter::endWorkWanted, this, &Application::endWork);
  connect(machine, &MachinePresenter::sampleWanted, this, &Application::openSample);
  connect(machine, &MachinePresenter::ownRecordingWanted, m_opener, &FileOpener::chooseRecording);
  connect(warmup, &WarmupPresenter::importWanted, m_opener, &FileOpener::chooseRecording);
  connect(physics, &PhysicsPresenter::planProposed, this, [this, warmup](const acquisition::Plan& plan) {
    warmup->propose(plan);
    openPage(warmup->id());
  });
  // The transaction is shown where transactions are; a verification of what was written follows.
  connect(verify, &VerifyPresenter::correctionWanted, this,
          [this, upload, verify](const compensation::Table& table, const std::function<void(bool)>& done) {
            upload->writeCorrection(table, [this, verify, done](bool good) {
              if (good) openPage(verify->id());
              done(good);
            });
            openPage(upload->id());
          });
  connect(verify, &VerifyPresenter::furtherRunWanted, this, [this, warmup] {
    openPage(warmup->id());
    warmup->planFurtherRun();
  });
  connect(verify, &VerifyPresenter::rollbackWanted, this, [this, upload](int version) {
    openPage(upload->id());
    upload->proposeRollback(version);
  });
  connect(m_window.get(), &ui::MainWindow::lampClicked, this, [this](ui::LampId lamp) {
    if (lamp == ui::LampId::compensation) switchCompensation();
    if (lamp == ui::LampId::access) changeAccess();
  });
}

void Application::paceVirtualMachine() {
  // A run that is broken off counts on the machine's clock: it is taken up as long after as that says.
  bool working = m_bench->tasks().running();
  for (const char* id : {"sensors", "fit", "physics", "report", "axis_errors"}) {
    working = working && !presenter(QString::fromLatin1(id))->working();  // they compute
  }
  for (const char* id : {"warmup", "verify"}) {
    auto* run = qobject_cast<RunPresenter*>(presenter(QString::fromLatin1(id)));
    working = working || (run != nullptr && run->interrupted().has_value());
  }
  m_demo->setWorking(working);
  const auto& profile = m_bench->profile();
  const bool connected = m_demo->running() && profile && profile->file == m_demo->profilePath().toStdString();
  m_bench->setPaceAtRest(connected ? std::optional(m_demo->pace()) : std::nullopt);
}

void Application::switchCompensation() {
  const auto profile = m_bench->profile();
  if (!profile || !m_bench->connected() || m_bench->lost() || m_bench->tasks().running()) return;
  const bool on = !m_bench->compensationOn();
  const QString machine = QString::fromStdString(profile->name);
  const QString heading = on ? tr("Switch the compensation ON?") : tr("Switch the compensation OFF?");
  const QString text = on ? tr("The axes of %1 move by what the active table says.").arg(machine)
                          : tr("The axes of %1 move back by what is applied now.").arg(machine);
  if (!ask(m_window.get(), heading, text, on ? tr("Switch ON") : tr("Switch OFF"))) return;
  const auto permit = permit_for(*m_bench, m_window.get(), tr("Switching the compensation"));
  if (!permit) return;
  m_bench->tasks().start<bool>(
      tr("Switching the compensation"),
      [profile = *profile, permit = *permit, job = m_bench->job(), on,
       questions = m_bench->questions()](const TaskContext& context) -> Result<bool> {
        ZD_TRY(auto devices, flow::Devices::open(profile, false, permit, questions->of(profile, context.stop)));
        return flow::switch_compensation(job.get(), devices, flow::Consent::given(), on);
      },
      [this](Result<bool> now) {
        if (now) m_bench->tellController(true, *now);
        m_bench->log(now ? LogKind::good : LogKind::bad, !now   ? lineOf(now.error(), Reader::window)
                                                         : *now ? tr("Compensation ON")
                                                                : tr("Compensation OFF"));
      });
}

void Application::changeAccess() {
  const auto& access = m_bench->access();
  if (!access.has_pin()) return change_pin(*m_bench, m_window.get());
  if (access.role() == access::Role::operator_) {
    unlock(*m_bench, m_window.get(), tr("Everybody may look. Writing to a machine needs the engineer."));
    return;
  }
  const QString text = tr("Whoever comes next may look and not write. To change the PIN choose \"Change\".");
  switch (ask(m_window.get(), tr("Lock this computer?"), text, tr("Lock"), tr("Change"))) {
    case Answer::yes:
      return lock(*m_bench, tr("Locked"));
    case Answer::other:
      return change_pin(*m_bench, m_window.get());
    case Answer::no:
      return;
  }
}

void Application::sayDisconnected(unsigned connected_serial, unsigned job_serial) {
  auto* open = presenter(m_open);
  if (open == nullptr) return;
  open->tell([connected_serial, job_serial] {
    return ui::Problem{
        ui::ProblemKind::warning,
        tr("Disconnected from the machine %1: this job is of the machine %2.").arg(connected_serial).arg(job_serial),
        tr("To go on with the connected machine open its own job, or begin a new one."),
        {}};
  });
}

void Application::sayDamaged(const Error& damage) {
  updateSteps();
  if (auto* open = presenter(m_open)) open->show(damage);
}

/// A run that was broken off is the first thing to know of a job: the newest of them, warm-up or verification.
void Application::sayInterrupted() {
  auto* open = presenter(m_open);
  if (open == nullptr || m_bench->job() == nullptr || m_bench->tasks().running()) return;
  for (const char* id : {"verify", "warmup"}) {
    auto* page = qobject_cast<RunPresenter*>(presenter(QString::fromLatin1(id)));
    if (page == nullptr || !page->interrupted()) continue;
    const bool verifies = page->id() == QStringLiteral("verify");
    open->tell([after_s = page->interrupted()->summary.duration_s, verifies] {
      const QString after = ui::durationText(after_s);
      return ui::Problem{ui::ProblemKind::note,
                         verifies ? tr("The verification run of this job was interrupted after %1.").arg(after)
                                  : tr("The warm-up run of this job was interrupted after %1.").arg(after),
                         verifies ? tr("On the Verify page it goes on, or is finished with what was recorded.")
                                  : tr("On the Warm-up page it goes on, or is finished with what was recorded."),
                         {}};
    });
    return;
  }
}

void Application::show() {
  const QSettings settings;
  m_window->restoreGeometry(settings.value(QStringLiteral("window/geometry")).toByteArray());
  m_window->setLogVisible(settings.value(QStringLiteral("window/log"), false).toBool());
  m_window->show();
}

Presenter* Application::presenter(const QString& id) const {
  for (auto* presenter : m_presenters) {
    if (presenter->id() == id) return presenter;
  }
  return nullptr;
}

void Application::openPage(const QString& id) {
  if (auto* before = presenter(m_open); before != nullptr && m_open != id) before->leave();
  m_open = id;
  m_window->setCurrentPage(id);
  m_window->setBackEnabled(id != m_presenters.front()->id());
  if (auto* now = presenter(id)) now->enter();
}

void Application::openNext(const QString& after) {
  bool behind = false;
  for (const auto* presenter : m_presenters) {
    if (behind && !presenter->page()->isNotNeeded()) return openPage(presenter->id());
    behind = behind || presenter->id() == after;
  }
}

void Application::openBack() {
  for (std::size_t i = 1; i < m_presenters.size(); ++i) {
    if (m_presenters[i]->id() == m_open) {
      openPage(m_presenters[i - 1]->id());
      return;
    }
  }
}

void Application::openJob(const QString& path) {
  if (auto* machine = qobject_cast<MachinePresenter*>(m_presenters.front())) machine->openJob(path);
}

void Application::openFiles(const QStringList& paths) {
  m_opener->open(paths);
}

void Application::openSample() {
  m_opener->openSample();
}

void Application::startDemo(const DemoOptions& options, const QString& jobPath) {
  auto* machine = qobject_cast<MachinePresenter*>(m_presenters.front());
  if (machine == nullptr) return;
  if (!jobPath.isEmpty()) machine->newJob(jobPath);
  machine->useVirtualMachine(options);
}

QString Application::rememberedLanguage() {
  const QString system = QLocale::system().language() == QLocale::Chinese ? chinese : english;
  return QSettings().value(language_key, system).toString();
}

void Application::setLanguage(const QString& code) {
  // Removing and installing a translator tells every widget, and each page draws itself anew from its state.
  QApplication::removeTranslator(&m_translator);
  QApplication::removeTranslator(&m_qtTranslator);
  m_language = code == chinese ? chinese : english;
  QLocale::setDefault(m_language == chinese ? QLocale(QLocale::Chinese, QLocale::China)
                                            : QLocale(QLocale::English, QLocale::UnitedStates));
  if (m_translator.load(QStringLiteral(":/i18n/zerodrift_") + m_language))
    QApplication::installTranslator(&m_translator);
  if (m_language == chinese && m_qtTranslator.load(QStringLiteral(":/i18n/qtbase_zh_CN"))) {
    QApplication::installTranslator(&m_qtTranslator);
  }
  m_window->setLanguageName(m_language == chinese ? QStringLiteral("中文") : QStringLiteral("EN"));
  for (auto* presenter : m_presenters) presenter->languageChanged();
  updateSteps();
  updateLamps();
}

void Application::updateLamps() {
  const bool running = m_bench->tasks().running();
  lightController();
  if (running && m_bench->lost() && (isRunning("warmup") || isRunning("verify"))) {
    m_window->setLamp(ui::LampId::recording, tr("%1 waits").arg(m_bench->tasks().name()), ui::Judgement::warn);
  } else if (running) {
    m_window->setLamp(ui::LampId::recording, m_bench->tasks().name(), ui::Judgement::ok);
  } else {
    m_window->setLamp(ui::LampId::recording, tr("Nothing running"), ui::Judgement::none);
  }
  const auto& access = m_bench->access();
  const bool engineer = access.role() == access::Role::engineer;
  m_window->setLamp(ui::LampId::access,
                    !access.has_pin() ? tr("No PIN")
                    : engineer        ? tr("Engineer")
                                      : tr("Locked"),
                    access.has_pin() && engineer ? ui::Judgement::ok : ui::Judgement::none);
  lightCamera();
  // A switch that cannot be read is neither on nor off.
  const bool known = m_bench->connected() && !m_bench->lost();
  const bool on = m_bench->compensationOn();
  m_window->setLamp(ui::LampId::compensation,
                    !known ? tr("Compensation unknown")
                    : on   ? tr("Compensation ON")
                           : tr("Compensation OFF"),
                    on ? ui::Judgement::warn : ui::Judgement::none, on);
}

void Application::lightController() {
  const auto light = [this](const QString& text, ui::Judgement judgement) {
    m_window->setLamp(ui::LampId::controller, text, judgement);
  };
  if (m_bench->lost()) return light(tr("Controller lost"), ui::Judgement::bad);
  if (!m_bench->connected()) return light(tr("Controller off"), ui::Judgement::none);
  // While a step works nobody else looks; a step that does not use the machine leaves it unseen.
  const bool unseen = m_bench->seenAt().msecsTo(QDateTime::currentDateTime()) > unseen_after_ms;
  if (m_bench->tasks().running() && unseen) {
    return light(tr("Controller not asked just now"), ui::Judgement::none);
  }
  const bool manual = m_bench->profile() && m_bench->profile()->manual;
  light(manual ? tr("Manual control") : tr("Controller connected"), ui::Judgement::ok);
}

void Application::lightCamera() {
  const auto light = [this](const QString& text, ui::Judgement judgement) {
    m_window->setLamp(ui::LampId::camera, text, judgement);
  };
  const auto& profile = m_bench->profile();
  if (!profile) return light(tr("Camera off"), ui::Judgement::none);
  if (profile->error_source != controller::ErrorSourceKind::camera) {
    const bool seen = m_bench->connected() && !m_bench->lost();
    return light(tr("Probes"), seen ? ui::Judgement::ok : ui::Judgement::none);
  }
  const auto count = static_cast<int>(profile->cameras.size());
  const QString cameras = count == 1 ? tr("1 camera") : tr("%1 cameras").arg(count);
  const auto& open = m_bench->openCameras();
  if (open.empty()) {  // a run has cameras of its own
    return light(isRunning("warmup") || isRunning("verify") ? tr("%1 in use").arg(cameras) : tr("%1 off").arg(cameras),
                 ui::Judgement::none);
  }
  const auto alive = std::count_if(open.begin(), open.end(), [](const auto& one) { return one->newest().has_value(); });
  if (alive == count) return light(cameras, ui::Judgement::ok);
  light(count == 1 ? tr("No picture") : tr("%1 of %2 cameras").arg(alive).arg(count), ui::Judgement::bad);
}

void Application::undo() {
  if (auto* now = presenter(m_open)) now->undo();
}

void Application::offerCommands() {
  const QString job = tr("Job");
  const QString window = tr("Window");
  QVector<ui::Command> commands = {
      {QStringLiteral("new"), tr("New job"), job, {}, true},
      {QStringLiteral("open"), tr("Open job"), job, QStringLiteral("Ctrl+O"), true},
      {QStringLiteral("recording"), tr("Import a recording"), job, {}, true},
      {QStringLiteral("sample"), tr("Open the sample job"), job, {}, true},
      {QStringLiteral("virtual"), tr("Connect to the virtual machine"), job, {}, true},
      {QStringLiteral("undo"), tr("Undo the last choice"), window, QStringLiteral("Ctrl+Z"), true}};
  for (const QString& path : MachinePresenter::recentJobs()) {
    commands.append({QStringLiteral("job:") + path, QFileInfo(path).completeBaseName(), job, path, true});
  }
  m_window->setExtraCommands(commands);
}

void Application::runCommand(const QString& id) {
  auto* machine = qobject_cast<MachinePresenter*>(m_presenters.front());
  if (id == QStringLiteral("new")) machine->chooseNewJob();
  if (id == QStringLiteral("open")) machine->chooseJob();
  if (id == QStringLiteral("recording")) m_opener->chooseRecording();
  if (id == QStringLiteral("sample")) openSample();
  if (id == QStringLiteral("virtual")) machine->useAnyVirtualMachine();
  if (id == QStringLiteral("undo")) undo();
  if (id.startsWith(QStringLiteral("job:"))) openFiles({id.mid(4)});
}

bool Application::isRunning(const char* id) const {
  const auto* run = qobject_cast<const RunPresenter*>(presenter(QString::fromLatin1(id)));
  return run != nullptr && run->running();
}

QString Application::whatEndingDoes() const {
  if (isRunning("warmup")) {
    return tr("The spindle, the path and the coolant stop. What was recorded is kept and the run can be resumed.");
  }
  if (isRunning("verify")) {
    return tr(
        "The spindle, the path and the coolant stop; the compensation stays as it is switched. What was recorded is "
        "kept and the run can be resumed.");
  }
  const auto* compensator = qobject_cast<const CompensatorPresenter*>(presenter(QStringLiteral("compensator")));
  if (compensator != nullptr && compensator->running()) {
    return tr("The offset runs to 0 and the compensation is switched as it was before.");
  }
  return tr("It is broken off; what the job holds already is kept.");
}

bool Application::mayEnd(const QString& question, const QString& deed) {
  const auto& tasks = m_bench->tasks();
  return !tasks.running() || ask(m_window.get(), question,
                                 ui::sentencesText({tr("%1 is running.").arg(tasks.name()), whatEndingDoes()}), deed);
}

void Application::endWork(const QString& question, const QString& deed, const std::function<void()>& then) {
  if (!mayEnd(question, deed)) return;
  auto& tasks = m_bench->tasks();
  if (!tasks.running()) return then();  // also when it ended while the question stood
  connect(&tasks, &TaskRunner::finished, this, then,
          static_cast<Qt::ConnectionType>(Qt::QueuedConnection | Qt::SingleShotConnection));
  tasks.cancel();
}

void Application::mayClose(bool* allowed) {
  *allowed = mayEnd(tr("Close Zerodrift?"), tr("Close"));
  if (!*allowed) return;
  QSettings settings;
  settings.setValue(QStringLiteral("window/geometry"), m_window->saveGeometry());
  settings.setValue(QStringLiteral("window/log"), m_window->isLogVisible());
}

}  // namespace zerodrift::desktop
