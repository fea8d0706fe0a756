#pragma once
// The machine page: the job file, the connection profile, the health list, Start commissioning.

#include <QHash>
#include <QVector>
#include <deque>

#include "app/desktop/demo_machine.h"
#include "app/desktop/presenter.h"

namespace zerodrift::ui {
class MachinePage;
}

namespace zerodrift::desktop {

class MachinePresenter : public Presenter {
  Q_OBJECT

 public:
  MachinePresenter(Workbench& bench, ui::MachinePage* page, DemoMachine& demo);
  void refresh() override;
  void tour(std::function<void(bool good)> done) override;

  /// The virtual machine beside the application, with a new job in the user's folder.
  void useVirtualMachine(const DemoOptions& options);
  void openJob(const QString& path);
  void newJob(const QString& path);
  static QString jobsFolder();

 private:
  void chooseNewJob();
  void chooseJob();
  void importProfile();
  void primary();
  void startCommissioning(std::function<void(bool good)> done);
  void looked();
  void remember(const QString& path);
  QString connectionText() const;

  ui::MachinePage* m_page;
  DemoMachine& m_demo;
  bool m_connecting = false;
  // The last readings of each sensor, for its noise.
  std::deque<std::vector<double>> m_readings;
  std::function<void()> m_whenReady;
};

}  // namespace zerodrift::desktop
