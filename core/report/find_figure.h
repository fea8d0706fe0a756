#pragma once
// Looks up figures of a finished report by their ids, so that every number can be traced to its rows.

#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/report/report.h"

namespace zerodrift::report {

/// The figure with this id; bad_argument naming those there are.
Result<Figure> find_figure(const Report& report, const std::string& id);
std::vector<Figure> all_figures(const Report& report);

}  // namespace zerodrift::report
