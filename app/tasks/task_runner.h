#pragma once
// Runs one piece of core work on a thread of its own and posts what it says back to the GUI thread: progress at most 20
// times a second, then the result once. A second start while one runs is refused. The destructor stops and joins. What
// the work holds is let go before its result is told.

#include <QObject>
#include <QString>
#include <any>
#include <exception>
#include <functional>
#include <memory>
#include <thread>

#include "core/base/result.h"
#include "core/base/task_context.h"

namespace zerodrift {

class TaskRunner : public QObject {
  Q_OBJECT

 public:
  explicit TaskRunner(QObject* parent = nullptr);
  ~TaskRunner() override;

  bool running() const { return m_running; }
  QString name() const { return m_name; }

  /// `work` runs on the thread; `done` on this object's thread, with the value or the error (cancelled is an error).
  template <class T>
  bool start(const QString& name, std::function<Result<T>(const TaskContext&)> work,
             std::function<void(Result<T>)> done) {
    return launch(
        name,
        [work = std::move(work)](const TaskContext& c) {
          // What throws here - no memory, a job whose artefacts do not hold what they should - ends this work, not the
          // program.
          try {
            return std::make_any<Result<T>>(work(c));
          } catch (const std::exception& problem) {
            return std::make_any<Result<T>>(fail(ErrorCode::internal, {{"detail", problem.what()}}));
          }
        },
        [done = std::move(done)](std::any result) { done(std::any_cast<Result<T>>(std::move(result))); });
  }

  /// Asks the work to stop; it ends with ErrorCode::cancelled at its next safe point.
  void cancel();
  /// The same, and waits for that point. What it made is not told to anybody any more.
  void end();

 Q_SIGNALS:
  void started(const QString& name);
  void progressed(double fraction, const QString& phase, double secondsLeft);  // secondsLeft < 0: not known
  void finished();

 private:
  bool launch(const QString& name, std::function<std::any(const TaskContext&)> work,
              std::function<void(std::any)> done);

  QString m_name;
  bool m_running = false;
  std::jthread m_thread;
};

}  // namespace zerodrift
