#include "core/report/find_figure.h"

namespace zerodrift::report {

std::vector<Figure> all_figures(const Report& report) {
  std::vector<Figure> all;
  for (const auto& section : report.sections) {
    for (const auto& block : section.blocks) {
      if (const auto* figures = std::get_if<Figures>(&block)) {
        all.insert(all.end(), figures->figures.begin(), figures->figures.end());
      }
    }
  }
  return all;
}

Result<Figure> find_figure(const Report& report, const std::string& id) {
  std::string known;
  for (auto& figure : all_figures(report)) {
    if (figure.id == id) return figure;
    known += (known.empty() ? "one of " : ", ") + figure.id;
  }
  return fail(ErrorCode::bad_argument, {{"what", "figure"}, {"found", id}, {"expected", known}});
}

}  // namespace zerodrift::report
