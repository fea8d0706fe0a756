// What is said of a frame in which the target was not measured.

#include "core/vision/target.h"

namespace zerodrift::vision {

std::string_view words_of(Refusal refusal) {
  switch (refusal) {
    case Refusal::none:
      return "";
    case Refusal::missing:
      return "target missing";
    case Refusal::wrong_target:
      return "target occluded, or another one";
    case Refusal::occluded:
      return "target occluded";
    case Refusal::glare:
      return "glare";
    case Refusal::dim:
      return "too little light or contrast";
    case Refusal::blurred:
      return "too blurred";
    case Refusal::out_of_view:
      return "target out of view";
    case Refusal::too_different:
      return "too different from the template";
    case Refusal::ambiguous:
      return "seen in part, may be a period further";
    case Refusal::moved_apart:
      return "parts of the region have moved apart";
    case Refusal::other_size:
      return "another resolution than the template";
  }
  return "";
}

}  // namespace zerodrift::vision
