#pragma once
// What a model looks at: temperatures as they are (static), and causal first-order low-passes of temperatures and
// inputs (dynamic): each is the answer of a lump of one time constant, so a sum of them is the answer of a structure.
// A filter starts steady at its first value: what was before the recording is taken as having lasted.

#include <Eigen/Core>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/prepare.h"

namespace zerodrift::analysis {

struct FeatureSpec {
  std::string channel;
  double time_constant_s = 0.0;  // 0: the value itself
  int power = 1;                 // of inputs: friction grows with speed, its torque with part of it
  double unit = 1.0;             // the value is divided by it before the power; 1 K, 1000 rpm
  bool temperature = false;      // temperatures are taken as the rise over the reference

  bool operator==(const FeatureSpec&) const = default;
};

/// Temperatures as they are.
std::vector<FeatureSpec> static_features(const std::vector<std::string>& sensors);
/// Filter banks: speed n and n^2 (0.05 to 6 h), other inputs that move (0.15 to 6 h), temperatures (0 to 5 h).
std::vector<FeatureSpec> dynamic_features(const std::vector<std::string>& sensors, const Prepared& data);

/// For a first-order ARX model: every moving input and every temperature through each of a list of poles (0.1 to 4 h).
std::vector<FeatureSpec> arx_features(const std::vector<std::string>& sensors, const Prepared& data);
/// For the grey box: moving inputs (speed n and n^2) and the room through each of a list of time constants.
std::vector<FeatureSpec> greybox_features(const std::string& room, const Prepared& data);
/// Inputs of this name are what a simulation of the machine says: its displacements, in um.
inline constexpr std::string_view simulated_prefix = "simulated_";
bool has_simulation(const Prepared& data);
/// For a physics model: the simulated displacements, at once and lagging (what the description leaves out of the
/// structure follows later), and the temperatures as they are.
std::vector<FeatureSpec> physics_features(const std::vector<std::string>& sensors, const Prepared& data);
/// Columns of the features that share one time constant, or two of them when `pairs`: the structures to choose from.
std::vector<std::vector<int>> pole_groups(const std::vector<FeatureSpec>& specs, bool pairs);

/// Where the filters and inputs stood at the end of a recording, to go on from there.
struct FilterState {
  double time_s = 0.0;
  std::vector<double> filtered;  // one for each feature
  std::vector<double> driving;   // the unfiltered value then
};

/// rows x features. `reference_C`: one for each feature (only used for temperatures).
/// `from`: state to go on from; `end`: receives the state at the last row.
Result<Eigen::MatrixXd> features(const Prepared& data, const std::vector<FeatureSpec>& specs,
                                 const std::vector<double>& reference_C, const FilterState* from = nullptr,
                                 FilterState* end = nullptr);

/// Start value of each feature's channel: the first temperature (smoothed over a short while); 0 for inputs.
std::vector<double> start_references(const Prepared& data, const std::vector<FeatureSpec>& specs);

/// First-order low-pass of a series with steady start; `state` when given is the value one step before the first row.
Eigen::VectorXd low_pass(const std::vector<double>& time_s, const Eigen::VectorXd& values, double time_constant_s);

}  // namespace zerodrift::analysis
