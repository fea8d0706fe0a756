#pragma once
// Looks up figures of a finished report by their ids, so that every number can be traced to its rows.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/commissioning/job.h"
#include "core/report/report.h"

namespace zerodrift::report {

/// The figure with this id; bad_argument naming those there are. Cells of tables with an id are figures, too.
Result<Figure> find_figure(const Report& report, const std::string& id);
std::vector<Figure> all_figures(const Report& report);

/// Where a figure comes from, looked up in the job: the artefact with who made it, when and from what, the value that
/// stands there, and the samples that decide it.
Result<nlohmann::json> origin_of(const commissioning::Job& job, const Figure& figure);
std::string origin_in_words(const nlohmann::json& origin);

}  // namespace zerodrift::report
