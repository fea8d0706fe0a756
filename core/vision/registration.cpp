#include "core/vision/registration.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "core/vision/opencv_image.h"

namespace zerodrift::vision {
namespace {

constexpr int patch_margin_px = 18;     // around the region: rotation, blur and the spline's support
constexpr double reach_px = 8.0;        // the coarse search is never further off
constexpr double length_px = 100.0;     // scale of coordinates in the linear columns, for conditioning
constexpr double linear_prior = 0.02;   // standard deviation of the affine part: keeps rings, which cannot see rotation
constexpr double read_variance = 12.0;  // of the noise at black in units of that of one grey level: shot noise model
constexpr double tukey_wide = 7.0;      // while the motion settles
constexpr double tukey_narrow = 4.7;    // 95 % efficient for normal noise
constexpr int saturated_level = 252;
constexpr double blur_limit_px2 = 0.12;    // a larger change of blur is put into the images and solved again
constexpr double largest_blur_px2 = 40.0;  // trace of the covariance
constexpr double settled_px = 3e-5;
constexpr int settle_iterations = 5;
constexpr int largest_iterations = 24;

// Columns of the solve.
enum Column { tx, ty, axx, axy, ayx, ayy, gain, gain_x, gain_y, offset, bxx, bxy, byy, column_count };
constexpr int motion_count = 6;
constexpr int light_count = column_count - motion_count;

using Normal = Eigen::Matrix<double, column_count, column_count>;
using Vector = Eigen::Matrix<double, column_count, 1>;
using Rows = Eigen::Matrix<float, column_count, Eigen::Dynamic>;

// The part of a frame in which the target is sought, blurred and as a spline, with its unusable pixels.
struct Patch {
  Patch(const GrayImage& frame, const Region& at, const Eigen::Matrix2d& blur_px2)
      : spline(blurred(crop(frame, at), blur_px2)), state(static_cast<std::size_t>(at.width) * at.height, seen) {
    cv::Mat saturated(at.height, at.width, CV_8U, cv::Scalar(0));
    for (int y = 0; y < at.height; ++y) {
      for (int x = 0; x < at.width; ++x) {
        const int fx = at.x + x;
        const int fy = at.y + y;
        if (fx < 0 || fy < 0 || fx >= frame.width || fy >= frame.height) {
          state[static_cast<std::size_t>(y) * at.width + x] = outside;
        } else if (frame.at(fx, fy) >= saturated_level) {
          saturated.at<std::uint8_t>(y, x) = 1;
        }
      }
    }
    const int reach = 2 + static_cast<int>(std::ceil(std::sqrt(blur_px2.trace())));
    cv::dilate(saturated, saturated, cv::Mat::ones(2 * reach + 1, 2 * reach + 1, CV_8U));
    for (std::size_t k = 0; k < state.size(); ++k) {
      if (state[k] == seen && saturated.data[k] != 0) state[k] = too_bright;
    }
  }

  enum State : std::uint8_t { seen, outside, too_bright };
  SplineImage spline;
  std::vector<std::uint8_t> state;
};

double median_of(std::vector<float>& values) {
  if (values.empty()) return 0.0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Solver {
 public:
  Solver(const TemplateModel& model, const Patch& patch, Eigen::Vector2d start_px, Eigen::Matrix2d start_linear,
         int region_to_patch_px)
      : m_model(model), m_patch(patch), m_shift(start_px), m_linear(start_linear), m_offset(region_to_patch_px) {
    const int n = model.pixels;
    m_rows.resize(column_count, n);
    m_frame.resize(n);
    m_error.resize(n);
    m_weight.resize(n);
    m_robust.resize(n);
    m_noise_weight.resize(n);
    m_pixel_state.resize(n);
    for (int k = 0; k < n; ++k) fill_row(k);
    m_light.setZero();
    m_light(0) = 1.0;
  }

  bool run();
  Registration result() const;
  const Eigen::Vector2d& shift() const { return m_shift; }
  const Eigen::Matrix2d& linear() const { return m_linear; }
  /// Covariance by which the frame is more blurred than the template.
  Eigen::Matrix2d extra_blur_px2() const {
    const Eigen::Vector3d q = m_light.tail<3>() / std::max(m_light(0), 0.05);
    return (Eigen::Matrix2d() << 2.0 * q(0), q(1), q(1), 2.0 * q(2)).finished();
  }

 private:
  void fill_row(int k);
  void sample(int count);
  void predict(int count);
  bool start_light(int count);
  double weigh(int count, double tukey);
  bool step(int count);

  const TemplateModel& m_model;
  const Patch& m_patch;
  Eigen::Vector2d m_shift;  // of the named point, from the region's place in the patch
  Eigen::Matrix2d m_linear;
  int m_offset;
  Eigen::Matrix<double, light_count, 1> m_light;
  Rows m_rows;
  Eigen::VectorXf m_frame, m_error, m_weight, m_robust, m_noise_weight;
  std::vector<std::uint8_t> m_pixel_state;
  std::vector<float> m_scratch;
  Normal m_normal = Normal::Zero();
  double m_scale = 1.0;
  double m_last_step_px = 1.0;
  int m_iterations = 0;
};

void Solver::fill_row(int k) {
  const float x = m_model.x[k] / static_cast<float>(length_px);
  const float y = m_model.y[k] / static_cast<float>(length_px);
  const float fx = m_model.fx[k];
  const float fy = m_model.fy[k];
  const float f = m_model.value[k];
  m_rows.col(k) << fx, fy, fx * x, fx * y, fy * x, fy * y, f, f * x, f * y, 1.0f, m_model.fxx[k], m_model.fxy[k],
      m_model.fyy[k];
  m_noise_weight(k) = 1.0f / (std::max(f, 0.0f) + static_cast<float>(read_variance));
}

// The frame's value at each pixel of the template moved by the present motion.
void Solver::sample(int count) {
  const auto a = static_cast<float>(m_linear(0, 0) - 1.0);
  const auto b = static_cast<float>(m_linear(0, 1));
  const auto c = static_cast<float>(m_linear(1, 0));
  const auto d = static_cast<float>(m_linear(1, 1) - 1.0);
  const auto sx = static_cast<float>(m_shift(0));
  const auto sy = static_cast<float>(m_shift(1));
  const int last_column = m_patch.spline.width() - 4;
  const int last_row = m_patch.spline.height() - 4;
  for (int k = 0; k < count; ++k) {
    const float ux = sx + a * m_model.x[k] + b * m_model.y[k];
    const float uy = sy + c * m_model.x[k] + d * m_model.y[k];
    const float whole_x = std::floor(ux);
    const float whole_y = std::floor(uy);
    const int column = m_model.column[k] + m_offset + static_cast<int>(whole_x);
    const int row = m_model.row[k] + m_offset + static_cast<int>(whole_y);
    if (column < 2 || row < 2 || column > last_column || row > last_row) {
      m_pixel_state[k] = Patch::outside;
      m_frame(k) = 0.0f;
      continue;
    }
    m_frame(k) = m_patch.spline.at(column, ux - whole_x, row, uy - whole_y);
    m_pixel_state[k] = m_patch.state[static_cast<std::size_t>(row) * m_patch.spline.width() + column];
  }
}

void Solver::predict(int count) {
  const Eigen::Matrix<float, light_count, 1> light = m_light.cast<float>();
  m_error.head(count).noalias() =
      m_frame.head(count) - m_rows.block(motion_count, 0, light_count, count).transpose() * light;
}

// Robust start of the light alone, so that a shadow or a highlight does not throw the first motion step.
bool Solver::start_light(int count) {
  m_weight.head(count) = m_noise_weight.head(count);
  for (int k = 0; k < count; ++k) {
    if (m_pixel_state[k] != Patch::seen) m_weight(k) = 0.0f;
  }
  using Light = Eigen::Matrix<double, light_count, light_count>;
  for (int round = 0; round < 6; ++round) {
    const auto rows = m_rows.block(motion_count, 0, light_count, count);
    const Eigen::Matrix<float, light_count, Eigen::Dynamic> weighted =
        rows.array().rowwise() * m_weight.head(count).transpose().array();
    Light normal = (weighted * rows.transpose()).cast<double>();
    const Eigen::Matrix<double, light_count, 1> right = (weighted * m_frame.head(count)).cast<double>();
    normal.diagonal() += 1e-6 * normal.diagonal();
    const Eigen::LDLT<Light> solved(normal);
    if (solved.info() != Eigen::Success) return false;
    m_light = solved.solve(right);
    predict(count);
    m_scratch.clear();
    for (int k = 0; k < count; ++k) {
      if (m_pixel_state[k] == Patch::seen) m_scratch.push_back(std::abs(m_error(k)));
    }
    if (m_scratch.size() < 100) return false;
    const float scale = static_cast<float>(1.4826 * median_of(m_scratch) + 0.3);
    for (int k = 0; k < count; ++k) {
      const float u = m_error(k) / (2.0f * scale);
      m_weight(k) = m_pixel_state[k] == Patch::seen ? m_noise_weight(k) / (1.0f + u * u) : 0.0f;
    }
  }
  return m_light.allFinite();
}

// Sets the weights; returns the robust scale of the residual, or 0 when too little is left.
double Solver::weigh(int count, double tukey) {
  m_scratch.clear();
  for (int k = 0; k < count; ++k) {
    if (m_pixel_state[k] == Patch::seen) m_scratch.push_back(std::abs(m_error(k)) * std::sqrt(m_noise_weight(k)));
  }
  if (m_scratch.size() < 100) return 0.0;
  const double scale = 1.4826 * median_of(m_scratch) + 1e-3;
  const float inverse = static_cast<float>(1.0 / (tukey * scale));
  for (int k = 0; k < count; ++k) {
    const float u = m_error(k) * std::sqrt(m_noise_weight(k)) * inverse;
    const float left = std::max(0.0f, 1.0f - u * u);
    m_robust(k) = m_pixel_state[k] == Patch::seen ? left * left : 0.0f;
    m_weight(k) = m_robust(k) * m_noise_weight(k);
  }
  return scale;
}

bool Solver::step(int count) {
  sample(count);
  predict(count);
  m_scale = weigh(count, m_iterations > settle_iterations ? tukey_narrow : tukey_wide);
  ++m_iterations;
  if (m_scale == 0.0) return false;
  const auto rows = m_rows.leftCols(count);
  const Rows weighted = rows.array().rowwise() * m_weight.head(count).transpose().array();
  m_normal = (weighted * rows.transpose()).cast<double>();
  Vector right = (weighted * m_error.head(count)).cast<double>();
  Vector motion_gain = Vector::Ones();
  motion_gain.head<motion_count>().setConstant(m_light(0));
  m_normal = motion_gain.asDiagonal() * m_normal * motion_gain.asDiagonal();
  right = motion_gain.cwiseProduct(right);
  const double prior = m_scale * m_scale / (length_px * linear_prior) / (length_px * linear_prior);
  const Eigen::Vector4d away(m_linear(0, 0) - 1.0, m_linear(0, 1), m_linear(1, 0), m_linear(1, 1) - 1.0);
  right.segment<4>(axx) += prior * length_px * away;
  m_normal.diagonal().segment<4>(axx).array() += prior;
  m_normal.diagonal() *= 1.0 + 1e-9;
  const Eigen::LDLT<Normal> solved(m_normal);
  if (solved.info() != Eigen::Success) return false;
  const Vector p = solved.solve(right);
  if (!p.allFinite()) return false;
  m_light += p.tail<light_count>();
  Eigen::Matrix2d change;
  change << 1.0 + p(axx) / length_px, p(axy) / length_px, p(ayx) / length_px, 1.0 + p(ayy) / length_px;
  m_linear = m_linear * change.inverse();
  m_shift -= m_linear * p.head<2>();
  m_last_step_px = p.head<2>().norm();
  return m_linear.allFinite() && (m_linear - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff() < 0.5;
}

bool Solver::run() {
  const Eigen::Vector2d start = m_shift;
  const int few = m_model.pixels / 4;  // the first quarter is spread evenly over the region
  sample(few);
  if (!start_light(few)) return false;
  for (int k = 0; k < settle_iterations; ++k) {
    if (!step(few) || (m_shift - start).norm() > reach_px) return false;
    if (m_last_step_px < 2e-3) break;
  }
  m_iterations = settle_iterations + 1;
  while (m_iterations < largest_iterations) {
    if (!step(m_model.pixels) || (m_shift - start).norm() > reach_px) return false;
    if (m_last_step_px < settled_px) break;
  }
  return m_last_step_px < 1e-2;
}

Registration Solver::result() const {
  Registration out;
  const int n = m_model.pixels;
  double sum_w = 0.0, sum_m = 0.0, sum_g = 0.0, psi2 = 0.0, slope = 0.0, energy = 0.0, kept_energy = 0.0;
  int inliers = 0, seen = 0, bright = 0, used = 0;
  for (int k = 0; k < n; ++k) {
    const double w = m_robust(k);
    const double z = m_error(k) * std::sqrt(m_noise_weight(k));
    const double u = z / (tukey_narrow * m_scale);
    sum_w += w;
    sum_m += w * (m_frame(k) - m_error(k));
    sum_g += w * m_frame(k);
    psi2 += w * z * w * z;
    if (w > 0.0) slope += (1.0 - u * u) * (1.0 - 5.0 * u * u);
    if (w > 0.0) ++used;
    const double e = double{m_model.fx[k]} * m_model.fx[k] + double{m_model.fy[k]} * m_model.fy[k];
    energy += e;
    if (w > 0.25) kept_energy += e;
    inliers += w > 0.25;
    seen += m_pixel_state[k] != Patch::outside;
    bright += m_pixel_state[k] == Patch::too_bright;
  }
  double mm = 0.0, gg = 0.0, mg = 0.0;
  for (int k = 0; k < n; ++k) {
    const double w = m_robust(k);
    const double m = m_frame(k) - m_error(k) - sum_m / sum_w;
    const double g = m_frame(k) - sum_g / sum_w;
    mm += w * m * m;
    gg += w * g * g;
    mg += w * m * g;
  }
  out.converged = true;
  out.linear = m_linear;
  out.displacement_px = m_shift;
  out.correlation = mg / std::sqrt(mm * gg + 1e-9);
  out.inlier_share = static_cast<double>(inliers) / n;
  out.informed_share = kept_energy / energy;
  out.seen_share = static_cast<double>(seen) / n;
  out.saturated_share = static_cast<double>(bright) / n;
  out.contrast = m_light(0);
  out.residual = m_scale;
  out.iterations = m_iterations;
  // Huber's covariance of an M-estimate: E psi^2 / (E psi')^2; the weights alone would flatter by some 7 %.
  const double variance = psi2 / std::max(used - static_cast<int>(column_count), 1) * used / sum_w;
  const double shrink = sum_w / std::max(slope, 0.1 * sum_w);
  const Eigen::Matrix2d inverse = m_normal.inverse().topLeftCorner<2, 2>();
  const Eigen::Vector2d growth(std::sqrt(m_model.noise_growth_x), std::sqrt(m_model.noise_growth_y));
  out.covariance_px2 = growth.asDiagonal() * inverse * growth.asDiagonal() * (variance * shrink * shrink);
  return out;
}

}  // namespace

Registrar::Registrar(TemplateSource source)
    : m_source(std::move(source)), m_model(make_template_model(m_source, 0.25 * Eigen::Matrix2d::Identity())) {}

Registration Registrar::run(const GrayImage& frame, int dx_px, int dy_px) const {
  const Region& region = m_source.region;
  const Region at{region.x + dx_px - patch_margin_px, region.y + dy_px - patch_margin_px,
                  region.width + 2 * patch_margin_px, region.height + 2 * patch_margin_px};
  Eigen::Matrix2d template_blur = m_model.blur_px2;
  Eigen::Matrix2d frame_blur = m_model.blur_px2;
  std::optional<TemplateModel> blurred_model;
  Eigen::Vector2d shift = Eigen::Vector2d::Zero();
  Eigen::Matrix2d linear = Eigen::Matrix2d::Identity();
  Registration out;
  for (int round = 0; round < 3; ++round) {
    const Patch patch(frame, at, frame_blur);
    Solver solver(blurred_model ? *blurred_model : m_model, patch, shift, linear, patch_margin_px);
    if (!solver.run()) return {};
    out = solver.result();
    shift = solver.shift();
    linear = solver.linear();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> extra(solver.extra_blur_px2());
    const Eigen::Vector2d change = extra.eigenvalues();
    const Eigen::Matrix2d axes = extra.eigenvectors();
    if (change.cwiseAbs().maxCoeff() < blur_limit_px2) break;
    // The sharper of the two images is blurred until both are alike; then the curvature columns have little left to do.
    template_blur += axes * change.cwiseMax(0.0).asDiagonal() * axes.transpose();
    frame_blur += axes * (-change).cwiseMax(0.0).asDiagonal() * axes.transpose();
    if (std::max(template_blur.trace(), frame_blur.trace()) > largest_blur_px2) break;
    blurred_model = make_template_model(m_source, template_blur);
  }
  const Eigen::Matrix2d difference = template_blur - frame_blur;
  out.blur_px2 = difference.trace() / 2.0;
  out.displacement_px += Eigen::Vector2d(dx_px, dy_px);
  return out;
}

}  // namespace zerodrift::vision
