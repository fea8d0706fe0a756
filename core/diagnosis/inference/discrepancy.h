#pragma once
// The repeatable part of a description's discrepancy: the error of its form, which comes back every day in step with
// the inputs. Each channel has unknown gains to a few drivers - the power of each source, other logged inputs, the
// room, neighbouring measured parts, each through first-order lags - with a zero-mean Gaussian prior. The gains are
// shared by all recordings, and those of neighbouring sensors are alike (Brynjarsdottir & O'Hagan 2014: discrepancy
// must be modelled, or parameters are biased and over-confident).

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/diagnosis/inference/run.h"
#include "core/physics/machine.h"

namespace zerodrift::diagnosis::inference {

/// A function of time, of every recording, largest value 1 over all of them.
struct Driver {
  std::string name;  // "spindle/motor", "coolant_on", "ambient_C"
  double lag_s = 0.0;
  std::string component;                   // acts on the channels of this part only; empty: on all
  bool heat = false;                       // of a heat source or of a switched input: displacements follow these alone
  std::vector<std::vector<double>> value;  // [run][row]
};

std::vector<Driver> make_drivers(const physics::Machine& machine, const std::vector<Run>& runs,
                                 const DiagnosisSettings& settings);

/// The gains of a kind of channel, as linear unknowns with a joint prior.
struct GainGroup {
  bool temperature = true;
  std::vector<std::size_t> series;  // that have gains
  std::vector<Eigen::Index> first;  // of each of them
  Eigen::Index count = 0;
  Eigen::MatrixXd prior_precision;     // at size 1
  double prior_log_determinant = 0.0;  // of the covariance at size 1
  /// [place in `series`][run]: rows x gains of that series, for gains of unit prior variance.
  std::vector<std::vector<RowMatrix>> basis;
  std::vector<std::vector<std::size_t>> driver;  // [place in `series`][gain]: index of the driver
};

/// Temperatures, then displacements.
std::vector<GainGroup> make_gains(const physics::Machine& machine, const std::vector<Run>& runs,
                                  const std::vector<Driver>& drivers, const DiagnosisSettings& settings);

}  // namespace zerodrift::diagnosis::inference
