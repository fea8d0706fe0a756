#pragma once
// Looks at the machine once a second while no step uses it: lamps, health list, the state of the switch. A thread of
// its own with a connection of its own; paused while a step runs, since many controllers serve one master at a time.

#include <QObject>
#include <atomic>
#include <memory>
#include <thread>

#include "core/acquisition/machine_io.h"
#include "core/controller/profile.h"

namespace zerodrift::desktop {

struct MachineLook {
  acquisition::MachineIdentity identity;
  acquisition::MachineSample sample;
  double round_trip_ms = 0.0;
  double clock_difference_s = 0.0;  // machine clock gained on the host's since the first look
};

class MachineMonitor : public QObject {
  Q_OBJECT

 public:
  explicit MachineMonitor(QObject* parent = nullptr);
  ~MachineMonitor() override;

  void start(const controller::Profile& profile);
  void stop();
  void pause(bool paused) { m_paused = paused; }
  bool running() const { return m_thread.joinable(); }

 Q_SIGNALS:
  void looked(const std::shared_ptr<const zerodrift::desktop::MachineLook>& look);
  void failed(const zerodrift::Error& error);

 private:
  void work(const std::stop_token& stop, const controller::Profile& profile);

  std::atomic<bool> m_paused = false;
  std::jthread m_thread;
};

}  // namespace zerodrift::desktop
