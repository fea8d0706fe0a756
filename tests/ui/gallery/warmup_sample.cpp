#include <cmath>

#include "tests/ui/gallery/page_samples.h"
#include "tests/ui/gallery/samples.h"
#include "ui/pages/warmup_page.h"

namespace zerodrift::ui::samples {

static void fillRun(RunView* run, double duration_s) {
  const double rises[] = {16.2, 11.4, 14.8, 13.1, 10.6, 6.2, 2.1, 1.4, 4.2, 3.1,
                          2.7,  2.2,  6.4,  5.1,  2.9,  3.3, 2.4, 1.2, 0.7, 4.8};
  const double taus[] = {2700, 3300, 2100, 2200, 2900, 6200, 9000, 11000, 3600,  3900,
                         3600, 3900, 3000, 3300, 5400, 4200, 4800, 8000,  15000, 3900};
  QVector<RunChannel> temperatures;
  for (int i = 0; i < 20; ++i) {
    const QString tag = QStringLiteral("T%1").arg(i + 1);
    temperatures.append({tag + "_C", tag, "Sensor " + tag, "°C", 2});
  }
  const QVector<RunChannel> errors = {{"dX_um", "X", "X error", "µm", 1, axisColor(0)},
                                      {"dY_um", "Y", "Y error", "µm", 1, axisColor(1)},
                                      {"dZ_um", "Z", "Z error", "µm", 1, axisColor(2)}};
  const QVector<RunChannel> inputs = {{"spindle_rpm", "Speed", "Spindle speed", "rpm", 0, groupColor(4)}};
  run->setChannels(temperatures, errors, inputs);
  run->clear();
  QVector<RunValue> values;
  const auto time = timeAxis(duration_s, 10.0);
  for (int i = 0; i < 20; ++i) {
    auto curve = warming(time, 20.1 + 0.03 * i, rises[i], taus[i], 0.04, i);
    if (i == 13) {
      for (int k = 700; k < 740 && k < curve.size(); ++k) curve[k] = NAN;
    }
    run->append(temperatures[i].id, time, curve);
    values.append(
        {temperatures[i].id, curve.last(), i == 13 ? "Noisy" : "OK", i == 13 ? Judgement::warn : Judgement::ok});
  }
  const auto measured = timeAxis(duration_s, 60.0);
  const double drift[] = {-9.6, 22.4, 58.3};
  const double tau[] = {5200, 6800, 3100};
  for (int i = 0; i < 3; ++i) {
    const auto curve = warming(measured, 0.0, drift[i], tau[i], 0.12, 40 + i);
    run->append(errors[i].id, measured, curve);
    values.append({errors[i].id, curve.last(), "± 0.07 µm", Judgement::none});
  }
  QVector<double> speed;
  for (const double t : time) speed.append(t < 300 ? 0.0 : t < 9000 ? 3000.0 : 1500.0);
  run->append("spindle_rpm", time, speed);
  values.append({"spindle_rpm", speed.last(), {}, Judgement::none});
  run->setValues(values);
  run->setRegimes({{300, 9000, 3000, false}, {9000, 9150, 8000, true}, {9150, duration_s, 1500, true}}, 8000);
  run->setMarks({{4210, "Door opened", Judgement::none},
                 {4900, "Pause", Judgement::none},
                 {5300, "Pause", Judgement::none},
                 {7000, "T14 lost 6 min", Judgement::warn},
                 {0.98 * duration_s, "Coolant refilled", Judgement::none}});
  CameraMarks marks;
  marks.targetRegion = {222, 132, 196, 196};
  marks.references = {{QRectF(38, 302, 130, 126)}, {QRectF(472, 302, 130, 126), std::nullopt, true}};
  marks.message = "reference 2: target missing";
  marks.judgement = Judgement::warn;
  marks.target = QPointF(320, 230.4);
  for (int i = 0; i < 60; ++i) marks.trail.append({320.0 - 0.8 * i / 60.0, 230.4 + 4.7 * (1.0 - std::exp(-i / 17.0))});
  marks.trailEnlargement = 20;
  run->setFrame(cameraImage(640, 480), marks);
}

void fillWarmup(Page* page, const QString& scene) {
  auto* warmup = qobject_cast<WarmupPage*>(page);
  WarmupState s;
  if (scene == "empty") {
    s.blocked = "Calibrate the cameras first: the run measures with them.";
    return warmup->setState(s);
  }
  s.presets = {"4 h at 3000 rpm", "ISO 230-3 environment (ETVE)", "ISO 230-3 spindle", "Stepped speeds"};
  s.preset = 3;
  s.plan = {{1800, 0, false, false},
            {5400, 3000, false, true},
            {3600, 6000, true, true},
            {3600, 1500, true, true},
            {1800, 0, false, false}};
  s.measurePeriod_s = 300;
  s.diskFree_GB = 79.2;
  s.expectedFrom = "from the run of 14 November";
  s.expectedTime_s = timeAxis(16200, 120);
  for (const double t : s.expectedTime_s) {
    const double warm = t < 1800 ? 0.0 : 44.0 * (1.0 - std::exp(-(t - 1800) / 3000.0));
    const double cool = t > 10800 ? -21.0 * (1.0 - std::exp(-(t - 10800) / 2600.0)) : 0.0;
    s.expectedDrift_um.append(warm + cool);
  }
  if (scene == "plan") return warmup->setState(s);
  s.phase = scene == "paused" ? RunPhase::paused : RunPhase::running;
  s.elapsed_s = 12600;
  s.timeLeft_s = 3600;
  s.largestError_um = 57.4;
  s.largestErrorAxis = "Z";
  s.slope_um_per_h = 2.6;
  s.slope_K_per_h = 0.9;
  s.samples = 27720;
  s.samplesLost = 36;
  s.steadyCriterion = "under 3 µm/h and 1 K/h for 20 minutes";
  s.steady = true;
  warmup->setState(s);
  fillRun(warmup->run(), 12600);
  warmup->setProblem({ProblemKind::warning,
                      "Sensor T14 gave no value for 6 minutes.",
                      "The gap is kept as a gap. Check its plug; the run goes on.",
                      {}});
  if (scene != "banner") warmup->clearProblem();
  warmup->run()->setTrouble({});
  if (scene != "trouble") return;
  warmup->run()->setTrouble(
      {"The temperature sensor T14 Spindle nose has not moved for 40 s: it is stuck. Check it, or "
       "leave it out of the model.",
       {"controller busy, 12 times, asked again", "sensor stuck (T14 Spindle nose), once"},
       false});
}

}  // namespace zerodrift::ui::samples
