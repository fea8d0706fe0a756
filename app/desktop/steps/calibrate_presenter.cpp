#include "app/desktop/steps/calibrate_presenter.h"

#include <fmt/format.h>

#include <cmath>

#include "app/desktop/pin_dialog.h"
#include "app/text/core_text.h"
#include "app/text/error_text.h"
#include "core/flow/flow.h"
#include "core/report/limits.h"
#include "core/vision/calibration.h"
#include "core/vision/image_quality.h"
#include "ui/pages/calibrate_page.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using nlohmann::json;

namespace {

constexpr int pictures_per_s = 12;
constexpr double expected_drift_mm = 0.1;  // until a run has shown the real one
constexpr double drift_margin = 1.5;       // of the calibrated area over what has been seen
constexpr double sharp_px = 1.0;           // sigma of the blur that pixels of a well set lens show
constexpr double trail_enlargement = 1.0;
constexpr int smallest_region_px = 24;
constexpr std::size_t undo_depth = 100;

QRectF rect_of(const std::array<int, 4>& box) {
  return QRectF(box[0], box[1], box[2], box[3]);
}

std::array<int, 4> box_of(const QRect& rect) {
  return {rect.x(), rect.y(), rect.width(), rect.height()};
}

}  // namespace

QImage image_of(const vision::GrayImage& image) {
  if (image.empty()) return {};
  return QImage(image.pixels.data(), image.width, image.height, image.width, QImage::Format_Grayscale8).copy();
}

CalibratePresenter::CalibratePresenter(Workbench& bench, ui::CalibratePage* page)
    : Presenter(bench, page), m_page(page) {
  m_pictures.setInterval(1000 / pictures_per_s);
  connect(&m_pictures, &QTimer::timeout, this, &CalibratePresenter::showPicture);
  connect(page, &ui::CalibratePage::cameraChosen, this, [this](int camera) {
    m_camera = camera;
    refresh();
  });
  connect(page, &ui::Page::primaryTriggered, this, [this] {
    if (m_page->state().accepted) {
      Q_EMIT nextRequested();
    } else {
      confirmed();
    }
  });
  connect(page, &ui::Page::secondaryTriggered, this, [this](const QString& action) {
    if (action == QStringLiteral("repeat")) confirmed();
  });
  connect(page, &ui::CalibratePage::regionDrawn, this, &CalibratePresenter::useRegion);
  connect(page, &ui::CalibratePage::markDrawn, this, &CalibratePresenter::addMark);
  connect(page, &ui::CalibratePage::markRemoved, this, &CalibratePresenter::removeMark);
}

void CalibratePresenter::forget() {
  m_moveCamera.clear();
  m_drawn = {};
  m_undo.clear();
  m_camera = 0;
  m_current = false;
  m_shownFor.clear();
  m_live = std::make_shared<Live>();
  static_cast<void>(m_page->takeConsent());  // it was for the moves of that job
  m_page->setFrame({}, {});
  m_page->setQuality({});
}

std::string CalibratePresenter::cameraShown() const {
  const auto& profile = bench().profile();
  if (!profile || m_camera >= static_cast<int>(profile->cameras.size())) return {};
  return profile->cameras[static_cast<std::size_t>(m_camera)].id;
}

const json* CalibratePresenter::calibrationOf(const std::string& camera) const {
  const json& body = bench().body("calibration");
  if (!m_current || !body.is_object() || !body.contains("cameras")) return nullptr;
  for (const auto& one : body["cameras"]) {
    if (one.at("id") == camera) return &one;
  }
  return nullptr;
}

CalibratePresenter::Box CalibratePresenter::regionOf(const std::string& camera) const {
  if (const auto drawn = m_drawn.regions.find(camera); drawn != m_drawn.regions.end()) return drawn->second;
  if (const json* made = calibrationOf(camera)) return made->at("roi").get<Box>();
  for (const auto& one : bench().profile()->cameras) {
    if (one.id == camera) return one.target_roi_px;
  }
  return {};
}

std::vector<CalibratePresenter::Box> CalibratePresenter::marksOf(const std::string& camera) const {
  if (const auto drawn = m_drawn.marks.find(camera); drawn != m_drawn.marks.end()) return drawn->second;
  if (const json* made = calibrationOf(camera)) return flow::marks_of(*made);
  for (const auto& one : bench().profile()->cameras) {
    if (one.id == camera) return one.reference_rois_px;
  }
  return {};
}

void CalibratePresenter::keepForUndo() {
  m_undo.push_back(m_drawn);
  if (m_undo.size() > undo_depth) m_undo.erase(m_undo.begin());
}

void CalibratePresenter::undo() {
  if (m_running || m_undo.empty()) return;
  m_drawn = m_undo.back();
  m_undo.pop_back();
  refresh();
}

bool CalibratePresenter::largeEnough(const QRect& box, const char* what) {
  if (std::min(box.width(), box.height()) >= smallest_region_px) return true;
  show({ErrorCode::bad_argument,
        {{"what", what},
         {"found", fmt::format("{}x{}", box.width(), box.height())},
         {"expected", fmt::format("at least {0}x{0}", smallest_region_px)}}});
  return false;
}

/// The next measurement looks for the target there; what was measured with another region no longer stands.
void CalibratePresenter::useRegion(const QRectF& region_px) {
  const std::string camera = cameraShown();
  const QRect box = region_px.toRect();
  if (camera.empty() || m_running || !largeEnough(box, "the region")) return;
  keepForUndo();
  m_drawn.regions[camera] = box_of(box);
  refresh();
}

/// What overlaps the target moves with it and would take out what is to be measured.
void CalibratePresenter::addMark(const QRectF& region_px) {
  const std::string camera = cameraShown();
  const QRect box = region_px.toRect();
  if (camera.empty() || m_running || !largeEnough(box, "the reference mark")) return;
  std::vector<Box> marks = marksOf(camera);
  std::vector<Box> others = marks;
  others.push_back(regionOf(camera));
  if (std::any_of(others.begin(), others.end(), [&](const Box& one) { return rect_of(one).intersects(box); })) {
    show({ErrorCode::bad_argument,
          {{"what", "the reference mark"},
           {"found", "over the target's region or another mark"},
           {"expected", "a place beside them"}}});
    return;
  }
  keepForUndo();
  marks.push_back(box_of(box));
  m_drawn.marks[camera] = std::move(marks);
  refresh();
}

void CalibratePresenter::removeMark(int index) {
  const std::string camera = cameraShown();
  if (camera.empty() || m_running) return;
  std::vector<Box> marks = marksOf(camera);
  if (index < 0 || index >= static_cast<int>(marks.size())) return;
  keepForUndo();
  marks.erase(marks.begin() + index);
  m_drawn.marks[camera] = std::move(marks);
  refresh();
}

void CalibratePresenter::showQuality(const vision::GrayImage& image, const QRectF& region) {
  const QRect box = region.toRect();
  const auto found = vision::quality_of(image, {box.x(), box.y(), box.width(), box.height()});
  ui::ImageQuality quality;
  if (std::isfinite(found.blur_px)) quality.focus = std::min(1.0, sharp_px / std::max(found.blur_px, 1e-3));
  quality.exposure = found.bright_level / 255.0;
  quality.saturated_percent = 100.0 * found.saturated_share;
  m_page->setQuality(quality);
}

void CalibratePresenter::enter() {
  refresh();
  m_pictures.start();
}

void CalibratePresenter::leave() {
  m_pictures.stop();
}

Status CalibratePresenter::waitForConsent(Live& live, const std::string& camera, const TaskContext& context) {
  std::unique_lock lock(live.mutex);
  live.waiting = camera;
  const bool given = live.agreement.wait(lock, context.stop, [&] { return live.agreed == camera; });
  live.waiting.clear();
  live.agreed.clear();
  if (!given) return fail(ErrorCode::cancelled);
  return {};
}

std::string CalibratePresenter::waitingFor() const {
  const std::scoped_lock lock(m_live->mutex);
  return m_running ? m_live->waiting : std::string();
}

std::string CalibratePresenter::cameraAtWork() const {
  const std::scoped_lock lock(m_live->mutex);
  return m_live->camera;
}

void CalibratePresenter::confirmed() {
  const std::string camera = m_moveCamera;
  if (!m_page->takeConsent()) return;
  if (!m_running) {
    {
      const std::scoped_lock lock(m_live->mutex);
      m_live->agreed = camera;
    }
    start({});
    return;
  }
  {
    const std::scoped_lock lock(m_live->mutex);
    if (m_live->waiting != camera) return;
    m_live->agreed = camera;
  }
  m_live->agreement.notify_all();
}

void CalibratePresenter::start(std::function<void(bool good)> done) {
  const auto profile = bench().profile();
  if (!profile || bench().job() == nullptr || m_running) return;
  const auto permit = permit_for(bench(), m_page, tr("Calibrating"));
  if (!permit) {
    if (done) done(false);
    return;
  }
  m_running = true;
  m_shownFor.clear();
  {
    const std::scoped_lock lock(m_live->mutex);
    m_live->waiting.clear();
    m_live->camera.clear();
    m_live->seen.clear();
    m_live->done = m_live->of = 0;
  }
  refresh();
  Drawn shown;  // what is boxed in the picture is what is measured
  for (const auto& camera : profile->cameras) {
    shown.regions[camera.id] = regionOf(camera.id);
    shown.marks[camera.id] = marksOf(camera.id);
  }
  runStep(
      tr("Calibrating"),
      [profile = *profile, permit = *permit, live = m_live, shown, asking = m_asking, span_mm = m_page->state().span_mm,
       questions = bench().questions()](commissioning::Job& job,
                                        const TaskContext& context) -> Result<commissioning::NewArtefact> {
        ZD_TRY(auto devices, flow::Devices::open(profile, true, permit, questions->of(profile, context.stop)));
        flow::CalibrateOptions options;
        options.regions = shown.regions;
        options.marks = shown.marks;
        options.span_mm = span_mm;
        options.watcher = [&](const flow::CalibrationProgress& now) {
          const std::scoped_lock lock(live->mutex);
          if (live->camera != now.camera) live->seen.clear();
          live->camera = now.camera;
          live->done = now.done;
          live->of = now.of;
          live->seen.push_back(*now.location);
        };
        if (asking) {
          options.may_move = [live](const std::string& camera, const TaskContext& now) {
            return waitForConsent(*live, camera, now);
          };
        }
        return flow::calibrate(job, devices, options, context);
      },
      [this, done = std::move(done)](bool good) {
        m_running = false;
        {
          const std::scoped_lock lock(m_live->mutex);
          m_live->agreed.clear();
        }
        if (good) {  // it is in the calibration now
          m_drawn = {};
          m_undo.clear();
        }
        refresh();
        if (done) done(good);
      });
}

void CalibratePresenter::fillPoints(ui::CalibrateState& state) const {
  std::size_t measured = 0;
  if (m_running) {
    const std::scoped_lock lock(m_live->mutex);
    const auto camera = state.cameras.value(state.camera).toStdString();
    measured = m_live->camera == camera ? m_live->seen.size() : 0;
  }
  for (const auto& position : vision::propose_positions(state.span_mm)) {
    ui::CalibrationPoint point;
    point.right_mm = position.x_mm;
    point.up_mm = position.y_mm;
    const auto index = static_cast<std::size_t>(state.points.size());
    if (index < measured) point.state = ui::PointState::measured;
    if (m_running && index == measured) point.state = ui::PointState::moving;
    state.points.append(point);
  }
}

void CalibratePresenter::fillMarks(ui::CalibrateState& state, const std::vector<Box>& marks, const Box& region,
                                   double umPerPx) const {
  state.marks = static_cast<int>(marks.size());
  switch (flow::taken_off_by(marks)) {
    case vision::TakenOff::nothing:
      state.takeOff = ui::MarksTakeOff::nothing;
      break;
    case vision::TakenOff::shift:
      state.takeOff = ui::MarksTakeOff::shift;
      break;
    case vision::TakenOff::shift_turn_scale:
      state.takeOff = ui::MarksTakeOff::shiftTurnScale;
      break;
  }
  if (marks.empty() || !(umPerPx > 0.0)) return;
  QPointF middle;
  for (const Box& mark : marks) middle += rect_of(mark).center() / static_cast<double>(marks.size());
  const QPointF way = rect_of(region).center() - middle;
  state.markDistance_mm = std::hypot(way.x(), way.y()) * umPerPx / 1000.0;
}

void CalibratePresenter::fillResult(ui::CalibrateState& state, const json& camera) const {
  const auto calibration = vision::calibration_from_json(camera.at("calibration"), "calibration");
  if (!calibration) return;
  state.solved = true;
  state.accepted = true;
  state.templateTaken = true;
  fillMarks(state, flow::marks_of(camera), camera.at("roi").get<Box>(), calibration->scale_um_per_px);
  state.umPerPx = calibration->scale_um_per_px;
  state.umPerPxSigma = calibration->sigma()(0, 0);
  state.rotation_deg = calibration->rotation_deg;
  state.rms_um = calibration->rms_um;
  // What the calibration adds to an error of 100 um.
  state.uncertainty_um = 100.0 / calibration->scale_um_per_px * state.umPerPxSigma;
  state.points.clear();
  double middle_x = 0.0, middle_y = 0.0;
  for (const auto& view : calibration->views) {
    middle_x += view.x_mm / static_cast<double>(calibration->views.size());
    middle_y += view.y_mm / static_cast<double>(calibration->views.size());
  }
  for (const auto& view : calibration->views) {
    ui::CalibrationPoint point;
    point.right_mm = view.x_mm - middle_x;
    point.up_mm = view.y_mm - middle_y;
    point.state = ui::PointState::measured;
    point.residualRight_um = view.residual_x_um;
    point.residualUp_um = view.residual_y_um;
    state.points.append(point);
  }
}

/// The positions must enclose the drift that is expected: what the last warm-up has shown, with a margin.
void CalibratePresenter::fillPlan(ui::CalibrateState& state) {
  const auto drift_mm = [this](const QString& axis) {
    const json body = bench().body("warmup");
    const std::string direction = axis.toStdString();
    if (!body.is_object() || !body.contains("peak_um") || !body["peak_um"].contains(direction)) {
      return expected_drift_mm;
    }
    return std::abs(body["peak_um"][direction].get<double>()) * drift_margin / 1000.0;
  };
  state.driftRight_mm = drift_mm(state.axisRight);
  state.driftUp_mm = drift_mm(state.axisUp);
  state.span_mm = std::max(state.span_mm, 2.0 * drift_margin * std::max(state.driftRight_mm, state.driftUp_mm));
}

/// Which moves come next: those of the camera that waits for a word, or those that are made; else of the first one.
void CalibratePresenter::fillMoves(ui::CalibrateState& state) {
  const auto& profile = bench().profile();
  const std::string waiting = waitingFor();
  state.waiting = !waiting.empty();
  state.moveOf = static_cast<int>(profile->cameras.size());
  if (profile->cameras.empty()) return;
  const std::string at_work = waiting.empty() && m_running ? cameraAtWork() : waiting;
  int next = 0;
  for (int i = 0; i < state.moveOf; ++i) {
    if (profile->cameras[static_cast<std::size_t>(i)].id == at_work) next = i;
  }
  const auto& camera = profile->cameras[static_cast<std::size_t>(next)];
  m_moveCamera = camera.id;
  state.moveCamera = coreText(camera.id);
  state.moveNumber = next + 1;
  for (const auto& axis : camera.axes) state.moveAxes << QString::fromStdString(axis);
  QStringList position;
  for (const auto& [axis, place_mm] : profile->measure_position_mm) {
    const bool turns = !axis.empty() && axis[0] >= 'A' && axis[0] <= 'C';
    position << QStringLiteral("%1 %2%3")
                    .arg(QString::fromStdString(axis))
                    .arg(ui::fixedText(place_mm, 1))
                    .arg(turns ? QStringLiteral("°") : QStringLiteral(" mm"));
  }
  state.movePosition = ui::listText(position);
  if (!state.waiting || m_shownFor == waiting) return;
  // Once: whoever is asked sees the camera that is meant.
  m_shownFor = waiting;
  m_camera = next;
  state.camera = next;
}

void CalibratePresenter::refresh() {
  ui::CalibrateState state;
  state.rmsLimit_um = report::limits::calibration_rms_um;
  state.uncertaintyLimit_um = report::limits::calibration_uncertainty_um;
  const auto& profile = bench().profile();
  if (!m_running) {
    m_current =
        bench().job() != nullptr && flow::status_of(*bench().job(), "calibrate").state == flow::StepState::current;
  }
  if (!profile || !bench().has("machine")) {
    state.blocked = tr("Connect a machine and start the commissioning first.");
    m_page->setState(state);
    return;
  }
  if (profile->error_source == controller::ErrorSourceKind::probes) {
    state.blocked = tr("This machine is measured with displacement probes; no camera has to be calibrated.");
  }
  for (const auto& camera : profile->cameras) state.cameras << coreText(camera.id);
  state.camera = m_camera;
  state.offline = offlineReason();
  state.running = m_running;
  fillMoves(state);
  if (state.waiting) m_page->setProgress(tr("Waiting for your word: camera %1").arg(state.moveCamera), -1.0);
  state.span_mm = profile->calibration_span_mm;
  if (m_camera < static_cast<int>(profile->cameras.size())) {
    const auto& camera = profile->cameras[static_cast<std::size_t>(m_camera)];
    state.axisRight = QString::fromStdString(camera.axes[0]);
    state.axisUp = QString::fromStdString(camera.axes[1]);
    state.fieldRight_mm = 640 * camera.um_per_px_nominal / 1000.0;
    state.fieldUp_mm = 480 * camera.um_per_px_nominal / 1000.0;
    fillMarks(state, marksOf(camera.id), regionOf(camera.id), camera.um_per_px_nominal);
    state.templateTaken = true;
  }
  fillPlan(state);
  fillPoints(state);
  const json& body = bench().body("calibration");
  const bool drawn = m_drawn.regions.contains(cameraShown()) || m_drawn.marks.contains(cameraShown());
  if (!m_running && !drawn && body.is_object() && body.value("source", "") == "camera") {
    const auto& cameras = body.at("cameras");
    if (m_camera < static_cast<int>(cameras.size())) fillResult(state, cameras.at(static_cast<std::size_t>(m_camera)));
  }
  m_page->setState(state);
}

void CalibratePresenter::showPicture() {
  if (m_running) refresh();
  const auto& cameras = bench().cameras();
  const auto& profile = bench().profile();
  if (!profile || m_camera >= static_cast<int>(cameras.size())) return;
  ui::CameraMarks marks;
  const auto& camera = profile->cameras[static_cast<std::size_t>(m_camera)];
  marks.targetRegion = rect_of(regionOf(camera.id));
  for (const Box& mark : marksOf(camera.id)) marks.references.append({rect_of(mark)});
  const auto frame = cameras[static_cast<std::size_t>(m_camera)]->newest();
  if (!frame) {
    marks.message = textOf(frame.error()).sentence;
    marks.judgement = ui::Judgement::bad;
    m_page->setFrame({}, marks);
    return;
  }
  {
    const std::scoped_lock lock(m_live->mutex);
    if (m_running && m_live->camera == camera.id && !m_live->seen.empty() && m_live->seen.back().ok) {
      const auto& location = m_live->seen.back();
      marks.target = QPointF(location.point.x_px, location.point.y_px);
      marks.sigmaMajor_px = std::max(location.sigma_x_px, location.sigma_y_px);
      marks.sigmaMinor_px = std::min(location.sigma_x_px, location.sigma_y_px);
      marks.enlargement = 5000.0;
      marks.judgement = ui::Judgement::ok;
    }
    if (m_live->camera == camera.id) {
      for (const auto& location : m_live->seen) {
        if (location.ok) marks.trail.append(QPointF(location.point.x_px, location.point.y_px));
      }
      marks.trailEnlargement = trail_enlargement;
    }
  }
  showQuality((*frame)->image, marks.targetRegion);
  m_page->setFrame(image_of((*frame)->image), marks);
}

void CalibratePresenter::tour(std::function<void(bool good)> done) {
  m_asking = false;
  start(std::move(done));
}

}  // namespace zerodrift::desktop
