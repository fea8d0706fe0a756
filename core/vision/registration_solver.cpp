#include "core/vision/registration_solver.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace zerodrift::vision {
namespace {

constexpr double reach_px = 8.0;        // the coarse search is never further off
constexpr double length_px = 100.0;     // scale of coordinates in the linear columns, for conditioning
constexpr double lens_unit = 1e-8;      // of the lens column, likewise
constexpr double linear_prior = 0.02;   // standard deviation of the affine part: keeps rings, which cannot see rotation
constexpr double read_variance = 12.0;  // of the noise at black in units of that of one grey level: shot noise model
constexpr double tukey_wide = 7.0;      // while the motion settles
constexpr double tukey_narrow = 4.7;    // 95 % efficient for normal noise
constexpr double field_prior_levels = 60.0;
constexpr double settled_px = 3e-5;
constexpr double nearly_settled_px = 2e-3;
constexpr int light_rounds = 6;
constexpr int settle_iterations = 5;
constexpr int largest_iterations = 24;
constexpr std::size_t least_pixels = 100;
constexpr int tiles_a_side = 8;

double median_of(std::vector<float>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

RegistrationSolver::RegistrationSolver(const TemplateModel& model, const FramePatch& patch, const SmoothField* field,
                                       const RegistrationStart& start)
    : m_model(model),
      m_patch(patch),
      m_field(field),
      m_whole_px(start.whole_px),
      m_shift(start.shift_px),
      m_linear(start.linear),
      m_prior(start.lens),
      m_lens(start.lens.per_px2),
      m_normal(Normal::Zero()) {
  const int n = model.pixels;
  m_rows.resize(column_count, n);
  for (Eigen::VectorXf* one : {&m_frame, &m_error, &m_weight, &m_robust, &m_noise_weight}) one->setZero(n);
  m_pixel_state.assign(static_cast<std::size_t>(n), FramePatch::seen);
  for (int k = 0; k < n; ++k) fill_row(k);
  m_light.setZero();
  m_light(0) = 1.0;
  if (m_field != nullptr) m_field_levels.setZero(m_field->size());
}

Eigen::Matrix2d RegistrationSolver::extra_blur_px2() const {
  const Eigen::Vector3d q = m_light.tail<3>() / std::max(m_light(0), 0.05);
  return (Eigen::Matrix2d() << 2.0 * q(0), q(1), q(1), 2.0 * q(2)).finished();
}

void RegistrationSolver::fill_row(int k) {
  const float x = m_model.x[k] / static_cast<float>(length_px);
  const float y = m_model.y[k] / static_cast<float>(length_px);
  const float fx = m_model.fx[k];
  const float fy = m_model.fy[k];
  const float f = m_model.value[k];
  m_rows.col(k) << fx, fy, fx * x, fx * y, fy * x, fy * y, 0.0f, f, f * x, f * y, 1.0f, m_model.fxx[k], m_model.fxy[k],
      m_model.fyy[k];
  m_noise_weight(k) = 1.0f / (std::max(f, 0.0f) + static_cast<float>(read_variance));
}

// The frame's value at each pixel of the template moved by the present motion.
void RegistrationSolver::sample(int count) {
  const Eigen::Matrix2f turn = (m_linear - Eigen::Matrix2d::Identity()).cast<float>();
  const Eigen::Vector2f shift = m_shift.cast<float>();
  // The lens moves a pixel at w from the point by 2 (w s) w + |w|^2 s times its constant, s being the displacement.
  const Eigen::Vector2f way = ((m_whole_px + m_shift) * lens_unit).cast<float>();
  const auto bent = static_cast<float>(m_lens / lens_unit);
  const int last_column = m_patch.spline.width() - 4;
  const int last_row = m_patch.spline.height() - 4;
  for (int k = 0; k < count; ++k) {
    const float x = m_model.x[k];
    const float y = m_model.y[k];
    const float along = 2.0f * (x * way(0) + y * way(1));
    const float squares = x * x + y * y;
    const float bend_x = along * x + squares * way(0);
    const float bend_y = along * y + squares * way(1);
    m_rows(bend, k) = m_model.fx[k] * bend_x + m_model.fy[k] * bend_y;
    const float ux = shift(0) + turn(0, 0) * x + turn(0, 1) * y + bent * bend_x;
    const float uy = shift(1) + turn(1, 0) * x + turn(1, 1) * y + bent * bend_y;
    const float whole_x = std::floor(ux);
    const float whole_y = std::floor(uy);
    const int column = m_model.column[k] + patch_margin_px + static_cast<int>(whole_x);
    const int row = m_model.row[k] + patch_margin_px + static_cast<int>(whole_y);
    if (column < 2 || row < 2 || column > last_column || row > last_row) {
      m_pixel_state[k] = FramePatch::outside;
      m_frame(k) = 0.0f;
      continue;
    }
    m_frame(k) = m_patch.spline.at(column, ux - whole_x, row, uy - whole_y);
    m_pixel_state[k] = m_patch.state[static_cast<std::size_t>(row) * m_patch.spline.width() + column];
  }
}

void RegistrationSolver::predict(int count) {
  const Eigen::Matrix<float, light_count, 1> light = m_light.cast<float>();
  m_error.head(count).noalias() =
      m_frame.head(count) - m_rows.block(motion_count, 0, light_count, count).transpose() * light;
  if (m_field != nullptr) m_field->subtract_from(m_error, count, m_field_levels);
}

// Robust standard deviation of the errors in units of the noise model; 0 when too few pixels are left.
double RegistrationSolver::scale_of_errors(int count) {
  m_scratch.clear();
  for (int k = 0; k < count; ++k) {
    if (m_pixel_state[k] == FramePatch::seen) m_scratch.push_back(std::abs(m_error(k)) * std::sqrt(m_noise_weight(k)));
  }
  return m_scratch.size() < least_pixels ? 0.0 : 1.4826 * median_of(m_scratch) + 1e-3;
}

// Robust start of the light alone (Cauchy weights), so that a shadow or a highlight does not throw the first motion
// step.
bool RegistrationSolver::start_light(int count) {
  sample(count);
  for (int k = 0; k < count; ++k) {
    m_robust(k) = m_pixel_state[k] == FramePatch::seen ? 1.0f : 0.0f;
    m_weight(k) = m_robust(k) * m_noise_weight(k);
  }
  for (int round = 0; round < light_rounds; ++round) {
    predict(count);
    m_scale = scale_of_errors(count);
    if (m_scale == 0.0) return false;
    if (round > 0) {
      const auto inverse = static_cast<float>(1.0 / (2.0 * m_scale));
      for (int k = 0; k < count; ++k) {
        const float u = m_error(k) * std::sqrt(m_noise_weight(k)) * inverse;
        m_robust(k) = m_pixel_state[k] == FramePatch::seen ? 1.0f / (1.0f + u * u) : 0.0f;
        m_weight(k) = m_robust(k) * m_noise_weight(k);
      }
    }
    if (!solve(count, true)) return false;
  }
  return true;
}

bool RegistrationSolver::step(int count) {
  sample(count);
  predict(count);
  m_scale = scale_of_errors(count);
  if (m_scale == 0.0) return false;
  const double tukey = m_iterations > settle_iterations ? tukey_narrow : tukey_wide;
  const auto inverse = static_cast<float>(1.0 / (tukey * m_scale));
  for (int k = 0; k < count; ++k) {
    const float u = m_error(k) * std::sqrt(m_noise_weight(k)) * inverse;
    const float left = std::max(0.0f, 1.0f - u * u);
    m_robust(k) = m_pixel_state[k] == FramePatch::seen ? left * left : 0.0f;
    m_weight(k) = m_robust(k) * m_noise_weight(k);
  }
  ++m_iterations;
  return solve(count, false);
}

void RegistrationSolver::add_priors(Vector& right) {
  const double linear = std::pow(m_scale / (length_px * linear_prior), 2);
  const Eigen::Vector4d away(m_linear(0, 0) - 1.0, m_linear(0, 1), m_linear(1, 0), m_linear(1, 1) - 1.0);
  right.segment<4>(axx) += linear * length_px * away;
  m_normal.diagonal().segment<4>(axx).array() += linear;
  const double lens = std::pow(m_scale * lens_unit / m_prior.sigma_per_px2, 2);
  right(bend) += lens * (m_lens - m_prior.per_px2) / lens_unit;
  m_normal(bend, bend) += lens;
}

// One step from the errors and weights at hand.
bool RegistrationSolver::solve(int count, bool light_only) {
  const auto rows = m_rows.leftCols(count);
  Eigen::MatrixXf weighted = rows.array().rowwise() * m_weight.head(count).transpose().array();
  m_normal = (weighted * rows.transpose()).cast<double>();
  Vector right = (weighted * m_error.head(count)).cast<double>();
  Vector motion_gain = Vector::Ones();
  motion_gain.head<motion_count>().setConstant(m_light(0));
  m_normal = motion_gain.asDiagonal() * m_normal * motion_gain.asDiagonal();
  right = motion_gain.cwiseProduct(right);
  Eigen::VectorXd field_step;
  if (m_field != nullptr) {
    Eigen::MatrixXd cross = m_field->cross(weighted, count).cast<double>() * motion_gain.asDiagonal();
    Eigen::MatrixXd normal = m_field->normal(m_weight, count).cast<double>();
    const double prior = std::pow(m_scale / field_prior_levels, 2);
    normal.diagonal().array() += prior + 1e-9 * normal.diagonal().maxCoeff();
    const Eigen::VectorXf weighted_errors = m_weight.head(count).cwiseProduct(m_error.head(count));
    const Eigen::VectorXd field_right =
        m_field->project(weighted_errors, count).cast<double>() - prior * m_field_levels.cast<double>();
    const Eigen::LLT<Eigen::MatrixXd> solved(normal);
    if (solved.info() != Eigen::Success) return false;
    m_field_share = solved.solve(cross);
    field_step = solved.solve(field_right);
    m_normal -= cross.transpose() * m_field_share;
    right -= cross.transpose() * field_step;
  }
  add_priors(right);
  if (light_only) {
    m_normal.diagonal().head<motion_count>().array() += 1e12;
    m_normal.diagonal().tail<light_count>() *= 1.0 + 1e-6;
  }
  m_normal.diagonal() *= 1.0 + 1e-9;
  const Eigen::LDLT<Normal> solved(m_normal);
  if (solved.info() != Eigen::Success) return false;
  Vector p = solved.solve(right);
  if (!p.allFinite()) return false;
  if (light_only) p.head<motion_count>().setZero();
  if (m_field != nullptr) m_field_levels += (field_step - m_field_share * p).cast<float>();
  m_light += p.tail<light_count>();
  if (!light_only) apply(p);
  return m_linear.allFinite() && (m_linear - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff() < 0.5;
}

// Inverse composition: the step was solved on the template's side.
void RegistrationSolver::apply(const Vector& p) {
  Eigen::Matrix2d change;
  change << 1.0 + p(axx) / length_px, p(axy) / length_px, p(ayx) / length_px, 1.0 + p(ayy) / length_px;
  m_linear = m_linear * change.inverse();
  m_lens -= p(bend) * lens_unit;
  m_shift -= m_linear * p.head<2>();
  m_last_step_px = p.head<2>().norm();
}

bool RegistrationSolver::glance() {
  const Eigen::Vector2d start = m_shift;
  const int few = m_model.pixels / 4;
  if (!start_light(few)) return false;
  for (int k = 0; k < settle_iterations; ++k) {
    if (!step(few) || (m_shift - start).norm() > reach_px) return false;
    if (m_last_step_px < nearly_settled_px) break;
  }
  return true;
}

bool RegistrationSolver::run() {
  const Eigen::Vector2d start = m_shift;
  if (!glance()) return false;
  m_iterations = settle_iterations + 1;
  while (m_iterations < largest_iterations) {
    if (!step(m_model.pixels) || (m_shift - start).norm() > reach_px) return false;
    if (m_last_step_px < settled_px) break;
  }
  return m_last_step_px < 1e-2;
}

Registration RegistrationSolver::result(int count) const {
  Registration out;
  out.converged = true;
  out.linear = m_linear;
  out.displacement_px = m_whole_px + m_shift;
  out.contrast = m_light(0);
  out.residual = m_scale;
  out.iterations = m_iterations;
  tell_fit(count, out);
  tell_uncertainty(count, out);
  return out;
}

std::vector<float> RegistrationSolver::residual_map(int width, int height) const {
  std::vector<float> out(static_cast<std::size_t>(width) * height, std::nanf(""));
  for (int k = 0; k < m_model.pixels; ++k) {
    if (m_pixel_state[k] != FramePatch::seen) continue;
    const auto scale = static_cast<float>(m_scale);
    out[static_cast<std::size_t>(m_model.row[k]) * width + m_model.column[k]] =
        m_error(k) * std::sqrt(m_noise_weight(k)) / scale;
  }
  return out;
}

void RegistrationSolver::tell_fit(int count, Registration& out) const {
  double sum_w = 0.0, sum_m = 0.0, sum_g = 0.0, energy = 0.0, kept_energy = 0.0;
  int inliers = 0, seen = 0, bright = 0;
  // The smooth field is taken off the frame first: it is no part of the target.
  const auto light_of_target = [&](int k) {
    return static_cast<double>(m_rows.col(k).tail<light_count>().dot(m_light.cast<float>()));
  };
  std::vector<double> model(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    const double w = m_robust(k);
    model[k] = light_of_target(k);
    sum_w += w;
    sum_m += w * model[k];
    sum_g += w * (model[k] + m_error(k));
    const double e = double{m_model.fx[k]} * m_model.fx[k] + double{m_model.fy[k]} * m_model.fy[k];
    energy += e;
    if (w > 0.25) kept_energy += e;
    inliers += w > 0.25;
    seen += m_pixel_state[k] != FramePatch::outside;
    bright += m_pixel_state[k] == FramePatch::too_bright;
  }
  double mm = 0.0, gg = 0.0, mg = 0.0;
  for (int k = 0; k < count; ++k) {
    const double w = m_robust(k);
    const double m = model[k] - sum_m / sum_w;
    const double g = model[k] + m_error(k) - sum_g / sum_w;
    mm += w * m * m;
    gg += w * g * g;
    mg += w * m * g;
  }
  out.correlation = mg / std::sqrt(mm * gg + 1e-9);
  out.inlier_share = static_cast<double>(inliers) / count;
  out.informed_share = kept_energy / energy;
  out.seen_share = static_cast<double>(seen) / count;
  out.saturated_share = static_cast<double>(bright) / count;
}

// Noise: Huber's covariance of an M-estimate, E psi^2 / (E psi')^2, with the blur's noise correlation. Structure left
// in the residual: the scores summed over tiles instead of pixels (cluster-robust sandwich), which sees what the noise
// formula cannot: a shade, a lens or a blur that the model misses. The larger of both counts.
void RegistrationSolver::tell_uncertainty(int count, Registration& out) const {
  constexpr int tiles = tiles_a_side * tiles_a_side;
  Eigen::Matrix<double, column_count, Eigen::Dynamic> scores =
      Eigen::Matrix<double, column_count, Eigen::Dynamic>::Zero(column_count, tiles);
  std::vector<Eigen::VectorXf> field_errors;
  std::array<double, tiles> sum_error{}, sum_weight{};
  const int width = *std::max_element(m_model.column.begin(), m_model.column.end()) + 1;
  const int height = *std::max_element(m_model.row.begin(), m_model.row.end()) + 1;
  Vector motion_gain = Vector::Ones();
  motion_gain.head<motion_count>().setConstant(m_light(0));
  if (m_field != nullptr) field_errors.assign(tiles, Eigen::VectorXf());
  double psi2 = 0.0, slope = 0.0, sum_w = 0.0;
  int used = 0;
  std::vector<int> tile_of(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    const int tile = m_model.row[k] * tiles_a_side / height * tiles_a_side + m_model.column[k] * tiles_a_side / width;
    tile_of[k] = tile;
    const double w = m_robust(k);
    if (w <= 0.0) continue;
    const double z = m_error(k) * std::sqrt(m_noise_weight(k));
    const double u2 = std::pow(z / (tukey_narrow * m_scale), 2);
    ++used;
    sum_w += w;
    psi2 += w * z * w * z;
    slope += (1.0 - u2) * (1.0 - 5.0 * u2);
    sum_error[tile] += w * z;
    sum_weight[tile] += w;
    scores.col(tile) += (m_weight(k) * m_error(k)) * m_rows.col(k).cast<double>();
  }
  scores = motion_gain.asDiagonal() * scores;
  if (m_field != nullptr) {
    for (int tile = 0; tile < tiles; ++tile) {
      Eigen::VectorXf own = Eigen::VectorXf::Zero(count);
      for (int k = 0; k < count; ++k) {
        if (tile_of[k] == tile) own(k) = m_weight(k) * m_error(k);
      }
      scores.col(tile) -= m_field_share.transpose() * m_field->project(own, count).cast<double>();
    }
  }
  const double variance = psi2 / std::max(used - static_cast<int>(column_count), 1);
  double structure = 0.0;
  int tiles_used = 0;
  for (int tile = 0; tile < tiles; ++tile) {
    if (sum_weight[tile] < 30.0) continue;
    structure += sum_error[tile] * sum_error[tile] / (sum_weight[tile] * variance);
    ++tiles_used;
  }
  out.structure = tiles_used > 4 ? std::sqrt(structure / tiles_used) : 0.0;
  const double shrink = sum_w / std::max(slope, 0.1 * sum_w);
  const Normal inverse = m_normal.inverse();
  const double factor = variance * used / sum_w * shrink * shrink;
  const Eigen::Vector2d growth(std::sqrt(m_model.noise_growth_x), std::sqrt(m_model.noise_growth_y));
  const Eigen::Matrix2d noise = growth.asDiagonal() * inverse.topLeftCorner<2, 2>() * growth.asDiagonal() * factor;
  const Normal sandwich = inverse * (scores * scores.transpose()) * inverse * (shrink * shrink);
  out.covariance_px2 = noise;
  // Each axis grows to what the tiles say; the correlation of the noise formula is kept.
  const Eigen::Vector2d ratio(std::sqrt(std::max(1.0, sandwich(0, 0) / noise(0, 0))),
                              std::sqrt(std::max(1.0, sandwich(1, 1) / noise(1, 1))));
  out.covariance_px2 = ratio.asDiagonal() * noise * ratio.asDiagonal();
  out.lens.per_px2 = m_lens;
  out.lens.sigma_per_px2 = std::sqrt(std::max(inverse(bend, bend) * factor, 0.0)) * lens_unit;
}

}  // namespace zerodrift::vision
