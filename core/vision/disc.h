#pragma once
// A disc or ball in a template. What the region holds beside it may stand still while it moves, and may be all that the
// registration follows; and of another size it fits nearly as well. Where a frame shows the circle tells both.

#include <optional>
#include <vector>

#include "core/vision/image.h"
#include "core/vision/registration.h"
#include "core/vision/template_model.h"

namespace zerodrift::vision {

class Disc {
 public:
  /// Those without a print within that the named point lies in, or where it lies in none all of them; of a ball with
  /// this rim none of its highlights. The source must be a registrar's.
  static std::vector<Disc> all_in(const TemplateSource& source, const std::optional<RimCircle>& rim);

  enum class Seen { as_expected, elsewhere, of_another_size };
  /// In a frame, against where the registration has found the target; `named` is the named point in the template. As
  /// expected too where the circle cannot be made out.
  Seen in(const GrayImage& frame, const PixelPoint& named, const Registration& found) const;

 private:
  RimCircle m_circle;  // its middle from the named point
  double m_noise_levels = 0.0;
  bool m_is_rim = false;
};

}  // namespace zerodrift::vision
