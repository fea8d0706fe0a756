#include "core/compensation/window_fit.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace zerodrift::compensation {
namespace {

// Sums from the start lose digits on short stretches far away: within this of the limit the stretch is fitted anew.
constexpr double in_doubt = 1e-6;

std::vector<double> from_mean(const std::vector<double>& values) {
  const double mean = std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
  std::vector<double> out;
  out.reserve(values.size());
  for (const double value : values) out.push_back(value - mean);
  return out;
}

}  // namespace

WindowFit::WindowFit(const std::vector<double>& u, const std::vector<double>& v)
    : m_u(from_mean(u)), m_v(from_mean(v)), m_sums(1) {
  m_sums.reserve(u.size() + 1);
  for (std::size_t i = 0; i < u.size(); ++i) {
    Sums sum = m_sums.back();
    const long double a = m_u[i];
    const long double b = m_v[i];
    sum.u += a;
    sum.v += b;
    sum.uu += a * a;
    sum.uv += a * b;
    sum.vv += b * b;
    m_sums.push_back(sum);
  }
}

WindowFit::Moments WindowFit::moments(std::size_t first, std::size_t count) const {
  const Sums& low = m_sums[first];
  const Sums& high = m_sums[first + count];
  const auto n = static_cast<long double>(count);
  const long double u = high.u - low.u;
  const long double v = high.v - low.v;
  return {std::max(0.0, static_cast<double>(high.uu - low.uu - u * u / n)),
          static_cast<double>(high.uv - low.uv - u * v / n),
          std::max(0.0, static_cast<double>(high.vv - low.vv - v * v / n))};
}

WindowFit::Moments WindowFit::exact(std::size_t first, std::size_t count) const {
  const auto n = static_cast<double>(count);
  double mean_u = 0.0;
  double mean_v = 0.0;
  for (std::size_t i = first; i < first + count; ++i) {
    mean_u += m_u[i] / n;
    mean_v += m_v[i] / n;
  }
  Moments out;
  for (std::size_t i = first; i < first + count; ++i) {
    out.uu += (m_u[i] - mean_u) * (m_u[i] - mean_u);
    out.uv += (m_u[i] - mean_u) * (m_v[i] - mean_v);
    out.vv += (m_v[i] - mean_v) * (m_v[i] - mean_v);
  }
  return out;
}

bool WindowFit::passes(std::size_t first, std::size_t count, double limit) const {
  Moments m = moments(first, count);
  const double wanted = limit * m.uu * m.vv;
  if (m.uv * m.uv < (1.0 - in_doubt) * wanted) return false;
  if (m.uv * m.uv > (1.0 + in_doubt) * wanted && wanted > 0.0) return true;
  m = exact(first, count);
  return m.vv > 0.0 && m.uv * m.uv >= limit * m.uu * m.vv;
}

bool WindowFit::ruled_out(std::size_t first, std::size_t low, std::size_t high, double limit) const {
  const Moments a = moments(first, low);
  const Moments b = moments(first, high);
  const double most = std::abs(a.uv) + std::sqrt(std::max(0.0, b.uu - a.uu) * std::max(0.0, b.vv - a.vv));
  return most * most < (1.0 - in_doubt) * limit * a.uu * a.vv;
}

std::size_t WindowFit::largest_count(std::size_t first, std::size_t most, double threshold) {
  const double limit = threshold * threshold;
  std::size_t high = most;
  while (high >= 3) {
    if (passes(first, high, limit)) return high;
    --high;
    for (m_stride *= 2; high >= 3; m_stride /= 2) {
      m_stride = std::clamp<std::size_t>(m_stride, 1, high - 2);
      if (ruled_out(first, high - m_stride + 1, high, limit)) {
        high -= m_stride;
        m_stride *= 4;  // and go on as far as it carries
      } else if (m_stride == 1) {
        break;
      }
    }
  }
  return 0;
}

}  // namespace zerodrift::compensation
