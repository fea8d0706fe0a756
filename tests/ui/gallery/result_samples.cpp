#include <cmath>

#include "tests/ui/gallery/page_samples.h"
#include "tests/ui/gallery/samples.h"
#include "ui/pages/axis_page.h"
#include "ui/pages/report_page.h"
#include "ui/pages/upload_page.h"
#include "ui/pages/verify_page.h"

namespace zerodrift::ui::samples {

void fillUpload(Page* page, const QString& scene) {
  auto* upload = qobject_cast<UploadPage*>(page);
  UploadState s;
  if (scene == "empty") {
    s.blocked = "Choose a model on the page Fit first: the table is made from it.";
    return upload->setState(s);
  }
  s.machineName = "Virtual five-axis";
  s.oldVersion = 3;
  s.newVersion = 4;
  const double sizes[] = {9.6, -22.4, -58.3};
  const double old[] = {4.1, -12.0, -41.0};
  const char* names[] = {"X", "Y", "Z"};
  for (int axis = 0; axis < 3; ++axis) {
    AxisTable t;
    t.axis = names[axis];
    t.abscissa = "the warm-up run replayed";
    t.overTime = true;
    t.x = timeAxis(16200, 120);
    t.after_um = warming(t.x, 0, sizes[axis], 3100, 0, 1);
    t.before_um = warming(t.x, 0, old[axis], 2500, 0, 1);
    t.terms = {{"Offset", "µm", 0.0, 1.42},
               {"T1 Spindle front bearing", "µm/K", -1.12, -2.087},
               {"T3 Motor, front end", "µm/K", -0.61, -0.882},
               {"T7 Column front, top", "µm/K", NAN, 0.412},
               {"T9 X screw nut", "µm/K", NAN, -0.218},
               {"T18 Table", "µm/K", 0.35, NAN}};
    s.axes.append(t);
  }
  s.expressed = "temperature terms and points; 86 of 2000 registers";
  s.largestChange_um = 17.3;
  s.steepest_um_per_K = 2.09;
  s.registers = 86;
  const bool writing = scene == "writing";
  s.writing = writing;
  const StageState done = writing ? StageState::done : StageState::waiting;
  s.stages = {{"Sign seen by the camera", StageState::done, "checked 10:32"},
              {"Compensation off", done, writing ? "confirmed" : ""},
              {"Save the old table", done, writing ? "version 3, 74 registers" : ""},
              {"Write in blocks", done, writing ? "86 registers" : ""},
              {"Read back and compare", writing ? StageState::running : StageState::waiting, {}},
              {"Commit", StageState::waiting, {}},
              {"Controller checks", StageState::waiting, {}},
              {"Read the active table", StageState::waiting, {}},
              {"Compensation on", StageState::waiting, {}},
              {"Ramp to full", StageState::waiting, {}}};
  s.sign.measured = true;
  s.sign.axes = {{"X", 10, 9.8, 0.3, true}, {"Y", 10, 10.4, 0.4, true}, {"Z", 10, 10.1, 0.2, true}};
  s.sign.note = "checked 10:32";
  s.sign.word = "Same direction and size";
  s.sign.judgement = Judgement::ok;
  const auto entry = [&](int version, const char* when, const char* how, const char* what) {
    TableVersion one;
    one.id = QString::number(version);
    one.version = version;
    one.when = when;
    one.who = "akeller";
    one.how = how;
    one.what = what;
    return one;
  };
  s.history = {entry(5, "14 Nov 16:02", "rollback to 3", "X Y Z, 74 registers"),
               entry(4, "14 Nov 15:40", "correction", "X Y Z, 74 registers"),
               entry(3, "14 Nov 14:55", "upload", "X Y Z, 74 registers"),
               entry(2, "2 Jun 10:41", "restored after a failed upload", "X Z, 50 registers"),
               entry(1, "2 Jun 09:55", "upload", "X Z, 50 registers"),
               entry(0, "2 Jun 09:30", "empty at the start", "no compensation")};
  s.history[0].active = true;
  s.history[0].blocked = "Version 5 is active; choose a former one.";
  s.history[2].blocked = "Version 3 is the same table as the active one.";
  s.history[3].proposed = true;
  if (scene == "away") {
    s.offline = s.rollbackBlocked = "No machine is connected: connect it on the Machine page.";
    s.written = true;
    s.asOf = "30 Sep 2026, 13:06";
    s.warnings = {"T1_C 24.53 °C (valid 20.91 to 24.50): the machine is outside the range the model was made in"};
  }
  upload->setState(s);
  if (scene == "history") upload->showHistory(2);
}

void fillVerify(Page* page, const QString& scene) {
  auto* verify = qobject_cast<VerifyPage*>(page);
  VerifyState s;
  if (scene == "empty") {
    s.blocked = "Write the table to the machine first: then its effect is measured.";
    return verify->setState(s);
  }
  if (scene == "again") {
    fillVerify(page, "correction");
    s.threshold_um = 3.0;
    verify->setState(s);
    return verify->showView(1);
  }
  const bool finished = scene != "running";
  s.phase = finished ? VerifyPhase::finished : VerifyPhase::running;
  s.peakBefore_um = 58.3;
  s.rmsBefore_um = 38.1;
  s.peakAfter_um = 3.6;
  s.rmsAfter_um = 1.42;
  s.lastGoodFrame_s = 12;
  s.threshold_um = 3.0;
  s.correctionProposed = finished;
  if (finished) {
    const double largest[3][2] = {{6.2, 6.6}, {9.8, 1.4}, {58.3, 3.6}};
    s.promised_um = 1.4;
    s.compared_s = 5400;
    s.beforeAxis = s.afterAxis = "Z";
    for (int i = 0; i < 3; ++i) {
      AxisResult r;
      r.axis = QString("XYZ").mid(i, 1);
      r.before_um = largest[i][0];
      r.after_um = largest[i][1];
      r.removed_percent = 100.0 * (1.0 - r.after_um / r.before_um);
      r.endBefore_um = 0.9 * r.before_um;
      r.endAfter_um = 0.9 * r.after_um;
      r.beforeTime_s = r.afterTime_s = timeAxis(5400, 120);
      r.before = warming(r.beforeTime_s, 0, r.before_um, 2400, 0.2, i);
      r.after = warming(r.afterTime_s, 0, r.after_um, 2400, 0.2, i + 3);
      s.results.append(r);
    }
  }
  if (scene == "worse") {
    s.sameRun = true;
    s.correctionProposed = false;
    s.versionBefore = 1;
    s.worseThanBefore = {{"X", 1.2, 2.9}};
  }
  const auto time = timeAxis(5400, 30);
  const char* names[] = {"X", "Y", "Z"};
  const double kappa[] = {1.004, 0.991, 1.062};
  for (int i = 0; i < 3; ++i) {
    AxisCorrection c;
    c.axis = names[i];
    c.kappa = kappa[i];
    c.kappaSigma = 0.008;
    c.evidence = i == 2 ? "31 measurements, t = 7.7" : "31 measurements, t = 0.5";
    c.peakBefore_um = i == 2 ? 3.6 : 1.2;
    c.peakAfter_um = i == 2 ? 1.4 : 1.2;
    c.proposed = i == 2;
    c.time_s = time;
    c.residual_um = warming(time, 0, i == 2 ? 3.4 : 0.6, 2400, 0.2, i);
    c.corrected_um = warming(time, 0, 0.4, 2400, 0.2, i + 5);
    s.corrections.append(c);
  }
  const QVector<RunChannel> temperatures = {{"T1_C", "T1", "Spindle front bearing", "°C", 2},
                                            {"T3_C", "T3", "Motor", "°C", 2},
                                            {"T7_C", "T7", "Column", "°C", 2},
                                            {"T9_C", "T9", "X screw nut", "°C", 2},
                                            {"T18_C", "T18", "Table", "°C", 2}};
  const QVector<RunChannel> errors = {
      {"without", "Z without", "Predicted without compensation", "µm", 1, groupColor(1), true},
      {"applied", "Z applied", "Compensation applied", "µm", 1, groupColor(0)},
      {"left", "Z left", "Measured residual", "µm", 1, groupColor(2)}};
  verify->run()->setChannels(temperatures, errors, {{"rpm", "Speed", "Spindle speed", "rpm", 0, groupColor(4)}});
  verify->run()->clear();
  const auto run = timeAxis(5400, 10);
  for (int i = 0; i < 5; ++i)
    verify->run()->append(temperatures[i].id, run, warming(run, 20.2, 12.0 - 2.2 * i, 2000 + 900 * i, 0.04, i));
  verify->run()->append("without", time, warming(time, 0, 58.3, 2400, 0, 1));
  verify->run()->append("applied", time, warming(time, 0, -56.1, 2500, 0, 1));
  verify->run()->append("left", time, warming(time, 0, 2.2, 1800, 0.3, 1));
  verify->run()->append("rpm", run, QVector<double>(run.size(), 3000.0));
  verify->run()->setRegimes({{0, 5400, 3000, false}}, 8000);
  verify->run()->setErrorLimits({{5, "limit 5 µm", Judgement::bad}, {-5, {}, Judgement::bad}});
  verify->run()->setValues({{"T1_C", 31.2, "OK", Judgement::ok},
                            {"T3_C", 29.1, "OK", Judgement::ok},
                            {"T7_C", 27.4, "OK", Judgement::ok},
                            {"T9_C", 24.6, "OK", Judgement::ok},
                            {"T18_C", 22.3, "OK", Judgement::ok},
                            {"without", 52.1, "predicted", Judgement::none},
                            {"applied", -49.8, "on", Judgement::ok},
                            {"left", 2.1, "good", Judgement::ok}});
  CameraMarks marks;
  marks.target = QPointF(320, 230.4);
  for (int i = 0; i < 40; ++i) marks.trail.append({320.0 + 0.2 * std::sin(0.7 * i), 230.4 + 0.15 * std::cos(0.9 * i)});
  marks.trailEnlargement = 50;
  verify->run()->setFrame(cameraImage(640, 480), marks);
  verify->setState(s);
  verify->showView(scene == "correction" || scene == "worse" ? 1 : 0);
}

static QImage sheet(int number) {
  QImage image(1240, 1754, QImage::Format_RGB32);
  image.fill(Qt::white);
  QPainter painter(&image);
  painter.setPen(QColor("#1C2530"));
  painter.setFont(uiFont(44, QFont::DemiBold));
  painter.drawText(110, 150, number == 1 ? "Thermal commissioning" : "Figures to ISO 230-3");
  painter.setFont(uiFont(26));
  painter.drawText(110, 220, "VMC-850 #3, serial 20261, 21 November 2026");
  painter.setPen(QPen(QColor("#D9DFE5"), 2));
  painter.drawRect(110, 280, 1020, 480);
  painter.setPen(QPen(QColor("#0F6CBD"), 4));
  QPolygonF curve;
  for (int i = 0; i <= 100; ++i) curve << QPointF(120 + 10 * i, 740 - 420 * (1.0 - std::exp(-i / 26.0)));
  painter.drawPolyline(curve);
  painter.setPen(QColor("#5F6E7C"));
  for (int i = 0; i < 14; ++i)
    painter.drawText(110, 840 + 56 * i, "Largest error before and after, with its uncertainty and source.");
  return image;
}

void fillReport(Page* page, const QString& scene) {
  auto* report = qobject_cast<ReportPage*>(page);
  ReportState s;
  if (scene == "empty") {
    s.blocked = "Record and verify first: the report is made from what was measured.";
    return report->setState(s);
  }
  s.head = {"Muster AG", "VMC-850", "20261", "A. Keller", "ISO 230-3:2020, ISO 230-2:2014"};
  s.languages = {"English", "简体中文"};
  s.sections = {{"summary", "For the service engineer", true, {}},
                {"machine", "Machine and sensors", true, {}},
                {"calibration", "Camera calibration", true, {}},
                {"run", "Warm-up run", true, {}},
                {"model", "Sensors and model", true, {}},
                {"physics", "Physics", true, {}},
                {"table", "Table written", true, {}},
                {"verification", "Verification", true, {}},
                {"axis", "Axis errors", false, "no laser file"},
                {"audit", "What was written to the machine", true, {}}};
  s.doubtful = {
      {"Sensor T14 lost 36 of 27720 samples", Judgement::warn, "warmup"},
      {"Largest error after compensation is 3.6 µm in Z; the correction was not applied", Judgement::warn, "verify"}};
  s.pages = {sheet(1), sheet(2)};
  report->setState(s);
}

void fillAxis(Page* page, const QString& scene) {
  auto* axis = qobject_cast<AxisPage*>(page);
  AxisState s;
  if (scene == "empty") return axis->setState(s);
  s.axis = "X";
  s.axes = {"X", "Y", "Z"};
  s.file = "x_axis.rtl";
  s.fileNotes = "x_axis.rtl, 5 runs, 17 targets, both directions";
  for (int i = 0; i < 17; ++i) {
    const double x = 50.0 * i;
    const double error = 0.018 * x + 2.6 * std::sin(x / 95.0) + (x > 480 ? 0.02 * (x - 480) : 0.0);
    s.position_mm.append(x);
    s.meanUp_um.append(error);
    s.meanDown_um.append(error - 2.4 - 0.4 * std::cos(x / 150.0));
    s.mean_um.append(error - 1.2);
    s.sigmaUp_um.append(0.35);
    s.sigmaDown_um.append(0.4);
  }
  for (int k = 0; k < 10; ++k) {
    LaserRun run;
    run.upwards = k % 2 == 0;
    run.position_mm = s.position_mm;
    for (int i = 0; i < 17; ++i) {
      run.error_um.append((run.upwards ? s.meanUp_um[i] : s.meanDown_um[i]) + 0.35 * std::sin(2.9 * i + 1.7 * k));
    }
    s.runs.append(run);
  }
  s.iso = {{"A", "Bidirectional accuracy", 27.41},
           {"A↑", "Unidirectional accuracy, up", 24.86},
           {"A↓", "Unidirectional accuracy, down", 24.93},
           {"E", "Bidirectional systematic deviation", 25.9},
           {"R", "Bidirectional repeatability", 4.42},
           {"R↑", "Repeatability, up", 1.4},
           {"R↓", "Repeatability, down", 1.6},
           {"B", "Reversal value", 2.81},
           {"M", "Mean bidirectional deviation", 24.1}};
  s.vdi = {{"P", "Position uncertainty", 26.8},          {"Pa", "Position deviation", 24.1},
           {"Ps max", "Position scatter, largest", 2.4}, {"Ps mean", "Position scatter, mean", 2.1},
           {"U max", "Reversal error, largest", 2.81},   {"U mean", "Reversal error, mean", 2.4}};
  for (int i = 0; i < 5; ++i) {
    AxisSegment g;
    g.from_mm = 160.0 * i;
    g.to_mm = 160.0 * (i + 1);
    const auto at = [&](double x) { return 0.018 * x + 2.6 * std::sin(x / 95.0) + (x > 480 ? 0.02 * (x - 480) : 0.0); };
    g.a = 1.0 + (at(g.to_mm) - at(g.from_mm)) / 160000.0;
    g.b_mm = at(g.from_mm) / 1000.0 - (g.a - 1.0) * g.from_mm;
    g.r = 0.9812 + 0.003 * i;
    g.points = 4;
    g.largestResidual_um = 0.4 + 0.13 * i;
    s.optimal.append(g);
    s.published.append(g);
  }
  s.published.append(s.published.last());
  s.before_um = 27.4;
  s.after_um = 6.2;
  s.roundTrip_nm = 0.12;
  s.formats = {"LinuxCNC", "SINUMERIK 840D", "Fanuc", "Heidenhain"};
  s.formatLoss = "backlash is one value, not one for each position";
  s.formatLoss_um = 0.31;
  s.formatConfirm = "the sign";
  axis->setState(s);
  axis->showView(scene == "segments" ? 1 : 0);
}

}  // namespace zerodrift::ui::samples
