#pragma once
// How many points from a first one on still make a straight line by |r|: the loop "drop the last point until it holds"
// without fitting each time. Sums over any stretch come from sums from the start; whole ranges of counts are ruled out
// at once, since by Cauchy and Schwarz the covariance of m points, lo <= m <= hi, is at most
// |Suv(lo)| + sqrt((Suu(hi) - Suu(lo)) (Svv(hi) - Svv(lo))), while Suu and Svv only grow.

#include <cstddef>
#include <vector>

namespace zerodrift::compensation {

class WindowFit {
 public:
  /// u strictly increasing; v as many as u.
  WindowFit(const std::vector<double>& u, const std::vector<double>& v);

  /// The largest count of points from `first` on, 3 to `most`, whose |r| reaches the threshold; 0: none does.
  std::size_t largest_count(std::size_t first, std::size_t most, double threshold);

 private:
  struct Sums {
    long double u = 0.0L, v = 0.0L, uu = 0.0L, uv = 0.0L, vv = 0.0L;
  };
  struct Moments {
    double uu = 0.0, uv = 0.0, vv = 0.0;  // about the means of the stretch
  };
  Moments moments(std::size_t first, std::size_t count) const;
  Moments exact(std::size_t first, std::size_t count) const;
  bool passes(std::size_t first, std::size_t count, double limit) const;
  bool ruled_out(std::size_t first, std::size_t low, std::size_t high, double limit) const;

  std::vector<double> m_u;  // from their means
  std::vector<double> m_v;
  std::vector<Sums> m_sums;  // of the points before
  std::size_t m_stride = 1;  // of the last range that was ruled out
};

}  // namespace zerodrift::compensation
