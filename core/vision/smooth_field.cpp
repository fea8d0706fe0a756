#include "core/vision/smooth_field.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::vision {
namespace {

// Cubic B-spline at 1 + t, t, 1 - t, 2 - t for t in [0, 1).
void cubic_weights(double t, float* w) {
  const double s = 1.0 - t;
  w[0] = static_cast<float>(s * s * s / 6.0);
  w[1] = static_cast<float>(2.0 / 3.0 - t * t * (2.0 - t) / 2.0);
  w[2] = static_cast<float>(2.0 / 3.0 - s * s * (2.0 - s) / 2.0);
  w[3] = static_cast<float>(t * t * t / 6.0);
}

int intervals(int side_px, double spacing_px) {
  return std::max(1, static_cast<int>(std::lround(side_px / spacing_px)));
}

}  // namespace

SmoothField::SmoothField(const TemplateModel& model, int width, int height, double spacing_px)
    : m_columns(intervals(width, spacing_px) + 3), m_rows(intervals(height, spacing_px) + 3) {
  const double step_x = static_cast<double>(width) / (m_columns - 3);
  const double step_y = static_cast<double>(height) / (m_rows - 3);
  m_places.resize(static_cast<std::size_t>(model.pixels));
  for (std::size_t k = 0; k < m_places.size(); ++k) {
    const double x = (model.column[k] + 0.5) / step_x;
    const double y = (model.row[k] + 0.5) / step_y;
    const int ix = std::min(static_cast<int>(x), m_columns - 4);
    const int iy = std::min(static_cast<int>(y), m_rows - 4);
    m_places[k].first = iy * m_columns + ix;
    cubic_weights(x - ix, m_places[k].wx);
    cubic_weights(y - iy, m_places[k].wy);
  }
}

void SmoothField::subtract_from(Eigen::VectorXf& error, int count, const Eigen::VectorXf& coefficients) const {
  for (int k = 0; k < count; ++k) {
    const Place& at = m_places[static_cast<std::size_t>(k)];
    float sum = 0.0f;
    for (int j = 0; j < 4; ++j) {
      const float* c = coefficients.data() + at.first + j * m_columns;
      sum += at.wy[j] * (at.wx[0] * c[0] + at.wx[1] * c[1] + at.wx[2] * c[2] + at.wx[3] * c[3]);
    }
    error(k) -= sum;
  }
}

Eigen::VectorXf SmoothField::project(const Eigen::VectorXf& weighted_values, int count) const {
  Eigen::VectorXf out = Eigen::VectorXf::Zero(size());
  for (int k = 0; k < count; ++k) {
    const Place& at = m_places[static_cast<std::size_t>(k)];
    for (int j = 0; j < 4; ++j) {
      const float w = weighted_values(k) * at.wy[j];
      float* c = out.data() + at.first + j * m_columns;
      for (int i = 0; i < 4; ++i) c[i] += w * at.wx[i];
    }
  }
  return out;
}

Eigen::MatrixXf SmoothField::normal(const Eigen::VectorXf& weights, int count) const {
  Eigen::MatrixXf out = Eigen::MatrixXf::Zero(size(), size());
  for (int k = 0; k < count; ++k) {
    if (weights(k) == 0.0f) continue;
    const Place& at = m_places[static_cast<std::size_t>(k)];
    for (int a = 0; a < 16; ++a) {
      const float wa = weights(k) * at.wy[a / 4] * at.wx[a % 4];
      float* column = out.data() + static_cast<std::ptrdiff_t>(at.first + (a / 4) * m_columns + a % 4) * out.rows();
      for (int j = 0; j < 4; ++j) {
        const float w = wa * at.wy[j];
        float* c = column + at.first + j * m_columns;
        for (int i = 0; i < 4; ++i) c[i] += w * at.wx[i];
      }
    }
  }
  return out;
}

Eigen::MatrixXf SmoothField::cross(const Eigen::MatrixXf& weighted_rows, int count) const {
  Eigen::MatrixXf out = Eigen::MatrixXf::Zero(weighted_rows.rows(), size());
  for (int k = 0; k < count; ++k) {
    const Place& at = m_places[static_cast<std::size_t>(k)];
    for (int a = 0; a < 16; ++a) {
      out.col(at.first + (a / 4) * m_columns + a % 4) += (at.wy[a / 4] * at.wx[a % 4]) * weighted_rows.col(k);
    }
  }
  return out.transpose();
}

}  // namespace zerodrift::vision
