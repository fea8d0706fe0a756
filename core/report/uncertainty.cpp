#include "core/report/uncertainty.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/report/camera_marks.h"

namespace zerodrift::report {

using nlohmann::json;

namespace {

// What nobody measured is assumed, and the budget says so.
constexpr double axis_error_um = 1.0;           // of the machine's axes over the span of the calibration
constexpr double holder_mm = 100.0;             // between spindle nose and target, or camera and its foot
constexpr double holder_expansion_1_K = 12e-6;  // steel
constexpr double camera_expansion_1_K = 23e-6;  // aluminium
constexpr double camera_turn = 1e-4;            // rad, and as a change of scale: a holder warmer on one side
// ISO/TR 230-9, annex C: an expansion coefficient from a handbook is within 2 µm/(m K).
constexpr double expansion_error_1_K = 2e-6;
constexpr double default_accuracy_C = 0.1;

double rectangular(double half_width) {
  return half_width / std::numbers::sqrt3;
}

double peak_um(const Source& source, const std::string& axis) {
  const auto* run = source.run_of("warmup");
  if (run == nullptr) return std::nan("");
  const auto extremes = extremes_of(*run, "d" + axis + "_um", std::numeric_limits<double>::infinity());
  return extremes.largest ? std::max(std::abs(extremes.low), std::abs(extremes.high)) : std::nan("");
}

std::vector<std::string> axes_of(const Source& source) {
  std::vector<std::string> axes;
  for (const char* axis : {"X", "Y", "Z"}) {
    if (std::isfinite(peak_um(source, axis))) axes.emplace_back(axis);
  }
  return axes;
}

/// How much the room changed; the range of all sensors at rest when nobody logged it.
double room_range_K(const Source& source) {
  const auto* run = source.run_of("warmup");
  if (run != nullptr) {
    const auto room = extremes_of(*run, "ambient_C", std::numeric_limits<double>::infinity());
    if (room.lowest) return room.range();
  }
  return 1.0;
}

/// Of locating the target: the least stated with a measurement, where the calibration has hardly anything to scale.
Contribution camera_part(const Source& source, const std::vector<std::string>& axes) {
  Contribution part{"camera",
                    source.say("Location of the target by the camera"),
                    source.say("stated with each measurement, the least of the run"),
                    'A',
                    {}};
  const LoadedRun* run = source.run(source.find("warmup"));
  for (const auto& axis : axes) {
    const std::string channel = "sigma_" + axis + "_nm";
    const auto least = extremes_of(run->samples, channel, std::numeric_limits<double>::infinity());
    if (!least.lowest) continue;
    part.u_um[axis] = least.low / 1000.0;
    part.trace.rows.push_back(row_of(*run, channel, *least.lowest));
  }
  const auto rows = part.trace.rows;
  part.trace = source.trace("warmup", "sigma");
  part.trace.rows = rows;
  return part;
}

/// Relative uncertainty of the scale of the cameras that see a direction: the worst of them.
double scale_sigma(const json& calibration, const std::string& axis) {
  double worst = 0.0;
  for (const auto& camera : list_of(calibration, "cameras")) {
    const auto axes = list_of(camera, "axes");
    const auto at = std::find(axes.begin(), axes.end(), json(axis));
    const auto sigma = list_of(object_of(camera, "calibration"), "sigma");
    const auto row = static_cast<std::size_t>(at - axes.begin());
    if (at == axes.end() || row >= sigma.size()) continue;
    for (const auto& one : sigma[row]) {
      if (one.is_number()) worst = std::max(worst, one.get<double>() / number_of(camera, "um_per_px"));
    }
  }
  return worst;
}

double calibration_span_mm(const Source& source) {
  const auto* machine = source.find("machine");
  const double span =
      machine == nullptr ? std::nan("") : number_of(object_of(machine->body, "profile"), "calibration_span_mm");
  return std::isfinite(span) && span > 0.0 ? span : 1.0;
}

double accuracy_C(const Source& source, const std::string& channel) {
  const auto* machine = source.find("machine");
  if (machine == nullptr) return default_accuracy_C;
  for (const auto& sensor : list_of(object_of(machine->body, "profile"), "sensors")) {
    const double accuracy = number_of(sensor, "accuracy_C");
    if (text_of(sensor, "channel") == channel && std::isfinite(accuracy)) return accuracy;
  }
  return default_accuracy_C;
}

}  // namespace

std::map<std::string, double> Budget::combined_um() const {
  std::map<std::string, double> sum;
  for (const auto& part : parts) {
    for (const auto& [axis, u] : part.u_um) sum[axis] = std::hypot(sum[axis], u);
  }
  return sum;
}

Budget budget_of_measurement(const Source& source) {
  Budget budget;
  const auto* calibration = source.find("calibration");
  const auto axes = axes_of(source);
  if (calibration == nullptr || axes.empty() || text_of(calibration->body, "source") == "probes") return budget;
  const auto part = [&](const char* id, std::string what, std::string basis, char type, const Trace& trace,
                        const auto& value) {
    Contribution made{id, std::move(what), std::move(basis), type, {}, trace};
    for (const auto& axis : axes) made.u_um[axis] = value(axis);
    budget.parts.push_back(std::move(made));
  };
  budget.parts.push_back(camera_part(source, axes));
  part("calibration", source.say("Scale of the calibration, at the largest drift"),
       source.say("covariance of the calibration's fit"), 'A', source.at("calibration", "/cameras"),
       [&](const std::string& axis) { return scale_sigma(calibration->body, axis) * peak_um(source, axis); });
  const double span_mm = calibration_span_mm(source);
  part("axes", source.say("Positions of the axes during the calibration"),
       source.tell("assumed: within {} µm over {} mm, rectangular", shown(axis_error_um, 1), shown(span_mm, 1)), 'B',
       source.trace("machine", "/profile/calibration_span_mm"), [&](const std::string& axis) {
         return rectangular(axis_error_um) / (1000.0 * span_mm) * peak_um(source, axis);
       });
  const double room_K = room_range_K(source);
  const CameraMarks marks = camera_marks(calibration->body);
  if (marks.taken_off == CameraMarks::TakenOff::shift && std::isfinite(marks.distance_mm)) {
    part("camera_turn", source.say("Turn and change of scale of the camera, which one reference mark does not show"),
         source.tell("assumed: within 0.1 mrad and 1 in 10 000 over {} mm, rectangular", shown(marks.distance_mm, 1)),
         'B', source.at("calibration", "/cameras"),
         [&](const std::string&) { return rectangular(1000.0 * marks.distance_mm * camera_turn); });
  }
  if (marks.taken_off == CameraMarks::TakenOff::nothing) {
    part("camera_drift", source.say("Drift of camera and foot, no reference target in view"),
         source.tell("assumed: {} mm of aluminium, room changed by {} K, rectangular", shown(holder_mm, 0),
                     shown(room_K, 1)),
         'B', source.trace("calibration", "/reference_target"),
         [&](const std::string&) { return rectangular(1000.0 * holder_mm * camera_expansion_1_K * room_K); });
  }
  part("expansion", source.say("Expansion coefficient of the target's holder"),
       source.tell("assumed: {} mm, within {} µm/(m·K), room changed by {} K, rectangular", shown(holder_mm, 0),
                   shown(1e6 * expansion_error_1_K, 0), shown(room_K, 1)),
       'B', source.trace("warmup", "ambient_C"),
       [&](const std::string&) { return rectangular(1000.0 * holder_mm * expansion_error_1_K * room_K); });
  const double sensor_C = accuracy_C(source, "ambient_C");
  part("holder_temperature", source.say("Temperature of the target's holder"),
       source.tell("assumed: {} mm of steel, sensor within {} K, rectangular", shown(holder_mm, 0), shown(sensor_C, 2)),
       'B', source.at("machine", "/profile/sensors"),
       [&](const std::string&) { return rectangular(1000.0 * holder_mm * holder_expansion_1_K * sensor_C); });
  return budget;
}

Budget budget_of_compensation(const Source& source) {
  Budget budget;
  const auto* model = source.find("model");
  if (model == nullptr) return budget;
  const auto measured = budget_of_measurement(source).combined_um();
  if (!measured.empty()) {
    budget.parts.push_back({"measurement", source.say("Measurement the model was made from"),
                            source.say("combined, from the table above"), 'B', measured,
                            source.trace("calibration", "budget")});
  }
  Contribution sensors{"sensors",
                       source.say("Temperature sensors of the model"),
                       source.say("stated accuracy, rectangular, by the coefficients of the table"),
                       'B',
                       {},
                       source.at("model", "/table")};
  for (const auto& term : list_of(model->body, "table")) {
    double& u = sensors.u_um[text_of(term, "axis")];
    u = std::hypot(u, number_of(term, "um_per_K") * rectangular(accuracy_C(source, text_of(term, "sensor"))));
  }
  budget.parts.push_back(std::move(sensors));
  Contribution left{"model",
                    source.say("What the model leaves on unseen data"),
                    source.say("rms of data left out"),
                    'A',
                    {},
                    source.at("model", "/figures")};
  for (const auto& figure : list_of(model->body, "figures")) {
    const std::string channel = text_of(figure, "channel");
    const double rms = number_of(figure, "rms_held_out_um");
    if (std::isfinite(rms)) left.u_um[tag_of(channel, source.labels())] = rms;
  }
  budget.parts.push_back(std::move(left));
  return budget;
}

}  // namespace zerodrift::report
