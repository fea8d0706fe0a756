#pragma once
// Camera frames computed from formulas, for tests of the image measurement: the displacement of a target is exact to
// the rounding of the grey levels. It shares nothing with the code under test, nor with the virtual machine's camera.
// Pixel (x, y) is centred on (x, y), x right, y down; machine positions in um, right and up.

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "tests/support/pattern.h"

namespace zerodrift::test_support {

struct Vector2 {
  double x = 0.0;
  double y = 0.0;
};

/// The camera as it was mounted: what does not change within a session.
struct Camera {
  int width_px = 640;
  int height_px = 480;
  double um_per_px = 14.0;
  double rotation_rad = 0.03;        // the picture's content turned counter-clockwise
  double shear = 0.0;                // the up axis leans to the right by this
  double aspect = 1.0;               // um per px along up over that along right
  bool mirrored = false;             // right and left swapped
  double distortion_per_px2 = 6e-9;  // undistorted radius = radius (1 + distortion_per_px2 radius^2)
  double vignetting_per_px2 = 7e-7;
  double blur_px = 0.9;  // sigma of the point spread, pixel area included
  double white_level = 225.0;
  std::uint64_t background_seed = 1;
};

/// The camera's own movement since the template, in its picture.
struct CameraShift {
  Vector2 shift_px;
  double roll_rad = 0.0;  // counter-clockwise
  double scale = 1.0;
};

/// Displacement of the target since its home, and rotation about its centre, counter-clockwise as the machine sees it.
struct TargetShift {
  Vector2 shift_um;
  double rotation_rad = 0.0;
};

struct Light {
  double gain = 1.0;
  Vector2 slope_per_px;  // light plane
  double curvature_per_px2 = 0.0;
  double offset_levels = 0.0;
  LampDirection lamp;
};

struct Chip {  // opaque, fixed in the picture
  Vector2 centre_px;
  double radius_px = 0.0;
  double reflectance = 0.2;
};

struct Glare {  // added to the picture: a core that saturates and a wide halo
  Vector2 centre_px;
  double core_levels = 0.0;
  double core_sigma_px = 12.0;
  double halo_levels = 0.0;
  double halo_sigma_px = 60.0;
};

struct SensorNoise {
  double electrons_per_level = 60.0;  // shot noise variance = level / this
  double read_levels = 0.5;
  double variance(double level) const {
    return read_levels * read_levels + (level > 0 ? level : 0) / electrons_per_level;
  }
};

struct FixedMark {
  Vector2 place_um;
  Pattern pattern;
};

/// What is in front of the camera in a session.
struct Stage {
  Pattern target;
  Vector2 home_um;  // of the target's centre
  std::vector<FixedMark> marks;
};

struct FrameSpec {
  TargetShift target;
  CameraShift camera;
  Light light;
  double blur_px = 0.0;  // 0: the camera's own
  Vector2 smear_um;      // movement during the exposure, centred on `target`
  std::vector<Chip> chips;
  std::optional<Glare> glare;
  SensorNoise noise;
  bool target_present = true;
  std::shared_ptr<const Pattern> other_target;  // shown in place of the stage's
  std::uint64_t noise_seed = 0;
};

struct Frame {
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> pixels;
};

/// From the picture to the machine, for one position of the camera.
class ObjectFromPixel {
 public:
  explicit ObjectFromPixel(const Camera& camera, const CameraShift& shift = {});
  Vector2 operator()(double x_px, double y_px) const;

 private:
  const Camera& m_camera;
  CameraShift m_shift;
  double m_cos;
  double m_sin;
};

class FrameRenderer {
 public:
  FrameRenderer(Camera camera, Stage stage);

  const Camera& camera() const { return m_camera; }
  const Stage& stage() const { return m_stage; }

  /// Grey levels without noise, rounding and saturation.
  std::vector<double> levels(const FrameSpec& spec) const;
  Frame render(const FrameSpec& spec) const;

  Vector2 object_from_pixel(Vector2 pixel, const CameraShift& shift = {}) const;
  Vector2 pixel_from_object(Vector2 object_um, const CameraShift& shift = {}) const;
  /// Where a point of the target that the unmoved camera sees at `pixel` with the target at home is seen in the frame.
  Vector2 target_point_seen(Vector2 pixel, const FrameSpec& spec) const;

 private:
  std::vector<double> background(const CameraShift& shift) const;
  void paint(const Pattern& pattern, Vector2 centre_um, double rotation_rad, const FrameSpec& spec, double share,
             const std::vector<double>& under, std::vector<double>& out) const;

  Camera m_camera;
  Stage m_stage;
  std::vector<double> m_background;  // seen by the unmoved camera
};

}  // namespace zerodrift::test_support
