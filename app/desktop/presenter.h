#pragma once
// Between a page and the job: shows what the job holds, runs the step when the user asks for it, keeps what it made.

#include <QObject>
#include <functional>

#include "app/desktop/workbench.h"
#include "ui/pages/page.h"
#include "ui/shell/rail.h"

namespace zerodrift::desktop {

class Presenter : public QObject {
  Q_OBJECT

 public:
  Presenter(Workbench& bench, ui::Page* page);

  ui::Page* page() const { return m_page; }
  QString id() const { return m_page->id(); }
  /// Draws the page from the job and the machine as they are now.
  virtual void refresh() = 0;
  /// The job that was open is not any more: whatever is known of it and was chosen in it goes. Application calls this
  /// on every page at each change of job, and draws the one that is open from the next job; a page that is opened later
  /// is drawn then.
  virtual void forget() = 0;
  /// Says again, in the language chosen now, what was said in another one.
  virtual void languageChanged();
  /// Light or dark: what carries colours of its own is coloured anew.
  virtual void themeChanged() {}
  /// The page was opened or left.
  virtual void enter() { refresh(); }
  virtual void leave() {}
  /// In the rail in place of the step's own state: of a page that is no step of the job, and of one whose result fell
  /// short or is no longer what the machine holds.
  struct Standing {
    QString words;  // empty: the step's own state
    ui::StepState state = ui::StepState::ready;
  };
  virtual Standing standing() const { return {}; }
  /// Takes back the last choice on this page (Ctrl+Z).
  virtual void undo() {}
  /// What the tour does on this page: starts the step and calls `done` when it has ended.
  virtual void tour(std::function<void(bool good)> done) = 0;
  /// Whether work of this page runs.
  bool working() const { return m_working; }
  /// Into the banner and the log.
  void show(const Error& error);
  /// Into the banner; asked again when the language changes.
  void tell(std::function<ui::Problem()> problem);

 Q_SIGNALS:
  /// The user is done here: open the next page.
  void nextRequested();
  void pageRequested(const QString& id);
  void standingChanged();

 protected:
  Workbench& bench() { return m_bench; }
  const Workbench& bench() const { return m_bench; }
  /// Does this page's step of the job that is open now, by Flow: progress in the page, errors in its banner, and the
  /// job is held until it has ended. From elsewhere: what is made names its inputs itself
  /// (Flow::take_in).
  enum class From { job, elsewhere };
  void runStep(const QString& name, flow::StepRun work, std::function<void(bool good)> done = {},
               From from = From::job);
  /// Any other work on the task thread: progress in the page, an error in its banner before `done` gets it.
  template <class T>
  void runTask(const QString& name, std::function<Result<T>(const TaskContext&)> work,
               std::function<void(Result<T>)> done) {
    QObject* progress = beginTask(name);
    auto finish = [this, progress, done](Result<T> made) {
      endTask(progress);
      if (!made) show(made.error());
      done(std::move(made));
    };
    if (m_bench.tasks().start<T>(name, std::move(work), std::move(finish))) return;
    endTask(progress);
    const Status idle = m_bench.idle();
    const Error refused = idle ? Error{ErrorCode::cancelled, {}} : idle.error();
    show(refused);
    done(fail(refused));
  }
  /// Whether work of this page may be stopped by Cancel.
  virtual bool cancellable() const { return true; }
  /// What the work stands still for, in a word or two; empty: it goes on.
  virtual QString waitsFor() const { return {}; }
  /// Into the banner alone: where the log was told already.
  void showOnly(const Error& error);
  /// Why nothing can be asked of the machine now; empty: it is there.
  QString offlineReason() const;
  /// Of a step that is done: that the machine holds another table than this job wrote, or none.
  Standing tableStanding() const;
  /// Calls `act` now, or when the task that runs has ended.
  void whenIdle(std::function<void()> act);

 private:
  QObject* beginTask(const QString& name);
  void endTask(QObject* progress);

  Workbench& m_bench;
  ui::Page* m_page;
  bool m_working = false;
  std::function<ui::Problem()> m_told;  // in the banner, unless it shows something else by now
  QString m_toldText;
};

}  // namespace zerodrift::desktop
