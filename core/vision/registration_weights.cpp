// How much each pixel counts in a registration: by its noise, its error and its neighbours.

#include <algorithm>
#include <array>
#include <cmath>

#include "core/vision/registration_solver.h"

namespace zerodrift::vision {
namespace {

constexpr double robust_deviation = 1.4826;  // over the median size, of normal errors
constexpr float near_median = 0.1f;
constexpr double middle_grey = 128.0;
constexpr double usual_read_variance = 25.0;  // of the noise at black in units of that of one grey level: shot noise
constexpr double least_read_variance = 5.0;
constexpr double largest_read_variance = 500.0;  // practically the same noise at all levels
constexpr double tukey_wide = 7.0;               // while the motion settles, and when there are no outliers
constexpr double tukey_narrow = 4.7;             // 95 % efficient for normal noise
constexpr double outlier_sigmas = 4.0;
constexpr double outlier_share = 0.0015;  // of the pixels: normal noise has 0.00006 beyond 4 sigma
constexpr double least_weight = 0.4;      // of the pixels' own weight must be left by their neighbours
constexpr double least_gain = 0.5;        // of the mean: so little light falls on no part of a target
constexpr double most_unlit = 0.01;       // of the pixels
constexpr int scale_samples = 4000;       // of the errors are enough for their median
constexpr std::size_t least_pixels = 100;

double median_of(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// 1 / variance: that of shot noise and of noise at black, which counts as much as `read` grey levels.
Eigen::VectorXf noise_weights(const Eigen::Ref<const Eigen::VectorXf>& levels, double read) {
  return static_cast<float>(middle_grey + read) / (levels.array().max(0.0f) + static_cast<float>(read));
}

}  // namespace

void RegistrationSolver::start_weights() {
  m_tukey = tukey_narrow;
  set_noise(usual_read_variance);
}

void RegistrationSolver::set_noise(double read) {
  m_noise_weight = noise_weights(Eigen::Map<const Eigen::VectorXf>(m_model.value.data(), m_model.pixels), read);
  m_noise_root = m_noise_weight.cwiseSqrt();
}

// How the noise grows with the level, from the errors themselves: their median square in classes of levels, fitted by
// a straight line.
void RegistrationSolver::find_noise_model(int count) {
  constexpr int classes = 8;
  std::array<std::vector<float>, classes> errors;
  std::array<double, classes> level{};
  for (int k = 0; k < count; ++k) {
    if (m_pixel_state[k] != FramePatch::seen) continue;
    const int at = std::clamp(static_cast<int>(m_model.value[k] * classes / 256.0f), 0, classes - 1);
    errors[at].push_back(std::abs(m_error(k)));
    level[at] += m_model.value[k];
  }
  // Least squares of variance = b (level + read), twice: the second time weighted with what the first found.
  double read = usual_read_variance;
  for (int round = 0; round < 2; ++round) {
    Eigen::Matrix2d normal = Eigen::Matrix2d::Zero();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (int c = 0; c < classes; ++c) {
      if (errors[c].size() < least_pixels / 2) continue;
      const double n = static_cast<double>(errors[c].size());
      const double variance = std::pow(robust_deviation * median_of(errors[c]), 2);
      const Eigen::Vector2d row(level[c] / n, 1.0);
      const double weight = n / std::pow(row(0) + read, 2);
      normal += weight * row * row.transpose();
      right += weight * variance * row;
    }
    const double determinant = normal.determinant();
    if (determinant < 1e-6 * normal(0, 0) * normal(1, 1)) return;  // one level only: nothing to learn
    const Eigen::Vector2d fit = normal.inverse() * right;
    if (!fit.allFinite() || fit.maxCoeff() <= 0.0) return;
    read =
        fit(0) <= 0.0 ? largest_read_variance : std::clamp(fit(1) / fit(0), least_read_variance, largest_read_variance);
  }
  set_noise(read);
}

// Robust standard deviation of the errors in units of the noise model; 0 when too few pixels are left. From one step to
// the next it changes little: the median is sought among what lies near the last one, and is the same.
double RegistrationSolver::scale_of_errors(int count) {
  const auto last = static_cast<float>(m_scale / robust_deviation);
  const float low = (1.0f - near_median) * last;
  const float high = (1.0f + near_median) * last;
  const int stride = std::max(1, count / scale_samples);
  m_scratch.resize(static_cast<std::size_t>(count / stride) + 1);
  std::size_t all = 0, below = 0, near = 0;
  for (int k = 0; k < count; k += stride) {  // without branches, which would be guessed wrongly
    const float size = std::abs(m_error(k)) * m_noise_root(k);
    const bool seen = m_pixel_state[k] == FramePatch::seen;
    all += seen;
    below += seen & (size < low);
    m_scratch[near] = size;
    near += seen & (size >= low) & (size <= high);
  }
  m_scratch.resize(near);
  if (all < least_pixels) return 0.0;
  const std::size_t rank = all / 2;
  if (rank < below || rank - below >= m_scratch.size()) {
    m_scratch.clear();
    below = 0;
    for (int k = 0; k < count; k += stride) {
      if (m_pixel_state[k] == FramePatch::seen) m_scratch.push_back(std::abs(m_error(k)) * m_noise_root(k));
    }
  }
  const auto middle = m_scratch.begin() + static_cast<std::ptrdiff_t>(rank - below);
  std::nth_element(m_scratch.begin(), middle, m_scratch.end());
  return std::max(robust_deviation * *middle + 1e-3, std::sqrt(m_least_variance));
}

// The pixels' weights from the present errors.
void RegistrationSolver::weigh(int count, bool ask_neighbours) {
  const double tukey = m_all_pixels ? m_tukey : tukey_wide;
  const auto inverse = static_cast<float>(1.0 / (tukey * m_scale));
  static_assert(FramePatch::seen == 0);
  tukey_weights(m_error.data(), m_noise_root.data(), inverse, m_pixel_state.data(), count, m_robust.data());
  leave_out_unlit(count);
  if (ask_neighbours) {
    const Eigen::VectorXf standard = m_error.cwiseProduct(m_noise_root) / static_cast<float>(m_scale);
    m_judge.judge(standard, m_robust, m_neighbours);
    // A model that fits nowhere has suspicious patches everywhere: then they say nothing.
    if (m_neighbours.dot(m_robust) < least_weight * m_robust.sum()) m_neighbours.setOnes();
  }
  m_weight.head(count) =
      m_robust.head(count).cwiseProduct(m_neighbours.head(count)).cwiseProduct(m_noise_weight.head(count));
}

// A plane of gain that falls to nothing makes an even cover of the target: it explains all of the cover, and its edge
// then draws the target. What would be lit so little says nothing of the target.
void RegistrationSolver::leave_out_unlit(int count) {
  const Eigen::Vector3f light = m_light.head<3>().cast<float>();
  const Eigen::Vector3f at_mean(1.0f, m_mean_place(0), m_mean_place(1));
  const float limit = static_cast<float>(least_gain) * light.dot(at_mean);
  const float along = light(1) / static_cast<float>(registration_length_px);
  const float down = light(2) / static_cast<float>(registration_length_px);
  int dark = 0;
  for (int k = 0; k < count; ++k) {
    const bool unlit = light(0) + along * m_model.x[k] + down * m_model.y[k] < limit;
    dark += unlit;
    m_robust(k) = unlit ? 0.0f : m_robust(k);
  }
  m_partly_unlit = dark > most_unlit * count;
  m_was_partly_unlit = m_was_partly_unlit || m_partly_unlit;
}

// Without outliers nothing need be paid for robustness.
void RegistrationSolver::choose_tukey() {
  const Eigen::ArrayXf standard = m_error.cwiseProduct(m_noise_root).array().abs() / static_cast<float>(m_scale);
  const auto far = (standard > static_cast<float>(outlier_sigmas)).count();
  const auto not_seen = std::count_if(m_pixel_state.begin(), m_pixel_state.end(),
                                      [](std::uint8_t state) { return state != FramePatch::seen; });
  const bool clean = static_cast<double>(far + not_seen) < outlier_share * m_model.pixels;
  m_tukey = clean ? tukey_wide : tukey_narrow;
}

}  // namespace zerodrift::vision
