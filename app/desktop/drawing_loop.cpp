#include "app/desktop/drawing_loop.h"

#include <QElapsedTimer>
#include <utility>

namespace zerodrift::desktop {
namespace {

constexpr int turn_ms = 8;

}  // namespace

DrawingLoop::DrawingLoop(QObject* parent) : QObject(parent) {
  connect(&m_turns, &QTimer::timeout, this, &DrawingLoop::turn);
}

void DrawingLoop::begin(std::unique_ptr<reporting::Drawing> drawing, std::function<void(Status ended)> done) {
  m_drawing = std::move(drawing);
  m_done = std::move(done);
  m_turns.start(0);
}

void DrawingLoop::drop() {
  m_turns.stop();
  m_drawing.reset();
  m_done = nullptr;
}

void DrawingLoop::turn() {
  QElapsedTimer taken;
  taken.start();
  do {
    const Result<bool> more = m_drawing->step();
    if (more && *more) continue;
    const auto done = std::exchange(m_done, nullptr);
    const Status ended = more ? Status() : Status(fail(more.error()));
    // Its owner may look at what was drawn, and begin the next.
    const std::unique_ptr<reporting::Drawing> drawn = std::move(m_drawing);
    m_turns.stop();
    if (done) done(ended);
    return;
  } while (taken.elapsed() < turn_ms);
}

}  // namespace zerodrift::desktop
