#pragma once
// Calibration of a camera against the machine (V2): from the target's image coordinates at known machine positions to
// um_from_px, the full 2x2 that turns a displacement in px (x right, y down) into one in um along two machine axes.
// Machine coordinates are those of the axes seen along the image's right and up directions; scale, rotation, mirroring
// and shear are all in the 2x2. Whichever of camera and target moves with the spindle: the displacement measured at the
// same commanded position is the error, actual - commanded.

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/vision/target.h"

namespace zerodrift::vision {

/// One position of the calibration: what the controller said, what the camera saw.
struct CalibrationView {
  std::string image;  // name, for messages
  double x_mm = 0.0;  // machine coordinate along the axis seen to the right
  double y_mm = 0.0;  // along the axis seen upwards
  double x_px = 0.0;  // displacement since the template
  double y_px = 0.0;
  double sigma_px = 0.0;       // stated of both, rms; 0: not known
  double residual_x_um = 0.0;  // machine coordinate - calibrated image coordinate
  double residual_y_um = 0.0;
};

struct ErrorUm {
  double x_um = 0.0;
  double y_um = 0.0;
  double sigma_x_um = 0.0;
  double sigma_y_um = 0.0;
};

struct Calibration {
  Eigen::Matrix2d um_from_px = Eigen::Matrix2d::Identity();
  Eigen::Matrix4d covariance = Eigen::Matrix4d::Zero();  // of the elements in the order 11, 12, 21, 22
  double rms_um = 0.0;                                   // of the residuals, each coordinate counted
  double leave_one_out_um = 0.0;  // rms of each view predicted from the others; NaN below five views
  double scale_um_per_px = 0.0;
  double rotation_deg = 0.0;         // of the image against the machine's axes, counter-clockwise; mirrored: -90 to 90
  bool mirrored = false;             // left and right exchanged, or top and bottom
  bool handedness_assumed = false;   // two positions cannot show a mirrored camera: it was taken not to be
  std::array<double, 2> range_px{};  // largest displacement seen in the calibration, x and y; 0: not known
  std::vector<CalibrationView> views;
  std::vector<std::string> warnings;

  Eigen::Matrix2d sigma() const;  // standard uncertainty of each element
  /// Within what the calibration has seen, to either side.
  bool covers(const Location& location) const;
  /// Displacement with its uncertainty (target and calibration) in um along the two machine axes.
  ErrorUm to_um(const Location& location) const;
};

struct CalibrationLimits {
  double repeatability_um = 1.0;    // of the machine, assumed where the residuals cannot tell
  double least_span_px = 10.0;      // extent of the positions in every direction
  double least_span_two_px = 30.0;  // distance of two positions
  double least_aspect = 0.1;        // narrow to wide extent: below it they lie on a line
  double largest_rms_um = 5.0;      // or 0.5 % of the span, whichever is larger
  double least_um_per_px = 0.005;   // a tenth of what light resolves
  double largest_um_per_px = 2000.0;
  double largest_scale_sigma = 0.05;  // relative: 1 um of an error of 20 um
};

/// Two views: similarity as in the published method. Three or more: full 2x2 by least squares.
/// Errors: not_enough_data, calibration_refused with the reason.
Result<Calibration> calibrate(std::vector<CalibrationView> views, const CalibrationLimits& limits = {});

struct OddView {
  std::size_t view = 0;
  double apart_um = 0.0;  // from where the others predict it
};
/// Which view the others predict worst; nothing below five views, which cannot tell.
std::optional<OddView> oddest_view(const std::vector<CalibrationView>& views);

/// Whether the views scatter about the calibration by more than chance makes of what their pictures state and a machine
/// of the assumed repeatability, where the pictures state a fair part of it: then it is likelier what they state that
/// is wrong than the machine.
bool scatters_beyond_pictures(const Calibration& calibration, const CalibrationLimits& limits = {});

/// A position to drive to, relative to the place of the template, always reached from the same side (backlash).
struct ProposedPosition {
  double x_mm = 0.0;
  double y_mm = 0.0;
  double approach_x_mm = 0.0;  // drive here first
  double approach_y_mm = 0.0;
};
/// A square grid of per_side x per_side positions over span_mm, the centre first. The expected drift should stay within
/// it.
std::vector<ProposedPosition> propose_positions(double span_mm, int per_side = 3, double approach_mm = 0.1);
/// calibration.json by the contract, with further keys; the mask goes with the region it was learned for.
nlohmann::json to_json(const Calibration& calibration);
Result<Calibration> calibration_from_json(const nlohmann::json& document, const std::string& file,
                                          std::vector<std::string>* warnings = nullptr);
Result<Calibration> read_calibration(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);

}  // namespace zerodrift::vision
