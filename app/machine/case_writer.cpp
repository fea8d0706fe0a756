#include "app/machine/case_writer.h"

#include <fmt/format.h>

#include <cerrno>
#include <cmath>
#include <nlohmann/json.hpp>
#include <system_error>

#include "app/machine/description.h"
#include "app/machine/sensors.h"
#include "app/machine/thermal_model.h"
#include "core/base/json.h"
#include "core/base/noise.h"
#include "core/recording/csv.h"

namespace zerodrift::machine {
namespace {

constexpr double displacement_noise_um = 0.2;

struct CaseStep {
  double minutes;
  double speed_rpm;
  bool coolant_on;
  double cutting_W;
};

/// Stepped speeds with stops, coolant and cutting at times of their own: what tells the effects apart.
std::vector<CaseStep> plan_of(bool second, Noise& noise) {
  std::vector<CaseStep> plan =
      second ? std::vector<CaseStep>{{40, 4500, false, 0}, {40, 4500, true, 900}, {30, 1500, true, 0},
                                     {50, 0, false, 0},    {50, 6500, true, 0},   {30, 2500, false, 1200},
                                     {40, 2500, false, 0}, {60, 0, false, 0}}
             : std::vector<CaseStep>{{60, 3000, false, 0},   {30, 3000, true, 0},  {30, 3000, true, 1200},
                                     {40, 6000, false, 0},   {60, 0, false, 0},    {30, 1500, true, 0},
                                     {30, 4500, false, 900}, {30, 4500, false, 0}, {50, 0, false, 0}};
  for (CaseStep& step : plan) {
    step.minutes = std::round(step.minutes * noise.uniform(0.85, 1.15));
    step.speed_rpm = std::round(step.speed_rpm * noise.uniform(0.9, 1.1) / 50.0) * 50.0;
  }
  return plan;
}

/// Runs the machine through the plan and writes rows: state at the sample, inputs of the time that follows it.
class CaseRecorder {
 public:
  CaseRecorder(const MachineParameters& parameters, double period_s, std::uint64_t noise_seed)
      : m_model(parameters), m_board(parameters), m_period_s(period_s), m_noise(noise_seed) {
    for (const char* name : {"spindle_rpm", "coolant_on", "spindle_load_W", "ambient_C"}) m_out.ensure(name);
    for (int i = 0; i < sensor_count; ++i) {
      if (sensor_places()[i].place == "spindle") m_sensors.push_back(i + 1);
    }
    for (const int sensor : m_sensors) m_out.ensure(fmt::format("T{}_C", sensor));
    m_out.ensure("dZ_um");
    m_out.ensure("dY_um");
  }

  void run(const CaseStep& step) {
    const auto rows = static_cast<int>(std::lround(step.minutes * 60.0 / m_period_s));
    for (int i = 0; i < rows; ++i) {
      sample(step);
      const auto steps = static_cast<int>(std::lround(m_period_s / ThermalModel::step_s));
      double load_J = 0.0;
      for (int k = 0; k < steps; ++k) {
        m_model.step({step.speed_rpm, step.coolant_on, step.cutting_W, {}, false});
        load_J += m_model.spindle_load_W() * ThermalModel::step_s;
      }
      m_out.find("spindle_load_W")->values.push_back(std::round(load_J / m_period_s));
    }
  }
  recording::Recording take() { return std::move(m_out); }

 private:
  void sample(const CaseStep& step) {
    const auto second = static_cast<std::uint64_t>(m_model.time_s());
    const auto add = [&](const std::string& channel, double value) { m_out.find(channel)->values.push_back(value); };
    m_out.time_s.push_back(m_model.time_s());
    add("spindle_rpm", step.speed_rpm);
    add("coolant_on", step.coolant_on ? 1.0 : 0.0);
    add("ambient_C", m_board.reading(0, m_model.room_C(), second) / 16.0);
    for (const int sensor : m_sensors) {
      add(fmt::format("T{}_C", sensor), m_board.reading(sensor, m_model.sensor_C()[sensor - 1], second) / 16.0);
    }
    const auto seen = m_model.nose_against_head_um();
    const auto noisy = [&](double um) {
      return std::round((um + displacement_noise_um * m_noise.normal()) * 100) / 100;
    };
    add("dY_um", noisy(seen[0]));
    add("dZ_um", noisy(seen[1]));
  }

  ThermalModel m_model;
  SensorBoard m_board;
  double m_period_s;
  Noise m_noise;
  std::vector<int> m_sensors;
  recording::Recording m_out;
};

}  // namespace

recording::Recording record_case(const HiddenEffect& hidden, std::uint64_t seed, bool second) {
  MachineParameters built = build_machine(seed, hidden);
  Noise noise(seed * 2654435761ULL + (second ? 2 : 1));
  if (second) {  // the same machine on another day
    built.room_start_C += noise.uniform(-1.5, 1.5);
    built.room_phase_h = noise.uniform(6.0, 16.0);
    built.noise_day = 1;
  }
  const double period_s = seed % 2 == 0 ? 30.0 : 60.0;
  CaseRecorder recorder(built, period_s, seed + (second ? 1000003 : 0));
  for (const CaseStep& step : plan_of(second, noise)) recorder.run(step);
  return recorder.take();
}

Status write_case(const std::filesystem::path& folder, const HiddenEffect& hidden, std::uint64_t seed) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) {
    return fail(ErrorCode::file_not_writable, {{"file", folder.string()}, {"detail", failed.message()}});
  }
  ZD_CHECK(recording::write_recording(folder / "run.csv", record_case(hidden, seed, false)));
  ZD_CHECK(recording::write_recording(folder / "second.csv", record_case(hidden, seed, true)));
  ZD_CHECK(write_json_file(folder / "machine.json", machine_description(hidden)));
  const Commitment commitment = commit_to(hidden);
  ZD_CHECK(write_json_file(folder / "commitment.json", {{"sha256", commitment.sha256}}));
  return write_json_file(folder / "answer.json", {{"sha256", commitment.sha256},
                                                  {"salt", commitment.salt},
                                                  {"committed_text", commitment.answer},
                                                  {"answer", to_json(hidden)}});
}

}  // namespace zerodrift::machine
