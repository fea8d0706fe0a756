#include "tests/ui/gallery/page_samples.h"
#include "tests/ui/gallery/samples.h"
#include "ui/pages/calibrate_page.h"

namespace zerodrift::ui::samples {

static CameraMarks calibrationMarks() {
  CameraMarks marks;
  marks.targetRegion = {222, 132, 196, 196};
  marks.references = {{QRectF(38, 302, 130, 126), QPointF(102.4, 364.8)}};
  marks.outline = QPolygonF(QRectF(242, 152, 156, 156));
  marks.target = QPointF(320, 230.4);
  marks.sigmaMajor_px = 0.0021;
  marks.sigmaMinor_px = 0.0014;
  marks.sigmaAngle_deg = 24;
  marks.enlargement = 10000;
  return marks;
}

void fillCalibrate(Page* page, const QString& scene) {
  auto* calibrate = qobject_cast<CalibratePage*>(page);
  CalibrateState s;
  if (scene == "empty") {
    s.blocked = "Connect to the controller first: the cameras stand in its connection profile.";
    return calibrate->setState(s);
  }
  s.cameras = {"Front", "Side"};
  s.templateTaken = true;
  s.marks = 1;
  s.takeOff = MarksTakeOff::shift;
  s.markDistance_mm = 3.0;
  s.fieldRight_mm = 7.68;
  s.fieldUp_mm = 5.76;
  s.driftRight_mm = 0.25;
  s.driftUp_mm = 0.6;
  const double rightResidual[] = {0.12, -0.08, 0.05, -0.14, 0.21, -0.06, 0.09, -0.11, 0.02};
  const double upResidual[] = {-0.05, 0.16, -0.12, 0.03, 0.07, -0.18, 0.11, 0.04, -0.09};
  for (int i = 0; i < 9; ++i) {
    CalibrationPoint p;
    p.right_mm = 0.8 * (i % 3 - 1);
    p.up_mm = 0.8 * (i / 3 - 1);
    p.residualRight_um = rightResidual[i];
    p.residualUp_um = upResidual[i];
    p.state = scene == "solved" || i < 4 ? PointState::measured : i == 4 ? PointState::moving : PointState::planned;
    s.points.append(p);
  }
  s.running = scene == "running";
  s.solved = scene == "solved";
  if (s.solved) {
    s.umPerPx = 12.034;
    s.umPerPxSigma = 0.0016;
    s.rotation_deg = 2.31;
    s.rms_um = 0.14;
    s.uncertainty_um = 0.09;
  } else {
    s.timeLeft_s = 41;
  }
  calibrate->setState(s);
  calibrate->setFrame(cameraImage(640, 480), calibrationMarks());
  calibrate->setQuality({0.82, 0.57, 0.2});
  if (s.running) calibrate->setProgress("Measuring position 5 of 9", 0.46, 41.0);
}

}  // namespace zerodrift::ui::samples
