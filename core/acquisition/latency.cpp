#include "core/acquisition/latency.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::acquisition {
namespace {

constexpr int enough_moves = 6;
constexpr double latency_coverage = 3.0;  // standard deviations of the single moves
// A latency that was exceeded once by this much may be exceeded by as much again.
constexpr double widening = 1.25;

}  // namespace

bool LatencyWatch::add(const LatencyBounds& bounds) {
  const double shortest_s = std::max(0.0, bounds.shortest_s);
  const bool older = shortest_s > m_latency.settle().count();
  if (older) {
    const double longest_s = widening * shortest_s;
    m_latency.spread_s = longest_s - m_latency.mean_s;
  }
  if (m_latency.observations == 0) {
    learn({shortest_s, std::max(shortest_s, bounds.longest_s)});
  } else {
    ++m_latency.observations;
  }
  return older;
}

void LatencyWatch::learn(const LatencyBounds& bounds) {
  const double middle_s = 0.5 * (bounds.shortest_s + bounds.longest_s);
  ++m_seen;
  m_sum_s += middle_s;
  m_squares_s2 += middle_s * middle_s;
  m_longest_s = std::max(m_longest_s, bounds.longest_s);
  if (m_seen < enough_moves) return;
  m_latency.mean_s = m_sum_s / m_seen;
  const double variance_s2 = std::max(0.0, m_squares_s2 / m_seen - m_latency.mean_s * m_latency.mean_s);
  m_latency.spread_s = std::max(m_longest_s - m_latency.mean_s, latency_coverage * std::sqrt(variance_s2));
  m_latency.observations = m_seen;
}

}  // namespace zerodrift::acquisition
