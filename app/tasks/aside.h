#pragma once
// Ends things beside the window: a connection or a camera that waits for a device must not be waited for by the thread
// that draws. Things are ended one after the other; the destructor waits for the last.

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>

namespace zerodrift {

class Aside {
 public:
  Aside();
  ~Aside();
  Aside(const Aside&) = delete;
  Aside& operator=(const Aside&) = delete;

  /// The last owner's end of it happens on the thread here.
  void drop(std::shared_ptr<void> thing);

 private:
  void work(const std::stop_token& stop);

  std::mutex m_mutex;
  std::condition_variable_any m_wake;
  std::deque<std::shared_ptr<void>> m_things;
  std::jthread m_thread;
};

}  // namespace zerodrift
