#include "app/desktop/workbench.h"

#include <QDir>
#include <QFileInfo>
#include <QRegularExpression>
#include <algorithm>

#include "app/text/core_text.h"
#include "app/text/error_text.h"
#include "core/base/json.h"
#include "core/base/redact.h"
#include "core/flow/devices.h"
#include "core/flow/flow.h"

namespace zerodrift::desktop {

Workbench::Workbench(QObject* parent)
    : QObject(parent), m_access(std::make_unique<access::Access>(access::access_file())) {
  connect(&m_monitor, &MachineMonitor::looked, this, [this](const std::shared_ptr<const MachineLook>& look) {
    const QString name = QString::fromStdString(look->identity.name);
    if (m_attempts > 1) {
      log(LogKind::good, tr("Connected to %1 again, after %n attempt(s) that failed", nullptr, m_attempts).arg(name));
    } else if (!m_look || m_lost) {
      log(LogKind::good, tr("Connected to %1").arg(name));
    }
    const HeldTable held = heldTable();
    m_look = look;
    m_lost = false;
    m_seenAt = QDateTime::currentDateTime();
    m_lastProblem.reset();
    m_attempts = 0;
    Q_EMIT machineSeen();
    noteMachineState();
    if (heldTable() != held) Q_EMIT heldTableChanged();
  });
  connect(&m_monitor, &MachineMonitor::failed, this, [this](const Error& error) {
    m_lost = m_lost || m_look != nullptr;
    m_look.reset();
    // It is tried every second: the same trouble is told once, and counted when it is over.
    if (m_lastProblem != error.code) {
      log(LogKind::bad, lineOf(error, Reader::window));
      m_attempts = 0;
    }
    m_lastProblem = error.code;
    ++m_attempts;
    Q_EMIT machineLost(error);
    noteMachineState();
  });
  connect(&m_tasks, &TaskRunner::started, this, [this](const QString& name) {
    m_monitor.pause(true);
    log(LogKind::note, name);
  });
  // A task may start the next one before it has told its end.
  connect(&m_tasks, &TaskRunner::finished, this, [this] { m_monitor.pause(m_tasks.running()); });
}

Workbench::~Workbench() {
  m_monitor.stop();
}

void Workbench::dropCameras() {
  for (auto& camera : m_cameras) m_ending.drop(std::move(camera));
  m_cameras.clear();
}

void Workbench::useAccess(std::unique_ptr<access::Access> access) {
  m_access = std::move(access);
  Q_EMIT accessChanged();
}

std::shared_ptr<const QString> Workbench::beginWork(const QString& name) {
  auto work = std::make_shared<const QString>(name);
  std::erase_if(m_work, [](const auto& one) { return one.expired(); });
  m_work.push_back(work);
  return work;
}

Status Workbench::idle() const {
  QString name = m_tasks.running() ? m_tasks.name() : QString();
  for (const auto& work : m_work) {
    if (const auto running = work.lock()) name = *running;
  }
  if (name.isEmpty()) return {};
  return fail(ErrorCode::machine_busy, {{"what", tr("%1 is still running").arg(name).toStdString()}});
}

void Workbench::leaveJob() {
  forgetRead();
  m_damage.reset();
  if (!m_job) return;
  m_job.reset();
  Q_EMIT jobLeft();
}

void Workbench::useJob(commissioning::Job job) {
  leaveJob();
  m_job = std::make_shared<commissioning::Job>(std::move(job));
  log(LogKind::note, tr("Job %1").arg(QString::fromStdString(m_job->path().string())));
  // A job of another machine takes neither the connection nor its profile over.
  const auto tested = body("machine");
  const auto serial = tested.is_object() ? tested.value("identity", nlohmann::json::object()).value("serial", 0U) : 0U;
  if (connected() && serial != 0 && m_look && m_look->identity.serial != serial) {
    log(LogKind::warning, tr("Disconnected: this job is of another machine (serial %1).").arg(serial));
    const unsigned from = m_look->identity.serial;
    static_cast<void>(disconnectMachine());  // nothing runs, or the job would not be changed
    m_profile.reset();
    Q_EMIT disconnectedFor(from, serial);
  }
  // A job brings its machine: the profile it was made with.
  if (const auto machine = body("machine"); machine.is_object() && machine.contains("profile") && !m_profile) {
    if (auto profile = controller::profile_from_job(machine["profile"])) {
      const bool incomplete = std::any_of(profile->cameras.begin(), profile->cameras.end(),
                                          [](const auto& camera) { return lacks_secret(camera.url); });
      if (incomplete) {
        log(LogKind::warning, tr("A job keeps no password: load the connection profile for the cameras."));
      }
      m_profileDocument = machine["profile"];
      m_profile = std::move(*profile);
      m_reached = false;
      dropCameras();
      Q_EMIT profileChanged();
    } else {
      log(LogKind::warning, lineOf(profile.error(), Reader::window));
    }
  }
  Q_EMIT jobChanged();
}

void Workbench::forgetRead() {
  m_bodies.clear();
  m_warmupRun = {};
  m_warmupSeries = 0;
}

Status Workbench::createJob(const std::filesystem::path& path) {
  ZD_CHECK(idle());
  ZD_TRY(auto job, commissioning::Job::create(path));
  useJob(std::move(job));
  return {};
}

Status Workbench::openJob(const std::filesystem::path& path) {
  ZD_CHECK(idle());
  ZD_TRY(auto job, commissioning::Job::open(path));
  useJob(std::move(job));
  checkWhole();
  return {};
}

void Workbench::checkWhole() {
  m_checks.emplace_back([this, path = m_job->path()] {
    const auto job = commissioning::Job::open_read_only(path);
    if (!job) return;
    const auto checked = job->check();
    if (checked && checked->ok()) return;
    const Error problem = checked ? checked->problems.front() : checked.error();
    QMetaObject::invokeMethod(
        this,
        [this, path, problem] {
          if (!m_job || m_job->path() != path) return;
          m_damage = problem;
          Q_EMIT jobDamaged(problem);
        },
        Qt::QueuedConnection);
  });
}

Status Workbench::closeJob() {
  ZD_CHECK(idle());
  leaveJob();
  Q_EMIT jobChanged();
  return {};
}

QString Workbench::folder() const {
  if (!m_job) return QDir::homePath();
  return QFileInfo(QString::fromStdString(m_job->path().string())).absolutePath();
}

commissioning::JobKind Workbench::kind() const {
  if (!m_job) return commissioning::JobKind::machine;
  return commissioning::kind_of(*m_job).value_or(commissioning::JobKind::machine);
}

Status Workbench::setKind(commissioning::JobKind kind) {
  ZD_CHECK(idle());
  if (!m_job) return fail(ErrorCode::step_blocked, {{"step", "machine"}, {"needs", "a job"}});
  ZD_CHECK(commissioning::set_kind(*m_job, kind));
  Q_EMIT artefactsChanged();
  return {};
}

Result<commissioning::Artefact> Workbench::takeIn(const std::string& step, const flow::StepRun& run) {
  if (!m_job) return fail(ErrorCode::step_blocked, {{"step", step}, {"needs", "a job"}});
  ZD_TRY(auto made, flow::Flow().take_in(*m_job, step, run, {}));
  announce(made);
  return made;
}

void Workbench::announce(const commissioning::Artefact& made) {
  log(LogKind::good, tr("Kept %1 #%2").arg(stepName(made.kind)).arg(made.id));
  if (made.kind == "upload" && m_look) {  // what was seen before is no longer so
    auto look = std::make_shared<MachineLook>(*m_look);
    look->table.reset();
    m_look = look;
  }
  Q_EMIT artefactsChanged();
}

Status Workbench::setHeader(const commissioning::JobHeader& header) {
  if (!m_job) return fail(ErrorCode::step_blocked, {{"step", "report"}, {"needs", "a job"}});
  ZD_CHECK(m_job->set_header(header));
  Q_EMIT artefactsChanged();
  return {};
}

bool Workbench::has(const std::string& kind) const {
  if (!m_job) return false;
  const auto latest = m_job->latest(kind);
  return latest && latest->has_value();
}

const nlohmann::json& Workbench::body(const std::string& kind) const {
  static const nlohmann::json none;
  if (!m_job) return none;
  const auto latest = m_job->latest(kind);
  if (!latest || !*latest) return none;
  Body& kept = m_bodies[kind];
  if (kept.of != (*latest)->id) kept = {(*latest)->id, (*latest)->document().value_or(nlohmann::json())};
  return kept.document;
}

const recording::Recording& Workbench::warmupRun() const {
  const nlohmann::json& warmup = body("warmup");
  const long long series = warmup.is_object() ? warmup.value("series", 0LL) : 0;
  if (series != m_warmupSeries) {
    m_warmupRun = series > 0 ? m_job->read_series(series).value_or(recording::Recording{}) : recording::Recording{};
    m_warmupSeries = series;
  }
  return m_warmupRun;
}

Status Workbench::loadProfile(const std::filesystem::path& path) {
  ZD_CHECK(idle());
  std::vector<std::string> warnings;
  ZD_TRY(auto profile, controller::read_profile(path, &warnings));
  ZD_TRY(m_profileDocument, read_json_file(path));
  for (const auto& warning : warnings) log(LogKind::warning, inWords(warning));
  m_profile = std::move(profile);
  dropCameras();
  m_reached = false;
  m_look.reset();
  m_lost = false;
  Q_EMIT profileChanged();
  noteMachineState();
  return {};
}

Status Workbench::setRegisterMap(const std::filesystem::path& path) {
  ZD_CHECK(idle());
  if (!m_profile) return fail(ErrorCode::step_blocked, {{"step", "machine"}, {"needs", "a connection profile"}});
  auto document = m_profileDocument;
  document["controller"]["register_map"] = path.string();
  document["controller"].erase("register_map_document");
  ZD_TRY(auto profile, controller::profile_from_json(document, m_profile->file));
  m_profile = std::move(profile);
  m_profileDocument = std::move(document);
  const bool connect_again = connected();
  m_look.reset();
  Q_EMIT profileChanged();
  if (connect_again) connectMachine();
  return {};
}

void Workbench::connectMachine() {
  if (!m_profile) return;
  m_reached = true;
  m_questions->forget();
  m_monitor.start(*m_profile, m_questions);
}

Status Workbench::disconnectMachine() {
  ZD_CHECK(idle());
  m_monitor.stop();
  m_reached = false;
  m_look.reset();
  dropCameras();
  m_lost = false;
  m_lastProblem.reset();
  m_attempts = 0;
  Q_EMIT profileChanged();
  noteMachineState();
  return {};
}

HeldTable Workbench::heldTable() const {
  if (!m_look || m_lost || !m_look->table) return HeldTable::unknown;
  if (controller::is_empty_table(static_cast<std::size_t>(m_look->table->registers))) return HeldTable::none;
  const auto& upload = body("upload");
  if (!upload.is_object()) return HeldTable::another;
  const auto words = upload.at("record").value("new_words", std::vector<std::uint16_t>{});
  return controller::is_marked(*m_look->table, words) ? HeldTable::own : HeldTable::another;
}

const std::vector<std::shared_ptr<vision::Camera>>& Workbench::cameras() {
  if (m_cameras.empty() && m_reached && m_profile && m_profile->error_source == controller::ErrorSourceKind::camera) {
    for (const auto& camera : m_profile->cameras) m_cameras.push_back(flow::open_camera(camera));
  }
  return m_cameras;
}

report::Labels Workbench::labels() const {
  report::Labels labels;
  if (m_profile) {
    for (const auto& sensor : m_profile->sensors) labels[sensor.channel] = coreText(sensor.label).toStdString();
  }
  if (const auto& warmup = body("warmup"); warmup.is_object()) {
    report::add_imported(labels, warmup.value("import", nlohmann::json()));
  }
  return labels;
}

QString Workbench::inWords(const std::string& text) const {
  const QString said = coreText(text);
  const QString room = QStringLiteral("Room");
  const report::Labels known = labels();
  if (coreText(room) == room) return QString::fromStdString(report::readable(text, known));
  static const QRegularExpression channels(QStringLiteral(
      "(?<![A-Za-z0-9_])([A-Za-z]\\w*_(?:C|um|urad)|spindle_rpm|coolant_on|spindle_load_W)(?![A-Za-z0-9_])"));
  // The sentences leave a space beside a channel, as beside any word of another script; between Chinese ones is none.
  const auto chinese = [](const QString& of, qsizetype at) {
    return at >= 0 && at < of.size() && of[at].script() == QChar::Script_Han;
  };
  QString words;
  qsizetype from = 0;
  for (auto at = channels.globalMatch(said); at.hasNext();) {
    const auto found = at.next();
    if (!report::is_channel(found.captured().toStdString(), known)) continue;
    const QString channel = channelInWords(found.captured().toStdString());
    words += said.mid(from, found.capturedStart() - from);
    if (words.endsWith(QLatin1Char(' ')) && chinese(words, words.size() - 2) && chinese(channel, 0)) words.chop(1);
    words += channel;
    from = found.capturedEnd();
    if (from < said.size() && said[from] == QLatin1Char(' ') && chinese(said, from + 1) &&
        chinese(channel, channel.size() - 1)) {
      ++from;
    }
  }
  return words + said.mid(from);
}

QString Workbench::channelInWords(const std::string& channel) const {
  return coreText(report::channel_in_words(channel, labels()));
}

QString Workbench::tagOf(const std::string& channel) const {
  return coreText(report::tag_of(channel, labels()));
}

QString Workbench::labelOf(const std::string& channel) const {
  const auto names = labels();
  const auto at = names.find(channel);
  return at == names.end() ? QString() : coreText(at->second);
}

void Workbench::tellController(bool answers, std::optional<bool> switch_on) {
  if (!answers && !m_lost) log(LogKind::bad, tr("The controller does not answer"));
  if (answers && m_lost) log(LogKind::good, tr("The controller answers again"));
  m_lost = !answers;
  if (answers) {
    m_seenAt = QDateTime::currentDateTime();
    if (switch_on) {
      auto look = m_look ? std::make_shared<MachineLook>(*m_look) : std::make_shared<MachineLook>();
      look->sample.compensation_on = *switch_on;
      m_look = look;
    }
  }
  Q_EMIT controllerTold();
  noteMachineState();
}

void Workbench::noteMachineState() {
  const auto before = std::exchange(m_machineState, std::tuple(connected(), lost(), compensationOn()));
  if (m_machineState != before) Q_EMIT machineStateChanged();
}

void Workbench::log(LogKind kind, const QString& text) {
  Q_EMIT logged(QDateTime::currentDateTime(), kind, QString::fromStdString(without_secrets(text.toStdString())));
}

}  // namespace zerodrift::desktop
