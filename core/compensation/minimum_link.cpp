#include "core/compensation/minimum_link.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace zerodrift::compensation {
namespace {

// Slopes beyond this would turn the direction of motion (1000 um per mm); no axis comes near it.
constexpr double steepest_um_per_mm = 900.0;

/// A line by its slope and its value at the link's own origin, so that no digits are lost far from zero.
struct Dual {
  double slope = 0.0;
  double value = 0.0;
};

/// Condition on a line: sign * (line(x) - bound) >= 0.
struct HalfPlane {
  double x = 0.0;
  double bound = 0.0;
  double sign = 1.0;
};

/// The lines that satisfy all conditions so far.
class Lines {
 public:
  Lines(double origin_mm, double low_um, double high_um)
      : m_origin(origin_mm),
        m_corners{{-steepest_um_per_mm, low_um},
                  {steepest_um_per_mm, low_um},
                  {steepest_um_per_mm, high_um},
                  {-steepest_um_per_mm, high_um}} {}

  double at(const Dual& line, double x) const { return line.value + line.slope * (x - m_origin); }

  /// The corner with the lowest (sign = 1) or highest (sign = -1) value at x.
  const Dual& extreme(double x, double sign) const {
    const Dual* best = &m_corners.front();
    for (const Dual& corner : m_corners) {
      if (sign * at(corner, x) < sign * at(*best, x)) best = &corner;
    }
    return *best;
  }

  /// False, and unchanged, when no line would be left. Called for every window twice and more: no allocation here.
  bool cut(const HalfPlane& plane) {
    const double dx = plane.x - m_origin;
    std::size_t out = 0;
    m_distances.resize(m_corners.size());
    for (std::size_t i = 0; i < m_corners.size(); ++i) {
      m_distances[i] = plane.sign * (m_corners[i].value + m_corners[i].slope * dx - plane.bound);
      out += m_distances[i] < 0.0 ? 1 : 0;
    }
    if (out == m_corners.size()) return false;
    m_planes.push_back(plane);
    if (out == 0) return true;
    m_kept.clear();
    for (std::size_t i = 0; i < m_corners.size(); ++i) {
      const std::size_t j = i + 1 == m_corners.size() ? 0 : i + 1;
      const Dual& a = m_corners[i];
      const Dual& b = m_corners[j];
      const double da = m_distances[i];
      const double db = m_distances[j];
      if (da >= 0.0) m_kept.push_back(a);
      if ((da < 0.0) == (db < 0.0)) continue;
      const double f = da / (da - db);
      m_kept.push_back({a.slope + f * (b.slope - a.slope), a.value + f * (b.value - a.value)});
    }
    std::swap(m_corners, m_kept);
    return true;
  }

  /// The farthest condition of this side that the line just meets: beyond it the line is free on that side.
  double last_contact(const Dual& line, double side, double slack) const {
    double farthest = m_origin;
    for (const HalfPlane& plane : m_planes) {
      const bool meets = plane.sign == side && std::abs(at(line, plane.x) - plane.bound) <= slack;
      if (meets) farthest = std::max(farthest, plane.x);
    }
    return farthest;
  }

  Dual middle() const {
    Dual sum;
    for (const Dual& corner : m_corners) {
      sum.slope += corner.slope / static_cast<double>(m_corners.size());
      sum.value += corner.value / static_cast<double>(m_corners.size());
    }
    return sum;
  }

  LinkLine line(const Dual& dual) const { return {dual.slope, dual.value - dual.slope * m_origin}; }

 private:
  double m_origin;
  std::vector<Dual> m_corners;
  std::vector<Dual> m_kept;         // room for a cut
  std::vector<double> m_distances;  // room for a cut
  std::vector<HalfPlane> m_planes;
};

struct Problem {
  const std::vector<double>& x;
  const std::vector<double>& e;
  double tolerance;
  double low;  // a box that holds every line's value at any origin
  double high;
  double slack;
};

/// Where a link had to end: the extreme line and the window it missed.
struct End {
  LinkLine line;
  double contact_mm = 0.0;
  std::size_t missed = 0;
  double side = 1.0;  // 1: the line passes above the missed window, the next link comes down to it
};

/// Goes on from window `next` as far as possible; no End when the last window is reached.
std::optional<End> run_link(const Problem& problem, Lines& lines, std::size_t next) {
  for (std::size_t i = next; i < problem.x.size(); ++i) {
    const double x = problem.x[i];
    const bool above = !lines.cut({x, problem.e[i] + problem.tolerance, -1.0});
    const bool below = !above && !lines.cut({x, problem.e[i] - problem.tolerance, 1.0});
    if (!above && !below) continue;
    const double side = above ? 1.0 : -1.0;
    const Dual extreme = lines.extreme(x, side);
    return End{lines.line(extreme), lines.last_contact(extreme, side, problem.slack), i, side};
  }
  return std::nullopt;
}

/// The conditions on the link after one that ended: it leaves the extreme line after the contact, towards the missed
/// window.
Lines start_link(const Problem& problem, const End& end) {
  Lines lines(end.contact_mm, problem.low, problem.high);
  const auto on_line = [&](double x) { return end.line.intercept + end.line.slope * x; };
  lines.cut({end.contact_mm, on_line(end.contact_mm), end.side});
  for (std::size_t i = end.missed; i-- > 0 && problem.x[i] > end.contact_mm;) {
    // Between contact and missed window the next link is on the far side of the extreme line: only the window's bound
    // on that side can bind.
    lines.cut({problem.x[i], problem.e[i] - end.side * problem.tolerance, end.side});
  }
  return lines;
}

double crossing(const LinkLine& a, const LinkLine& b, double low, double high) {
  const double slope = a.slope - b.slope;
  const double x = slope == 0.0 ? high : (b.intercept - a.intercept) / slope;
  return std::clamp(x, low, high);
}

/// Nothing when it takes more than `most` links.
std::optional<LinkPath> path_within(const std::vector<double>& x_mm, const std::vector<double>& e_um,
                                    double tolerance_um, std::size_t most) {
  const auto [low, high] = std::minmax_element(e_um.begin(), e_um.end());
  const double room = 10.0 * (*high - *low + tolerance_um) + 1.0;
  const Problem problem{x_mm, e_um, tolerance_um, *low - room, *high + room, 1e-7 * (tolerance_um + *high - *low)};
  LinkPath path;
  path.joints_mm.push_back(x_mm.front());
  Lines lines(x_mm.front(), problem.low, problem.high);
  std::optional<End> last;
  std::size_t next = 0;
  for (;;) {
    const std::optional<End> end = run_link(problem, lines, next);
    const LinkLine own = end ? end->line : lines.line(lines.middle());
    if (last) path.joints_mm.push_back(crossing(path.lines.back(), own, last->contact_mm, x_mm[last->missed]));
    path.lines.push_back(own);
    if (!end) break;
    if (path.lines.size() == most) return std::nullopt;
    lines = start_link(problem, *end);
    next = end->missed;
    last = end;
  }
  path.joints_mm.push_back(x_mm.back());
  return path;
}

}  // namespace

LinkPath minimum_link_path(const std::vector<double>& x_mm, const std::vector<double>& e_um, double tolerance_um) {
  return *path_within(x_mm, e_um, tolerance_um, x_mm.size());
}

LinkPath tightest_minimum_link_path(const std::vector<double>& x_mm, const std::vector<double>& e_um,
                                    double tolerance_um) {
  LinkPath best = minimum_link_path(x_mm, e_um, tolerance_um);
  const std::size_t fewest = best.lines.size();
  double low = 0.0;
  double high = tolerance_um;
  for (int i = 0; i < 8; ++i) {
    const double middle = 0.5 * (low + high);
    if (auto path = path_within(x_mm, e_um, middle, fewest)) {
      high = middle;
      best = std::move(*path);
    } else {
      low = middle;
    }
  }
  return best;
}

}  // namespace zerodrift::compensation
