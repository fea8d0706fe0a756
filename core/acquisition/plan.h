#pragma once
// The warm-up plan (R2): what the machine does and when it is measured. Format: the contract's warm-up plan.

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace zerodrift::acquisition {

struct PlanStep {
  double duration_s = 0.0;
  double spindle_rpm = 0.0;
  bool coolant_on = false;
  bool path_cycle = false;  // "cycle": axes run the fixed path; "still": they stand
};

struct Plan {
  std::string name;
  double sample_period_s = 10.0;
  double measure_period_s = 60.0;
  std::map<std::string, double> measure_position_mm;
  std::vector<PlanStep> steps;

  double duration_s() const;
  /// The step running at this time since the start; the last one after the end.
  std::size_t index_at(double time_s) const;
  const PlanStep& step_at(double time_s) const;
};

Result<Plan> plan_from_json(const nlohmann::json& document, const std::string& file,
                            std::vector<std::string>* warnings = nullptr);
nlohmann::json to_json(const Plan& plan);
Result<Plan> read_plan(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);

/// The plan with the measuring position it is measured at: its own, on the axes that it leaves open the profile's.
/// no_measuring_position when there is none at all.
Result<Plan> with_measuring_position(Plan plan, const std::map<std::string, double>& of_profile);

/// Presets, measured at the profile's position: 4 h of stepped speeds (first, the usual one); 4 h at 3000 rpm;
/// stepped-speed spectrum; ISO 230-3 ETVE (environment), spindle and linear axis tests.
std::vector<Plan> preset_plans();

}  // namespace zerodrift::acquisition
