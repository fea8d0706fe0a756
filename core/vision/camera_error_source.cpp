#include "core/vision/camera_error_source.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <cmath>
#include <future>
#include <limits>
#include <thread>

namespace zerodrift::vision {
namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
// A clean target is measured with nearly all of its pixels.
constexpr double covered_share = 0.8;
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
std::string in_view(const ErrorView& view, const std::string& problem) {
  return fmt::format("camera {}: {}", view.id, problem);
}

}  // namespace

CameraErrorSource::CameraErrorSource(std::vector<ErrorView> views, MeasureOptions options)
    : m_views(std::move(views)), m_options(options), m_zero(m_views.size()), m_states(m_views.size()) {
  for (std::size_t k = 0; k < m_views.size(); ++k) m_states[k].id = m_views[k].id;
}

Result<ViewState> CameraErrorSource::look(const ErrorView& view, const CameraTurn& turn,
                                          const TaskContext& context) const {
  ViewState state;
  state.id = view.id;
  state.turn = turn;
  for (const Target& reference : view.references) state.marks.push_back(reference.region());
  std::vector<Location> locations;
  const Camera::Time begin = std::chrono::steady_clock::now();
  Camera::Time::duration since_begin{0};
  Camera::Time after = std::chrono::steady_clock::now() + m_options.settle;
  for (int k = 0; k < m_options.frames; ++k) {
    ZD_TRY(state.frame, view.camera->fresh_frame(after, m_options.frame_timeout, context.stop));
    // Only the first frame can have been on its way when the machine came to stand; the others follow it.
    after = state.frame->arrived - std::chrono::milliseconds(1);
    since_begin += state.frame->arrived - begin;
    locations.push_back(
        locate_against(*view.target, view.references, state.frame->image, &state.references, &state.turn));
    const std::string lost = marks_not_seen(state.references);
    if (locations.back().ok && !lost.empty()) state.lost_marks = lost;
  }
  state.seen = begin + since_begin / std::max(m_options.frames, 1);
  for (const Location& one : locations) {
    if (one.ok) state.least_share = std::min(state.least_share, one.inlier_share);
  }
  const MeanLocation mean = mean_of(locations);
  state.location = mean.location;
  state.good_frames = mean.good;
  state.refused_frames = mean.refused;
  state.scatter_x_px = mean.scatter_x_px;
  state.scatter_y_px = mean.scatter_y_px;
  if (!mean.location.ok) state.problem = mean.location.reason;
  return state;
}

std::vector<Result<ViewState>> CameraErrorSource::look_all(const TaskContext& context) const {
  // All cameras at the same time: the machine drifts while it is looked at.
  std::vector<CameraTurn> turns;
  for (const ViewState& state : states()) turns.push_back(state.turn);
  std::vector<std::future<Result<ViewState>>> pending;
  for (std::size_t k = 1; k < m_views.size(); ++k) {
    pending.push_back(
        std::async(std::launch::async, [this, k, &turns, &context] { return look(m_views[k], turns[k], context); }));
  }
  std::vector<Result<ViewState>> looks;
  if (!m_views.empty()) looks.push_back(look(m_views[0], turns[0], context));
  for (auto& one : pending) looks.push_back(one.get());
  return looks;
}

Status CameraErrorSource::take_zero(const TaskContext& context) {
  auto looks = look_all(context);
  for (std::size_t k = 0; k < m_views.size(); ++k) {
    ZD_TRY(ViewState state, std::move(looks[k]));
    if (!state.problem.empty()) {
      return fail(ErrorCode::target_refused, {{"reason", in_view(m_views[k], state.problem)}});
    }
    m_zero[k] = {state.location.x_px, state.location.y_px, state.location.sigma_x_px, state.location.sigma_y_px};
    state.trail.push_back({state.location.x_px, state.location.y_px});
    const std::lock_guard lock(m_mutex);
    m_states[k] = std::move(state);
  }
  return {};
}

Result<acquisition::ErrorSample> CameraErrorSource::measure(const TaskContext& context) {
  std::array<Combined, 3> combined{};
  acquisition::ErrorSample sample;
  std::optional<Error> dead;
  std::size_t dead_count = 0;
  std::vector<Camera::Time> seen;
  std::string lost;
  auto looks = look_all(context);
  for (std::size_t k = 0; k < m_views.size(); ++k) {
    const ErrorView& view = m_views[k];
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
    if (state.problem.empty()) {
      Location since_zero = state.location;
      since_zero.x_px -= m_zero[k].x_px;
      since_zero.y_px -= m_zero[k].y_px;
      since_zero.sigma_x_px = std::hypot(since_zero.sigma_x_px, m_zero[k].sigma_x_px);
      since_zero.sigma_y_px = std::hypot(since_zero.sigma_y_px, m_zero[k].sigma_y_px);
      state.error = view.calibration.to_um(since_zero);
      seen.push_back(state.seen);
      combined[view.axes[0]].add(state.error.x_um, state.error.sigma_x_um);
      combined[view.axes[1]].add(state.error.y_um, state.error.sigma_y_um);
      if (state.least_share < covered_share) {
        const std::string percent = std::to_string(static_cast<int>(100.0 * state.least_share));
        sample.remark = Error{ErrorCode::target_partly_covered, {{"view", view.id}, {"percent", percent}}};
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
    Camera::Time::duration sum{0};
    for (const Camera::Time& one : seen) sum += one - seen.front();
    sample.seen = seen.front() + sum / static_cast<int>(seen.size());
  }
  return sample;
}

std::string CameraErrorSource::name() const {
  std::string text = "camera";
  for (const ErrorView& view : m_views) {
    text += " " + view.id + " (" + axis_names[view.axes[0]] + ", " + axis_names[view.axes[1]] + ")";
  }
  return text;
}

std::optional<std::array<double, 3>> CameraErrorSource::zero_um() const {
  std::array<double, 3> sum{};
  std::array<int, 3> count{};
  for (std::size_t k = 0; k < m_views.size(); ++k) {
    const Eigen::Vector2d um = m_views[k].calibration.um_from_px * Eigen::Vector2d(m_zero[k].x_px, m_zero[k].y_px);
    for (std::size_t i = 0; i < 2; ++i) {
      const auto axis = static_cast<std::size_t>(m_views[k].axes[i]);
      sum[axis] += um[static_cast<Eigen::Index>(i)];
      ++count[axis];
    }
  }
  for (std::size_t axis = 0; axis < 3; ++axis) sum[axis] /= std::max(count[axis], 1);
  return sum;
}

bool CameraErrorSource::restore_zero_um(const std::array<double, 3>& zero_um) {
  for (std::size_t k = 0; k < m_views.size(); ++k) {
    const auto& axes = m_views[k].axes;
    const Eigen::Vector2d um(zero_um[static_cast<std::size_t>(axes[0])], zero_um[static_cast<std::size_t>(axes[1])]);
    const Eigen::Vector2d px = m_views[k].calibration.um_from_px.inverse() * um;
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
