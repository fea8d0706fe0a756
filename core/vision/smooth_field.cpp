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
  m_along.resize(static_cast<std::size_t>(model.pixels));
  int row = -1;
  for (int k = 0; k < model.pixels; ++k) {
    const double x = (model.column[k] + 0.5) / step_x;
    const double y = (model.row[k] + 0.5) / step_y;
    const int ix = std::min(static_cast<int>(x), m_columns - 4);
    const int iy = std::min(static_cast<int>(y), m_rows - 4);
    const int first = iy * m_columns + ix;
    cubic_weights(x - ix, m_along[k].wx);
    if (model.row[k] != row || m_segments.empty() || m_segments.back().first != first) {
      m_segments.push_back({k, k, first, {}});
      cubic_weights(y - iy, m_segments.back().wy);
      row = model.row[k];
    }
    m_segments.back().end = k + 1;
  }
}

void SmoothField::subtract_from(Eigen::VectorXf& error, int count, const Eigen::VectorXf& coefficients) const {
  for (const Segment& at : m_segments) {
    float c[4] = {};
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) c[i] += at.wy[j] * coefficients(at.first + j * m_columns + i);
    }
    for (int k = at.begin; k < std::min(at.end, count); ++k) {
      const float* w = m_along[k].wx;
      error(k) -= w[0] * c[0] + w[1] * c[1] + w[2] * c[2] + w[3] * c[3];
    }
  }
}

Eigen::VectorXf SmoothField::project(const Eigen::VectorXf& weighted_values, int count) const {
  Eigen::VectorXf out = Eigen::VectorXf::Zero(size());
  for (const Segment& at : m_segments) {
    float sum[4] = {};
    for (int k = at.begin; k < std::min(at.end, count); ++k) {
      for (int i = 0; i < 4; ++i) sum[i] += weighted_values(k) * m_along[k].wx[i];
    }
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 4; ++i) out(at.first + j * m_columns + i) += at.wy[j] * sum[i];
    }
  }
  return out;
}

Eigen::MatrixXf SmoothField::normal(const Eigen::VectorXf& weights, int count) const {
  Eigen::MatrixXf out = Eigen::MatrixXf::Zero(size(), size());
  for (const Segment& at : m_segments) {
    Eigen::Matrix4f sum = Eigen::Matrix4f::Zero();
    for (int k = at.begin; k < std::min(at.end, count); ++k) {
      const Eigen::Map<const Eigen::Vector4f> w(m_along[k].wx);
      sum.noalias() += (weights(k) * w) * w.transpose();
    }
    for (int a = 0; a < 4; ++a) {
      for (int b = 0; b < 4; ++b) {
        out.block<4, 4>(at.first + a * m_columns, at.first + b * m_columns) += (at.wy[a] * at.wy[b]) * sum;
      }
    }
  }
  return out;
}

Eigen::MatrixXf SmoothField::cross(const Rows& rows, const Eigen::VectorXf& weights, int count) const {
  Eigen::MatrixXf out = Eigen::MatrixXf::Zero(row_length, size());
  Eigen::Matrix<float, row_length, 4> sum;
  for (const Segment& at : m_segments) {
    const int end = std::min(at.end, count);
    if (at.begin >= end) continue;
    sum.setZero();
    add_shared(rows.col(at.begin).data(), weights.data() + at.begin, m_along[at.begin].wx, end - at.begin, sum.data());
    for (int j = 0; j < 4; ++j) out.middleCols<4>(at.first + j * m_columns) += at.wy[j] * sum;
  }
  return out.transpose();
}

void SmoothField::take_off(Rows& rows, int count, const Eigen::MatrixXf& share) const {
  Eigen::MatrixXf across = Eigen::MatrixXf::Zero(row_length, size());
  across.topRows(share.cols()) = share.transpose();
  Eigen::Matrix<float, row_length, 4> sum;
  for (const Segment& at : m_segments) {
    const int end = std::min(at.end, count);
    if (at.begin >= end) continue;
    sum.setZero();
    for (int j = 0; j < 4; ++j) sum += at.wy[j] * across.middleCols<4>(at.first + j * m_columns);
    subtract_shared(rows.col(at.begin).data(), m_along[at.begin].wx, end - at.begin, sum.data());
  }
}

}  // namespace zerodrift::vision
