#pragma once
// L D L^T of a symmetric positive definite matrix stored by its envelope: a chain of cells costs what the Thomas
// algorithm costs, and a coupling between components only widens the rows it touches (George and Liu 1981, ch. 4).
// A pure chain is eliminated from both ends towards its middle (the "twisted" or "burn at both ends" factorisation,
// Babuska 1972): each half waits only for itself, so that the processor works on both at once.

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
  void factor_chain();
  void solve_chain(double* x) const;
  void solve_chain(double* x, std::size_t columns) const;

  std::vector<int> m_first;
  std::vector<std::ptrdiff_t> m_start;
  std::vector<double> m_below;
  std::vector<double> m_diagonal;
  std::vector<double> m_inverse;
  std::vector<double> m_link;    // chain: entry (i, i - 1) of the matrix, 0 for i = 0
  std::vector<double> m_factor;  // chain: eliminates row i from its neighbour nearer to the middle
  bool m_chain = true;
};

}  // namespace zerodrift::physics
