#pragma once
// From a fitted model to a compensation table, and several tables into one.

#include <string>
#include <vector>

#include "core/analysis/model.h"
#include "core/base/result.h"
#include "core/compensation/follower.h"
#include "core/compensation/table.h"

namespace zerodrift::compensation {

struct ModelTableOptions {
  std::string machine;
  std::uint32_t serial = 0;
  double max_um = 200.0;
  double max_um_per_s = 2.0;
  double max_um_per_K = 50.0;
};

/// The table of the model's errors dX_um, dY_um, dZ_um (other errors are left out with a warning). A dynamic model
/// gives its best static approximation, with a warning that says what is lost.
Result<Table> table_from_model(const analysis::Model& model, const ModelTableOptions& options,
                               std::vector<std::string>* warnings = nullptr);
/// A model that remembers, at work beside the machine: its errors dX_um, dY_um, dZ_um; others are not compensated.
Predictor live_predictor(const analysis::Model& model);
/// Adds the position points and segments of an axis table, within the machine's limits; bad_argument when an axis
/// already has points, limit_exceeded when its errors are larger than the machine's compensation may be.
Status add_axis_table(Table& table, const Table& axis_table, const ModelTableOptions& machine);

}  // namespace zerodrift::compensation
