#pragma once
// Targets that look like themselves a period further: grids of dots, checkers, rows of lines. Whoever sees only a part
// of such a target may take it for itself in another place.

#include <cstdint>
#include <vector>

#include "core/vision/image.h"
#include "core/vision/registration.h"
#include "core/vision/spline_image.h"

namespace zerodrift::vision {

class RepeatingTarget {
 public:
  /// `usable` as in TemplateSource.
  RepeatingTarget(const GrayImage& image, const Region& region, const PixelPoint& point,
                  const std::vector<std::uint8_t>& usable);

  /// False for a pattern that is like itself nowhere.
  bool repeats() const { return !m_periods.empty(); }
  /// Whether the target, found there, may as well stand a period further: the found place explains no more of the
  /// frame, and contradicts no less of it, than the other does.
  bool may_be_elsewhere(const GrayImage& frame, const Registration& found) const;

 private:
  struct Period {
    Eigen::Vector2d shift_px;  // in the template
    double lost;               // by which the balance falls where all is seen
  };
  /// Gradient energy, of all, that a place explains less what is seen there and otherwise.
  double balance(const FloatImage& frame, const FloatImage& visible, const Registration& found,
                 const Eigen::Vector2d& shift_px) const;

  Region m_region;
  PixelPoint m_point;
  int m_step_px;                              // of the samples
  FloatImage m_template, m_energy, m_usable;  // one value a sample
  std::vector<Period> m_periods;
};

}  // namespace zerodrift::vision
