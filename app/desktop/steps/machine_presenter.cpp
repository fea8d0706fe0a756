#include "app/desktop/steps/machine_presenter.h"

#include <QDateTime>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>
#include <QStandardPaths>
#include <cmath>
#include <limits>

#include "app/desktop/moment.h"
#include "app/text/core_text.h"
#include "app/text/error_text.h"
#include "core/acquisition/machine_fault.h"
#include "core/base/resources.h"
#include "core/flow/devices.h"
#include "core/flow/steps/machine_step.h"
#include "ui/pages/machine_page.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t readings_kept = 30;
constexpr int jobs_remembered = 8;
constexpr qint64 old_after_ms = 5000;    // live, the machine is looked at every second
constexpr double course_s = 900.0;       // of the machine: how far back the change of temperatures is looked at
constexpr double spread_s = 60.0;        // of the machine: the readings whose means tell the spread of now
constexpr std::size_t spread_least = 3;  // on a quick machine they are minutes apart
constexpr double course_least_s = 180.0;
constexpr std::size_t course_least = 20;
constexpr std::size_t course_most = 900;

double noise_of(const std::deque<std::vector<double>>& readings, std::size_t sensor) {
  // From differences of neighbours, so that a slow drift is no noise.
  double squares = 0.0;
  int count = 0;
  for (std::size_t i = 1; i < readings.size(); ++i) {
    const double step = readings[i][sensor] - readings[i - 1][sensor];
    if (std::isnan(step)) continue;
    squares += step * step;
    ++count;
  }
  return count < 3 ? unknown : std::sqrt(squares / (2.0 * count));
}

/// Kelvin an hour by least squares over the course; NaN while it is too short, or while the sensor was silent.
double slope_K_h(const std::deque<std::pair<double, std::vector<double>>>& course, std::size_t sensor) {
  if (course.size() < course_least || course.back().first - course.front().first < course_least_s) return unknown;
  double mean_t = 0.0;
  double mean_T = 0.0;
  const auto n = static_cast<double>(course.size());
  for (const auto& [time_s, values] : course) {
    mean_t += time_s / n;
    mean_T += values[sensor] / n;
  }
  double tt = 0.0;
  double tT = 0.0;
  for (const auto& [time_s, values] : course) {
    tt += (time_s - mean_t) * (time_s - mean_t);
    tT += (time_s - mean_t) * (values[sensor] - mean_T);
  }
  return 3600.0 * tT / tt;
}

double median_of(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return std::isnan(v); }), values.end());
  if (values.empty()) return unknown;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

QString tag_of(const MachineLook& look, std::size_t sensor) {
  const auto& sensors = look.identity.sensors;
  const QString id = sensor < sensors.size() ? QString::fromStdString(sensors[sensor].channel)
                                             : QStringLiteral("T%1_C").arg(sensor + 1);
  return QString(id).remove(QStringLiteral("_C"));
}

}  // namespace

MachinePresenter::MachinePresenter(Workbench& bench, ui::MachinePage* page, DemoMachine& demo)
    : Presenter(bench, page), m_page(page), m_demo(demo), m_map(new MapEditor(bench, page)) {
  connect(m_map, &MapEditor::draftChanged, this, &MachinePresenter::refresh);
  connect(m_map, &MapEditor::refused, this, [this](const Error& error) { show(error); });
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
    state.profiles = {QString::fromStdString(profile->name)};
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

void MachinePresenter::fillSensors(ui::MachineState& state) {
  const auto& look = *bench().look();
  const auto& sensors = look.identity.sensors;
  const QDateTime now = QDateTime::currentDateTime();
  for (std::size_t i = 0; i < look.sample.temperature_C.size(); ++i) {
    ui::SensorHealth health;
    const bool known = i < sensors.size();
    health.tag = tag_of(look, i);
    health.id = health.tag + QStringLiteral("_C");
    health.label = known ? coreText(sensors[i].label) : QString();
    health.place = known ? QString::fromStdString(sensors[i].place) : QString();
    health.value_C = look.sample.temperature_C[i];
    health.noise_K = noise_of(m_readings, i);
    const bool dead = std::isnan(health.value_C);
    if (!dead) m_alive[health.id] = m_lookedAt.isValid() ? m_lookedAt : now;
    if (m_alive.contains(health.id)) health.age_s = 1e-3 * static_cast<double>(m_alive[health.id].msecsTo(now));
    const bool stuck = !dead && m_readings.size() >= 20 && health.noise_K == 0.0;
    health.judgement = dead ? ui::Judgement::bad : stuck ? ui::Judgement::warn : ui::Judgement::ok;
    health.state = dead ? tr("No signal") : stuck ? tr("Stuck") : tr("OK");
    state.sensors.append(health);
  }
  state.roundTrip_ms = look.round_trip_ms;
  state.clockDifference_s = std::round(10.0 * look.clock_difference_s) / 10.0 + 0.0;  // no "-0.0"
}

void MachinePresenter::fillRest(ui::MachineState& state) const {
  const auto& look = *bench().look();
  const auto& now_C = look.sample.temperature_C;
  const double middle_C = median_of(now_C);
  ui::RestState& rest = state.rest;
  for (std::size_t i = 0; i < now_C.size(); ++i) {
    if (std::isnan(now_C[i])) continue;
    const double apart_K = now_C[i] - middle_C;
    if (std::isnan(rest.apart_K) || std::abs(apart_K) > std::abs(rest.apart_K)) {
      rest.apart_K = apart_K;
      rest.warmest = tag_of(look, i);
    }
    const double slope = slope_K_h(m_course, i);
    if (std::isnan(slope)) continue;
    if (std::isnan(rest.change_K_h) || std::abs(slope) > std::abs(rest.change_K_h)) {
      rest.change_K_h = slope;
      rest.quickest = tag_of(look, i);
    }
  }
  std::vector<std::vector<double>> by_sensor(now_C.size());
  for (std::size_t k = 0; k < m_course.size(); ++k) {
    if (m_course.back().first - m_course[k].first > spread_s && m_course.size() - k > spread_least) continue;
    for (std::size_t i = 0; i < now_C.size(); ++i) by_sensor[i].push_back(m_course[k].second[i]);
  }
  if (!m_course.empty()) rest.now_K = acquisition::spread_of(acquisition::judged(look.identity.sensors, by_sensor));
  rest.spread_K = rest.now_K;
  const auto& begun = bench().body("machine");  // what the job and its report say of the start
  if (begun.is_object() && begun.value("spread_K", nlohmann::json()).is_number()) {
    rest.spread_K = begun["spread_K"].get<double>();
    rest.atStart = true;
  }
}

void MachinePresenter::fillParts(ui::MachineState& state) const {
  const auto& look = *bench().look();
  const auto& sample = look.sample;
  for (const auto& [axis, position] : sample.axes) {
    const bool turns = axis == "A" || axis == "B" || axis == "C";
    state.parts.append({QString::fromStdString(axis), tr("%1 axis").arg(QString::fromStdString(axis)),
                        QStringLiteral("%1 %2")
                            .arg(ui::fixedText(position, 3))
                            .arg(turns ? QStringLiteral("°") : QStringLiteral("mm")),
                        sample.referenced ? ui::Judgement::ok : ui::Judgement::warn});
  }
  if (!std::isnan(sample.spindle_rpm)) {
    state.parts.append(
        {QStringLiteral("spindle"), tr("Spindle"), tr("%1 rpm").arg(sample.spindle_rpm, 0, 'f', 0), ui::Judgement::ok});
  }
  state.parts.append({QStringLiteral("switch"), tr("Compensation"), sample.compensation_on ? tr("ON") : tr("OFF"),
                      sample.compensation_on ? ui::Judgement::warn : ui::Judgement::ok});
}

void MachinePresenter::fillDevices(ui::MachineState& state) const {
  for (const controller::DeviceState& device : bench().look()->devices) {
    ui::DeviceHealth health;
    health.id = QString::fromStdString(device.id);
    health.missed = device.faults;
    health.rounds = device.rounds + device.faults;
    health.judgement = device.fault ? ui::Judgement::bad : device.rounds > 0 ? ui::Judgement::ok : ui::Judgement::none;
    if (device.age_s) health.age_s = *device.age_s;
    if (device.rounds > 0 && !device.fault) health.roundTrip_ms = 1000.0 * device.round_trip_s;
    if (device.fault) {
      const ErrorText text = textOf(*device.fault, Reader::window);
      health.state = text.sentence;
      health.remedy = text.remedy;
    } else {
      QStringList remarks;
      for (const auto& remark : device.remarks) remarks << coreText(remark);
      health.state = remarks.join(QStringLiteral("; "));
    }
    state.devices.append(health);
  }
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
