#include "tests/support/frame_set.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "core/base/noise.h"

namespace zerodrift::test_support {
namespace {

constexpr double machine_repeatability_um = 1.0;
constexpr double usual_half_span_um = 800.0;
constexpr double span_over_drift = 1.5;

double range_px(Disturbance disturbance) {
  return disturbance == Disturbance::large_motion ? 40.0 : 8.0;
}

double either_sign(Noise& noise, double low, double high) {
  const double size = noise.uniform(low, high);
  return noise.uniform() < 0.5 ? -size : size;
}

Camera draw_camera(Noise& noise, std::uint64_t seed) {
  constexpr double degree = std::numbers::pi / 180.0;
  Camera camera;
  camera.um_per_px = noise.uniform(11.0, 18.0);
  camera.rotation_rad = either_sign(noise, 1.0, 4.0) * degree;
  camera.shear = noise.uniform(-0.01, 0.01);
  camera.aspect = noise.uniform(0.995, 1.005);
  camera.mirrored = noise.uniform() < 0.25;
  camera.distortion_per_px2 = either_sign(noise, 0.0008, 0.0025) / (400.0 * 400.0);
  camera.blur_px = noise.uniform(0.8, 1.05);
  camera.background_seed = seed + 17;
  return camera;
}

SensorNoise sensor_of(Disturbance disturbance) {
  if (disturbance == Disturbance::clean) return {2000.0, 0.15};
  if (disturbance == Disturbance::noise) return {18.0, 1.5};
  return {60.0, 0.5};
}

struct Scene {
  FrameRenderer renderer;
  PixelRegion roi;
  std::vector<PixelRegion> mark_rois;
};

Scene draw_scene(PatternKind kind, Disturbance disturbance, std::uint64_t seed, Noise& noise) {
  const Camera camera = draw_camera(noise, seed);
  const bool with_marks = disturbance == Disturbance::camera_drift;
  const double half_px = noise.uniform(80.0, 98.0);
  const Vector2 centre_px{319.5 + noise.uniform(-18.0, 18.0), (with_marks ? 214.5 : 239.5) + noise.uniform(-8.0, 8.0)};
  Stage stage{Pattern(kind, half_px * camera.um_per_px, seed), {}, {}};
  const ObjectFromPixel seen_at(camera);
  stage.home_um = seen_at(centre_px.x, centre_px.y);
  std::vector<PixelRegion> mark_rois;
  if (with_marks) {
    for (const Vector2 place : {Vector2{82.3, 392.6}, Vector2{557.8, 391.2}}) {
      stage.marks.push_back({seen_at(place.x, place.y), Pattern(PatternKind::mark, 36.0 * camera.um_per_px, seed)});
      mark_rois.push_back({static_cast<int>(place.x) - 43, static_cast<int>(place.y) - 43, 88, 88});
    }
  }
  const int reach = static_cast<int>(std::ceil(half_px)) + 6;
  const PixelRegion roi{static_cast<int>(std::lround(centre_px.x + 0.5)) - reach,
                        static_cast<int>(std::lround(centre_px.y + 0.5)) - reach, 2 * reach, 2 * reach};
  return {FrameRenderer(camera, std::move(stage)), roi, std::move(mark_rois)};
}

void disturb_light(FrameSpec& spec, Noise& noise) {
  spec.light.gain = noise.uniform(0.45, 1.15);
  spec.light.slope_per_px = {noise.uniform(-0.35, 0.35) / 320.0, noise.uniform(-0.35, 0.35) / 320.0};
  spec.light.curvature_per_px2 = noise.uniform(-0.5e-6, 0.5e-6);
  spec.light.offset_levels = noise.uniform(0.0, 15.0);
  spec.light.lamp.x += noise.uniform(-0.12, 0.12);
  spec.light.lamp.y += noise.uniform(-0.12, 0.12);
}

/// Chips over 12 to 30 % of the region.
void occlude(FrameSpec& spec, const PixelRegion& roi, Noise& noise) {
  const double wanted = noise.uniform(0.12, 0.30) * roi.width * roi.height;
  double covered = 0.0;
  while (covered < wanted) {
    Chip chip;
    chip.radius_px = noise.uniform(12.0, 30.0);
    const double area = std::numbers::pi * chip.radius_px * chip.radius_px;
    if (covered + area > 0.31 * roi.width * roi.height) break;
    chip.centre_px = {roi.centre().x + noise.uniform(-0.45, 0.45) * roi.width,
                      roi.centre().y + noise.uniform(-0.45, 0.45) * roi.height};
    chip.reflectance = noise.uniform(0.04, 0.75);
    spec.chips.push_back(chip);
    covered += area;
  }
}

Glare draw_glare(const PixelRegion& roi, Noise& noise) {
  Glare glare;
  glare.centre_px = {roi.centre().x + noise.uniform(-0.35, 0.35) * roi.width,
                     roi.centre().y + noise.uniform(-0.35, 0.35) * roi.height};
  glare.core_levels = noise.uniform(200.0, 600.0);
  glare.core_sigma_px = noise.uniform(7.0, 15.0);
  glare.halo_levels = noise.uniform(25.0, 80.0);
  glare.halo_sigma_px = noise.uniform(30.0, 70.0);
  return glare;
}

/// Another kind, or the same kind in another size (speckle: other grains).
std::shared_ptr<const Pattern> other_target(const Pattern& own, int number, std::uint64_t seed, Noise& noise) {
  if (number % 2 == 0 && own.kind() != PatternKind::ball) {
    const double size = own.kind() == PatternKind::speckle ? 1.0 : 0.84;
    return std::make_shared<Pattern>(own.kind(), size * own.half_um(), seed + 1000);
  }
  PatternKind kind = own.kind();
  while (kind == own.kind()) kind = target_kinds[noise.index(target_kinds.size())];
  return std::make_shared<Pattern>(kind, own.half_um(), seed + 1000);
}

CameraShift draw_camera_shift(int number, int count, Noise& noise) {
  const double warm = (number + 1.0) / count;  // the bracket warms up over the session
  CameraShift shift;
  shift.shift_px = {2.5 * warm * noise.uniform(0.6, 1.0), -1.8 * warm * noise.uniform(0.6, 1.0)};
  if (2 * number >= count) {
    shift.roll_rad = either_sign(noise, 50e-6, 300e-6);
    shift.scale = 1.0 + either_sign(noise, 30e-6, 200e-6);
  }
  return shift;
}

/// Turned by 0.2 to 1.2 degrees, either way.
double draw_rotation_rad(Noise& noise) {
  return either_sign(noise, 0.2, 1.2) * std::numbers::pi / 180.0;
}

FrameSpec draw_frame(Disturbance disturbance, const Scene& scene, std::uint64_t seed, int number, int count,
                     Noise& noise) {
  const double um_per_px = scene.renderer.camera().um_per_px;
  const double range_um = um_per_px * range_px(disturbance);
  FrameSpec spec;
  spec.noise = sensor_of(disturbance);
  spec.noise_seed = seed * 1000 + 100 + static_cast<std::uint64_t>(number);
  spec.target.shift_um = {noise.uniform(-range_um, range_um), noise.uniform(-range_um, range_um)};
  switch (disturbance) {
    case Disturbance::clean:
    case Disturbance::noise:
    case Disturbance::large_motion:
      break;
    case Disturbance::light:
      disturb_light(spec, noise);
      break;
    case Disturbance::rotation:
      spec.target.rotation_rad = draw_rotation_rad(noise);
      break;
    case Disturbance::defocus:
      spec.blur_px = noise.uniform(1.5, 2.6);
      break;
    case Disturbance::occluded:
      occlude(spec, scene.roi, noise);
      break;
    case Disturbance::glare:
      spec.glare = draw_glare(scene.roi, noise);
      break;
    case Disturbance::motion_blur: {
      const double length_um = um_per_px * noise.uniform(3.0, 7.0);
      const double direction = noise.uniform(0.0, 2.0 * std::numbers::pi);
      spec.smear_um = {length_um * std::cos(direction), length_um * std::sin(direction)};
      break;
    }
    case Disturbance::missing:
      spec.target_present = false;
      break;
    case Disturbance::wrong_target:
      spec.other_target = other_target(scene.renderer.stage().target, number, seed, noise);
      break;
    case Disturbance::camera_drift:
      spec.camera = draw_camera_shift(number, count, noise);
      break;
  }
  return spec;
}

CalibrationView draw_view(Disturbance disturbance, Vector2 recorded_um, std::uint64_t noise_seed, Noise& noise) {
  CalibrationView view;
  view.recorded_um = recorded_um;
  view.spec.noise = sensor_of(disturbance);
  view.spec.noise_seed = noise_seed;
  view.spec.target.shift_um = {recorded_um.x + machine_repeatability_um * noise.normal(),
                               recorded_um.y + machine_repeatability_um * noise.normal()};
  return view;
}

}  // namespace

std::string name_of(Disturbance disturbance) {
  static const std::array<std::string, disturbances.size()> names = {
      "clean", "noise",       "light",        "rotation", "defocus",      "occluded",
      "glare", "motion_blur", "large_motion", "missing",  "wrong_target", "camera_drift"};
  return names[static_cast<std::size_t>(disturbance)];
}

Session make_session(PatternKind kind, Disturbance disturbance, std::uint64_t seed, int frame_count,
                     double half_span_px) {
  const std::uint64_t own_seed =
      seed * 10007 + static_cast<std::uint64_t>(kind) * 101 + static_cast<std::uint64_t>(disturbance);
  Noise noise(own_seed);
  Scene scene = draw_scene(kind, disturbance, own_seed, noise);
  std::vector<FrameSpec> frames;
  frames.reserve(static_cast<std::size_t>(frame_count));
  for (int i = 0; i < frame_count; ++i) {
    frames.push_back(draw_frame(disturbance, scene, own_seed, i, frame_count, noise));
  }
  const double um_per_px = scene.renderer.camera().um_per_px;
  const double span_um = half_span_px > 0.0
                             ? half_span_px * um_per_px
                             : std::max(usual_half_span_um, span_over_drift * range_px(disturbance) * um_per_px);
  std::vector<CalibrationView> grid;
  for (int i = 0; i < 9; ++i) {
    const int column = i % 3 - 1;
    const int row = i / 3 - 1;
    const Vector2 place{span_um * column, span_um * row};
    grid.push_back(draw_view(disturbance, place, own_seed * 1000 + 10 + static_cast<std::uint64_t>(i), noise));
  }
  std::vector<CalibrationView> moves;
  for (const Vector2 place : {Vector2{0.0, 0.0}, Vector2{span_um, 0.0}, Vector2{0.0, span_um}}) {
    moves.push_back(draw_view(disturbance, place, own_seed * 1000 + 20 + moves.size(), noise));
  }
  FrameSpec template_spec;
  template_spec.noise = sensor_of(disturbance);
  template_spec.noise_seed = own_seed * 1000;
  const Vector2 point = scene.roi.centre();
  return {kind,
          disturbance,
          seed,
          std::move(scene.renderer),
          scene.roi,
          point,
          scene.mark_rois,
          template_spec,
          std::move(frames),
          std::move(grid),
          std::move(moves)};
}

FrameTruth truth_of(const Session& session, const FrameSpec& spec) {
  const FrameRenderer& renderer = session.renderer;
  FrameTruth truth;
  truth.valid = spec.target_present && !spec.other_target;
  const Vector2 seen = renderer.target_point_seen(session.point_px, spec);
  truth.shift_px = {seen.x - session.point_px.x, seen.y - session.point_px.y};
  FrameSpec unmoved = spec;
  unmoved.camera = {};
  const Vector2 from = renderer.object_from_pixel(session.point_px);
  const Vector2 to = renderer.object_from_pixel(renderer.target_point_seen(session.point_px, unmoved));
  truth.shift_um = {to.x - from.x, to.y - from.y};
  for (const FixedMark& mark : renderer.stage().marks) {
    const Vector2 before = renderer.pixel_from_object(mark.place_um);
    const Vector2 after = renderer.pixel_from_object(mark.place_um, spec.camera);
    truth.marks_px.push_back({after.x - before.x, after.y - before.y});
  }
  return truth;
}

}  // namespace zerodrift::test_support
