#pragma once
// Draws a report bit by bit, some milliseconds in each turn of the event loop.

#include <QObject>
#include <QTimer>
#include <functional>
#include <memory>

#include "app/reporting/drawing.h"

namespace zerodrift::desktop {

class DrawingLoop : public QObject {
  Q_OBJECT

 public:
  explicit DrawingLoop(QObject* parent = nullptr);
  /// `done` is told once how it ended; what was being drawn before is dropped without a word.
  void begin(std::unique_ptr<reporting::Drawing> drawing, std::function<void(Status ended)> done);
  void drop();
  bool running() const { return m_drawing != nullptr; }

 private:
  void turn();

  QTimer m_turns;
  std::unique_ptr<reporting::Drawing> m_drawing;
  std::function<void(Status)> m_done;
};

}  // namespace zerodrift::desktop
