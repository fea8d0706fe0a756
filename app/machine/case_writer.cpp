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

constexpr int rest_rows = 60;  // ten hours
constexpr double rest_row_s = 600.0;

/// Stepped speeds with stops, coolant and cutting at times of their own: what tells the effects apart.
std::vector<CaseStep> plan_of(const CaseOptions& options, Noise& noise) {
  if (options.one_speed) {
    return {{std::round(noise.uniform(240.0, 330.0)), std::round(noise.uniform(2500, 6000) / 50.0) * 50.0, false, 0}};
  }
  std::vector<CaseStep> plan =
      options.second ? std::vector<CaseStep>{{40, 4500, false, 0}, {40, 4500, true, 900}, {30, 1500, true, 0},
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
  CaseRecorder(const MachineParameters& parameters, double period_s, std::uint64_t noise_seed, bool noisy)
      : m_model(parameters), m_board(parameters), m_period_s(period_s), m_noisy(noisy), m_noise(noise_seed) {
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
      m_out.find("spindle_load_W")->values.push_back(std::round(advance(step, m_period_s)));
    }
  }

  /// Stands still; only the room is recorded, everything else is an empty cell.
  void rest() {
    for (int row = 0; row < rest_rows; ++row) {
      m_out.time_s.push_back(m_model.time_s());
      for (auto& channel : m_out.channels) {
        const bool input = recording::is_input(channel.kind());
        const bool room = channel.name == "ambient_C";
        channel.values.push_back(room ? room_C() : input ? 0.0 : std::nan(""));
      }
      advance({}, rest_row_s);
    }
  }
  recording::Recording take() { return std::move(m_out); }

 private:
  /// The mean load of that time.
  double advance(const CaseStep& step, double duration_s) {
    const auto steps = static_cast<int>(std::lround(duration_s / ThermalModel::step_s));
    double load_J = 0.0;
    for (int k = 0; k < steps; ++k) {
      m_model.step({step.speed_rpm, step.coolant_on, step.cutting_W, {}, false});
      load_J += m_model.spindle_load_W() * ThermalModel::step_s;
    }
    return load_J / duration_s;
  }

  double shown_C(int sensor, double true_C) const {
    if (!m_noisy) return m_board.expected_C(sensor, true_C);
    return m_board.reading(sensor, true_C, static_cast<std::uint64_t>(m_model.time_s())) / 16.0;
  }
  double room_C() const { return shown_C(0, m_model.room_C()); }

  void sample(const CaseStep& step) {
    const auto add = [&](const std::string& channel, double value) { m_out.find(channel)->values.push_back(value); };
    m_out.time_s.push_back(m_model.time_s());
    add("spindle_rpm", step.speed_rpm);
    add("coolant_on", step.coolant_on ? 1.0 : 0.0);
    add("ambient_C", room_C());
    for (const int sensor : m_sensors) {
      add(fmt::format("T{}_C", sensor), shown_C(sensor, m_model.sensor_C()[sensor - 1]));
    }
    const auto seen = m_model.nose_against_head_um();
    const auto noisy = [&](double um) {
      if (!m_noisy) return um;
      return std::round((um + displacement_noise_um * m_noise.normal()) * 100) / 100;
    };
    add("dY_um", noisy(seen[0]));
    add("dZ_um", noisy(seen[1]));
  }

  ThermalModel m_model;
  SensorBoard m_board;
  double m_period_s;
  bool m_noisy;
  Noise m_noise;
  std::vector<int> m_sensors;
  recording::Recording m_out;
};

}  // namespace

recording::Recording record_case(const HiddenEffects& hidden, std::uint64_t seed, const CaseOptions& options) {
  MachineParameters built = build_machine(seed, hidden);
  for (std::size_t i = 0; i < options.built_otherwise.size(); ++i) {
    built.*ordinary_numbers[i].factor *= std::exp(options.built_otherwise[i]);
  }
  Noise noise(seed * 2654435761ULL + (options.second ? 2 : 1));
  if (options.second) {  // the same machine on another day
    built.room_start_C += noise.uniform(-1.5, 1.5);
    built.room_phase_h = noise.uniform(6.0, 16.0);
    built.noise_day = 1;
  }
  const double period_s = seed % 2 == 0 ? 30.0 : 60.0;
  CaseRecorder recorder(built, period_s, seed + (options.second ? 1000003 : 0), options.noisy);
  for (const CaseStep& step : plan_of(options, noise)) recorder.run(step);
  if (!options.after_rest.empty()) recorder.rest();
  for (const CaseStep& step : options.after_rest) recorder.run(step);
  return recorder.take();
}

Status write_case(const std::filesystem::path& folder, const HiddenEffects& hidden, std::uint64_t seed) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) {
    return fail(ErrorCode::file_not_writable, {{"file", folder.string()}, {"detail", failed.message()}});
  }
  ZD_CHECK(recording::write_recording(folder / "run.csv", record_case(hidden, seed)));
  ZD_CHECK(recording::write_recording(folder / "second.csv", record_case(hidden, seed, {.second = true})));
  ZD_CHECK(write_json_file(folder / "machine.json", machine_description(hidden)));
  const Commitment commitment = commit_to(hidden);
  ZD_CHECK(write_json_file(folder / "commitment.json", {{"sha256", commitment.sha256}}));
  return write_json_file(folder / "answer.json", {{"sha256", commitment.sha256},
                                                  {"salt", commitment.salt},
                                                  {"committed_text", commitment.answer},
                                                  {"answer", to_json(hidden)}});
}

}  // namespace zerodrift::machine
