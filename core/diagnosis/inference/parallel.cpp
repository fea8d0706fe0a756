#include "core/diagnosis/inference/parallel.h"

#include <algorithm>
#include <atomic>
#include <thread>

#include "core/physics/skyline.h"

namespace zerodrift::diagnosis {
namespace {

constexpr std::size_t most_threads = 4;
// Columns are simulated in blocks of so many: a part of a block takes as long as a whole one.
constexpr std::size_t block = physics::Skyline::lanes;

// Threads at work on a job, and whether this is one of them. Where the last jobs of many are left, the processors of
// those that are done are free for the columns of what still runs.
std::atomic<std::size_t> s_busy{0};
thread_local bool t_counted = false;

class Counted {
 public:
  Counted() : m_first(!t_counted) {
    if (m_first) t_counted = true, ++s_busy;
  }
  ~Counted() {
    if (m_first) t_counted = false, --s_busy;
  }
  Counted(const Counted&) = delete;
  Counted& operator=(const Counted&) = delete;

 private:
  bool m_first;
};

std::size_t threads_there() {
  return std::min<std::size_t>(most_threads, std::max(1u, std::thread::hardware_concurrency()));
}

void on_threads(std::size_t threads, std::size_t count, const std::function<void(std::size_t)>& job) {
  std::atomic<std::size_t> next{0};
  const auto work = [&] {
    const Counted at_work;
    for (std::size_t i = next++; i < count; i = next++) job(i);
  };
  std::vector<std::jthread> helpers;
  for (std::size_t t = 1; t < threads; ++t) helpers.emplace_back(work);
  work();
}

}  // namespace

void in_parallel(std::size_t count, const std::function<void(std::size_t)>& job) {
  on_threads(std::min(count, threads_there()), count, job);
}

physics::Prediction predicted(const physics::Network& network, const physics::InputSet& inputs,
                              const std::vector<double>& values, const std::vector<int>& parameters) {
  const std::size_t columns = parameters.size();
  const std::size_t blocks = (columns + block - 1) / block;
  const std::size_t others = s_busy - (t_counted ? 1 : 0);
  const std::size_t parts = std::min(blocks, threads_there() - std::min(threads_there() - 1, others));
  if (parts < 2) return physics::predict(network, inputs, values, parameters);
  // Dealt one by one: the columns that move temperatures, which alone take time, often stand together.
  std::vector<physics::Prediction> predictions(parts);
  on_threads(parts, parts, [&](std::size_t part) {
    std::vector<int> own;
    for (std::size_t c = part; c < columns; c += parts) own.push_back(parameters[c]);
    predictions[part] = physics::predict(network, inputs, values, own);
  });
  physics::Prediction whole{predictions.front().rows, columns, {}};
  whole.channels.resize(predictions.front().channels.size());
  on_threads(parts, whole.channels.size(), [&](std::size_t c) {
    physics::PredictedChannel& first = predictions.front().channels[c];
    physics::PredictedChannel all{first.channel, first.temperature, std::move(first.values), {}};
    all.derivatives.resize(whole.rows * columns);
    for (std::size_t part = 0; part < parts; ++part) {
      const double* from = predictions[part].channels[c].derivatives.data();
      for (std::size_t k = 0; k < whole.rows; ++k) {
        double* row = all.derivatives.data() + k * columns;
        for (std::size_t at = part; at < columns; at += parts) row[at] = *from++;
      }
    }
    whole.channels[c] = std::move(all);
  });
  return whole;
}

}  // namespace zerodrift::diagnosis
