#pragma once
// Where the template may be in a frame, to the whole pixel: normalized cross-correlation down a pyramid.
// Checkers, grids and rings resemble themselves one period further, so the best few candidates are handed on. Where
// nothing is found, a glaring spot may have drowned the target: then it is sought in images whose smooth light is taken
// off and whose extremes are cut.

#include <vector>

#include "core/vision/image.h"

namespace zerodrift::vision {

struct Candidate {
  int dx_px = 0;  // displacement of the template's region
  int dy_px = 0;
  double correlation = 0.0;  // zero-mean normalized, -1 .. 1
};

class CoarseSearch {
 public:
  CoarseSearch(const GrayImage& image, const Region& region);
  /// The best places in the whole frame, best first, at most `count`; part of the region may lie outside the frame.
  std::vector<Candidate> find(const GrayImage& frame, int count) const;

 private:
  std::vector<Candidate> find_from(const std::vector<GrayImage>& frames, const std::vector<GrayImage>& templates,
                                   int top_level, int count) const;

  Region m_region;
  std::vector<GrayImage> m_templates;  // level k is smaller by 2^k
  std::vector<GrayImage> m_flat;       // the same without smooth light
  bool m_fine_pattern = false;         // of which the coarsest level has lost a part
};

}  // namespace zerodrift::vision
