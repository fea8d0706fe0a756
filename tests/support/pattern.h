#pragma once
// Printed and etched targets as formulas: reflectance at a point of the target, already blurred by a Gaussian of the
// given sigma. Straight edges, products of them and the speckle are exact convolutions; circles and spokes use the
// error function of the distance to their edge, which is as smooth and moves as exactly. Lengths in um.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace zerodrift::test_support {

enum class PatternKind {
  rings,
  circle_grid,
  cross_hair,
  checkerboard,
  siemens_star,
  speckle,
  ball,  // a polished sphere: no print, only its limb, its shading and the lamp's highlight
  mark,  // small square plate with ring and quadrants, for the fixed reference
  code,  // square cells, black or white at random, like a data matrix
};
inline constexpr std::array<PatternKind, 8> target_kinds = {
    PatternKind::rings,        PatternKind::circle_grid, PatternKind::cross_hair, PatternKind::checkerboard,
    PatternKind::siemens_star, PatternKind::speckle,     PatternKind::ball,       PatternKind::code};
std::string name_of(PatternKind kind);

/// Where the lamp stands, as the part of the sphere's normal that mirrors it into the camera (-1 .. 1 each).
struct LampDirection {
  double x = -0.28;
  double y = 0.33;
};

struct Paint {
  double coverage;  // 0 beside the target, 1 on it
  double reflectance;
};

class Pattern {
 public:
  /// Fills a square (the ball: a circle) of +-half_um. The seed varies proportions, so the same kind with another seed
  /// is another target.
  Pattern(PatternKind kind, double half_um, std::uint64_t seed);

  PatternKind kind() const { return m_kind; }
  double half_um() const { return m_half_um; }
  Paint at(double x_um, double y_um, double sigma_um, const LampDirection& lamp) const;

 private:
  struct Bump {
    double x_um;
    double y_um;
    double sigma_um;
    double height;
  };

  double rings(double x, double y, double sigma) const;
  double circle_grid(double x, double y, double sigma) const;
  double cross_hair(double x, double y, double sigma) const;
  double checkerboard(double x, double y, double sigma) const;
  double siemens_star(double x, double y, double sigma) const;
  double speckle(double x, double y, double sigma) const;
  double mark(double x, double y, double sigma) const;
  double code(double x, double y, double sigma) const;
  double ball(double x, double y, double sigma, const LampDirection& lamp) const;
  void scatter_bumps(std::uint64_t seed);

  PatternKind m_kind;
  double m_half_um;
  double m_proportion;                     // 0.9 .. 1.1 by the seed
  int m_count;                             // spokes or squares
  std::vector<std::vector<Bump>> m_cells;  // speckle, by place
  int m_cells_a_side = 0;
  std::vector<std::uint8_t> m_black;  // cells of the code, row by row
};

}  // namespace zerodrift::test_support
