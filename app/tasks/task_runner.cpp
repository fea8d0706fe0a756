#include "app/tasks/task_runner.h"

#include <chrono>
#include <exception>
#include <utility>

namespace zerodrift {
namespace {

using std::chrono::steady_clock;

constexpr auto shortest_pause = std::chrono::milliseconds(50);

}  // namespace

TaskRunner::TaskRunner(QObject* parent) : QObject(parent) {}

TaskRunner::~TaskRunner() {
  m_thread.request_stop();
}

void TaskRunner::cancel() {
  m_thread.request_stop();
}

void TaskRunner::end() {
  m_thread.request_stop();
  if (m_thread.joinable()) m_thread.join();
}

bool TaskRunner::launch(const QString& name, std::function<std::any(const TaskContext&)> work,
                        std::function<void(std::any)> done) {
  if (m_running) return false;
  m_running = true;
  m_name = name;
  setObjectName(name);  // for who watches which event took long
  Q_EMIT started(name);
  // Work on std::jthread, results through the event loop: the receiver is this object, so nothing arrives after its
  // end.
  m_thread = std::jthread([this, work = std::move(work), done = std::move(done)](std::stop_token stop) mutable {
    auto last = steady_clock::now() - shortest_pause;
    TaskContext context;
    context.stop = std::move(stop);
    context.report = [this, last](const Progress& progress) mutable {
      if (steady_clock::now() - last < shortest_pause) return;
      last = steady_clock::now();
      QMetaObject::invokeMethod(
          this,
          [this, progress] {
            Q_EMIT progressed(progress.fraction, QString::fromStdString(progress.phase),
                              progress.seconds_left.value_or(-1.0));
          },
          Qt::QueuedConnection);
    };
    std::any result = std::exchange(work, nullptr)(context);
    QMetaObject::invokeMethod(
        this,
        [this, result = std::move(result), done]() mutable {
          m_running = false;
          done(std::move(result));
          Q_EMIT finished();
        },
        Qt::QueuedConnection);
  });
  return true;
}

}  // namespace zerodrift
