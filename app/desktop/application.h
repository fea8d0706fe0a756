#pragma once
// Joins window, workbench and presenters: step states, lamps, log, languages, shortcuts.

#include <QObject>
#include <QTimer>
#include <QTranslator>
#include <vector>

#include "app/desktop/demo_machine.h"
#include "app/desktop/presenter.h"
#include "app/desktop/workbench.h"
#include "ui/shell/main_window.h"
#include "ui/shell/theme.h"

namespace zerodrift::flow {
struct StepStatus;
}

namespace zerodrift::desktop {

class FileOpener;
class MachinePresenter;

class Application : public QObject {
  Q_OBJECT

 public:
  explicit Application(ui::Theme& theme);
  ~Application() override;

  /// The window as it was left last time.
  void show();
  void openJob(const QString& path);
  /// Jobs, profiles, plans, laser reports, recordings: each to its page.
  void openFiles(const QStringList& paths);
  void openSample();
  /// The virtual machine beside the application, with a new job; the machine page shows it connected.
  void startDemo(const DemoOptions& options, const QString& jobPath = {});

  ui::MainWindow& window() { return *m_window; }
  Workbench& bench() { return *m_bench; }
  DemoMachine& demo() { return *m_demo; }
  const std::vector<Presenter*>& presenters() const { return m_presenters; }
  Presenter* presenter(const QString& id) const;
  void openPage(const QString& id);
  /// "en" or "zh_CN".
  void setLanguage(const QString& code);
  /// The language kept by the user's last choice, else the desktop's.
  static QString rememberedLanguage();

 private:
  void wire();
  /// What one page asks of another.
  void wireSteps();
  /// The virtual machine's clock goes fast only for what runs on it.
  void paceVirtualMachine();
  void switchCompensation();
  void sayInterrupted();
  void sayDisconnected(unsigned connected_serial, unsigned job_serial);
  void sayDamaged(const Error& damage);
  /// The lamp of the lock: sets a PIN, unlocks or locks.
  void changeAccess();
  void openNext(const QString& after);
  void openBack();
  /// How each step stands, into the rail.
  void updateSteps();
  QString wordsOf(const flow::StepStatus& status) const;
  /// Tells the page whether it makes sense in this job, and why not.
  void tellNeed(Presenter& presenter, bool needed);
  void updateLamps();
  void lightController();
  void lightCamera();
  void undo();
  void offerCommands();
  void runCommand(const QString& id);
  void mayClose(bool* allowed);
  bool mayEnd(const QString& question, const QString& deed);
  /// Asks whether the work that runs may end, ends it, then does it; at once when nothing runs.
  void endWork(const QString& question, const QString& deed, const std::function<void()>& then);
  /// Warm-up or verification.
  bool isRunning(const char* id) const;
  QString whatEndingDoes() const;

  ui::Theme& m_theme;
  std::unique_ptr<Workbench> m_bench;
  std::unique_ptr<DemoMachine> m_demo;
  std::unique_ptr<ui::MainWindow> m_window;
  std::vector<Presenter*> m_presenters;
  FileOpener* m_opener;
  QTimer m_lampTimer;  // what is not told is looked at
  QTranslator m_translator;
  QTranslator m_qtTranslator;  // Qt's own words: Cancel, Copy, the file dialog
  QString m_language = QStringLiteral("en");
  QString m_open;
};

}  // namespace zerodrift::desktop
