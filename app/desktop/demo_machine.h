#pragma once
// The virtual machine tool beside the application (--demo, --tour): started as a process of its own on free ports,
// ended with the application.

#include <QObject>
#include <QProcess>
#include <optional>

#include "app/desktop/scratch_folder.h"

namespace zerodrift::desktop {

struct DemoOptions {
  double speedup = 240.0;
  int seed = 1;
  QString conceal;     // effect id or "random"; empty: nothing is hidden
  QString program;     // empty: zerodrift-machine beside this program
  QStringList faults;  // of the machine, as its own option names them
};

/// The seed of the virtual machine that has this serial; nothing: no virtual machine has it (docs/virtual-machine.md).
std::optional<int> virtual_seed_of(unsigned serial);

class DemoMachine : public QObject {
  Q_OBJECT

 public:
  explicit DemoMachine(QObject* parent = nullptr);
  ~DemoMachine() override;

  void start(const DemoOptions& options);
  bool running() const { return m_ready; }
  /// It was started and is not ready yet.
  bool starting() const { return !m_ready && m_process.state() != QProcess::NotRunning; }
  /// While work runs its clock goes at the speedup; else as fast as the wall's, so that its room does not move on by
  /// hours while somebody reads.
  void setWorking(bool working);
  /// Machine seconds a second of wall time, now.
  double pace() const { return m_working ? m_options.speedup : 1.0; }
  /// As it was started last.
  const DemoOptions& options() const { return m_options; }
  /// Ends the process and waits for it; what it printed at its end (the opened seal) is in lastWords().
  void stop();
  QString profilePath() const;
  QString truthPath() const;
  QString lastWords() const { return m_words; }

 Q_SIGNALS:
  void ready();
  void failed(const QString& why);

 private:
  void readLines();
  void sendPace();

  QProcess m_process;
  DemoOptions m_options;
  ScratchFolder m_folder;
  QString m_words;
  bool m_ready = false;
  bool m_working = false;
  bool m_stopping = false;  // its end is wanted
};

}  // namespace zerodrift::desktop
