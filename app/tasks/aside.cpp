#include "app/tasks/aside.h"

#include <utility>

namespace zerodrift {

Aside::Aside() : m_thread([this](const std::stop_token& stop) { work(stop); }) {}

Aside::~Aside() {
  m_thread.request_stop();
  m_thread.join();
}

void Aside::drop(std::shared_ptr<void> thing) {
  const std::scoped_lock lock(m_mutex);
  m_things.push_back(std::move(thing));
  m_wake.notify_one();
}

void Aside::work(const std::stop_token& stop) {
  for (;;) {
    std::shared_ptr<void> thing;
    std::unique_lock lock(m_mutex);
    m_wake.wait(lock, stop, [this] { return !m_things.empty(); });
    if (m_things.empty()) return;  // asked to stop, and nothing is left
    thing = std::move(m_things.front());
    m_things.pop_front();
    lock.unlock();
    thing.reset();
  }
}

}  // namespace zerodrift
