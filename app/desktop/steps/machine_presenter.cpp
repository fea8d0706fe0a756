#include "app/desktop/steps/machine_presenter.h"

#include <QDateTime>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>
#include <cmath>

#include "app/desktop/moment.h"
#include "app/text/error_text.h"
#include "core/acquisition/machine_fault.h"
#include "core/base/resources.h"
#include "core/flow/devices.h"
#include "core/flow/steps/machine_step.h"
#include "ui/pages/machine_page.h"

namespace zerodrift::desktop {
namespace {

constexpr std::size_t readings_kept = 30;
constexpr int jobs_remembered = 8;
constexpr qint64 old_after_ms = 5000;  // live, the machine is looked at every second
constexpr double course_s = 900.0;     // of the machine: how far back the change of temperatures is looked at
constexpr std::size_t course_most = 900;

}  // namespace

MachinePresenter::MachinePresenter(Workbench& bench, ui::MachinePage* page, DemoMachine& demo)
    : Presenter(bench, page),
      m_page(page),
      m_demo(demo),
      m_map(new MapEditor(bench, page)),
      m_rig(new RigEditor(bench, page)) {
  connect(m_map, &MapEditor::draftChanged, this, &MachinePresenter::refresh);
  connect(m_map, &MapEditor::refused, this, [this](const Error& error) { show(error); });
  connect(m_rig, &RigEditor::stateChanged, this, &MachinePresenter::refresh);
  connect(m_rig, &RigEditor::refused, this, [this](const Error& error) { show(error); });
  connect(m_rig, &RigEditor::taken, this, [this] { m_page->clearProblem(); });
  connect(page, &ui::MachinePage::newJobRequested, this, &MachinePresenter::chooseNewJob);
  connect(page, &ui::MachinePage::openJobRequested, this, [this](const QString& path) {
    if (path.isEmpty()) {
      chooseJob();
    } else {
      openJob(path);
    }
  });
  connect(page, &ui::MachinePage::virtualMachineRequested, this, [this] { useAnyVirtualMachine(); });
  connect(page, &ui::MachinePage::sampleRequested, this, &MachinePresenter::sampleWanted);
  connect(page, &ui::MachinePage::ownRecordingRequested, this, &MachinePresenter::ownRecordingWanted);
  connect(page, &ui::Page::emptyActionTriggered, this, [this] {
    // Only a page that is not needed has a button in its middle.
    unlessBusy(this->bench().setKind(commissioning::JobKind::machine));
  });
  connect(page, &ui::MachinePage::profileImportRequested, this, &MachinePresenter::importProfile);
  connect(page, &ui::Page::primaryTriggered, this, &MachinePresenter::primary);
  connect(page, &ui::Page::secondaryTriggered, this, [this](const QString& action) {
    if (action == QStringLiteral("import")) importProfile();
    if (action == QStringLiteral("job")) {
      Q_EMIT endWorkWanted(tr("Leave this job?"), tr("End it and leave"),
                           [this] { unlessBusy(this->bench().closeJob()); });
    }
    if (action == QStringLiteral("test")) this->bench().connectMachine();
    if (action == QStringLiteral("disconnect")) {
      Q_EMIT endWorkWanted(tr("Disconnect from the machine?"), tr("End it and disconnect"),
                           [this] { unlessBusy(this->bench().disconnectMachine()); });
    }
    if (action == QStringLiteral("virtual")) startVirtual();
    if (action == QStringLiteral("connect")) connectNow();
    if (action == QStringLiteral("start")) commissionAnew();
    if (action.startsWith(QStringLiteral("setup"))) setUp(action);
  });
  connect(&bench, &Workbench::machineSeen, this, &MachinePresenter::looked);
  connect(&bench, &Workbench::machineLost, this, [this](const Error& error) {
    m_connecting = false;
    m_readings.clear();
    m_course.clear();
    // It is tried every second; the banner and the log say it once.
    if (m_lostSaid != error.code) showOnly(error);
    m_lostSaid = error.code;
    refresh();
    // Asking again helps against a silent controller, not against a file that is not there.
    if (m_whenReady && !acquisition::may_pass(error)) std::exchange(m_whenReady, nullptr)(false);
  });
  connect(&bench, &Workbench::controllerTold, this, [this] {
    if (m_toldLost == this->bench().lost()) return;
    m_toldLost = this->bench().lost();
    refresh();
  });
  connect(&bench, &Workbench::profileChanged, this, &MachinePresenter::refresh);
  connect(&m_demo, &DemoMachine::ready, this, [this] { whenIdle([this] { useReadyMachine(); }); });
  connect(&m_demo, &DemoMachine::failed, this, [this](const QString& why) {
    m_connecting = false;
    tell([why] {
      return ui::Problem{ui::ProblemKind::failure,
                         tr("The virtual machine could not be started: %1.").arg(why),
                         tr("Check that zerodrift-machine stands beside this program."),
                         {}};
    });
  });
}

void MachinePresenter::setUp(const QString& action) {
  if (action == QStringLiteral("setup-open")) return m_rig->chooseOpen();
  if (action == QStringLiteral("setup-save-as")) return m_rig->chooseSave(true);
  if (action == QStringLiteral("setup-leave")) return m_rig->leave();
  // Its devices may serve one program at a time.
  Q_EMIT endWorkWanted(tr("Disconnect from the machine?"), tr("End it and disconnect"), [this] {
    if (const Status done = bench().disconnectMachine(); !done) return show(done.error());
    m_page->clearProblem();
    m_rig->begin();
  });
}

void MachinePresenter::unlessBusy(const Status& done) {
  if (!done) show(done.error());
}

void MachinePresenter::useReadyMachine() {
  if (const Status loaded = bench().loadProfile(m_demo.profilePath().toStdString()); !loaded) {
    m_connecting = false;
    refresh();
    show(loaded.error());
    if (m_whenReady) std::exchange(m_whenReady, nullptr)(false);
    return;
  }
  m_connecting = true;
  bench().connectMachine();
  refresh();
}

QString MachinePresenter::jobsFolder() {
  const QString documents = QStandardPaths::writableLocation(QStandardPaths::DocumentsLocation);
  QString folder = (documents.isEmpty() ? QDir::homePath() : documents) + QStringLiteral("/Zerodrift");
  QDir().mkpath(folder);
  return folder;
}

void MachinePresenter::useVirtualMachine(const DemoOptions& options) {
  if (const Status idle = bench().idle(); !idle) return show(idle.error());  // it may be using the one that runs
  if (bench().job() == nullptr) {
    newJob(jobsFolder() + QStringLiteral("/virtual-") +
           QDateTime::currentDateTime().toString(QStringLiteral("yyyyMMdd-HHmmss")) + QStringLiteral(".zdj"));
  }
  m_connecting = true;
  if (m_demo.running() && m_demo.options().seed == options.seed) {
    useReadyMachine();
  } else if (!m_demo.starting() || m_demo.options().seed != options.seed) {
    m_demo.start(options);
  }
  refresh();
}

void MachinePresenter::useAnyVirtualMachine() {
  const bool there = m_demo.running() || m_demo.starting();
  useVirtualMachine(there ? m_demo.options() : DemoOptions());
}

void MachinePresenter::newJob(const QString& path) {
  if (const Status made = bench().createJob(path.toStdString()); !made) {
    show(made.error());
    return;
  }
  m_page->clearProblem();
  remember(path);
}

void MachinePresenter::openJob(const QString& path) {
  if (const Status opened = bench().openJob(path.toStdString()); !opened) {
    show(opened.error());
    return;
  }
  m_page->clearProblem();
  remember(path);
}

void MachinePresenter::chooseNewJob() {
  const QString proposal = jobsFolder() + QStringLiteral("/") +
                           QDateTime::currentDateTime().toString(QStringLiteral("yyyy-MM-dd")) + QStringLiteral(".zdj");
  QString path = QFileDialog::getSaveFileName(m_page, tr("New job"), proposal, tr("Zerodrift jobs (*.zdj)"));
  if (path.isEmpty()) return;
  if (!path.endsWith(QStringLiteral(".zdj"))) path += QStringLiteral(".zdj");
  newJob(path);
}

void MachinePresenter::chooseJob() {
  const QString path = QFileDialog::getOpenFileName(m_page, tr("Open job"), jobsFolder(), tr("Zerodrift jobs (*.zdj)"));
  if (!path.isEmpty()) openJob(path);
}

void MachinePresenter::importProfile() {
  const QString path =
      QFileDialog::getOpenFileName(m_page, tr("Connection profile"), bench().folder(), tr("Profiles (*.json)"));
  if (path.isEmpty()) return;
  if (const Status loaded = bench().loadProfile(path.toStdString()); !loaded) {
    show(loaded.error());
    return;
  }
  m_page->clearProblem();
  refresh();
}

QStringList MachinePresenter::recentJobs() {
  QStringList recent = QSettings().value(QStringLiteral("recentJobs")).toStringList();
  recent.removeIf([](const QString& path) { return !QFileInfo::exists(path); });
  return recent;
}

void MachinePresenter::remember(const QString& given) {
  const QString path = QFileInfo(given).absoluteFilePath();  // the folder may be another one next time
  QSettings settings;
  QStringList recent = settings.value(QStringLiteral("recentJobs")).toStringList();
  recent.removeAll(path);
  recent.prepend(path);
  settings.setValue(QStringLiteral("recentJobs"), QStringList(recent.mid(0, jobs_remembered)));
}

void MachinePresenter::connectNow() {
  m_connecting = true;
  m_page->clearProblem();
  bench().connectMachine();
  refresh();
}

void MachinePresenter::startVirtual() {
  DemoOptions options;
  options.seed = virtualSeed().value_or(options.seed);
  useVirtualMachine(options);
}

void MachinePresenter::primary() {
  if (m_rig->open()) return m_rig->chooseSave(false);
  if (!bench().connected() && m_page->startsVirtual()) return startVirtual();
  if (!bench().connected()) return connectNow();
  if (m_page->tableLost()) return Q_EMIT pageRequested(QStringLiteral("upload"));
  commissionAnew();
}

void MachinePresenter::commissionAnew() {
  startCommissioning([this](bool good) {
    if (good) Q_EMIT nextRequested();
  });
}

void MachinePresenter::startCommissioning(std::function<void(bool good)> done) {
  const auto profile = bench().profile();
  if (!profile) return;
  const auto document = bench().profileDocument();
  runStep(
      tr("Checking the machine"),
      [profile = *profile, document, questions = bench().questions()](
          commissioning::Job&, const TaskContext& context) -> Result<commissioning::NewArtefact> {
        ZD_TRY(auto devices,
               flow::Devices::open(profile, false, access::Permit::read_only(), questions->of(profile, context.stop)));
        return flow::check_machine(devices, document, context);
      },
      [this, done = std::move(done)](bool good) {
        if (good && bench().job() != nullptr && bench().look()) {
          auto header = bench().job()->header().value_or(commissioning::JobHeader{});
          if (header.machine.empty()) header.machine = bench().look()->identity.name;
          if (header.serial.empty()) header.serial = std::to_string(bench().look()->identity.serial);
          if (const Status named = bench().job()->set_header(header); !named) show(named.error());
          Q_EMIT bench().artefactsChanged();
        }
        if (done) done(good);
      });
}

void MachinePresenter::looked() {
  m_connecting = false;
  const auto& look = bench().look();
  if (!look) return;
  m_lookedAt = QDateTime::currentDateTime();
  if (std::exchange(m_lostSaid, std::nullopt)) m_page->clearProblem();
  if (!m_readings.empty() && m_readings.back().size() != look->sample.temperature_C.size()) {
    m_readings.clear();
    m_course.clear();
  }
  const double now_s = look->sample.machine_time_s;
  if (!m_course.empty() && now_s <= m_course.back().first) m_course.clear();  // another machine, or it began anew
  m_course.emplace_back(now_s, look->sample.temperature_C);
  // On a quick machine a few looks are hours: then as many as a slope needs.
  while (m_course.size() > course_most ||
         (m_course.size() > course_least && now_s - m_course.front().first > course_s)) {
    m_course.pop_front();
  }
  m_readings.push_back(look->sample.temperature_C);
  if (m_readings.size() > readings_kept) m_readings.pop_front();
  refresh();
  if (m_whenReady && m_readings.size() >= 4) std::exchange(m_whenReady, nullptr)(true);
}

/// Of the job's machine, when it is a virtual one on this computer.
std::optional<int> MachinePresenter::virtualSeed() const {
  const auto& workbench = bench();
  const auto& profile = workbench.profile();
  const auto& machine = workbench.body("machine");
  if (!profile || profile->manual || profile->controller.host != "127.0.0.1" || !machine.is_object())
    return std::nullopt;
  return virtual_seed_of(machine.value("identity", nlohmann::json::object()).value("serial", 0U));
}

QString MachinePresenter::connectionText() const {
  const auto& profile = bench().profile();
  if (!profile) return {};
  if (profile->manual) return tr("Manual control");
  const auto& link = profile->controller;
  if (link.kind == controller::LinkKind::rtu) {
    return tr("Modbus RTU %1, unit %2").arg(QString::fromStdString(link.device)).arg(link.unit);
  }
  return tr("Modbus TCP %1:%2, unit %3").arg(QString::fromStdString(link.host)).arg(link.port).arg(link.unit);
}

void MachinePresenter::refresh() {
  ui::MachineState state;
  state.jobOpen = bench().job() != nullptr;
  // A step that lost the controller asks again by itself; until it answers, what stands here is how it was.
  const bool lost = bench().lost() && bench().tasks().running();
  state.connected = bench().connected() && !bench().lost();
  state.connecting = m_connecting || lost;
  state.compensationOn = bench().compensationOn();
  if (const auto& upload = bench().body("upload"); upload.is_object())
    state.writtenVersion = upload.value("version", 0);
  const auto held = bench().heldTable();
  state.tableGone = held == HeldTable::none || held == HeldTable::another;
  state.sampleAvailable = find_resource("samples/sample.zdj").has_value();
  state.address = connectionText();
  state.virtualOffered = virtualSeed().has_value();
  const QStringList recent = recentJobs();
  for (const QString& path : recent) {
    const QFileInfo file(path);
    state.recent.append({path, file.completeBaseName(), momentText(file.lastModified())});
  }
  if (const auto& profile = bench().profile()) {
    const QString name = QString::fromStdString(profile->name);
    state.profiles = {name.isEmpty() ? QFileInfo(QString::fromStdString(profile->file)).completeBaseName() : name};
    state.profile = 0;
    state.manual = profile->manual;
    state.machineName = QString::fromStdString(profile->name);
  }
  if (bench().look()) {
    fillSensors(state);
    fillRest(state);
    if (lost) {
      state.keptFrom = momentText(m_lookedAt);
    } else {
      fillParts(state);
      fillDevices(state);
    }
  } else if (!m_connecting) {
    fillKept(state);
  }
  m_map->fill(state);
  state.settingUp = m_rig->open();
  state.setupValid = m_rig->valid();
  m_page->setState(state);
  sayWhenOld();
}

void MachinePresenter::sayWhenOld() {
  const bool old = m_lookedAt.isValid() && bench().tasks().running() &&
                   m_lookedAt.msecsTo(QDateTime::currentDateTime()) > old_after_ms;
  if (old == m_saidOld) return;
  m_saidOld = old;
  if (!old) return m_page->clearProblem();
  if (bench().lost()) return;  // said by the state
  tell([at = m_lookedAt] {
    return ui::Problem{ui::ProblemKind::note,
                       tr("Something runs on the machine: what stands here was seen at %1.")
                           .arg(at.toString(QStringLiteral("HH:mm:ss"))),
                       tr("The page of the run shows it live."),
                       {}};
  });
}

void MachinePresenter::tour(std::function<void(bool good)> done) {
  const auto start = [this, done = std::move(done)](bool good) { good ? startCommissioning(done) : done(false); };
  if (m_readings.size() >= 4) {
    start(true);
  } else {
    m_whenReady = start;
  }
}

}  // namespace zerodrift::desktop
