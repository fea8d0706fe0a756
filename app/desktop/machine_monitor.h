#pragma once
// Looks at the machine once a second while no step uses it: lamps, health list, the state of the switch. A thread of
// its own with a connection of its own; paused while a step runs, since many controllers serve one master at a time.

#include <QObject>
#include <atomic>
#include <memory>
#include <mutex>
#include <thread>

#include "app/desktop/operator_questions.h"
#include "app/tasks/aside.h"
#include "core/acquisition/machine_io.h"
#include "core/controller/active_table.h"
#include "core/controller/device_readings.h"
#include "core/controller/profile.h"
#include "core/controller/register_view.h"

namespace zerodrift::desktop {

struct MachineLook {
  acquisition::MachineIdentity identity;
  acquisition::MachineSample sample;
  double round_trip_ms = 0.0;
  double clock_difference_s = 0.0;                   // machine clock gained on the host's since the first look
  std::optional<controller::ActiveMark> table;       // nothing: this controller cannot tell
  std::vector<controller::RegisterValue> registers;  // of the map that is watched
  std::vector<controller::DeviceState> devices;      // beside the control
};

class MachineMonitor : public QObject {
  Q_OBJECT

 public:
  explicit MachineMonitor(QObject* parent = nullptr);
  ~MachineMonitor() override;

  /// The state of a manual control is asked for by the questions, once.
  void start(const controller::Profile& profile, std::shared_ptr<OperatorQuestions> questions);
  /// Returns at once: a look that waits for a dead machine ends beside the window, and nothing of it is told any more.
  void stop();
  void pause(bool paused) { m_paused = paused; }
  /// The clock of the machine goes so fast while nobody works with it; nothing: as its profile says.
  void setPace(std::optional<double> pace) { m_pace = pace.value_or(0.0); }
  /// Reads every register of this map with each look; null: none.
  void watch(std::shared_ptr<const controller::RegisterMap> map);
  bool running() const { return m_thread.joinable(); }

 Q_SIGNALS:
  void looked(const std::shared_ptr<const zerodrift::desktop::MachineLook>& look);
  void failed(const zerodrift::Error& error);

 private:
  void work(const std::stop_token& stop, const controller::Profile& profile,
            std::shared_ptr<controller::Operator> person);

  std::shared_ptr<const controller::RegisterMap> watched() const;

  std::atomic<bool> m_paused = false;
  std::atomic<double> m_pace = 0.0;
  mutable std::mutex m_lock;
  std::shared_ptr<const controller::RegisterMap> m_watched;
  std::jthread m_thread;
  Aside m_ending;  // last: what ends there still looks at the rest
};

}  // namespace zerodrift::desktop
