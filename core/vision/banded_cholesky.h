#pragma once
// Cholesky factors of a symmetric positive matrix whose elements vanish beyond a band: what a spline on a grid has. Its
// cost is that of the band, a tenth of the full matrix's here.

#include <Eigen/Core>

namespace zerodrift::vision {

class BandedCholesky {
 public:
  /// The matrix's lower half within the band is used; false when it is not positive.
  bool compute(const Eigen::MatrixXd& matrix, int band);
  /// right = inverse(matrix) right.
  void solve_in_place(Eigen::MatrixXd& right) const;

 private:
  int m_band = 0;
  // Row by row, the band's elements up to the diagonal; the diagonal holds its inverse.
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> m_factor;
};

}  // namespace zerodrift::vision
