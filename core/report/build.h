#pragma once
// Builds the report of a job from its artefacts. Sections whose step was not done say so; nothing is made up.

#include <optional>

#include "core/base/result.h"
#include "core/commissioning/job.h"
#include "core/report/report.h"
#include "core/report/source.h"
#include "core/report/text/language.h"

namespace zerodrift::report {

Result<Report> build_report(const commissioning::Job& job, Language language = Language::english);

// One line a section, in the order of the report; each stands in sections/<section>.cpp and is left out when its
// function gives nothing.
std::optional<Section> summary_section(const Source& source);
std::optional<Section> doubts_section(const Source& source);
std::optional<Section> setup_section(const Source& source);
std::optional<Section> uncertainty_section(const Source& source);
std::optional<Section> warmup_section(const Source& source);
std::optional<Section> iso230_3_section(const Source& source);
std::optional<Section> sensors_section(const Source& source);
std::optional<Section> choice_section(const Source& source);
std::optional<Section> model_section(const Source& source);
std::optional<Section> physics_section(const Source& source);
std::optional<Section> table_section(const Source& source);
std::optional<Section> upload_section(const Source& source);
std::optional<Section> verification_section(const Source& source);
std::optional<Section> axis_section(const Source& source);
std::optional<Section> provenance_section(const Source& source);

}  // namespace zerodrift::report
