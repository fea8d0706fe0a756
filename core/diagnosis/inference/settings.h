#pragma once
// Every number by which a diagnosis weighs evidence, each with its unit, its reason and where it comes from. Log odds
// are natural logarithms. Nothing outside this file accepts or rejects a hypothesis.

#include <string>
#include <vector>

#include "core/base/result.h"

namespace zerodrift::diagnosis {

/// Sizes that the discrepancy of a description may have, with what is thought of each beforehand.
struct SizePrior {
  double size = 1.0;
  double log_prior = 0.0;
};

struct DiagnosisSettings {
  // -- The data ---------------------------------------------------------------------------------------------------
  /// Rows of a recording that are fitted; longer ones are averaged. Thermal time constants are minutes.
  std::size_t most_rows = 600;
  /// Noise that a sensor has at least, K, and a displacement, um: resolution of common instruments.
  double least_noise_K = 0.01;
  double least_noise_um = 0.05;

  // -- Discrepancy: the difference between a right description and the machine --------------------------------------
  // Random, slow and smooth (Matern 3/2): what does not come back on another day.
  /// Correlation times: between the time constants of a part and of a hall, and of what a form gets wrong in minutes.
  /// Of recordings shorter than `full_run_s` in proportion: what is small heats up fast and is recorded for minutes.
  std::vector<double> slow_times_s = {1500.0, 300.0};
  double short_time_log_prior = -1.0;  // of each further of them, relative to the first
  double full_run_s = 14400.0;
  double slow_K = 0.02;  // standard deviation at size 1: hypot(this, share of the channel's range)
  double slow_um = 0.2;
  double slow_share = 0.0015;  // of the channel's range
  std::vector<double> slow_sizes = {0.35, 0.7, 1.4, 3.0, 6.0, 12.0, 25.0, 50.0};
  double usual_slow_size = 0.7;
  double slow_size_spread = 0.7;  // of ln(size), of a description by rods of stated sizes
  double coarse_slow_size = 2.0;  // the same of a description by lumps or of guessed sizes
  double coarse_slow_spread = 1.2;
  // Repeatable: the error of a description's form, which comes back in step with the inputs.
  std::vector<double> lags_s = {600.0, 2400.0, 9000.0};  // in proportion like the times above
  double repeatable_share = 0.005;  // of the channel's range, standard deviation of a gain at size 1
  std::vector<SizePrior> repeatable_sizes = {{0.0, -0.7}, {1.0, -1.4}, {2.0, -1.9}, {4.0, -2.6}};
  double common_share = 0.3;  // of a gain's variance, that all sensors have in common (the room, the film)
  double part_share = 0.3;    // that the sensors of a part have in common (its power, its capacity)
  double near_share = 0.3;    // that neighbouring places have in common (shares of heat, shape)
  double near_length = 0.3;   // correlation length over the part's length
  double alike = 0.995;       // two drivers that correlate by more count as one

  // -- Prior odds -----------------------------------------------------------------------------------------------
  double effect_log_prior = -3.5;  // of a kind of effect to be missing: a handful of some thirty are, if any
  double error_log_prior = -5.0;   // of a kind of mistake in the description
  double decisive = 3.0;           // twenty to one: what is certain enough to act on
  double tempering = 1.0;          // of log posterior odds, so that stated probabilities come true; fitted on trials
  double named_from = 0.5;         // posterior mass from which an effect is named: more likely than not
  /// Share of what the description leaves of a channel that a named effect has to take: less is a detail, which a
  /// better form of something else would take as well.
  double material_share = 0.15;
  double rival_from = 0.02;  // and from which it is reported as what this recording cannot exclude

  // -- What a good description leaves of a channel: hypot(size * slow discrepancy, share of range)
  double adequate_size = 4.0, adequate_share = 0.01;                 // by rods of stated sizes
  double adequate_coarse_size = 12.0, adequate_coarse_share = 0.05;  // by lumps, guessed sizes

  double significance = 1e-3;  // of the test whether a hypothesis leaves more than noise and usual discrepancy

  // -- Search ----------------------------------------------------------------------------------------------------
  int most_effects = 3;             // what three do not explain, no list of effects does
  std::size_t beam = 2;             // hypotheses that are extended in each round
  std::size_t proposals = 6;        // of each, fitted after the score test
  std::size_t forms_of_a_kind = 2;  // among them
  std::size_t followed = 4;         // of all proposals of a round, fitted to the end
  int most_rounds = 6;
  double margin = 12.0;    // log odds behind the best at which a hypothesis is dropped
  int iterations = 12;     // of a fit
  double tolerance = 0.2;  // of -2 log posterior, at which a fit has converged

  /// What is wrong with these settings, and why.
  Status check() const;
};

}  // namespace zerodrift::diagnosis
