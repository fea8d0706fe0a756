#include "app/desktop/stall_watch.h"

#include <time.h>

#include <QEvent>
#include <QMetaEnum>
#include <chrono>
#include <exception>

namespace zerodrift::desktop {
namespace {

constexpr std::size_t most_stalls = 1000;

double thread_ms() {
  timespec now{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

QString name_of(const QObject* receiver, QEvent::Type type) {
  const char* event = QMetaEnum::fromType<QEvent::Type>().valueToKey(type);
  QString name = QString::fromLatin1(receiver->metaObject()->className());
  if (!receiver->objectName().isEmpty()) name += QLatin1Char('#') + receiver->objectName();
  return name + QLatin1Char(' ') + (event == nullptr ? QString::number(type) : QString::fromLatin1(event));
}

}  // namespace

bool WatchedApplication::notify(QObject* receiver, QEvent* event) {
  if (m_inside) return QApplication::notify(receiver, event);
  m_inside = true;
  // The event may delete its receiver and itself.
  const QString what = name_of(receiver, event->type());
  const auto wall = std::chrono::steady_clock::now();
  const double work = thread_ms();
  bool done = false;
  try {
    done = QApplication::notify(receiver, event);
  } catch (const std::exception& problem) {
    if (onException) onException(QString::fromUtf8(problem.what()));
  }
  const double worked_ms = thread_ms() - work;
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - wall;
  m_inside = false;
  if (m_counting) note(what, took.count(), worked_ms);
  m_counting = true;
  return done;
}

void WatchedApplication::note(const QString& what, double wall_ms, double work_ms) {
  if (work_ms > m_longest.work_ms) m_longest = {wall_ms, work_ms, what};
  if (wall_ms > limit_ms && m_stalls.size() < most_stalls) m_stalls.push_back({wall_ms, work_ms, what});
}

}  // namespace zerodrift::desktop
