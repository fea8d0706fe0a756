#pragma once
// What long work in core gets from its caller: a stop token to obey and a place to report progress.
// Core starts no threads for its caller's sake; cancelled work returns ErrorCode::cancelled.

#include <functional>
#include <optional>
#include <stop_token>
#include <string>

#include "core/base/result.h"

namespace zerodrift {

struct Progress {
  double fraction = 0.0;               // 0 .. 1
  std::string phase;                   // a short identifier, for example "clustering"; app/text makes words of it
  std::optional<double> seconds_left;  // when it can be told
};

struct TaskContext {
  std::stop_token stop;
  std::function<void(const Progress&)> report;

  bool cancelled() const { return stop.stop_requested(); }
  void progress(double fraction, std::string phase = {}, std::optional<double> seconds_left = std::nullopt) const {
    if (report) report(Progress{fraction, std::move(phase), seconds_left});
  }
};

}  // namespace zerodrift
