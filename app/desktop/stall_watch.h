#pragma once
// The application's last word on events.
// How long the window stood still: the time each event of the window's thread took, on the wall and of this thread's
// own work. What another program took of the processor is in the first and not in the second. An exception that got
// through to here ends the event and not the program: a job from elsewhere may hold artefacts that are not what they
// should be.

#include <QApplication>
#include <QString>
#include <functional>
#include <vector>

namespace zerodrift::desktop {

struct Stall {
  double wall_ms = 0.0;
  double work_ms = 0.0;
  QString what;  // which object got which event
};

class WatchedApplication : public QApplication {
 public:
  static constexpr double limit_ms = 50.0;  // beyond that a hand feels it

  using QApplication::QApplication;
  bool notify(QObject* receiver, QEvent* event) override;

  /// The one whose processor time was longest; what the tour does itself, taking pictures, is not counted.
  const Stall& longest() const { return m_longest; }
  /// Every one beyond the limit, in the order they came.
  const std::vector<Stall>& stalls() const { return m_stalls; }
  /// Told what the exception said.
  std::function<void(const QString& what)> onException;
  void count(bool counting) { m_counting = counting; }

 private:
  void note(const QString& what, double wall_ms, double work_ms);

  bool m_inside = false;
  bool m_counting = true;
  Stall m_longest;
  std::vector<Stall> m_stalls;
};

}  // namespace zerodrift::desktop
