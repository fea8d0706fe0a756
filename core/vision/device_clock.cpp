#include "core/vision/device_clock.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::vision {
namespace {

constexpr double span_s = 60.0;
constexpr double largest_rate_error = 5e-4;  // of a crystal, with that of the host; five times the usual 100 ppm
constexpr double largest_leap_s = 5.0;       // of an arrival from the line: the clock was set

/// Above zero when c is left of the way from a to b: b stays below.
template <class Point>
double turn(const Point& a, const Point& b, const Point& c) {
  return (b.device_s - a.device_s) * (c.host_s - a.host_s) - (b.host_s - a.host_s) * (c.device_s - a.device_s);
}

}  // namespace

Seconds DeviceClock::to_host(Seconds device, Seconds arrived) {
  if (m_times.empty()) m_first_s = device.count();
  const Arrival now{device.count() - m_first_s, arrived.count()};
  const bool backwards = !m_times.empty() && now.device_s <= m_times.back();
  const bool leapt = !m_hull.empty() && std::abs((now.host_s - m_hull.back().host_s) -
                                                 (now.device_s - m_hull.back().device_s)) > largest_leap_s;
  if (backwards || leapt) {
    *this = DeviceClock();
    return to_host(device, arrived);
  }
  m_times.push_back(now.device_s);
  m_sum_s += now.device_s;
  while (m_times.front() < now.device_s - span_s) {
    m_sum_s -= m_times.front();
    m_times.pop_front();
  }
  // A hull without what is too old is the hull of the rest but for points that the old ones hid: fewer, never wrong.
  while (m_hull.size() > 1 && m_hull.front().device_s < now.device_s - span_s) m_hull.pop_front();
  while (m_hull.size() > 1 && turn(m_hull[m_hull.size() - 2], m_hull.back(), now) <= 0.0) m_hull.pop_back();
  m_hull.push_back(now);
  const double mean_s = m_sum_s / static_cast<double>(m_times.size());
  const auto behind = std::find_if(m_hull.begin(), m_hull.end(), [&](const Arrival& a) { return a.device_s > mean_s; });
  double rate = 1.0;
  if (behind != m_hull.begin() && behind != m_hull.end()) {
    const auto before = behind - 1;
    rate = (behind->host_s - before->host_s) / (behind->device_s - before->device_s);
    rate = std::clamp(rate, 1.0 - largest_rate_error, 1.0 + largest_rate_error);
  }
  double offset_s = now.host_s - rate * now.device_s;
  for (const Arrival& one : m_hull) offset_s = std::min(offset_s, one.host_s - rate * one.device_s);
  return Seconds(offset_s + rate * now.device_s);
}

}  // namespace zerodrift::vision
