#pragma once
// Where, when and in which regime simulation and recording differ, before any effect is named. The place comes from a
// point source with a free heat history, scanned along the rod: the evidence over x peaks where heat is missing.

#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/model.h"

namespace zerodrift::diagnosis {

struct SourceScan {
  std::string component;
  std::vector<double> position_mm;
  std::vector<double> evidence;   // with a source there
  double evidence_without = 0.0;  // without any
  double best_mm = 0.0;
  double from_mm = 0.0;
  double to_mm = 0.0;
  std::vector<double> time_s;  // of the heat history at the best place
  std::vector<double> watts;
  std::vector<std::vector<double>> watts_by_position;
};

/// Linearised at the base's nominal values (every unknown at its mean): at the fitted values they absorb the place.
/// A lump has one place, 0 mm.
SourceScan scan_sources(const Model& nominal, const std::string& component);
/// Log evidence of a heat that comes and goes as it likes at one place of a rod, over the fitted model alone.
double evidence_of_wandering_heat(const Model& model);
/// What changes with time: the mean over a block about each of the times.
struct History {
  std::vector<double> time_s;
  std::vector<double> value;
};
/// How a channel of a recording, or a simulation of it, differs from another: in blocks.
History history_of(const recording::Recording& recording, const std::vector<double>& one,
                   const std::vector<double>& other);
/// "while the spindle turns", "while the coolant runs" ... the input that what is missing follows best. `driven_by`:
/// the channel that the named effect follows, empty: none; it is the one where the history follows it at all.
std::string regime_of(const History& missing, const recording::Recording& recording, const std::string& driven_by);

}  // namespace zerodrift::diagnosis
