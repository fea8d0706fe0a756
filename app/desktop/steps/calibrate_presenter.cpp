#include "app/desktop/steps/calibrate_presenter.h"

#include <cmath>

#include "app/text/error_text.h"
#include "core/vision/calibration.h"
#include "core/vision/image_quality.h"
#include "ui/pages/calibrate_page.h"

namespace zerodrift::desktop {

using nlohmann::json;

namespace {

constexpr int pictures_per_s = 12;
constexpr double expected_drift_mm = 0.1;  // until a run has shown the real one

QRectF rect_of(const std::array<int, 4>& box) {
  return QRectF(box[0], box[1], box[2], box[3]);
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
      start({});
    }
  });
  connect(page, &ui::Page::secondaryTriggered, this, [this](const QString& action) {
    // Every measurement begins with a new template at rest.
    if (action == QStringLiteral("repeat") || action == QStringLiteral("template")) start({});
  });
  page->allow(QStringLiteral("plan"), false, tr("The positions shown are the proposed ones."));
}

void CalibratePresenter::enter() {
  refresh();
  m_pictures.start();
}

void CalibratePresenter::leave() {
  m_pictures.stop();
}

void CalibratePresenter::start(std::function<void(bool good)> done) {
  const auto profile = bench().profile();
  const auto* job = bench().job();
  if (!profile || job == nullptr || m_running) return;
  m_running = true;
  {
    const std::scoped_lock lock(m_live->mutex);
    m_live->camera.clear();
    m_live->seen.clear();
    m_live->done = m_live->of = 0;
  }
  refresh();
  runStep(
      tr("Calibrating"),
      [profile = *profile, job, live = m_live](const TaskContext& context) -> Result<commissioning::NewArtefact> {
        ZD_TRY(auto devices, flow::Devices::open(profile));
        flow::CalibrateOptions options;
        options.watcher = [&](const flow::CalibrationProgress& now) {
          const std::scoped_lock lock(live->mutex);
          if (live->camera != now.camera) live->seen.clear();
          live->camera = now.camera;
          live->done = now.done;
          live->of = now.of;
          live->seen.push_back(*now.location);
        };
        return flow::calibrate(*job, devices, options, context);
      },
      [this, done = std::move(done)](bool good) {
        m_running = false;
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

void CalibratePresenter::fillResult(ui::CalibrateState& state, const json& camera) const {
  const auto calibration = vision::calibration_from_json(camera.at("calibration"), "calibration");
  if (!calibration) return;
  state.solved = true;
  state.accepted = true;
  state.templateTaken = true;
  state.referenceFound = camera.contains("reference_roi");
  state.umPerPx = calibration->scale_um_per_px;
  state.umPerPxSigma = calibration->sigma()(0, 0);
  state.rotation_deg = calibration->rotation_deg;
  state.rms_um = calibration->rms_um;
  state.rmsLimit_um = 2.0;
  // What the calibration adds to an error of 100 um.
  state.uncertainty_um = 100.0 / calibration->scale_um_per_px * state.umPerPxSigma;
  state.points.clear();
  for (const auto& view : calibration->views) {
    ui::CalibrationPoint point;
    point.right_mm = view.x_mm;
    point.up_mm = view.y_mm;
    point.state = ui::PointState::measured;
    point.residualRight_um = view.residual_x_um;
    point.residualUp_um = view.residual_y_um;
    state.points.append(point);
  }
}

void CalibratePresenter::refresh() {
  ui::CalibrateState state;
  const auto& profile = bench().profile();
  if (!profile || !bench().has("machine")) {
    state.blocked = tr("Connect a machine and start the commissioning first.");
    m_page->setState(state);
    return;
  }
  if (profile->error_source == controller::ErrorSourceKind::probes) {
    state.blocked = tr("This machine is measured with displacement probes; no camera has to be calibrated.");
  }
  for (const auto& camera : profile->cameras) state.cameras << QString::fromStdString(camera.id);
  state.camera = m_camera;
  state.running = m_running;
  state.span_mm = profile->calibration_span_mm;
  if (m_camera < static_cast<int>(profile->cameras.size())) {
    const auto& camera = profile->cameras[static_cast<std::size_t>(m_camera)];
    state.axisRight = QString::fromStdString(camera.axes[0]);
    state.axisUp = QString::fromStdString(camera.axes[1]);
    state.fieldRight_mm = 640 * camera.um_per_px_nominal / 1000.0;
    state.fieldUp_mm = 480 * camera.um_per_px_nominal / 1000.0;
    state.referenceFound = camera.reference_roi_px.has_value();
    state.templateTaken = true;
  }
  state.driftRight_mm = expected_drift_mm;
  state.driftUp_mm = expected_drift_mm;
  fillPoints(state);
  const json body = bench().body("calibration");
  if (!m_running && body.is_object() && body.value("source", "") == "camera") {
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
  marks.targetRegion = rect_of(camera.target_roi_px);
  if (camera.reference_roi_px) marks.referenceRegion = rect_of(*camera.reference_roi_px);
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
  }
  m_page->setFrame(image_of((*frame)->image), marks);
}

void CalibratePresenter::tour(std::function<void(bool good)> done) {
  start(std::move(done));
}

}  // namespace zerodrift::desktop
