#include "core/vision/registration_solver.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace zerodrift::vision {
namespace {

constexpr double reach_px = 8.0;  // the coarse search is never further off
constexpr double lens_unit = registration_lens_unit;
constexpr double length_px = registration_length_px;
constexpr double linear_prior = 0.02;  // standard deviation of the affine part: keeps rings, which cannot see rotation
constexpr double linear_prior_with_field = 0.006;  // beside a free field, shape is weak evidence of the linear part
constexpr double field_prior_levels = 60.0;
constexpr double settled_px = 3e-5;
constexpr double nearly_settled_px = 2e-3;
constexpr double weight_change = 0.03;  // of the weights' sum: beyond it the normal matrix is made anew
constexpr double scale_change = 0.1;
constexpr int light_rounds = 4;
constexpr int settle_iterations = 5;
constexpr int sampling_rounds = 7;
constexpr int reweightings = 5;
constexpr double negligible_sigmas = 0.03;
constexpr double resampled_px = 5e-4;  // a smaller motion since the frame was sampled needs no new sample

// From the template to a patch of the frame. Plain numbers: Eigen's types differ where registers are wide.
struct PixelMotion {
  float shift_x, shift_y;
  float xx, xy, yx, yy;  // linear part less one
  // The lens moves a pixel at w from the point by 2 (w s) w + |w|^2 s times its constant, s being the displacement.
  float way_x, way_y;
  float bent;                 // its constant
  int left, top, width;       // of the patch: where the region begins in it, and its own width
  int last_column, last_row;  // that can be sampled
};

// Places in the patch (-1 where they cannot be sampled), the fractions there, and how the lens moves each pixel.
ZERODRIFT_WIDE void move_pixels(const PixelMotion& motion, const float* x, const float* y, const int* column,
                                const int* row, int count, int* __restrict place, float* __restrict fraction_x,
                                float* __restrict fraction_y, float* __restrict bend_x, float* __restrict bend_y) {
  const PixelMotion m = motion;  // which nothing that is written to can alias
  for (int k = 0; k < count; ++k) {
    const float along = 2.0f * (x[k] * m.way_x + y[k] * m.way_y);
    const float squares = x[k] * x[k] + y[k] * y[k];
    bend_x[k] = along * x[k] + squares * m.way_x;
    bend_y[k] = along * y[k] + squares * m.way_y;
    const float ux = m.shift_x + m.xx * x[k] + m.xy * y[k] + m.bent * bend_x[k];
    const float uy = m.shift_y + m.yx * x[k] + m.yy * y[k] + m.bent * bend_y[k];
    const float whole_x = std::floor(ux);
    const float whole_y = std::floor(uy);
    fraction_x[k] = ux - whole_x;
    fraction_y[k] = uy - whole_y;
    const int to_column = column[k] + m.left + static_cast<int>(whole_x);
    const int to_row = row[k] + m.top + static_cast<int>(whole_y);
    const bool known = (to_column >= 2) & (to_row >= 2) & (to_column <= m.last_column) & (to_row <= m.last_row);
    place[k] = known ? to_row * m.width + to_column : -1;
  }
}

}  // namespace

RegistrationSolver::RegistrationSolver(const TemplateModel& model, const FramePatch& patch, const SmoothField* field,
                                       const RegistrationStart& start)
    : m_whole_px(start.whole_px),
      m_shift(start.shift_px),
      m_linear(start.linear),
      m_model(model),
      m_patch(patch),
      m_field(field),
      m_doubted(start.doubted),
      m_lens(start.lens.per_px2),
      m_least_variance(2.0 * rounding_variance / model.noise_correlation),
      m_prior(start.lens),
      m_outline_alone(start.outline_alone),
      m_middle(start.middle_px),
      m_judge(model, model.noise_correlation) {
  const int n = model.pixels;
  m_rows.resize(row_length, n);
  for (Eigen::VectorXf* one : {&m_frame, &m_error, &m_weight, &m_robust}) one->setZero(n);
  m_neighbours.setOnes(n);
  m_pixel_state.assign(static_cast<std::size_t>(n), FramePatch::seen);
  start_weights();
  m_light.setZero();
  m_light(0) = 1.0;
  if (start.light) m_light = *start.light;
  m_light_known = start.light.has_value();
  if (m_field != nullptr) m_field_levels.setZero(m_field->size());
  const auto mean_of = [n](const std::vector<float>& places) {
    return Eigen::Map<const Eigen::VectorXf>(places.data(), n).mean() / static_cast<float>(length_px);
  };
  m_mean_place = {mean_of(model.x), mean_of(model.y)};
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
  m_rows.col(k).head<column_count>() << fx, fy, fx * x, fx * y, fy * x, fy * y, 0.0f, f, f * x, f * y, 1.0f,
      m_model.fxx[k], m_model.fxy[k], m_model.fyy[k];
  m_rows.col(k).tail<row_length - column_count>().setZero();
}

// The frame's value at each pixel of the template moved by the present motion.
void RegistrationSolver::sample(int count) {
  const std::size_t size = static_cast<std::size_t>(m_frame.size());
  m_place.resize(size);
  for (std::vector<float>* one : {&m_fx, &m_fy, &m_bend_x, &m_bend_y}) one->resize(size);
  const Eigen::Vector2f shift = m_shift.cast<float>();
  const Eigen::Matrix2f turn = (m_linear - Eigen::Matrix2d::Identity()).cast<float>();
  const Eigen::Vector2f way = ((m_whole_px + m_shift) * lens_unit).cast<float>();
  PixelMotion motion;
  motion.shift_x = shift(0), motion.shift_y = shift(1);
  motion.xx = turn(0, 0), motion.xy = turn(0, 1), motion.yx = turn(1, 0), motion.yy = turn(1, 1);
  motion.way_x = way(0), motion.way_y = way(1);
  motion.bent = static_cast<float>(m_lens / lens_unit);
  motion.width = m_patch.spline.width();
  motion.left = m_model.region.x + static_cast<int>(m_whole_px(0)) - m_patch.at.x;
  motion.top = m_model.region.y + static_cast<int>(m_whole_px(1)) - m_patch.at.y;
  motion.last_column = motion.width - SplineImage::reach_after;
  motion.last_row = m_patch.spline.height() - SplineImage::reach_after;
  move_pixels(motion, m_model.x.data(), m_model.y.data(), m_model.column.data(), m_model.row.data(), count,
              m_place.data(), m_fx.data(), m_fy.data(), m_bend_x.data(), m_bend_y.data());
  for (int k = 0; k < count; ++k) {
    m_rows(bend, k) = m_model.fx[k] * m_bend_x[k] + m_model.fy[k] * m_bend_y[k];
    const bool known = m_place[k] >= 0;
    if (!known) m_place[k] = SplineImage::first_place(motion.width);
    m_pixel_state[k] = known ? m_patch.state[m_place[k]] : std::uint8_t{FramePatch::outside};
  }
  for (int k = 0; m_doubted != nullptr && !m_all_pixels && k < count; ++k) {
    const std::size_t at = static_cast<std::size_t>(m_model.row[k]) * m_model.region.width + m_model.column[k];
    if ((*m_doubted)[at] != 0) m_pixel_state[k] = FramePatch::doubted;
  }
  m_patch.spline.sample(m_place.data(), m_fx.data(), m_fy.data(), count, m_frame.data());
  look_behind(count);
}

// The model's values where the target lets through what now stands behind it.
void RegistrationSolver::look_behind(int count) {
  for (std::size_t i = 0; i < m_model.shown.size() && m_model.shown[i] < count; ++i) {
    const int k = m_model.shown[i];
    if (m_pixel_state[k] == FramePatch::outside) continue;
    const int width = m_patch.spline.width();
    const float behind = m_model.backdrop->at(static_cast<float>(m_patch.at.x + m_place[k] % width) + m_fx[k],
                                              static_cast<float>(m_patch.at.y + m_place[k] / width) + m_fy[k]);
    const float value = m_model.value[k] + m_model.clear[i] * (behind - m_model.behind[i]);
    m_rows(gain, k) = value;
    m_rows(gain_x, k) = value * m_model.x[k] / static_cast<float>(length_px);
    m_rows(gain_y, k) = value * m_model.y[k] / static_cast<float>(length_px);
  }
}

void RegistrationSolver::predict(int count) {
  Eigen::Matrix<float, row_length, 1> light = Eigen::Matrix<float, row_length, 1>::Zero();
  light.segment<light_count>(motion_count) = m_light.cast<float>();
  subtract_model(m_rows.data(), light.data(), count, m_frame.data(), m_error.data());
  if (m_field != nullptr) m_field->subtract_from(m_error, count, m_field_levels);
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
        const float u = m_error(k) * m_noise_root(k) * inverse;
        m_robust(k) = m_pixel_state[k] == FramePatch::seen ? 1.0f / (1.0f + u * u) : 0.0f;
        m_weight(k) = m_robust(k) * m_noise_weight(k);
      }
    }
    if (!solve(count, true)) return false;
  }
  return true;
}

// A Gauss-Newton step on the frame sampled where the motion now is.
bool RegistrationSolver::step(int count) {
  sample(count);
  predict(count);
  return reweighted_step(count, false);
}

// Weights from the present errors, a solve with them, and the errors after it to first order.
bool RegistrationSolver::reweighted_step(int count, bool ask_neighbours) {
  m_scale = scale_of_errors(count);
  if (m_scale == 0.0) return false;
  weigh(count, ask_neighbours);
  ++m_iterations;
  return solve(count, false);
}

// Reweights until the errors and the weights agree, to a small part of the uncertainty; then samples anew, until that
// moves nothing any more.
bool RegistrationSolver::settle(int count) {
  bool settled = false;
  for (int round = 0; round < sampling_rounds; ++round) {
    const Eigen::Vector2d before = m_shift;
    sample(count);
    predict(count);
    for (int k = 0; k < reweightings; ++k) {
      if (!reweighted_step(count, settled && k == 0)) return false;
      const double least_sigma_px = m_scale / (m_prepared.gain * std::sqrt(m_prepared.normal(tx, tx)));
      if (m_last_step_px < std::max(settled_px, negligible_sigmas * least_sigma_px)) break;
    }
    const double moved = (m_shift - before).norm();
    if (moved > reach_px) return false;
    if (settled && moved < resampled_px) return true;
    if (!settled && moved < nearly_settled_px) {
      choose_tukey();
      settled = true;
    }
  }
  return m_last_step_px < 1e-2;
}

bool RegistrationSolver::outdated(int count, bool light_only) const {
  if (m_prepared.count != count || m_prepared.light_only != light_only) return true;
  // The priors count in units of the scale.
  if (std::abs(m_scale - m_prepared.scale) > scale_change * m_scale) return true;
  const double change = (m_weight.head(count) - m_prepared.weight).lpNorm<1>();
  return change > weight_change * m_prepared.weight.sum();
}

RegistrationSolver::Normal RegistrationSolver::normal_of(const float* rows, const float* weights, int begin,
                                                         int end) const {
  Eigen::Matrix<double, row_length, row_length> sums = Eigen::Matrix<double, row_length, row_length>::Zero();
  add_squares(rows + static_cast<std::ptrdiff_t>(begin) * row_length, weights + begin, end - begin, sums.data());
  return sums.topLeftCorner<column_count, column_count>();
}

// The motion's columns count times the gain of the light.
RegistrationSolver::Vector RegistrationSolver::motion_gain() const {
  Vector out = Vector::Ones();
  out.head<motion_count>().setConstant(m_prepared.gain);
  return out;
}

// Takes off the columns' normal matrix what the field would explain of them.
bool RegistrationSolver::eliminate(const SmoothField& field, const Eigen::VectorXf& weight, int count, FieldPart& out,
                                   Normal& normal) const {
  const Eigen::MatrixXd cross =
      field.cross(m_rows, weight, count).leftCols<column_count>().cast<double>() * motion_gain().asDiagonal();
  Eigen::MatrixXd own = field.normal(weight, count).cast<double>();
  out.prior = std::pow(m_scale / field_prior_levels, 2);
  own.diagonal().array() += out.prior + 1e-9 * own.diagonal().maxCoeff();
  if (!out.solved.compute(own, field.band())) return false;
  out.share = cross;
  out.solved.solve_in_place(out.share);
  normal -= cross.transpose() * out.share;
  return true;
}

bool RegistrationSolver::prepare_normal(int count, bool light_only) {
  Prepared& p = m_prepared;
  p.count = count;
  p.light_only = light_only;
  p.weight = m_weight.head(count);
  p.gain = m_light(0);
  p.scale = m_scale;
  const Vector factors = motion_gain();
  p.normal = factors.asDiagonal() * normal_of(m_rows.data(), p.weight.data(), 0, count) * factors.asDiagonal();
  if (m_field != nullptr && !eliminate(*m_field, p.weight, count, p.field, p.normal)) return false;
  double linear = m_field != nullptr ? linear_prior_with_field : linear_prior;
  if (m_outline_alone) linear = linear_prior_of_outline;
  p.linear_prior = std::pow(m_scale / (length_px * linear), 2);
  p.lens_prior = std::pow(m_scale * lens_unit / m_prior.sigma_per_px2, 2);
  p.normal.diagonal().segment<4>(axx).array() += p.linear_prior;
  p.normal(bend, bend) += p.lens_prior;
  if (light_only) {
    p.normal.diagonal().head<motion_count>().array() += 1e12;
    p.normal.diagonal().tail<light_count>() *= 1.0 + 1e-6;
  }
  p.normal.diagonal() *= 1.0 + 1e-9;
  p.solved.compute(p.normal);
  return p.solved.info() == Eigen::Success;
}

// What the errors and the priors pull at each column, a field aside.
RegistrationSolver::Vector RegistrationSolver::right_of(const Eigen::VectorXf& weighted_errors, int count,
                                                        double prior) const {
  Eigen::Matrix<double, row_length, 1> sums = Eigen::Matrix<double, row_length, 1>::Zero();
  add_products(m_rows.data(), weighted_errors.data(), count, sums.data());
  Vector out = motion_gain().asDiagonal() * sums.head<column_count>();
  const Eigen::Vector4d away(m_linear(0, 0) - 1.0, m_linear(0, 1), m_linear(1, 0), m_linear(1, 1) - 1.0);
  out.segment<4>(axx) += prior * length_px * away;
  out(bend) += m_prepared.lens_prior * (m_lens - m_prior.per_px2) / lens_unit;
  return out;
}

// The step that a solve with the field would begin with: the motion is known, so it is nearly all of it.
std::optional<RegistrationSolver::FieldStep> RegistrationSolver::step_with(const SmoothField& field,
                                                                           const Registration& told) const {
  const int count = m_model.pixels;
  const double with_field = std::pow(m_scale / (length_px * linear_prior_with_field), 2);
  Normal normal = m_prepared.normal;
  normal.diagonal().segment<4>(axx).array() += with_field - m_prepared.linear_prior;
  FieldPart part;
  if (!eliminate(field, m_weight, count, part, normal)) return std::nullopt;
  const Eigen::VectorXf weighted_errors = m_weight.cwiseProduct(m_error);
  const Vector right = right_of(weighted_errors, count, with_field) -
                       part.share.transpose() * field.project(weighted_errors, count).cast<double>();
  const Normal precise = m_prepared.normal.inverse();
  const Normal robust = normal.inverse();
  const Eigen::Vector2d grown = robust.diagonal().head<2>().cwiseQuotient(precise.diagonal().head<2>());
  return FieldStep{(robust * right).head<2>(), told.noise_variance_px2.cwiseProduct(grown)};
}

// One step from the errors and weights at hand.
bool RegistrationSolver::solve(int count, bool light_only) {
  if (outdated(count, light_only) && !prepare_normal(count, light_only)) return false;
  const Prepared& ready = m_prepared;
  const Eigen::VectorXf weighted_errors = m_weight.head(count).cwiseProduct(m_error.head(count));
  Vector right = right_of(weighted_errors, count, ready.linear_prior);
  Eigen::MatrixXd field_step;
  if (m_field != nullptr) {
    const Eigen::VectorXd field_right =
        m_field->project(weighted_errors, count).cast<double>() - ready.field.prior * m_field_levels.cast<double>();
    field_step = field_right;
    ready.field.solved.solve_in_place(field_step);
    right -= ready.field.share.transpose() * field_right;
  }
  Vector p = ready.solved.solve(right);
  if (!p.allFinite()) return false;
  if (light_only) p.head<motion_count>().setZero();
  if (m_field != nullptr) {
    const Eigen::VectorXf levels = (field_step - ready.field.share * p).cast<float>();
    m_field_levels += levels;
    m_field->subtract_from(m_error, count, levels);
  }
  m_light += p.tail<light_count>();
  if (!light_only) apply(p);
  Vector change = p;
  change.head<motion_count>() *= ready.gain;
  Eigen::Matrix<float, row_length, 1> factors = Eigen::Matrix<float, row_length, 1>::Zero();
  factors.head<column_count>() = change.cast<float>();
  subtract_model(m_rows.data(), factors.data(), count, m_error.data(), m_error.data());
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
  for (int k = 0; k < few; ++k) fill_row(k);
  if (!m_light_known && !start_light(few)) return false;
  for (int k = 0; k < settle_iterations; ++k) {
    if (!step(few) || (m_shift - start).norm() > reach_px) return false;
    if (m_last_step_px < nearly_settled_px) break;
  }
  return true;
}

// The weights are those before the last step. Where a cover's level happens to be the target's, a field that is held
// by nothing else there may have left their pixels far behind with it.
void RegistrationSolver::leave_out_gone() {
  const auto reach = static_cast<float>(m_tukey * m_scale);
  for (int k = 0; k < m_model.pixels; ++k) {
    if (std::abs(m_error(k)) * m_noise_root(k) > reach) m_robust(k) = m_weight(k) = 0.0f;
  }
}

bool RegistrationSolver::run() {
  const Eigen::Vector2d start = m_shift;
  if (!glance()) return false;
  find_noise_model(m_model.pixels / 4);
  for (int k = m_model.pixels / 4; k < m_model.pixels; ++k) fill_row(k);
  m_all_pixels = true;
  if (!settle(m_model.pixels) || m_partly_unlit) return false;
  leave_out_gone();
  return (m_shift - start).norm() < reach_px;
}

bool RegistrationSolver::compare() {
  for (int k = 0; k < m_model.pixels; ++k) fill_row(k);
  m_all_pixels = true;
  return start_light(m_model.pixels);
}

void RegistrationSolver::hand_over(RegistrationStart& start) const {
  start.shift_px = m_shift;
  start.linear = m_linear;
  start.light = m_light;
  start.light->tail<3>().setZero();
}

Registration RegistrationSolver::fit(int count) const {
  Registration out;
  out.converged = true;
  out.linear = m_linear;
  out.displacement_px = m_whole_px + m_shift;
  out.contrast = m_light(0);
  out.residual = m_scale;
  out.iterations = m_iterations;
  tell_fit(count, out);
  tell_structure(count, out);
  return out;
}

}  // namespace zerodrift::vision
