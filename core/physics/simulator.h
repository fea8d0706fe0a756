#pragma once
// Steps the thermal network through a run, and with it the exact derivatives of that same discrete scheme
// (tangent-linear model). TR-BDF2 (Bank et al. 1985) with gamma = 2 - sqrt(2): both stages share one matrix, so one
// factorisation a step (none while the coefficients stand still), second order, L-stable. Coefficients that depend on
// temperatures are taken at temperatures extrapolated to the middle of the step, which keeps the order and the step
// linear. Backward Euler would not do: its time shift of half a step looks like a sensor lag.

#include <vector>

#include "core/base/unfilled.h"
#include "core/physics/inputs.h"
#include "core/physics/network.h"

namespace zerodrift::physics {

struct SimulateOptions {
  double longest_step_s = 31.0;     // twice that where no input has stepped for a while
  bool keep_field = false;          // node temperatures at every sample
  bool keep_balance = false;        // stored and supplied heat
  std::vector<bool> values_only{};  // probes whose derivatives nobody asks for; empty: none
};

struct Trajectory {
  std::size_t rows = 0;
  std::size_t columns = 0;      // derivatives, in the order of the parameters asked for
  std::vector<double> probes;   // [row * probe count + probe]
  UnfilledNumbers derivatives;  // [(place * rows + row) * columns + column], by parameter value
  std::vector<int> derived;     // place of each probe among the derivatives, -1: values only
  std::vector<double> field_C;  // [row * nodes + node]
  double stored_J = 0.0;
  double supplied_J = 0.0;  // sources less what films took away
};

/// `values`: one a parameter of the network. `parameters`: indices of those to differentiate by.
Trajectory run_network(const Network& network, const InputSet& inputs, const std::vector<double>& values,
                       const std::vector<int>& parameters = {}, const SimulateOptions& options = {});

}  // namespace zerodrift::physics
