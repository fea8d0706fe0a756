#pragma once
// The machine page: the job file, the connection profile, the health list, Start commissioning.

#include <QDateTime>
#include <QHash>
#include <QVector>
#include <deque>
#include <optional>
#include <vector>

#include "app/desktop/demo_machine.h"
#include "app/desktop/map_editor.h"
#include "app/desktop/presenter.h"
#include "app/desktop/rig_editor.h"

namespace zerodrift::ui {
class MachinePage;
struct MachineState;
}  // namespace zerodrift::ui

namespace zerodrift::desktop {

class MachinePresenter : public Presenter {
  Q_OBJECT

 public:
  MachinePresenter(Workbench& bench, ui::MachinePage* page, DemoMachine& demo);
  void refresh() override;
  void themeChanged() override { m_rig->refresh(); }
  /// What else it shows is the machine's, or read from the job each time.
  void forget() override { m_rig->forget(); }
  void undo() override {
    if (m_rig->open()) m_rig->undo();
  }
  void tour(std::function<void(bool good)> done) override;

  /// The virtual machine beside the application, with a new job in the user's folder. One that runs is not started
  /// over: it holds a table, and its heat.
  void useVirtualMachine(const DemoOptions& options);
  /// Whichever runs, else this one.
  void useAnyVirtualMachine();
  void openJob(const QString& path);
  void newJob(const QString& path);
  static QString jobsFolder();
  /// The last jobs that are still there, the newest first.
  static QStringList recentJobs();
  void chooseNewJob();
  void chooseJob();

  /// Looks from which a slope is told.
  static constexpr std::size_t course_least = 20;

 Q_SIGNALS:
  /// To be done when nothing runs any more; what runs is ended if a person agrees.
  void endWorkWanted(const QString& question, const QString& deed, const std::function<void()>& then);
  void sampleWanted();
  void ownRecordingWanted();

 private:
  void importProfile();
  void setUp(const QString& action);
  /// Says why something was refused.
  void unlessBusy(const Status& done);
  /// Connects to the virtual machine that was started.
  void useReadyMachine();
  void primary();
  void commissionAnew();
  void connectNow();
  /// The virtual machine of the job, anew.
  void startVirtual();
  void startCommissioning(std::function<void(bool good)> done);
  void looked();
  void sayWhenOld();
  void remember(const QString& path);
  QString connectionText() const;
  std::optional<int> virtualSeed() const;
  void fillSensors(ui::MachineState& state);
  void fillRest(ui::MachineState& state) const;
  void fillParts(ui::MachineState& state) const;
  void fillDevices(ui::MachineState& state) const;
  /// Without a connection: how the machine stood when the commissioning was started, as the job kept it.
  void fillKept(ui::MachineState& state) const;

  ui::MachinePage* m_page;
  DemoMachine& m_demo;
  bool m_connecting = false;
  MapEditor* m_map;
  RigEditor* m_rig;
  // The last readings of each sensor, for its noise.
  std::deque<std::vector<double>> m_readings;
  // And over minutes of the machine's time, for what still changes.
  std::deque<std::pair<double, std::vector<double>>> m_course;
  QHash<QString, QDateTime> m_alive;  // when a sensor last had a value
  QDateTime m_lookedAt;               // when the machine was last looked at: a run has it to itself
  bool m_saidOld = false;
  std::optional<ErrorCode> m_lostSaid;  // the trouble that stands in the banner
  bool m_toldLost = false;
  std::function<void(bool good)> m_whenReady;
};

}  // namespace zerodrift::desktop
