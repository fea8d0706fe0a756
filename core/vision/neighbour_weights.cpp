#include "core/vision/neighbour_weights.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::vision {
namespace {

constexpr int crowd_radius_px = 2;    // of the window in which outliers are counted
constexpr int patch_radius_px = 4;    // of the window whose mean error is tested
constexpr float crowd_none = 0.45f;   // mean own weight at which a pixel counts no more
constexpr float crowd_full = 0.80f;   // and at which it counts fully; normal noise alone gives 0.91
constexpr float mean_limit = 5.0f;    // of the patch's mean over its standard deviation
constexpr float known_enough = 3.0f;  // fewer pixels say nothing

// to[x] = sum of from[x - radius .. x + radius].
template <int radius>
inline void add_along(const float* from, int count, float* to) {
  for (int x = 0; x < count; ++x) {
    float sum = from[x - radius];
    for (int shift = 1 - radius; shift <= radius; ++shift) sum += from[x + shift];
    to[x] = sum;
  }
}

// Sums over (2 radius + 1)^2 windows, in place, of a map with a border of zeros that is at least as wide.
template <int radius>
void box_sums(std::vector<float>& map, int stride, std::vector<float>& scratch) {
  scratch.assign(map.size(), 0.0f);
  const int height = static_cast<int>(map.size()) / stride;
  add_along<radius>(map.data() + radius, static_cast<int>(map.size()) - 2 * radius, scratch.data() + radius);
  std::vector<float> sum(static_cast<std::size_t>(stride), 0.0f);
  const auto row = [stride](std::vector<float>& of, int y) {
    return of.data() + static_cast<std::ptrdiff_t>(y) * stride;
  };
  for (int y = 0; y < radius; ++y) {
    for (int x = 0; x < stride; ++x) sum[x] += row(scratch, y)[x];
  }
  const std::vector<float> nothing(static_cast<std::size_t>(stride), 0.0f);
  for (int y = 0; y < height; ++y) {
    const float* ahead = y + radius < height ? row(scratch, y + radius) : nothing.data();
    const float* behind = y - radius - 1 >= 0 ? row(scratch, y - radius - 1) : nothing.data();
    float* to = row(map, y);
    for (int x = 0; x < stride; ++x) {
      sum[x] += ahead[x] - behind[x];
      to[x] = sum[x];
    }
  }
}

}  // namespace

NeighbourWeights::NeighbourWeights(const TemplateModel& model, double correlated)
    : m_model(model), m_correlated(static_cast<float>(correlated)), m_stride(model.width + 2 * patch_radius_px) {}

// What does not change from one call to the next.
void NeighbourWeights::prepare() {
  m_place.resize(static_cast<std::size_t>(m_model.pixels));
  m_known.assign(static_cast<std::size_t>(m_stride) * m_model.height, 0.0f);
  for (int k = 0; k < m_model.pixels; ++k) {
    m_place[k] = m_model.row[k] * m_stride + m_model.column[k] + patch_radius_px;
    m_known[m_place[k]] = 1.0f;
  }
  box_sums<crowd_radius_px>(m_known, m_stride, m_scratch);
}

void NeighbourWeights::judge(const Eigen::VectorXf& standard_errors, const Eigen::VectorXf& own_weights,
                             Eigen::VectorXf& out) {
  if (m_place.empty()) prepare();
  for (std::vector<float>* map : {&m_kept, &m_sum, &m_squares}) map->assign(m_known.size(), 0.0f);
  const int n = m_model.pixels;
  for (int k = 0; k < n; ++k) {
    const std::size_t at = static_cast<std::size_t>(m_place[k]);
    const float w = own_weights(k);
    m_kept[at] = w;
    m_sum[at] = w * standard_errors(k);
    m_squares[at] = w * w;
  }
  box_sums<crowd_radius_px>(m_kept, m_stride, m_scratch);
  box_sums<patch_radius_px>(m_sum, m_stride, m_scratch);
  box_sums<patch_radius_px>(m_squares, m_stride, m_scratch);
  for (int k = 0; k < n; ++k) {
    const std::size_t at = static_cast<std::size_t>(m_place[k]);
    float weight = 1.0f;
    if (m_known[at] >= known_enough) {
      weight = std::clamp((m_kept[at] / m_known[at] - crowd_none) / (crowd_full - crowd_none), 0.0f, 1.0f);
    }
    if (m_squares[at] > 0.0f) {
      const float u2 = m_sum[at] * m_sum[at] / (m_squares[at] * m_correlated * mean_limit * mean_limit);
      const float left = std::max(0.0f, 1.0f - u2);
      weight *= left * left;
    }
    out(k) = weight;
  }
}

}  // namespace zerodrift::vision
