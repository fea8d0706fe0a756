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

// Sums over (2 radius + 1)^2 windows, in place; beyond the border there is nothing.
void box_sums(std::vector<float>& map, int width, int height, int radius, std::vector<float>& scratch) {
  scratch.assign(map.size(), 0.0f);
  for (int y = 0; y < height; ++y) {
    const float* from = map.data() + static_cast<std::ptrdiff_t>(y) * width;
    float* to = scratch.data() + static_cast<std::ptrdiff_t>(y) * width;
    for (int shift = -radius; shift <= radius; ++shift) {
      for (int x = std::max(0, -shift); x < width - std::max(0, shift); ++x) to[x] += from[x + shift];
    }
  }
  std::vector<float> sum(static_cast<std::size_t>(width), 0.0f);
  const auto row = [&](int y) { return scratch.data() + static_cast<std::ptrdiff_t>(y) * width; };
  for (int y = -radius; y < height; ++y) {
    if (y + radius < height) {
      for (int x = 0; x < width; ++x) sum[x] += row(y + radius)[x];
    }
    if (y - radius - 1 >= 0) {
      for (int x = 0; x < width; ++x) sum[x] -= row(y - radius - 1)[x];
    }
    if (y >= 0) std::copy(sum.begin(), sum.end(), map.begin() + static_cast<std::ptrdiff_t>(y) * width);
  }
}

}  // namespace

NeighbourWeights::NeighbourWeights(const TemplateModel& model, double correlated)
    : m_model(model),
      m_correlated(static_cast<float>(correlated)),
      m_width(*std::max_element(model.column.begin(), model.column.end()) + 1),
      m_height(*std::max_element(model.row.begin(), model.row.end()) + 1) {}

void NeighbourWeights::judge(const Eigen::VectorXf& standard_errors, const Eigen::VectorXf& own_weights,
                             Eigen::VectorXf& out) {
  const std::size_t size = static_cast<std::size_t>(m_width) * m_height;
  for (std::vector<float>* map : {&m_known, &m_kept, &m_sum, &m_squares}) map->assign(size, 0.0f);
  const int n = m_model.pixels;
  for (int k = 0; k < n; ++k) {
    const std::size_t at = static_cast<std::size_t>(m_model.row[k]) * m_width + m_model.column[k];
    const float w = own_weights(k);
    m_known[at] = 1.0f;
    m_kept[at] = w;
    m_sum[at] = w * standard_errors(k);
    m_squares[at] = w * w;
  }
  box_sums(m_known, m_width, m_height, crowd_radius_px, m_scratch);
  box_sums(m_kept, m_width, m_height, crowd_radius_px, m_scratch);
  box_sums(m_sum, m_width, m_height, patch_radius_px, m_scratch);
  box_sums(m_squares, m_width, m_height, patch_radius_px, m_scratch);
  for (int k = 0; k < n; ++k) {
    const std::size_t at = static_cast<std::size_t>(m_model.row[k]) * m_width + m_model.column[k];
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
