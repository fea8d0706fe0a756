#pragma once
// What others would use, with OpenCV: the yardsticks of the table. Each gives the displacement of the region's centre.

#include <optional>
#include <string>
#include <vector>

#include "core/vision/image.h"

namespace zerodrift::bench {

struct PeerAnswer {
  double x_px = 0.0;
  double y_px = 0.0;
  bool accepted = false;  // by the usual threshold: correlation above 0.8
};

std::vector<std::string> peer_names();
/// Nothing when the method fails.
std::optional<PeerAnswer> run_peer(const std::string& name, const vision::GrayImage& image,
                                   const vision::Region& region, const vision::GrayImage& frame);

}  // namespace zerodrift::bench
