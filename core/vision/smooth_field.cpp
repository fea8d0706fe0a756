#include "core/vision/smooth_field.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

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

// Four numbers in one register; the way GCC and Clang spell it. In memory they stand anywhere.
typedef float Four __attribute__((vector_size(16)));

Four load_four(const float* at) {
  Four out;
  std::memcpy(&out, at, sizeof(out));
  return out;
}
void add_four(float* at, const Four& part) {
  const Four sum = load_four(at) + part;
  std::memcpy(at, &sum, sizeof(sum));
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
    Four c = {};
    for (int j = 0; j < 4; ++j) c += at.wy[j] * load_four(&coefficients(at.first + j * m_columns));
    const int end = std::min(at.end, count);
    for (int k = at.begin; k < end; ++k) {
      const Four part = load_four(m_along[k].wx) * c;
      error(k) -= (part[0] + part[1]) + (part[2] + part[3]);
    }
  }
}

Eigen::VectorXf SmoothField::project(const Eigen::VectorXf& weighted_values, int count) const {
  Eigen::VectorXf out = Eigen::VectorXf::Zero(size());
  for (const Segment& at : m_segments) {
    Four sum = {};
    const int end = std::min(at.end, count);
    for (int k = at.begin; k < end; ++k) sum += weighted_values(k) * load_four(m_along[k].wx);
    for (int j = 0; j < 4; ++j) add_four(&out(at.first + j * m_columns), at.wy[j] * sum);
  }
  return out;
}

// The products of a segment go into the sums of its cell of the grid, 16 x 16 without their lower half; these are laid
// out at the end.
Eigen::MatrixXf SmoothField::normal(const Eigen::VectorXf& weights, int count) const {
  using Cell = std::array<Four, 40>;  // pairs of rows (a, b >= a) of the grid, each with 4 x 4 products
  std::vector<Cell> cells(static_cast<std::size_t>(size()), Cell{});
  for (const Segment& at : m_segments) {
    const int end = std::min(at.end, count);
    if (at.begin >= end) continue;
    Four sum[4] = {};
    for (int k = at.begin; k < end; ++k) {
      const Four w = load_four(m_along[k].wx);
      const Four weighted = weights(k) * w;
      for (int i = 0; i < 4; ++i) sum[i] += w[i] * weighted;
    }
    Four* cell = cells[static_cast<std::size_t>(at.first)].data();
    for (int a = 0; a < 4; ++a) {
      for (int b = a; b < 4; ++b, cell += 4) {
        const float factor = at.wy[a] * at.wy[b];
        for (int i = 0; i < 4; ++i) cell[i] += factor * sum[i];
      }
    }
  }
  Eigen::MatrixXf out = Eigen::MatrixXf::Zero(size(), size());
  for (int first = 0; first + 3 * m_columns + 3 < size(); ++first) {
    const Four* cell = cells[static_cast<std::size_t>(first)].data();
    for (int a = 0; a < 4; ++a) {
      for (int b = a; b < 4; ++b, cell += 4) {
        for (int i = 0; i < 4; ++i) add_four(&out(first + b * m_columns, first + a * m_columns + i), cell[i]);
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
