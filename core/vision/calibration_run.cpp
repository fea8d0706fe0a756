#include "core/vision/calibration_run.h"

#include <fmt/format.h>

#include <cmath>

#include "core/vision/error_view.h"
#include "core/vision/standing_pictures.h"

namespace zerodrift::vision {
namespace {

std::map<std::string, double> place(const CalibrationPlan& plan, double x_mm, double y_mm) {
  std::map<std::string, double> out = plan.centre_mm;
  out[plan.axes[0]] += x_mm;
  out[plan.axes[1]] += y_mm;
  return out;
}

struct Seen {
  CalibrationView view;
  std::vector<GrayImage> frames;
  Seconds when{0.0};  // host time
};

/// The move to a position by way of its approach, as one: the pictures before it show the position before.
Result<acquisition::Stand> come_by(acquisition::MachineIo& machine, const CalibrationPlan& plan,
                                   const ProposedPosition& at, Clock& host) {
  ZD_TRY(const acquisition::Stand on_the_way,
         acquisition::come_to(machine, place(plan, at.approach_x_mm, at.approach_y_mm), host));
  ZD_TRY(acquisition::Stand stand, acquisition::come_to(machine, place(plan, at.x_mm, at.y_mm), host));
  stand.left = on_the_way.left;
  for (std::size_t i = 0; i < 3; ++i) stand.came_mm[i] = std::max(stand.came_mm[i], on_the_way.came_mm[i]);
  return stand;
}

Result<std::vector<GrayImage>> frames_at(const PictureSource& camera, const acquisition::Stand& stand,
                                         const Region& region, const CalibrationPlan& plan,
                                         const TaskContext& context) {
  StandingLook look;
  look.region = region;
  look.latency = plan.latency;
  look.pictures = plan.frames;
  look.picture_timeout = plan.frame_timeout;
  ZD_TRY(const Pictures pictures, standing_pictures(camera, stand, look, context));
  std::vector<GrayImage> out;
  for (const auto& picture : pictures) out.push_back(picture->image);
  return out;
}

struct Pattern {
  const Target& target;
  const std::vector<Target>& marks;
};

void take(const Location& at, CalibrationView& view) {
  view.x_px = at.x_px;
  view.y_px = at.y_px;
  view.sigma_px = std::hypot(at.sigma_x_px, at.sigma_y_px) / std::sqrt(2.0);
}

MeanLocation located(const Pattern& pattern, const std::vector<GrayImage>& frames) {
  std::vector<Location> locations;
  for (const GrayImage& frame : frames) {
    std::vector<Location> seen;
    Location at = locate_against(pattern.target, pattern.marks, frame, &seen);
    // On its way the target may hide a mark that it leaves free where errors are measured.
    if (!at.ok && !marks_not_seen(seen).empty()) at = pattern.target.locate(frame);
    locations.push_back(std::move(at));
  }
  return mean_of(locations);
}

Result<Seen> see(acquisition::MachineIo& machine, const PictureSource& camera, const Pattern& pattern,
                 const CalibrationPlan& plan, const ProposedPosition& at, const TaskContext& context, Clock& host) {
  ZD_TRY(const acquisition::Stand stand, come_by(machine, plan, at, host));
  Seen seen;
  seen.when = stand.since;
  ZD_TRY(const acquisition::MachineSample sample, machine.read());
  ZD_TRY(seen.frames, frames_at(camera, stand, pattern.target.region(), plan, context));
  const auto coordinate = [&](int axis) -> double {
    const auto found = sample.axes.find(plan.axes[static_cast<std::size_t>(axis)]);
    return found == sample.axes.end() ? std::nan("") : found->second;
  };
  seen.view.image = fmt::format("position {:+.3f}, {:+.3f} mm", at.x_mm, at.y_mm);
  seen.view.x_mm = coordinate(0);
  seen.view.y_mm = coordinate(1);
  const MeanLocation mean = located(pattern, seen.frames);
  if (!mean.location.ok) {
    return fail(ErrorCode::target_refused, {{"reason", mean.location.reason + " at " + seen.view.image}});
  }
  take(mean.location, seen.view);
  return seen;
}

// A picture may be spoilt by something that is over a moment later: a position where the target is refused, or the
// camera hangs, gets a second look.
Result<Seen> see_patiently(acquisition::MachineIo& machine, const PictureSource& camera, const Pattern& pattern,
                           const CalibrationPlan& plan, const ProposedPosition& at, const TaskContext& context,
                           Clock& host) {
  Result<Seen> seen = see(machine, camera, pattern, plan, at, context, host);
  if (seen || context.cancelled()) return seen;
  const ErrorCode code = seen.error().code;
  if (code != ErrorCode::target_refused && code != ErrorCode::camera_frozen) return seen;
  return see(machine, camera, pattern, plan, at, context, host);
}

// The positions measured with what their pictures teach together: the pixels that stand still taken out.
CalibrationOutcome taught(const Pattern& pattern, const std::vector<Seen>& all, std::vector<CalibrationView>& views) {
  CalibrationOutcome out{{}, pattern.target, {}};
  for (const Seen& seen : all) out.frames.push_back(seen.frames.back());
  out.target = pattern.target.learned_from(out.frames);
  for (const Seen& seen : all) {
    CalibrationView view = seen.view;
    const MeanLocation mean = located({out.target, pattern.marks}, seen.frames);
    if (mean.location.ok) take(mean.location, view);
    views.push_back(view);
  }
  return out;
}

/// The view that shows the target farther from where the machine was sent than heat, the machine's own scatter and the
/// picture can put it: a picture of another moment, a target that slipped, an axis that is not where it says.
std::optional<OddView> leapt(const std::vector<Seen>& all, const std::vector<CalibrationView>& views,
                             const Calibration& calibration, const CalibrationPlan& plan, double& limit_um) {
  const std::optional<OddView> odd = oddest_view(views);
  if (!odd) return std::nullopt;
  Seconds first = all.front().when;
  Seconds last = all.front().when;
  for (const Seen& seen : all) {
    first = std::min(first, seen.when);
    last = std::max(last, seen.when);
  }
  const double minutes = (last - first).count() * plan.time_factor / 60.0;
  const double picture_um = views[odd->view].sigma_px * calibration.scale_um_per_px;
  constexpr double coverage = 4.0;  // standard uncertainties
  limit_um = plan.drift.least_um + plan.drift.um_per_min * minutes +
             coverage * std::hypot(picture_um, CalibrationLimits().repeatability_um);
  return odd->apart_um > limit_um ? odd : std::nullopt;
}

}  // namespace

Result<CalibrationOutcome> run_calibration(acquisition::MachineIo& machine, const PictureSource& camera,
                                           const Target& target, const std::vector<Target>& marks,
                                           const CalibrationPlan& plan, const TaskContext& context,
                                           const CalibrationWatcher& watcher, Clock& host) {
  const Pattern pattern{target, marks};
  const std::vector<ProposedPosition> positions = propose_positions(plan.span_mm, plan.per_side, plan.approach_mm);
  const int count = static_cast<int>(positions.size());
  std::vector<Seen> all;
  for (const ProposedPosition& at : positions) {
    if (context.cancelled()) return fail(ErrorCode::cancelled);
    ZD_TRY(Seen seen, see_patiently(machine, camera, pattern, plan, at, context, host));
    all.push_back(std::move(seen));
    const int done = static_cast<int>(all.size());
    if (watcher) watcher(done, count, all.back().frames.back(), target.locate(all.back().frames.back()));
    context.progress(static_cast<double>(done) / count, "calibration");
  }
  CalibrationOutcome out{{}, target, {}};
  Result<Calibration> calibration = fail(ErrorCode::internal);
  std::optional<OddView> odd;  // that does not fit the others
  double limit_um = 0.0;
  const auto judge = [&] {
    std::vector<CalibrationView> views;
    out = taught(pattern, all, views);
    calibration = calibrate(views);
    const bool refused = !calibration && calibration.error().code == ErrorCode::calibration_refused;
    odd = refused ? oddest_view(views) : std::nullopt;
    if (calibration) odd = leapt(all, views, *calibration, plan, limit_um);
  };
  judge();
  // One view that does not fit the others may be a picture of another moment: it is taken anew before all is refused.
  if (odd) {
    ZD_TRY(all[odd->view], see_patiently(machine, camera, pattern, plan, positions[odd->view], context, host));
    judge();
  }
  ZD_CHECK(machine.move_to(place(plan, positions[0].approach_x_mm, positions[0].approach_y_mm)));
  ZD_CHECK(machine.move_to(place(plan, 0.0, 0.0)));
  ZD_CHECK(calibration);
  if (odd) {
    return fail(ErrorCode::calibration_refused,
                {{"reason",
                  fmt::format("{} shows the target {:.1f} um from where the machine was sent, heat can make {:.1f} um",
                              all[odd->view].view.image, odd->apart_um, limit_um)}});
  }
  out.calibration = std::move(*calibration);
  return out;
}

}  // namespace zerodrift::vision
