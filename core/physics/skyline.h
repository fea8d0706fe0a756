#pragma once
// L D L^T of a symmetric positive definite matrix stored by its envelope: a chain of cells costs what the Thomas
// algorithm costs, and a coupling between components only widens the rows it touches (George and Liu 1981, ch. 4).

#include <cstddef>
#include <vector>

namespace zerodrift::physics {

class Skyline {
 public:
  /// first[i]: the first column of row i that may be non-zero.
  explicit Skyline(std::vector<int> first);
  std::size_t size() const { return m_first.size(); }
  void clear();
  double& diagonal(int i) { return m_diagonal[i]; }
  /// Entry (row, column), column < row, inside the envelope.
  double& below(int row, int column) { return m_below[m_start[row] + column - m_first[row]]; }
  void factor();
  void solve(double* x) const;
  /// `columns` right-hand sides side by side: x[row * columns + column].
  void solve(double* x, std::size_t columns) const;

 private:
  std::vector<int> m_first;
  std::vector<std::ptrdiff_t> m_start;
  std::vector<double> m_below;
  std::vector<double> m_diagonal;
  std::vector<double> m_inverse;
  bool m_chain = true;
};

}  // namespace zerodrift::physics
