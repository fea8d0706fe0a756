#pragma once
// Sessions written by render_frames (tests/support), read back for the benchmark.

#include <filesystem>
#include <string>
#include <vector>

#include "core/vision/image.h"
#include "core/vision/measure_files.h"

namespace zerodrift::bench {

struct BenchFrame {
  std::string name;
  vision::GrayImage image;
  bool valid = false;
  double x_px = 0.0, y_px = 0.0;              // displacement in the picture
  double ex_um = 0.0, ey_um = 0.0;            // along the machine's axes, without the camera's drift
  double bound_x_px = 0.0, bound_y_px = 0.0;  // Cramer-Rao; NaN if it was not computed
};

struct BenchView {
  vision::GrayImage image;
  double x_mm = 0.0, y_mm = 0.0;  // recorded by the machine
  double true_x_px = 0.0, true_y_px = 0.0;
};

struct BenchSession {
  std::string set;
  std::string target;
  vision::GrayImage picture;  // the template
  vision::Region region;
  std::vector<vision::Region> marks;
  std::vector<BenchView> views;
  std::vector<BenchFrame> frames;
};

Result<BenchSession> read_session(const std::filesystem::path& folder);

}  // namespace zerodrift::bench
