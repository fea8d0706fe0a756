#pragma once
// A sink that remembers, and refuses or takes its time when told.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <thread>
#include <vector>

#include "core/acquisition/run_sink.h"

namespace zerodrift::acquisition {

class MemorySink : public RunSink {
 public:
  Status begin(const RunStart& s) override {
    start = s;
    return {};
  }
  Status append(double time_s, std::span<const double> values) override {
    times.push_back(time_s);
    rows.emplace_back(values.begin(), values.end());
    return {};
  }
  Status event(const RunEvent& e) override {
    events.push_back(e);
    return {};
  }
  Status flush() override {
    ++flushes;
    std::this_thread::sleep_for(flush_takes);
    if (in_flush) in_flush();
    if (full) return fail(ErrorCode::disk_full, {{"file", "memory"}});
    committed = times.size();
    return {};
  }
  Status end(RunEnd e) override {
    ended = e;
    return {};
  }

  std::size_t column(const std::string& channel) const {
    return static_cast<std::size_t>(std::find(start.channels.begin(), start.channels.end(), channel) -
                                    start.channels.begin());
  }
  double value(std::size_t row, const std::string& channel) const { return rows.at(row).at(column(channel)); }
  int count(const std::string& kind, const std::string& text = {}) const {
    return static_cast<int>(std::count_if(events.begin(), events.end(), [&](const RunEvent& e) {
      return e.kind == kind && (text.empty() || e.text == text);
    }));
  }

  RunStart start;
  std::vector<double> times;
  std::vector<std::vector<double>> rows;
  std::vector<RunEvent> events;
  std::size_t committed = 0;
  int flushes = 0;
  std::atomic<bool> full = false;  // set by the test while another thread writes
  std::chrono::milliseconds flush_takes{0};
  std::function<void()> in_flush;  // called by the thread that writes
  std::optional<RunEnd> ended;
};

}  // namespace zerodrift::acquisition
