#pragma once
// A fitted thermal-error model (S4): error = actual - commanded, in um, as a function of temperatures (and, for dynamic
// models, of the speeds and of the recent past). File format "zerodrift-model/1"; layout in model_json.cpp.
//
// Static models (mlr, ridge) are offset + sum um_per_K * (T - reference_C): what a controller's table can run.
// Dynamic models need the host compensator; they carry the best static approximation as well.

#include <Eigen/Core>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "core/analysis/features.h"
#include "core/analysis/findings.h"
#include "core/analysis/linear.h"
#include "core/analysis/statistics.h"
#include "core/base/result.h"

namespace zerodrift::analysis {

enum class Method {
  automatic,
  mlr,
  ridge,
  pcr,      // principal components
  lasso,    // few sensors by their penalty
  robust,   // ridge that wild measurements do not pull
  dynamic,  // ridge on banks of low-passes of temperatures and inputs
  arx,      // first-order autoregressive with inputs, its pole always stable, fitted by what it simulates
  greybox,  // state space of two time constants: powers of the speed, other inputs and the room
  physics,  // ridge on simulated displacements and temperatures
};
/// offset + sum um_per_K (T - reference): what a controller runs itself.
bool is_static(Method method);
std::string_view name_of(Method method);
Result<Method> method_from(const std::string& name);

struct StaticTerm {
  std::string sensor;
  double um_per_K = 0.0;
  double reference_C = 0.0;
};

/// What a table holds for one error: predicted = offset + sum um_per_K (T - reference).
struct TableTerms {
  std::string error;
  double offset_um = 0.0;
  std::vector<StaticTerm> terms;
  ResidualFigures fit;       // on the training data
  ResidualFigures held_out;  // on data left out of the fit
};

/// Half-width of the band: factor * deviation of the prediction, at least half_width_um.
struct Band {
  double stated_coverage = 0.9;      // share of unseen errors meant to lie inside; 0: none can be stated
  double guaranteed_coverage = 0.0;  // n / (n + 1) with n independent cycles (split conformal); 0 when nothing is
  double factor = 0.0;
  double half_width_um = 0.0;    // typical, on the data left out
  double measured_coverage = 0;  // on the data left out

  /// One cycle: the coverage rests on how machines are built (structural.h), no repetition guarantees it.
  bool by_prior() const { return stated_coverage > 0.0 && guaranteed_coverage <= 0.0; }
};

struct ErrorModel {
  std::string error;
  RidgeFit regression;  // over the features of the model
  ResidualFigures fit;
  ResidualFigures held_out;
  Band band;
  double remembered_um = 0.0;  // what the slow noise still holds at the end of the training
};

/// The states the training saw, to tell interpolation from extrapolation.
struct Domain {
  std::vector<std::string> channels;  // sensors, then inputs
  std::vector<double> low;
  std::vector<double> high;
  Eigen::VectorXd mean;     // of the sensors' rise over the run's start
  Eigen::MatrixXd inverse;  // of their covariance, regularised
  double limit = 0.0;       // squared Mahalanobis distance that training reaches
};

struct Candidate {
  std::string label;  // "ridge on 5 sensors"
  Method method = Method::mlr;
  std::vector<std::string> sensors;
  double held_out_rms_um = 0.0;  // mean over the errors
  double held_out_peak_um = 0.0;
  double noise_um = 0.0;  // rms that the noise of single readings adds when the model runs
  bool runs_on_controller = false;
  bool chosen = false;
};

/// How good the run itself was, with advice.
struct RunQuality {
  double rise_K = 0.0;            // largest rise of a used sensor
  double error_range_um = 0.0;    // largest range of an error
  int cycles = 1;                 // independent stretches for validation
  double condition_number = 1.0;  // of the used sensors
  std::vector<std::string> advice;
};

struct Model {
  Method method = Method::mlr;
  Method asked = Method::automatic;
  std::string reason;    // why this method
  std::string held_out;  // what was left out, in words
  std::vector<std::string> recordings;
  std::vector<std::string> sensors;
  std::vector<FeatureSpec> features;
  std::vector<std::size_t> averaged;  // numbers of sensors (first so many) whose fits were averaged; empty: one fit
  std::vector<double> reference_C;    // of each feature (temperatures; 0 for inputs)
  std::vector<double> noise_C;        // reading noise of each feature as it is used (1 sigma); 0 for filtered ones
  std::vector<ErrorModel> errors;
  std::vector<TableTerms> table;  // static models: the model; dynamic: the best static approximation
  double table_lost_percent = 0;  // rise of the held-out rms when the table runs instead of this model
  FilterState end;                // where training ended, to go on from there
  double start_time_s = 0.0;
  std::vector<double> start_C;  // of each sensor at the start of training
  std::vector<double> end_C;    // of each sensor at its end
  Domain domain;
  std::vector<Candidate> candidates;
  RunQuality quality;
  std::vector<Finding> findings;
  std::string machine;  // physics: the machine description (JSON) whose simulation the inputs "simulated_..." are

  bool is_static() const { return analysis::is_static(method); }
  /// Half-width of the band at each row of features: noise, uncertain coefficients, reading noise of the sensors.
  /// `zero`: the state from which errors are counted; at it nothing is uncertain.
  Eigen::VectorXd half_width_um(const ErrorModel& error, const Eigen::MatrixXd& x,
                                const Eigen::RowVectorXd* zero = nullptr) const;
  const ErrorModel* find(std::string_view error) const;
  const TableTerms* table_terms(std::string_view error) const;
};

nlohmann::json to_json(const Model& model);
Result<Model> model_from_json(const nlohmann::json& document, const std::string& file,
                              std::vector<std::string>* warnings = nullptr);
Result<Model> read_model(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);

}  // namespace zerodrift::analysis
