#include "app/desktop/machine_monitor.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <utility>

#include "core/flow/devices.h"

namespace zerodrift::desktop {

using std::chrono::steady_clock;

namespace {

bool wait(const std::stop_token& stop, std::chrono::milliseconds duration) {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock lock(mutex);  // cppcheck-suppress localMutex; only what the condition needs
  wake.wait_for(lock, stop, duration, [] { return false; });
  return !stop.stop_requested();
}

double seconds_between(steady_clock::time_point from, steady_clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

/// One connection and what is known through it.
class Eye {
 public:
  Eye(const controller::Profile& profile, std::shared_ptr<controller::Operator> person)
      : m_profile(profile), m_person(std::move(person)) {}

  Result<MachineLook> look(const controller::RegisterMap* watched, double pace) {
    if (std::exchange(m_pace, pace) != pace) m_first.reset();  // its clock gained at another rate until now
    if (!m_devices.machine) {
      ZD_TRY(m_devices, flow::Devices::open(m_profile, false, access::Permit::read_only(), m_person));
      if (m_devices.link != nullptr) m_devices.link->link().set_attempts(2);
      ZD_TRY(m_identity, m_devices.machine->identify());
    }
    MachineLook seen;
    seen.identity = m_identity;
    const auto before = steady_clock::now();
    ZD_TRY(seen.sample, m_devices.machine->read());
    const auto after = steady_clock::now();
    seen.round_trip_ms = 1000.0 * seconds_between(before, after);
    if (!m_first) m_first = {after, seen.sample.machine_time_s};
    const double host_s = seconds_between(m_first->host, after) * (pace > 0.0 ? pace : m_profile.time_factor);
    seen.clock_difference_s = (seen.sample.machine_time_s - m_first->machine_s) - host_s;
    seen.devices = m_devices.device_states();
    if (m_devices.link == nullptr) return seen;
    if (auto mark = controller::read_active_mark(*m_devices.link)) seen.table = *mark;
    if (watched != nullptr) seen.registers = controller::read_all(m_devices.link->link(), *watched);
    return seen;
  }

  void forget() {
    m_devices = {};
    m_first.reset();
  }

 private:
  struct First {
    steady_clock::time_point host;
    double machine_s;
  };
  const controller::Profile& m_profile;
  std::shared_ptr<controller::Operator> m_person;
  flow::Devices m_devices;
  acquisition::MachineIdentity m_identity;
  std::optional<First> m_first;
  double m_pace = 0.0;
};

}  // namespace

MachineMonitor::MachineMonitor(QObject* parent) : QObject(parent) {}

MachineMonitor::~MachineMonitor() {
  stop();
}

void MachineMonitor::start(const controller::Profile& profile, std::shared_ptr<OperatorQuestions> questions) {
  stop();
  m_thread = std::jthread([this, profile, questions = std::move(questions)](const std::stop_token& token) {
    work(token, profile, questions->of(profile, token));
  });
}

void MachineMonitor::stop() {
  if (!m_thread.joinable()) return;
  m_thread.request_stop();
  m_ending.drop(std::make_shared<std::jthread>(std::exchange(m_thread, {})));
}

void MachineMonitor::watch(std::shared_ptr<const controller::RegisterMap> map) {
  const std::lock_guard lock(m_lock);
  m_watched = std::move(map);
}

std::shared_ptr<const controller::RegisterMap> MachineMonitor::watched() const {
  const std::lock_guard lock(m_lock);
  return m_watched;
}

void MachineMonitor::work(const std::stop_token& stop, const controller::Profile& profile,
                          std::shared_ptr<controller::Operator> person) {
  Eye eye(profile, std::move(person));
  do {
    if (m_paused) {
      eye.forget();
      continue;
    }
    const auto map = watched();
    const auto seen = eye.look(map.get(), m_pace);
    if (!seen) eye.forget();
    QMetaObject::invokeMethod(
        this,
        [this, seen, stop] {
          if (m_paused || stop.stop_requested()) return;
          if (seen) {
            Q_EMIT looked(std::make_shared<const MachineLook>(*seen));
          } else {
            Q_EMIT failed(seen.error());
          }
        },
        Qt::QueuedConnection);
  } while (wait(stop, std::chrono::milliseconds(1000)));
}

}  // namespace zerodrift::desktop
