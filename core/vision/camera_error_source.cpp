#include "core/vision/camera_error_source.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <deque>
#include <future>
#include <limits>
#include <thread>

namespace zerodrift::vision {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
// A clean target is measured with nearly all of its pixels.
constexpr double covered_share = 0.8;
// A move by fewer pixels need not show in the small copies of the pictures that tell when it was seen.
constexpr double least_visible_px = 5.0;
constexpr double most_of_spacing = 0.9;  // the next picture after that is the one that is meant
constexpr int tries = 3;                 // windows of pictures before a measurement is given up
constexpr const char* axis_names[] = {"X", "Y", "Z"};

// What a dead camera is called among the reasons of a sample.
std::string problem_of(const Error& error) {
  switch (error.code) {
    case ErrorCode::camera_unreachable:
      return "camera does not answer";
    case ErrorCode::camera_silent:
      return "camera sends no picture";
    case ErrorCode::camera_frozen:
      return "camera is frozen";
    case ErrorCode::camera_exchanged:
      return "another camera than before";
    case ErrorCode::camera_ambiguous:
      return "several cameras have this address";
    case ErrorCode::camera_setting:
      return "camera does not take its setting";
    case ErrorCode::camera_format:
      return "pixel format of the camera is not read";
    default:
      return std::string(name_of(error.code));
  }
}

// Weighted mean of the directions as the cameras see them.
struct Combined {
  double weight = 0.0;
  double sum = 0.0;

  void add(double value_um, double sigma_um) {
    const double w = 1.0 / std::max(sigma_um * sigma_um, 1e-12);
    weight += w;
    sum += w * value_um;
  }
};

/// A reason, with the camera that gives it.
std::string in_view(const TargetView& view, const std::string& problem) {
  return fmt::format("camera {}: {}", view.id(), problem);
}

/// How far the machine came across what the camera sees, um.
double visible_way_um(const TargetView& view, const acquisition::Stand& stand) {
  double way_mm = 0.0;
  for (const int axis : view.axes()) way_mm = std::max(way_mm, stand.came_mm[static_cast<std::size_t>(axis)]);
  return 1000.0 * way_mm;
}

}  // namespace

/// The newest located pictures of one look.
struct CameraErrorSource::Window {
  std::deque<SeenTarget> pictures;
  std::size_t needed = 5;
  int judged = 0;                                    // pictures since the look began
  std::optional<acquisition::LatencyBounds> bounds;  // of the latency, by the move to the stand

  void add(SeenTarget picture) {
    ++judged;
    pictures.push_back(std::move(picture));
    if (pictures.size() > needed) pictures.pop_front();
  }
  bool full() const { return pictures.size() == needed; }
  std::vector<Location> locations() const {
    std::vector<Location> out;
    for (const SeenTarget& one : pictures) out.push_back(one.location);
    return out;
  }
  acquisition::StandstillVerdict verdict(const Calibration& calibration,
                                         const acquisition::StandstillRule& rule) const {
    std::vector<acquisition::Sighting> sightings;
    for (const SeenTarget& one : pictures) {
      const Location& at = one.location;
      if (!at.ok) continue;
      const Eigen::Vector2d um = calibration.um_from_px * Eigen::Vector2d(at.x_px, at.y_px);
      const double own_px =
          std::sqrt(std::max(0.0, 0.5 * (at.sigma_x_px * at.sigma_x_px + at.sigma_y_px * at.sigma_y_px) -
                                      at.shared_sigma_px * at.shared_sigma_px));
      const double scale = calibration.um_from_px.norm() / std::sqrt(2.0);
      sightings.push_back({one.stamp, {um.x(), um.y()}, {own_px * scale, own_px * scale}});
    }
    return acquisition::standstill(sightings, rule);
  }
};

CameraErrorSource::CameraErrorSource(std::vector<ErrorView> views, MeasureOptions options)
    : CameraErrorSource(
          [&] {
            std::vector<std::unique_ptr<TargetView>> located;
            for (ErrorView& view : views) located.push_back(located_view(std::move(view), options.frame_timeout));
            return located;
          }(),
          options, host_clock()) {}

CameraErrorSource::CameraErrorSource(std::vector<std::unique_ptr<TargetView>> views, MeasureOptions options,
                                     Clock& host)
    : m_views(std::move(views)), m_options(options), m_host(host), m_zero(m_views.size()), m_states(m_views.size()) {
  for (std::size_t k = 0; k < m_views.size(); ++k) {
    m_states[k].id = m_views[k]->id();
    m_latencies.emplace_back(m_views[k]->latency());
  }
}

acquisition::Latency CameraErrorSource::latency_of(std::size_t view) const {
  const std::lock_guard lock(m_mutex);
  return m_latencies[view].now();
}

/// Whether the pictures show the stand: the move to it was seen in them, or they are later than any latency. Pictures
/// of one camera come in the order in which they were taken, so after that move all show the stand.
bool CameraErrorSource::arrived(std::size_t view, const acquisition::Stand& stand, Window& window) const {
  const TargetView& camera = *m_views[view];
  const ShownSince shown = camera.shown_since(stand.left, window.needed);
  const double scale_um = camera.calibration().um_from_px.norm() / std::sqrt(2.0);
  const bool must_show = visible_way_um(camera, stand) > least_visible_px * scale_um;
  window.bounds.reset();
  if (!shown.change) return !must_show || window.pictures.front().stamp > surely_here(view, stand);
  if (must_show) {
    window.bounds = {(shown.change->last_other - stand.since).count(), (shown.change->first_same - stand.left).count()};
  }
  return shown.change->first_same <= window.pictures.front().stamp;
}

Seconds CameraErrorSource::surely_here(std::size_t view, const acquisition::Stand& stand) const {
  return stand.since + std::max(Seconds(acquisition::assumed_latency_s), latency_of(view).settle());
}

ViewState CameraErrorSource::state_of(std::size_t view, const acquisition::Stand& stand, const Window& window) const {
  ViewState state;
  state.id = m_views[view]->id();
  state.marks = m_views[view]->marks();
  const acquisition::Latency latency = latency_of(view);
  Seconds sum{0.0};
  for (const SeenTarget& one : window.pictures) {
    sum += one.stamp;
    state.frame = one.frame;
    state.turn = one.turn;
    state.references = one.references;
    const std::string lost = marks_not_seen(one.references);
    if (!one.location.ok) continue;
    if (!lost.empty()) state.lost_marks = lost;
    state.least_share = std::min(state.least_share, one.location.inlier_share);
  }
  state.seen = sum / static_cast<double>(window.pictures.size()) - Seconds(latency.mean_s);
  state.settled = {state.id, latency.mean_s, latency.spread_s, (window.pictures.front().stamp - stand.since).count(),
                   false};
  const MeanLocation mean = mean_of(window.locations());
  state.location = mean.location;
  state.good_frames = mean.good;
  state.refused_frames = mean.refused;
  state.scatter_x_px = mean.scatter_x_px;
  state.scatter_y_px = mean.scatter_y_px;
  if (!mean.location.ok) state.problem = mean.location.reason;
  return state;
}

Result<ViewState> CameraErrorSource::look(std::size_t view, const acquisition::Stand& stand, const CameraTurn& turn,
                                          Meanwhile& meanwhile, const TaskContext& context) {
  TargetView& camera = *m_views[view];
  Window window;
  window.needed = static_cast<std::size_t>(std::max(1, m_options.frames));
  const double spacing_s =
      most_of_spacing * m_options.span_s / static_cast<double>(std::max<std::size_t>(1, window.needed - 1));
  CameraTurn last = turn;
  Seconds after = stand.since + latency_of(view).settle();
  for (;;) {
    ZD_TRY(SeenTarget picture, camera.next(after, last, context.stop));
    after = picture.stamp + Seconds(spacing_s);
    last = picture.turn;
    window.add(std::move(picture));
    if (view == 0 && !meanwhile.moved) {
      meanwhile.still = stand.still();
      meanwhile.moved = !meanwhile.still;
    }
    if (meanwhile.moved) return state_of(view, stand, window);
    if (!window.full()) continue;
    const bool here = arrived(view, stand, window);
    const acquisition::StandstillVerdict verdict = window.verdict(camera.calibration(), m_options.rule);
    ViewState state = state_of(view, stand, window);
    const bool located = state.problem.empty();
    const bool rests =
        located ? verdict.stands : camera.shown_since(window.pictures.front().stamp, window.needed).at_rest;
    const Seconds until = std::max(stand.until, here ? stand.since : surely_here(view, stand));
    const bool again = window.judged < tries * static_cast<int>(window.needed) || after <= until;
    if (!(here && rests) && again) continue;
    // What hides the target hides its move too, and is the reason.
    if (located && !here) {
      state.problem = "the picture does not show the move to the measuring position";
    } else if (located && !rests) {
      state.problem = verdict.reason;
    }
    const Eigen::Matrix2d px_from_um = camera.calibration().um_from_px.inverse();
    const Eigen::Vector2d trend = px_from_um * Eigen::Vector2d(verdict.trend_um[0], verdict.trend_um[1]);
    state.location.sigma_x_px = std::hypot(state.location.sigma_x_px, trend.x());
    state.location.sigma_y_px = std::hypot(state.location.sigma_y_px, trend.y());
    const std::lock_guard lock(m_mutex);
    // Of what hides the target no one knows when it came: it says nothing about the latency.
    state.settled.widened = located && window.bounds && m_latencies[view].add(*window.bounds);
    return state;
  }
}

std::vector<Result<ViewState>> CameraErrorSource::look_all(const acquisition::Stand& stand, Meanwhile& meanwhile,
                                                           const TaskContext& context) {
  // All cameras at the same time: the machine drifts while it is looked at.
  std::vector<CameraTurn> turns;
  for (const ViewState& state : states()) turns.push_back(state.turn);
  std::vector<std::future<Result<ViewState>>> pending;
  for (std::size_t k = 1; k < m_views.size(); ++k) {
    pending.push_back(std::async(std::launch::async, [this, k, &stand, &turns, &meanwhile, &context] {
      return look(k, stand, turns[k], meanwhile, context);
    }));
  }
  std::vector<Result<ViewState>> looks;
  if (!m_views.empty()) looks.push_back(look(0, stand, turns[0], meanwhile, context));
  for (auto& one : pending) looks.push_back(one.get());
  return looks;
}

Status CameraErrorSource::take_zero(const acquisition::Stand& stand, const TaskContext& context) {
  // Every error counts from it: it is waited for as if no latency were known.
  acquisition::Stand patient = stand;
  for (std::size_t k = 0; k < m_views.size(); ++k) {
    patient.since = std::max(patient.since, surely_here(k, stand) - latency_of(k).settle());
  }
  Meanwhile meanwhile;
  auto looks = look_all(patient, meanwhile, context);
  ZD_CHECK(meanwhile.still);
  ZD_CHECK(stand.still());
  for (std::size_t k = 0; k < m_views.size(); ++k) {
    ZD_TRY(ViewState state, std::move(looks[k]));
    if (!state.problem.empty()) {
      return fail(ErrorCode::target_refused, {{"reason", in_view(*m_views[k], state.problem)}});
    }
    m_zero[k] = {state.location.x_px, state.location.y_px, state.location.sigma_x_px, state.location.sigma_y_px};
    state.trail.push_back({state.location.x_px, state.location.y_px});
    const std::lock_guard lock(m_mutex);
    m_states[k] = std::move(state);
  }
  return {};
}

Result<acquisition::ErrorSample> CameraErrorSource::measure(const acquisition::Stand& stand,
                                                            const TaskContext& context) {
  std::array<Combined, 3> combined{};
  acquisition::ErrorSample sample;
  std::optional<Error> dead;
  std::size_t dead_count = 0;
  std::vector<Seconds> seen;
  std::string lost;
  Meanwhile meanwhile;
  auto looks = look_all(stand, meanwhile, context);
  if (!meanwhile.still) {
    const bool moved = meanwhile.still.error().code == ErrorCode::machine_not_ready;
    return acquisition::not_measured(
        {moved ? "the machine moved while it was measured" : "the controller does not answer"}, true);
  }
  for (std::size_t k = 0; k < m_views.size(); ++k) {
    const TargetView& view = *m_views[k];
    Result<ViewState>& looked = looks[k];
    if (!looked) {
      if (looked.error().code == ErrorCode::cancelled) return fail(looked.error());
      sample.problems.push_back(in_view(view, problem_of(looked.error())));
      dead = looked.error();
      ++dead_count;
      const std::lock_guard lock(m_mutex);
      m_states[k].problem = problem_of(looked.error());
      continue;
    }
    ViewState& state = *looked;
    sample.settled.push_back(state.settled);
    if (state.problem.empty()) {
      Location since_zero = state.location;
      since_zero.x_px -= m_zero[k].x_px;
      since_zero.y_px -= m_zero[k].y_px;
      since_zero.sigma_x_px = std::hypot(since_zero.sigma_x_px, m_zero[k].sigma_x_px);
      since_zero.sigma_y_px = std::hypot(since_zero.sigma_y_px, m_zero[k].sigma_y_px);
      state.error = view.calibration().to_um(since_zero);
      seen.push_back(state.seen);
      combined[view.axes()[0]].add(state.error.x_um, state.error.sigma_x_um);
      combined[view.axes()[1]].add(state.error.y_um, state.error.sigma_y_um);
      if (state.least_share < covered_share) {
        const std::string percent = std::to_string(static_cast<int>(100.0 * state.least_share));
        sample.remark = Error{ErrorCode::target_partly_covered, {{"view", view.id()}, {"percent", percent}}};
      }
      if (!state.lost_marks.empty()) lost += (lost.empty() ? "" : "; ") + in_view(view, state.lost_marks);
    } else {
      state.error = {nan_value, nan_value, nan_value, nan_value};
      sample.problems.push_back(in_view(view, state.problem));
    }
    const std::lock_guard lock(m_mutex);
    state.trail = std::move(m_states[k].trail);
    if (state.problem.empty()) state.trail.push_back({state.location.x_px, state.location.y_px});
    m_states[k] = std::move(state);
  }
  if (dead && dead_count == m_views.size()) return fail(*dead);
  if (!lost.empty()) sample.remark = Error{ErrorCode::reference_lost, {{"reason", lost}}};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const bool measured = combined[axis].weight > 0.0;
    sample.error_um[axis] = measured ? combined[axis].sum / combined[axis].weight : nan_value;
    sample.sigma_um[axis] = measured ? 1.0 / std::sqrt(combined[axis].weight) : nan_value;
  }
  if (!seen.empty()) {
    Seconds sum{0.0};
    for (const Seconds& one : seen) sum += one;
    sample.seen = sum / static_cast<double>(seen.size());
  }
  return sample;
}

std::string CameraErrorSource::name() const {
  std::string text = "camera";
  for (const auto& view : m_views) {
    text += " " + view->id() + " (" + axis_names[view->axes()[0]] + ", " + axis_names[view->axes()[1]] + ")";
  }
  return text;
}

std::optional<std::array<double, 3>> CameraErrorSource::zero_um() const {
  std::array<double, 3> sum{};
  std::array<int, 3> count{};
  for (std::size_t k = 0; k < m_views.size(); ++k) {
    const Eigen::Vector2d um = m_views[k]->calibration().um_from_px * Eigen::Vector2d(m_zero[k].x_px, m_zero[k].y_px);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto axis = static_cast<std::size_t>(m_views[k]->axes()[i]);
      sum[axis] += um[static_cast<Eigen::Index>(i)];
      ++count[axis];
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] /= std::max(count[axis], 1);
  return sum;
}

bool CameraErrorSource::restore_zero_um(const std::array<double, 3>& zero_um) {
  for (std::size_t k = 0; k < m_views.size(); ++k) {
    const auto& axes = m_views[k]->axes();
    const Eigen::Vector2d um(zero_um[static_cast<std::size_t>(axes[0])], zero_um[static_cast<std::size_t>(axes[1])]);
    const Eigen::Vector2d px = m_views[k]->calibration().um_from_px.inverse() * um;
    m_zero[k] = {px.x(), px.y(), 0.0, 0.0};
  }
  return true;
}

std::vector<ViewState> CameraErrorSource::states() const {
  const std::lock_guard lock(m_mutex);
  return m_states;
}

std::vector<std::array<double, 4>> CameraErrorSource::zero_px() const {
  std::vector<std::array<double, 4>> out;
  for (const Zero& zero : m_zero) out.push_back({zero.x_px, zero.y_px, zero.sigma_x_px, zero.sigma_y_px});
  return out;
}

Status CameraErrorSource::restore_zero(const std::vector<std::array<double, 4>>& zero_px) {
  if (zero_px.size() != m_zero.size()) {
    return fail(ErrorCode::data_does_not_fit, {{"what", "the stored zero"},
                                               {"found", std::to_string(zero_px.size()) + " views"},
                                               {"expected", std::to_string(m_zero.size())}});
  }
  for (std::size_t k = 0; k < m_zero.size(); ++k) {
    m_zero[k] = {zero_px[k][0], zero_px[k][1], zero_px[k][2], zero_px[k][3]};
  }
  return {};
}

}  // namespace zerodrift::vision
