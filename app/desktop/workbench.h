#pragma once
// What the presenters share: the open job, the profile, the machine as last seen, the one running task, and the log.
// Everything that changes says so by a signal; presenters read again from here and from the job.

#include <QDateTime>
#include <QObject>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <thread>
#include <tuple>
#include <vector>

#include "app/desktop/machine_monitor.h"
#include "app/tasks/task_runner.h"
#include "core/access/access.h"
#include "core/commissioning/job_kind.h"
#include "core/controller/profile.h"
#include "core/flow/step.h"
#include "core/recording/recording.h"
#include "core/report/wording.h"
#include "core/vision/camera.h"

namespace zerodrift::desktop {

/// What a machine holds beside what the job has written into it last.
enum class HeldTable {
  unknown,  // no machine, or it cannot tell
  own,
  none,  // nothing is compensated; or what the job wrote was empty, too
  another,
};

enum class LogKind {
  note,
  good,
  warning,
  bad,
};

class Workbench : public QObject {
  Q_OBJECT

 public:
  explicit Workbench(QObject* parent = nullptr);
  ~Workbench() override;

  /// Who may write to machines from here.
  access::Access& access() { return *m_access; }
  void useAccess(std::unique_ptr<access::Access> access);

  // The job. Whoever works on it holds it; while work runs it is neither closed nor changed (machine_busy).
  Status createJob(const std::filesystem::path& path);
  Status openJob(const std::filesystem::path& path);
  Status closeJob();
  /// What the check of the whole file has found since it was opened; the job works on with what can be read.
  const std::optional<Error>& damage() const { return m_damage; }
  /// Of the open job; with a machine where none is open.
  commissioning::JobKind kind() const;
  /// Says how the open job comes to its data, and tells everybody.
  Status setKind(commissioning::JobKind kind);
  /// Null: none is open. Work beside the window takes the pointer with it, never the address.
  const std::shared_ptr<commissioning::Job>& job() { return m_job; }
  std::shared_ptr<const commissioning::Job> job() const { return m_job; }
  /// Where a file is looked for and saved first: beside the job, else at home.
  QString folder() const;
  /// Does a step that is quick and does not come from what the job holds (Flow::take_in), and tells everybody.
  Result<commissioning::Artefact> takeIn(const std::string& step, const flow::StepRun& run);
  /// Tells everybody what a step has made.
  void announce(const commissioning::Artefact& made);
  /// Customer, machine, engineer: what the report's head says.
  Status setHeader(const commissioning::JobHeader& header);
  bool has(const std::string& kind) const;
  /// Body of the latest artefact of this kind, until another one is kept; null when there is none.
  const nlohmann::json& body(const std::string& kind) const;
  /// The warm-up run, until another one is kept; without rows when there is none.
  const recording::Recording& warmupRun() const;

  // The machine
  Status loadProfile(const std::filesystem::path& path);
  const std::optional<controller::Profile>& profile() const { return m_profile; }
  const nlohmann::json& profileDocument() const { return m_profileDocument; }
  /// Another register map for this profile, from now on and in what the job keeps; a connection is made anew.
  Status setRegisterMap(const std::filesystem::path& path);
  /// Every register of this map is read with each look at the machine; null: none.
  void watchRegisters(std::shared_ptr<const controller::RegisterMap> map) { m_monitor.watch(std::move(map)); }
  /// Between two pieces of work the machine's clock goes so fast; nothing: as its profile says.
  void setPaceAtRest(std::optional<double> pace) { m_monitor.setPace(pace); }
  void connectMachine();
  /// The person at a manual control; a step asks by it (flow::Devices::open).
  const std::shared_ptr<OperatorQuestions>& questions() const { return m_questions; }
  /// machine_busy while work runs: it may use the machine.
  Status disconnectMachine();
  bool connected() const { return m_look != nullptr; }
  /// It was there and does not answer any more: what is known of it is how it stood, not how it is.
  bool lost() const { return m_lost; }
  /// When it answered last; not valid: never.
  const QDateTime& seenAt() const { return m_seenAt; }
  const std::shared_ptr<const MachineLook>& look() const { return m_look; }
  /// As the machine stood when it was last looked at, since the job wrote.
  HeldTable heldTable() const;
  bool compensationOn() const { return m_look && !m_lost && m_look->sample.compensation_on; }
  /// Live cameras of the profile, for the pictures; opened at the first call after a person has connected. A job that
  /// was merely opened reaches nothing.
  const std::vector<std::shared_ptr<vision::Camera>>& cameras();
  /// Whether the pictures were ever asked for: only then is anything known of the cameras.
  const std::vector<std::shared_ptr<vision::Camera>>& openCameras() const { return m_cameras; }
  /// A step reads the machine itself: whether it answers, and the switch where the step sees it.
  void tellController(bool answers, std::optional<bool> switch_on = {});

  /// A sentence or a channel of core as people read it: units, places of the sensors (core/report/wording.h).
  QString inWords(const std::string& text) const;
  QString channelInWords(const std::string& channel) const;
  /// What a channel of the warm-up run is called where there is little room: "T1", "X", "Room", "probe2".
  QString tagOf(const std::string& channel) const;
  /// Where the sensor of the run is, as the machine's profile or the import's map says; "" where none says it.
  QString labelOf(const std::string& channel) const;

  // Work: one task at a time; the monitor is paused meanwhile.
  TaskRunner& tasks() { return m_tasks; }
  /// Other work on the job, until what is returned is let go: a report that is being drawn.
  [[nodiscard]] std::shared_ptr<const QString> beginWork(const QString& name);
  /// machine_busy with the name of the work that runs.
  Status idle() const;

  void log(LogKind kind, const QString& text);

 Q_SIGNALS:
  /// The job that was open is not any more: whatever is known of it is forgotten, before anything of another is shown.
  void jobLeft();
  void jobChanged();
  void jobDamaged(const zerodrift::Error& damage);
  void artefactsChanged();
  void profileChanged();
  void machineSeen();
  void heldTableChanged();
  void machineLost(const zerodrift::Error& error);
  void accessChanged();
  /// A job of another machine than the connected one was opened, so the connection was given up.
  void disconnectedFor(unsigned connected_serial, unsigned job_serial);
  /// A step has told how it stands with the controller.
  void controllerTold();
  /// The machine came, went, or its compensation was switched: what may be done with it is another thing now.
  void machineStateChanged();
  void logged(const QDateTime& time, zerodrift::desktop::LogKind kind, const QString& text);

 private:
  report::Labels labels() const;
  /// Cameras that are not needed any more; they may be waiting for a picture.
  void dropCameras();
  void noteMachineState();
  void leaveJob();
  void useJob(commissioning::Job job);
  /// Beside the window and by a connection of its own: the whole file is read.
  void checkWhole();
  void forgetRead();

  std::unique_ptr<access::Access> m_access;
  std::shared_ptr<commissioning::Job> m_job;
  std::optional<controller::Profile> m_profile;
  nlohmann::json m_profileDocument;
  std::shared_ptr<const MachineLook> m_look;
  std::vector<std::shared_ptr<vision::Camera>> m_cameras;
  std::shared_ptr<OperatorQuestions> m_questions = std::make_shared<OperatorQuestions>();
  MachineMonitor m_monitor;
  TaskRunner m_tasks;
  std::vector<std::weak_ptr<const QString>> m_work;  // beside the tasks: names
  Aside m_ending;
  std::optional<Error> m_damage;
  struct Body {
    long long of = 0;
    nlohmann::json document;
  };
  // Of this job, as read: pages ask for them many times a second.
  mutable std::map<std::string, Body> m_bodies;
  mutable recording::Recording m_warmupRun;
  mutable long long m_warmupSeries = 0;
  bool m_reached = false;  // a person has asked for this machine: until then nothing goes out to it or its cameras
  bool m_lost = false;
  QDateTime m_seenAt;
  std::tuple<bool, bool, bool> m_machineState{};  // connected, lost, compensation on
  std::optional<ErrorCode> m_lastProblem;
  int m_attempts = 0;                  // that failed for the same reason
  std::vector<std::jthread> m_checks;  // waited for when the window is closed
};

}  // namespace zerodrift::desktop
