#pragma once
// L D L^T of a symmetric positive definite matrix, of which only the entries that can differ from zero are stored: a
// chain of cells costs what the Thomas algorithm costs, and a coupling between components only the rows it touches
// (George and Liu 1981, ch. 5).
// Two chains side by side (a rod and its inside, in turns) have two entries beside the diagonal and loops of their own.
// Both are eliminated from both ends towards the middle (the "twisted" or "burn at both ends" factorisation, Babuska
// 1972): each half waits only for itself, so that the processor works on both at once.

#include <cstddef>
#include <vector>

/// The inner loops over columns are worth the wider registers of today's processors; the loader picks the version.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define ZERODRIFT_WIDE __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define ZERODRIFT_WIDE
#endif

namespace zerodrift::physics {

/// Four numbers in one register (two where registers are narrow). Written out, because loops of a fixed short length
/// are taken apart into single numbers by the compiler. Sums and products are element by element.
using Four = double __attribute__((vector_size(32), aligned(8), may_alias));

class Skyline {
 public:
  /// Right-hand sides that are solved side by side: a fixed number, so that they stay in registers.
  static constexpr std::size_t lanes = 8;

  /// columns[i]: the columns below i of row i in which L may differ from zero, ascending. order[i]: where row i's
  /// values stand in the vectors that solve() gets; empty: in place i.
  explicit Skyline(const std::vector<std::vector<int>>& columns, std::vector<int> order = {});
  std::size_t size() const { return m_diagonal.size(); }
  void clear();
  double& diagonal(int i) { return m_diagonal[i]; }
  /// Entry (row, column), column < row, among those that may differ from zero.
  double& below(int row, int column) { return m_below[find(row, column)]; }
  void factor();
  void solve(double* x) const;
  /// x[row * lanes + lane].
  void solve_lanes(double* x) const;

 private:
  /// Index of an entry; where it is none, its row's end.
  std::size_t find(std::size_t row, std::size_t column) const;
  /// Of the matrix, not yet factored.
  double entry(std::size_t row, std::size_t column) const;
  void factor_chain();
  void factor_band();
  void solve_band(double* x) const;
  std::size_t middle() const { return (size() - 2) / 2; }  // band: first of the two rows that are left
  void solve_chain(double* x) const;
  void solve_lanes_of_chain(double* x) const;
  void solve_lanes_of_band(double* x) const;

  std::vector<int> m_order;
  std::vector<std::size_t> m_start;   // of each row, and the end: entries m_start[i] .. m_start[i + 1]
  std::vector<std::size_t> m_column;  // of each entry
  std::vector<std::size_t> m_place;   // of each entry: where its column's values stand in what solve() gets
  std::vector<std::size_t> m_up;      // of each column, and the end, into the two lists below
  std::vector<std::size_t> m_up_entry, m_up_place;  // column by column: the entry, and where its row's values stand
  std::vector<double> m_work;
  std::vector<double> m_below;
  std::vector<double> m_diagonal;
  std::vector<double> m_inverse;
  std::vector<double> m_link;    // chain: entry (i, i - 1) of the matrix, 0 for i = 0
  std::vector<double> m_factor;  // chain: eliminates row i from its neighbour nearer to the middle
  // Band: what eliminates row i from the rows i - 1 and i - 2 (upper half and the two in the middle), and from the rows
  // i + 1 and i + 2 (lower half and the two in the middle).
  std::vector<double> m_near, m_far, m_near_up, m_far_up;
  double m_middle[3] = {};  // the inverse of the two rows in the middle: (0, 0), (0, 1), (1, 1)
  bool m_chain = true;
  bool m_band = true;
};

}  // namespace zerodrift::physics
