#include <cmath>

#include "tests/ui/gallery/page_samples.h"
#include "tests/ui/gallery/samples.h"
#include "ui/pages/fit_page.h"
#include "ui/pages/physics_page.h"
#include "ui/pages/sensors_page.h"

namespace zerodrift::ui::samples {

void fillSensors(Page* page, const QString& scene) {
  auto* sensors = qobject_cast<SensorsPage*>(page);
  SensorsState s;
  if (scene == "empty") {
    s.blocked = "Record a warm-up run first: the choice is made from its temperatures and errors.";
    return sensors->setState(s);
  }
  const char* labels[] = {"Spindle front bearing",
                          "Spindle middle",
                          "Motor, front end",
                          "Motor, rear end",
                          "Spindle rear bearing",
                          "Headstock",
                          "Column front, top",
                          "Column rear, top",
                          "X screw nut",
                          "X screw bearing",
                          "Y screw nut",
                          "Y screw bearing",
                          "Z screw nut",
                          "Z screw bearing",
                          "X guide",
                          "A trunnion drive",
                          "C table drive",
                          "Table",
                          "Bed",
                          "Coolant tank"};
  const int cluster[] = {0, 0, 1, 1, 0, 2, 2, 2, 3, 3, 3, 3, 1, 1, 3, 3, 3, 4, 4, 4};
  s.time_s = timeAxis(14400, 120);
  for (int i = 0; i < 20; ++i) {
    SensorRow row;
    row.tag = QStringLiteral("T%1").arg(i + 1);
    row.id = row.tag + "_C";
    row.label = labels[i];
    row.cluster = cluster[i];
    row.kept = i == 0 || i == 2 || i == 6 || i == 8 || i == 17;
    const double near = std::cos(0.5 * cluster[i] + 0.11 * i);
    row.r[0] = -0.55 * near - 0.2;
    row.r[1] = 0.72 * near + 0.12;
    row.r[2] = 0.99 - 0.09 * cluster[i] - 0.008 * i;
    row.sum = row.r[0] + row.r[1] + row.r[2];
    row.lag_s = 60.0 * (1.5 + 4.0 * cluster[i] + 0.4 * (i % 5));
    row.vif = row.kept ? 2.4 + 1.7 * cluster[i] : 14.0 + 9.0 * (i % 7);
    row.price_um = row.kept ? 0.35 + 1.9 / (1.0 + cluster[i]) : -0.01 - 0.012 * (i % 6);
    row.pc1 = 2.6 * std::cos(1.25 * cluster[i]) + 0.35 * std::sin(3.1 * i);
    row.pc2 = 1.9 * std::sin(1.25 * cluster[i]) + 0.3 * std::cos(2.3 * i);
    if (scene == "leftout" && i == 16) {
      row.cluster = -1;
      row.note = "stuck in the warm-up run, so it is not proposed";
    }
    s.sensors.insert(row.cluster < 0 ? 0 : s.sensors.size(), row);
    s.temperatures.insert(
        row.cluster < 0 ? 0 : s.temperatures.size(),
        warming(s.time_s, -1.4, 2.6 - 0.1 * (i % 3), 1800.0 + 1500.0 * cluster[i] + 60.0 * i, 0.03, i));
  }
  s.explained1_percent = 83;
  s.explained2_percent = 11;
  for (int n = 1; n <= 20; ++n) {
    s.budgetCount.append(n);
    s.budgetError_um.append(1.35 + 9.0 * std::exp(-0.75 * n) + 0.02 * n);
  }
  s.error_um = 1.68;
  s.errorLimit_um = 5.0;
  s.lost_percent = 4.2;
  s.condition = 18.4;
  sensors->setState(s);
}

void fillFit(Page* page, const QString& scene) {
  auto* fit = qobject_cast<FitPage*>(page);
  FitState s;
  if (scene == "empty") {
    s.blocked = "Choose the sensors first: the model is fitted to their temperatures.";
    return fit->setState(s);
  }
  const double drift[] = {-9.6, 22.4, 58.3};
  const char* names[] = {"X", "Y", "Z"};
  for (int axis = 0; axis < 3; ++axis) {
    FitSeries series;
    series.name = names[axis];
    series.time_s = timeAxis(16200, 60);
    series.measured_um = warming(series.time_s, 0.0, drift[axis], 3100.0 + 900.0 * (2 - axis), 0.35, 60 + axis);
    series.predicted_um = warming(series.time_s, 0.0, drift[axis] * 1.01, 3150.0 + 900.0 * (2 - axis), 0.0, 3);
    series.temperature_C = warming(series.time_s, 20.1, 16.0, 2700.0, 0.05, 9);
    for (const double p : series.predicted_um) {
      series.low_um.append(p - 2.4);
      series.high_um.append(p + 2.4);
    }
    s.series.append(series);
  }
  s.stretches = {{0, 5400, true}, {5400, 8100, false}, {8100, 13500, true}, {13500, 16200, false}};
  s.methods = {{"mlr", "Linear regression", 2.41, 6.8, 84, true, "Simple, but the sensors repeat each other"},
               {"ridge", "Ridge regression", 1.92, 5.1, 88, true, "Steady coefficients, and the controller can run it"},
               {"dynamic", "Filtered inputs", 1.31, 3.4, 91, false, "Best on unseen stretches"},
               {"physics", "Physical model", 1.66, 4.2, 90, false, "Simulation as predictor"}};
  s.method = "ridge";
  s.proposed = "ridge";
  s.sensors = {"T1", "T3", "T7", "T9", "T18"};
  s.attainablePeak_um = 5.1;
  s.attainable90_um = 3.4;
  s.attainableRms_um = 2.1;
  s.removed_percent = 91;
  s.coverage_percent = 88;
  s.validity = "18 to 41 °C";
  s.validityLimits = "0 to 6000 rpm";
  s.advice = {"The run excites the spindle well, the room hardly: watch days that are much colder.",
              "Filtered inputs would leave 0.6 µm less but need this computer connected."};
  fit->setState(s);
}

void fillPhysics(Page* page, const QString& scene) {
  auto* physics = qobject_cast<PhysicsPage*>(page);
  PhysicsState s;
  if (scene == "empty") {
    s.blocked = "Record a warm-up run first: it is compared with the simulation.";
    return physics->setState(s);
  }
  DrawnComponent spindle;
  spindle.name = "Spindle";
  spindle.length_mm = 400;
  spindle.sources = {{"rear bearing", 20, 45}, {"motor", 90, 200}, {"front bearing", 330, 355}};
  spindle.sensors = {{"T5", 25, Judgement::ok},
                     {"T4", 100, Judgement::ok},
                     {"T3", 180, Judgement::bad},
                     {"T2", 260, Judgement::warn},
                     {"T1", 345, Judgement::ok}};
  spindle.regionFrom_mm = 75;
  spindle.regionTo_mm = 87.5;
  DrawnComponent column;
  column.name = "Column";
  s.components = {spindle, column};
  s.rmse_K = 0.61;
  s.noise_K = 0.09;
  const auto time = timeAxis(14400, 60);
  for (int i = 0; i < 5; ++i) {
    SimulatedChannel channel;
    channel.tag = spindle.sensors[i].tag;
    channel.id = channel.tag + "_C";
    channel.unit = "K";
    channel.valueUnit = "°C";
    channel.time_s = time;
    channel.recorded = warming(time, 20, 10.0 + i, 2600, 0.05, i);
    channel.simulated = warming(time, 20, i == 2 ? 8.6 : 9.9 + i, 2600, 0.0, i);
    channel.refined = warming(time, 20, 9.95 + i, 2600, 0.0, i);
    channel.rmse = i == 2 ? 1.9 : i == 3 ? 0.3 : 0.1;
    channel.noise = 0.09;
    s.channels.append(channel);
  }
  if (scene == "before") return physics->setState(s);
  spindle.mismatchFrom_mm = 150;
  spindle.mismatchTo_mm = 195;
  s.components[0] = spindle;
  HeatMapData map;
  map.from_s = 0;
  map.to_s = 14400;
  map.from_mm = 0;
  map.to_mm = 400;
  map.columns = 60;
  map.rows = 50;
  map.unit = "W";
  for (int row = 0; row < map.rows; ++row) {
    for (int column_ = 0; column_ < map.columns; ++column_) {
      const double x = 400.0 * (row + 0.5) / map.rows;
      const double t = 14400.0 * (column_ + 0.5) / map.columns;
      const double on = t > 1800 && t < 10800 ? 1.0 : 0.08;
      map.values.append(36.0 * on * std::exp(-std::pow((x - 172) / 26, 2)) -
                        6.0 * on * std::exp(-std::pow((x - 300) / 40, 2)));
    }
  }
  s.missingHeat = map;
  s.verdict = PhysicsVerdict::missingEffect;
  s.verdictSentence = "While the spindle turns, 36 W are missing between 150 and 195 mm.";
  s.missing_W = 36;
  s.held_K = 0.11;
  const auto residual = [](double size, double tau, int seed) {
    auto r = warming(timeAxis(14400, 240), 0.0, size, tau, 0.05, seed);
    return r;
  };
  Explanation first;
  first.id = "extra_heat_source";
  first.name = "A heat source that the description lacks";
  first.sentence = "Something between motor and front bearing heats the shaft while it turns.";
  first.magnitude = "36.1 ± 2.0 W";
  first.place = "spindle, 172 mm";
  first.confidence = 0.97;
  first.before = residual(1.9, 2600, 1);
  first.refit = residual(0.9, 3900, 2);
  first.after = residual(0.05, 3000, 3);
  first.channel = "T3";
  first.rmseBefore = 1.62;
  first.rmseRefit = 0.74;
  first.rmseAfter = 0.10;
  first.couldDetect = "Such a source would have shown from 6 W on.";
  Explanation second = first;
  second.id = "bearing_preload";
  second.name = "Front bearing gains preload";
  second.sentence = "The friction of the front bearing rises as it warms.";
  second.magnitude = "+ 22 % at 40 °C";
  second.place = "front bearing";
  second.confidence = 0.31;
  second.after = residual(0.7, 2500, 5);
  second.rmseAfter = 0.58;
  second.rivals = "This recording cannot tell it from a worn bearing.";
  second.couldDetect.clear();
  s.explanations = {first, second};
  s.nextExperiment =
      "40 minutes at 6000 rpm after a cold start separates the two: the preload grows with the heat, the source with "
      "the speed.";
  s.trials = {{"extra_heat_source", "extra_heat_source", true, 94},
              {"radiation", "radiation", true, 71},
              {"sensor_lag", "sensor_lag", true, 88},
              {"contact_resistance", "extra_heat_source", false, 12}};
  if (scene == "unexplained") {
    s.verdict = PhysicsVerdict::unexplained;
    s.verdictSentence =
        "Something is missing that the library does not explain: worst at T3, while the spindle turns, about "
        "36 W.\nIt shows most at 30–180 min.\nAs heat it would come in between 150 and 195 mm of "
        "spindle.";
    s.explanations.clear();
    s.nextExperiment =
        "To tell a sensor that answers late from a joint that conducts badly, switch the heater off and read both by "
        "hand for 10 min.";
    s.nextIsWarmupRun = false;
  }
  if (scene == "trial") {
    s.trial.stage = TrialStage::opened;
    s.trial.seal = "9f2c41d7a0be6e35c8f4b1d20763ac59e1f08b7d5a6c3e94210f7d8b6ac5e3f1";
    s.trial.answer = "An extra heat source, 96 %";
    s.trial.hidden = "An extra heat source";
    s.trial.right = true;
    for (const SimulatedChannel& channel : s.channels) {
      s.trial.curves.append({channel.tag, channel.time_s, channel.recorded, channel.simulated, channel.refined});
    }
  }
  physics->setState(s);
  physics->showView(scene == "channels" ? 1 : scene == "trial" ? 2 : 0);
}

}  // namespace zerodrift::ui::samples
