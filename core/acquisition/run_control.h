#pragma once
// What a person may ask of a running recording, from any thread. Requests are obeyed at the next sample; abort at once.

#include <atomic>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <utility>
#include <vector>

namespace zerodrift::acquisition {

class RunControl {
 public:
  void pause() { m_paused = true; }
  void resume() { m_paused = false; }
  /// Ends the run before its plan does, with a last measurement unless the machine is away; what was recorded counts.
  void finish() { m_finish = true; }
  /// Ends the run now; the series is marked as aborted.
  void abort() {
    m_abort = true;
    m_stop.request_stop();
  }
  struct Note {
    std::string text;
    std::optional<double> time_s;  // of the run, when it was begun; nothing: now
  };
  void note(std::string text, std::optional<double> time_s = {}) {
    const std::scoped_lock lock(m_mutex);
    m_notes.push_back({std::move(text), time_s});
  }

  bool paused() const { return m_paused; }
  bool finish_requested() const { return m_finish; }
  bool abort_requested() const { return m_abort; }
  std::stop_source& stop() { return m_stop; }
  std::vector<Note> take_notes() {
    const std::scoped_lock lock(m_mutex);
    return std::exchange(m_notes, {});
  }

 private:
  std::atomic<bool> m_paused = false;
  std::atomic<bool> m_finish = false;
  std::atomic<bool> m_abort = false;
  std::stop_source m_stop;
  std::mutex m_mutex;
  std::vector<Note> m_notes;
};

}  // namespace zerodrift::acquisition
