#pragma once
// Sets up the connection profile on the machine page: holds the draft while it is edited, says what is wrong at its
// field, searches and tests devices, reads signals live, looks through a camera.

#include <QObject>
#include <QTimer>
#include <atomic>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "app/desktop/rig_words.h"
#include "app/desktop/workbench.h"
#include "core/controller/live_signals.h"
#include "ui/pages/machine_page.h"

namespace zerodrift::desktop {

class RigEditor : public QObject {
  Q_OBJECT

 public:
  RigEditor(Workbench& bench, ui::MachinePage* page);
  ~RigEditor() override;

  /// On the page: with the job's profile, or a new one. What was not saved is still there.
  void begin();
  /// The page shows the machine again; what was edited is kept until another job.
  void leave();
  bool open() const { return m_open; }
  bool valid() const { return m_valid; }
  const controller::ProfileDraft& draft() const { return m_draft; }
  /// Draws it as it is now.
  void refresh();
  /// The job that was open is not any more.
  void forget();
  void undo();
  Status load(const QString& path);
  /// Saves it and lets the job use it.
  Status save(const QString& path);
  /// Asks for a file where there is none yet, or another is wanted.
  void chooseSave(bool another);
  void chooseOpen();

 Q_SIGNALS:
  void stateChanged();
  void refused(const zerodrift::Error& error);
  /// A profile was saved and is in use.
  void taken();

 private:
  struct Found {
    ui::FoundThing shown;
    std::function<void()> take;  // what a choice of it enters
  };
  void connectPage();
  /// The profile of the job, as it is now.
  std::string origin() const;
  void add(const QString& kind);
  void edit(const QString& path, const QString& key, const QString& value);
  void editSignal(int row, int column, const QString& text);
  void redo();
  /// After every change: is it valid, and what is shown.
  void changed();
  void tellProblem(ui::RigSetupState& state) const;
  void fillSelected(ui::RigSetupState& state) const;
  const nlohmann::json* selected() const;
  std::string selectedKind() const;

  // Searches and the test, one at a time (rig_search.cpp).
  using Tell = std::function<void(const Found& found)>;
  void search(const QString& words, std::function<Status(const TaskContext&, const Tell&)> work);
  void find(const QString& what);
  void findPorts();
  void findUnits();
  void findNetwork();
  void findCameras();
  void test();
  void tellTest(const controller::DeviceProfile& device, const Result<controller::DeviceTest>& test);
  void say(const QString& words, ui::Judgement judgement);
  void setSelected(const QString& key, const QString& value);

  // Live (rig_live.cpp).
  void setLive(bool on);
  void readAgain();
  void showValues();
  bool isModbus(const std::string& device) const;
  void setPreview(bool on);
  void showPicture();

  Workbench& m_bench;
  ui::MachinePage* m_page;
  ui::RigSetup* m_view;
  controller::ProfileDraft m_draft;
  std::string m_of;  // what the draft was made from
  bool m_open = false;
  bool m_valid = true;
  std::optional<Error> m_problem;
  QString m_current = machine_item;
  QString m_busy;
  double m_fraction = -1.0;
  std::vector<Found> m_found;
  QString m_result;
  ui::Judgement m_resultJudgement = ui::Judgement::none;
  std::shared_ptr<controller::LiveSignals> m_live;
  bool m_liveOn = false;
  Watches m_watches;
  SaidSignals m_said;
  std::map<std::string, long> m_rounds;  // of the last value of each row
  QTimer m_liveTimer;
  std::shared_ptr<vision::Camera> m_camera;
  std::string m_cameraOf;  // the entry it was opened by
  QTimer m_pictureTimer;
  TaskRunner m_tasks;
  Aside m_ending;
};

}  // namespace zerodrift::desktop
