#pragma once
// L D L^T of a symmetric positive definite matrix stored by its envelope: a chain of cells costs what the Thomas
// algorithm costs, and a coupling between components only widens the rows it touches (George and Liu 1981, ch. 4).
// Two chains side by side (a rod and its inside, in turns) have two entries beside the diagonal and loops of their own.
// A pure chain is eliminated from both ends towards its middle (the "twisted" or "burn at both ends" factorisation,
// Babuska 1972): each half waits only for itself, so that the processor works on both at once.

#include <cstddef>
#include <vector>

/// The inner loops over columns are worth the wider registers of today's processors; the loader picks the version.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define ZERODRIFT_WIDE __attribute__((target_clones("avx2", "default")))
#else
#define ZERODRIFT_WIDE
#endif

namespace zerodrift::physics {

class Skyline {
 public:
  /// first[i]: the first column of row i that may be non-zero. order[i]: where row i's values stand in the vectors that
  /// solve() gets; empty: in place i.
  explicit Skyline(std::vector<int> first, std::vector<int> order = {});
  std::size_t size() const { return m_first.size(); }
  void clear();
  double& diagonal(int i) { return m_diagonal[i]; }
  /// Entry (row, column), column < row, inside the envelope.
  double& below(int row, int column) { return m_below[m_start[row] + column - m_first[row]]; }
  void factor();
  void solve(double* x);
  /// `columns` right-hand sides side by side: x[row * columns + column].
  void solve(double* x, std::size_t columns) const;

 private:
  void factor_chain();
  void factor_band();
  void solve_band(double* x) const;
  void solve_chain(double* x) const;
  void solve_chain(double* x, std::size_t columns) const;

  std::vector<int> m_first;
  std::vector<int> m_order;
  std::vector<double> m_sorted;
  std::vector<std::ptrdiff_t> m_start;
  std::vector<double> m_below;
  std::vector<double> m_diagonal;
  std::vector<double> m_inverse;
  std::vector<double> m_link;         // chain: entry (i, i - 1) of the matrix, 0 for i = 0
  std::vector<double> m_factor;       // chain: eliminates row i from its neighbour nearer to the middle
  std::vector<double> m_near, m_far;  // band: L at (i, i - 1) and (i, i - 2)
  bool m_chain = true;
  bool m_band = true;
};

}  // namespace zerodrift::physics
