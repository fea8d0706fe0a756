#include "core/vision/banded_cholesky.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::vision {

// Element (i, j) of the factor is at column j - i + band of row i.
bool BandedCholesky::compute(const Eigen::MatrixXd& matrix, int band) {
  const int n = static_cast<int>(matrix.rows());
  m_band = std::min(band, n - 1);
  m_factor.setZero(n, m_band + 1);
  for (int i = 0; i < n; ++i) {
    const int first = std::max(0, i - m_band);
    for (int j = first; j <= i; ++j) {
      const int common = std::max(first, j - m_band);
      const auto own = m_factor.row(i).segment(common - i + m_band, j - common);
      const auto other = m_factor.row(j).segment(common - j + m_band, j - common);
      const double left = matrix(i, j) - own.dot(other);
      if (j < i) {
        m_factor(i, j - i + m_band) = left * m_factor(j, m_band);
      } else {
        if (!(left > 0.0)) return false;
        m_factor(i, m_band) = 1.0 / std::sqrt(left);
      }
    }
  }
  return true;
}

void BandedCholesky::solve_in_place(Eigen::MatrixXd& right) const {
  const int n = static_cast<int>(m_factor.rows());
  if (right.cols() == 1) {
    auto x = right.col(0);
    for (int i = 0; i < n; ++i) {
      const int first = std::max(0, i - m_band);
      const auto own = m_factor.row(i).segment(first - i + m_band, i - first);
      x(i) = (x(i) - own.dot(x.segment(first, i - first))) * m_factor(i, m_band);
    }
    for (int i = n - 1; i >= 0; --i) {
      const int first = std::max(0, i - m_band);
      x(i) *= m_factor(i, m_band);
      x.segment(first, i - first) -= x(i) * m_factor.row(i).segment(first - i + m_band, i - first).transpose();
    }
    return;
  }
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> x = right;
  for (int i = 0; i < n; ++i) {
    for (int j = std::max(0, i - m_band); j < i; ++j) x.row(i) -= m_factor(i, j - i + m_band) * x.row(j);
    x.row(i) *= m_factor(i, m_band);
  }
  for (int i = n - 1; i >= 0; --i) {
    x.row(i) *= m_factor(i, m_band);
    for (int j = std::max(0, i - m_band); j < i; ++j) x.row(j) -= m_factor(i, j - i + m_band) * x.row(i);
  }
  right = x;
}

}  // namespace zerodrift::vision
