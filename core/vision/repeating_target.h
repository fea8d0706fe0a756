#pragma once
// Targets that look like themselves a period further: grids of dots, checkers, rows of lines. Whoever sees only a part
// of such a target may take it for itself in another place.

#include <cstdint>
#include <optional>
#include <vector>

#include "core/vision/image.h"
#include "core/vision/registration.h"
#include "core/vision/spline_image.h"

namespace zerodrift::vision {

class RepeatingTarget {
 public:
  /// Of the region, or where it lies within a pattern that goes on beyond it and looks the same a period further, of a
  /// larger one about it that shows the pattern's end or a mark; none where the whole picture shows neither.
  static std::optional<RepeatingTarget> that_tells(const GrayImage& image, const Region& region);

  /// The same for a point and the pixels that can be used (as in TemplateSource); `image` as it was.
  RepeatingTarget with(const GrayImage& image, const PixelPoint& point, const std::vector<std::uint8_t>& usable) const;

  const Region& region() const { return m_region; }
  /// False for a pattern that is like itself nowhere.
  bool repeats() const { return !m_periods.empty(); }
  /// Share of its area by which the target differs from itself a period further, where that is least; 1 for
  /// a pattern that is like itself nowhere.
  double told_apart() const;

  struct Doubt {
    bool may_be_elsewhere = false;               // a period further: no more of the frame speaks for the found place
    double unlike = 0.0;                         // share of the region that the found place does not explain
    std::optional<Eigen::Vector2d> likelier_px;  // from the found place to the one for which most more speaks
  };
  Doubt doubt(const GrayImage& frame, const Registration& found) const;

 private:
  RepeatingTarget(const GrayImage& image, const Region& region);
  void compare(const GrayImage& image, const std::vector<std::uint8_t>& usable);

  /// Share of the region that speaks against another place more than against this one. A cover over what only
  /// one place foretells would decide alone: where both do is told apart.
  struct Lead {
    double in_all = 0.0;
    double where_both_tell = 0.0;
  };
  struct Period {
    Eigen::Vector2d shift_px;  // in the template
    Lead lost;                 // over it, where all is seen
  };
  /// Where a frame shows the target that stands `shift_px` of the template from the found place.
  FloatImage likeness(const FloatImage& frame, const FloatImage& visible, const Registration& found,
                      const Eigen::Vector2d& shift_px) const;
  Lead lead(const FloatImage& here, const FloatImage& there, const Eigen::Vector2d& shift_px) const;

  Region m_region;
  PixelPoint m_point;
  int m_step_px;                    // of the samples
  FloatImage m_template, m_usable;  // one value a sample
  double m_even_variance = 0.0;
  std::vector<Period> m_periods;
};

}  // namespace zerodrift::vision
