#pragma once
// What warm-up and verification share: a run on the machine that is started, watched, paused, ended after a question,
// and shown again from the job.

#include "app/desktop/presenter.h"
#include "app/desktop/run_feed.h"
#include "core/flow/devices.h"
#include "core/flow/steps/warmup_step.h"

namespace zerodrift::desktop {

class RunPresenter : public Presenter {
  Q_OBJECT

 public:
  RunPresenter(Workbench& bench, ui::Page* page, ui::RunView* view);
  void languageChanged() override;
  void themeChanged() override;
  void forget() override;

  bool running() const { return m_running; }
  /// The run of this page that was broken off and can be gone on with, unless a newer one is kept.
  const std::optional<flow::RecordedRun>& interrupted();

 protected:
  /// From the job.
  virtual Result<std::optional<flow::RecordedRun>> readInterrupted() const = 0;
  /// Starts this page's run; one that was broken off is gone on with.
  virtual void start(std::function<void(bool good)> done) = 0;
  /// Draws the interrupted run.
  void showInterrupted();
  /// Takes the interrupted run up and ends it as it should: spindle off, series closed, what there is kept.
  void resumeToFinish();
  /// The interrupted run is used no more: the run that was kept before counts.
  void dropInterrupted();
  /// Since when the controller has been silent in the run; "" while it answers.
  QString silentSince() const;
  using Step = std::function<Result<commissioning::NewArtefact>(commissioning::Job&, flow::Devices&,
                                                                const flow::RunOptions&, const TaskContext&)>;

  RunFeed& feed() { return *m_feed; }
  /// Opens the machine and records by this step; the feed sees every sample.
  void record(const QString& name, const acquisition::Plan& plan, Step step, std::function<void(bool good)> done);
  void pauseOrResume();
  /// Nothing moves without a word: what this plan will do, and that the area is clear.
  bool agreed(const acquisition::Plan& plan);
  /// "finish", "abort" and "note"; true when it was one of them. The first two are asked for.
  bool steer(const QString& action);
  /// Draws the run that this artefact names, once.
  void showKept(const nlohmann::json& body);
  /// Draws a run of the job, once; false: it is drawn already, or cannot be read.
  bool showSeries(long long series);
  /// The plots of the run shown are cleared.
  void forgetRun();
  /// Pause, finish and abort end a run as it should; stopping the work as such has no place beside them.
  bool cancellable() const override { return false; }
  QString waitsFor() const override;
  /// How far the run goes, in machine time and, when that differs, in time on the wall.
  QString wallTime(double machine_s) const;

  bool m_again = false;  // a new run although one is kept

 private:
  RunFeed* m_feed;
  bool m_running = false;
  std::optional<flow::RecordedRun> m_interrupted;  // as it was read last
  long long m_shown = 0;                           // series drawn now
};

}  // namespace zerodrift::desktop
