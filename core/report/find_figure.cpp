#include "core/report/find_figure.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/json.h"

namespace zerodrift::report {

using nlohmann::json;

namespace {

void add_cells(const Table& table, std::vector<Figure>& all) {
  for (const auto& row : table.rows) {
    for (std::size_t c = 0; c < row.size(); ++c) {
      const Cell& one = row[c];
      if (one.id.empty()) continue;
      Figure made;
      made.id = one.id;
      made.label = table.title + ": " + row.front().text + (c < table.header.size() ? ", " + table.header[c] : "");
      made.value = one.text;
      made.verdict = one.verdict;
      made.trace = one.trace;
      all.push_back(std::move(made));
    }
  }
}

}  // namespace

std::vector<Figure> all_figures(const Report& report) {
  std::vector<Figure> all;
  for (const auto& section : report.sections) {
    for (const auto& block : section.blocks) {
      if (const auto* figures = std::get_if<Figures>(&block)) {
        all.insert(all.end(), figures->figures.begin(), figures->figures.end());
      }
      if (const auto* table = std::get_if<Table>(&block)) add_cells(*table, all);
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

Result<json> origin_of(const commissioning::Job& job, const Figure& figure) {
  json origin = {{"figure", figure.id},
                 {"label", figure.label},
                 {"value", figure.value},
                 {"unit", figure.unit},
                 {"artefact", figure.trace.artefact},
                 {"artefact_id", figure.trace.id},
                 {"detail", figure.trace.detail},
                 {"rows", json::array()}};
  if (figure.trace.id > 0) {
    ZD_TRY(const auto artefact, job.artefact(figure.trace.id));
    origin["made_utc"] = artefact.created_utc;
    origin["made_by"] = artefact.made_by;
    origin["engineer"] = artefact.engineer;
    origin["content_hash"] = artefact.content_hash;
    origin["inputs"] = json::array();
    for (const auto& input : artefact.inputs) {
      origin["inputs"].push_back({{"kind", input.kind}, {"id", input.id}, {"content_hash", input.content_hash}});
    }
    ZD_TRY(const json body, artefact.document());
    if (!figure.trace.pointer.empty()) {
      const json::json_pointer pointer(figure.trace.pointer);
      origin["pointer"] = figure.trace.pointer;
      origin["stored"] = body.contains(pointer) ? body.at(pointer) : json();
    }
    if (body.contains("series")) origin["series"] = body.at("series");
  }
  for (const auto& row : figure.trace.rows) {
    origin["rows"].push_back({{"series", row.series},
                              {"row", row.row},
                              {"time_s", row.time_s},
                              {"channel", row.channel},
                              {"value", std::isfinite(row.value) ? json(row.value) : json()}});
  }
  return origin;
}

std::string origin_in_words(const json& origin) {
  const auto text = [&](const char* key) { return origin.value(key, std::string()); };
  std::string out = fmt::format("{} = {}{}{} ({})\n", text("figure"), text("value"), text("unit").empty() ? "" : " ",
                                text("unit"), text("label"));
  out += fmt::format("artefact {} #{}", text("artefact"), origin.value("artefact_id", 0LL));
  if (origin.contains("made_utc")) {
    out += fmt::format(", made {} by {}{}{}, SHA-256 {}", text("made_utc"), text("made_by"),
                       text("engineer").empty() ? ", nobody named" : ", ", text("engineer"), text("content_hash"));
  }
  if (origin.contains("stored")) {
    const std::string stored = json_text(origin.at("stored"));
    constexpr std::size_t most = 400;
    out += fmt::format("\n{}: {}", text("pointer"), stored.size() > most ? stored.substr(0, most) + " ..." : stored);
  } else if (!text("detail").empty()) {
    out += "\n" + text("detail");
  }
  for (const auto& row : origin.at("rows")) {
    out += fmt::format("\nseries {}, row {}, {:.3f} s: {} = {}", row.at("series").get<long long>(),
                       row.at("row").get<long long>(), row.at("time_s").get<double>(),
                       row.at("channel").get<std::string>(), json_text(row.at("value")));
  }
  for (const auto& input : origin.value("inputs", json::array())) {
    out += fmt::format("\nmade from {} #{} ({})", input.at("kind").get<std::string>(), input.at("id").get<long long>(),
                       input.at("content_hash").get<std::string>().substr(0, 16));
  }
  return out;
}

}  // namespace zerodrift::report
