#pragma once
// Where an effect stands, when every place of its component is as likely beforehand. A fit finds one peak of the
// evidence over position and its width; where the evidence is flat or has several peaks, that peak is no answer.

#include <optional>
#include <vector>

#include "core/diagnosis/elsewhere.h"

namespace zerodrift::diagnosis {

/// The distribution of a place, mm from the fixed end.
struct Place {
  double mean_mm = 0.0;
  double sigma_mm = 0.0;
  double from_mm = 0.0, to_mm = 0.0;  // 95 % of it
};

/// From log evidences at rising places, linear between them.
Place place_from(const std::vector<double>& position_mm, const std::vector<double>& log_evidence);

/// Place of an effect in `fit` and, where there are any, in the other recordings, each with what those before it have
/// shown (elsewhere.h); everything else is fitted anew at each place. None without a place that is free.
std::optional<Place> place_of_effect(const Model& fit, const SeenByAll& others, std::size_t effect);

}  // namespace zerodrift::diagnosis
