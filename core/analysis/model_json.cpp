// model.json, "zerodrift-model/1":
//   method, asked, reason, held_out (what was left out), recordings, sensors, averaged, runs_on_controller,
//   errors [{error, intercept_um, terms [{sensor, um_per_K, reference_C}] (static models), fit, held_out {rms_um,
//            peak_um, p90_um, removed_percent, count}, band {half_width_um, stated_coverage, guaranteed_coverage,
//            measured_coverage, factor}, regression {...}}],
//   features [{channel, time_constant_s, power, unit, temperature, reference}] (what regression.coefficients belong
//   to), table [{error, offset_um, terms [...], fit, held_out}], table_lost_percent, valid {sensor: [low, high] in C},
//   machine (physics: the description that is simulated), domain, candidates, quality, findings, training
//   {start_time_s, end_time_s, start_C, end_C, filtered, driving} (to go on from).
// Covariances are packed lower triangles, row by row.

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "core/analysis/model.h"
#include "core/base/json.h"

namespace zerodrift::analysis {
namespace {

using nlohmann::json;

constexpr const char* format_name = "zerodrift-model/1";

std::vector<double> list_of(const Eigen::VectorXd& v) {
  return {v.begin(), v.end()};
}

std::vector<double> packed(const Eigen::MatrixXd& m) {
  std::vector<double> out;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) out.push_back(static_cast<double>(static_cast<float>(m(i, j))));
  }
  return out;
}

json figures_json(const ResidualFigures& f) {
  json out = {{"rms_um", f.rms_um}, {"peak_um", f.peak_um}, {"removed_percent", f.removed_percent}, {"count", f.count}};
  if (std::isfinite(f.p90_um)) out["p90_um"] = f.p90_um;
  return out;
}

json terms_json(const std::vector<StaticTerm>& terms) {
  json list = json::array();
  for (const auto& t : terms) {
    list.push_back({{"sensor", t.sensor}, {"um_per_K", t.um_per_K}, {"reference_C", t.reference_C}});
  }
  return list;
}

json error_json(const Model& model, std::size_t e) {
  const ErrorModel& m = model.errors[e];
  const RidgeFit& r = m.regression;
  json out = {{"error", m.error},
              {"intercept_um", r.raw_intercept()},
              {"fit", figures_json(m.fit)},
              {"held_out", figures_json(m.held_out)},
              {"band",
               {{"half_width_um", m.band.half_width_um},
                {"stated_coverage", m.band.stated_coverage},
                {"guaranteed_coverage", m.band.guaranteed_coverage},
                {"measured_coverage", m.band.measured_coverage},
                {"factor", m.band.factor}}},
              {"remembered_um", m.remembered_um},
              {"regression",
               {{"coefficients_um", list_of(r.raw_coefficients())},
                {"mean", list_of(r.mean)},
                {"scale", list_of(r.scale)},
                {"penalty", r.penalty},
                {"memory_s", r.noise.memory_s},
                {"nugget", r.noise.nugget},
                {"sigma_um", r.sigma_um},
                {"covariance", packed(r.covariance)}}}};
  if (model.is_static()) out["terms"] = terms_json(model.table[e].terms);
  return out;
}

json features_json(const Model& model) {
  json list = json::array();
  for (std::size_t f = 0; f < model.features.size(); ++f) {
    const FeatureSpec& s = model.features[f];
    list.push_back({{"channel", s.channel},
                    {"time_constant_s", s.time_constant_s},
                    {"power", s.power},
                    {"unit", s.unit},
                    {"temperature", s.temperature},
                    {"noise", model.noise_C[f]},
                    {"reference", model.reference_C[f]}});
  }
  return list;
}

json table_json(const Model& model) {
  json list = json::array();
  for (const auto& t : model.table) {
    list.push_back({{"error", t.error},
                    {"offset_um", t.offset_um},
                    {"terms", terms_json(t.terms)},
                    {"fit", figures_json(t.fit)},
                    {"held_out", figures_json(t.held_out)}});
  }
  return list;
}

json candidates_json(const Model& model) {
  json list = json::array();
  for (const auto& c : model.candidates) {
    list.push_back({{"label", c.label},
                    {"method", name_of(c.method)},
                    {"sensors", c.sensors},
                    {"held_out_rms_um", c.held_out_rms_um},
                    {"held_out_peak_um", c.held_out_peak_um},
                    {"noise_um", c.noise_um},
                    {"runs_on_controller", c.runs_on_controller},
                    {"chosen", c.chosen}});
  }
  return list;
}

// ---- reading ----

ResidualFigures figures_from(JsonObject& o) {
  ResidualFigures f;
  f.rms_um = o.number("rms_um", not_negative);
  f.peak_um = o.number("peak_um", not_negative);
  f.removed_percent = o.number("removed_percent");
  f.p90_um = o.number_or("p90_um", std::numeric_limits<double>::quiet_NaN(), not_negative);
  f.count = o.integer("count", 0, 2000000000);
  return f;
}

std::vector<StaticTerm> terms_from(JsonObject& o) {
  std::vector<StaticTerm> terms;
  for (JsonObject& t : o.objects("terms")) {
    terms.push_back({t.text("sensor"), t.number("um_per_K"), t.number("reference_C")});
  }
  return terms;
}

Eigen::VectorXd vector_from(JsonObject& o, std::string_view key, std::size_t count) {
  const std::vector<double> v = o.numbers(key, count);
  return Eigen::Map<const Eigen::VectorXd>(v.data(), static_cast<Eigen::Index>(v.size()));
}

Eigen::MatrixXd matrix_from(JsonObject& o, std::string_view key, std::size_t size) {
  const std::vector<double> v = o.numbers(key, size * (size + 1) / 2);
  Eigen::MatrixXd m(static_cast<Eigen::Index>(size), static_cast<Eigen::Index>(size));
  std::size_t k = 0;
  for (Eigen::Index i = 0; i < m.rows(); ++i) {
    for (Eigen::Index j = 0; j <= i; ++j) m(i, j) = m(j, i) = v[k++];
  }
  return m;
}

RidgeFit regression_from(JsonObject& o, double intercept_um, std::size_t features) {
  RidgeFit r;
  r.mean = vector_from(o, "mean", features);
  r.scale = vector_from(o, "scale", features);
  for (const double s : r.scale) {
    if (!(s > 0.0)) o.reject("scale", std::to_string(s), "numbers above 0");
  }
  r.beta = vector_from(o, "coefficients_um", features).cwiseProduct(r.scale);
  r.intercept = intercept_um + r.raw_coefficients().dot(r.mean);
  r.penalty = o.number("penalty", not_negative);
  r.noise.memory_s = o.number("memory_s", not_negative);
  r.noise.nugget = o.number("nugget", not_negative);
  r.sigma_um = o.number("sigma_um", not_negative);
  r.covariance = matrix_from(o, "covariance", features);
  return r;
}

ErrorModel error_from(JsonObject& o, std::size_t features) {
  ErrorModel m;
  m.error = o.text("error");
  m.fit = figures_from(o.object("fit"));
  m.held_out = figures_from(o.object("held_out"));
  JsonObject& band = o.object("band");
  m.band.half_width_um = band.number("half_width_um", not_negative);
  m.band.stated_coverage = band.number("stated_coverage", not_negative);
  m.band.guaranteed_coverage = band.number_or("guaranteed_coverage", 0.0, not_negative);
  m.band.measured_coverage = band.number_or("measured_coverage", 0.0, not_negative);
  m.band.factor = band.number("factor", not_negative);
  m.remembered_um = o.number_or("remembered_um", 0.0);
  m.regression = regression_from(o.object("regression"), o.number("intercept_um"), features);
  o.raw("terms");
  return m;
}

void features_from(JsonObject& o, Model& model) {
  for (JsonObject& f : o.objects("features")) {
    FeatureSpec spec;
    spec.channel = f.text("channel");
    spec.time_constant_s = f.number("time_constant_s", not_negative);
    spec.power = f.integer("power", 1, 4);
    spec.unit = f.number("unit", positive);
    spec.temperature = f.flag_or("temperature", false);
    model.reference_C.push_back(f.number("reference"));
    model.noise_C.push_back(f.number_or("noise", 0.0, not_negative));
    model.features.push_back(std::move(spec));
  }
}

void domain_from(JsonObject& o, Domain& domain, std::size_t sensors) {
  domain.channels = o.texts_or_empty("channels");
  domain.low = o.numbers("low", domain.channels.size());
  domain.high = o.numbers("high", domain.channels.size());
  domain.mean = vector_from(o, "mean", sensors);
  domain.inverse = matrix_from(o, "inverse", sensors);
  domain.limit = o.number("limit", positive);
}

void training_from(JsonObject& o, Model& model) {
  model.start_time_s = o.number("start_time_s");
  model.end.time_s = o.number("end_time_s");
  model.start_C = o.numbers("start_C", model.sensors.size());
  model.end_C = o.numbers("end_C", model.sensors.size());
  model.end.filtered = o.numbers("filtered", model.features.size());
  model.end.driving = o.numbers("driving", model.features.size());
}

void candidates_from(JsonObject& o, Model& model) {
  for (JsonObject& c : o.objects_or_empty("candidates")) {
    Candidate candidate;
    candidate.label = c.text("label");
    if (auto m = method_from(c.text("method"))) candidate.method = *m;
    candidate.sensors = c.texts_or_empty("sensors");
    candidate.held_out_rms_um = c.number("held_out_rms_um", not_negative);
    candidate.held_out_peak_um = c.number("held_out_peak_um", not_negative);
    candidate.noise_um = c.number_or("noise_um", 0.0, not_negative);
    candidate.runs_on_controller = c.flag_or("runs_on_controller", false);
    candidate.chosen = c.flag_or("chosen", false);
    model.candidates.push_back(std::move(candidate));
  }
}

void quality_from(JsonObject& o, RunQuality& q) {
  q.rise_K = o.number("rise_K");
  q.error_range_um = o.number("error_range_um", not_negative);
  q.cycles = o.integer("cycles", 0, 1000000);
  q.condition_number = o.number("condition_number", not_negative);
  q.advice = o.texts_or_empty("advice");
}

Model model_from(JsonObject& o) {
  Model model;
  o.word("format", {format_name});
  if (auto m = method_from(
          o.word("method", {"mlr", "ridge", "pcr", "lasso", "robust", "dynamic", "arx", "greybox", "physics"})))
    model.method = *m;
  if (auto m = method_from(o.text_or("asked", "auto"))) model.asked = *m;
  model.reason = o.text_or("reason", "");
  model.held_out = o.text_or("held_out", "");
  model.recordings = o.texts_or_empty("recordings");
  model.sensors = o.texts_or_empty("sensors");
  features_from(o, model);
  if (const json* averaged = o.raw("averaged")) {
    for (const auto& count : *averaged) {
      if (count.is_number_unsigned() && count > 0U && count.get<std::size_t>() <= model.sensors.size()) {
        model.averaged.push_back(count.get<std::size_t>());
      }
    }
  }
  for (JsonObject& e : o.objects("errors")) model.errors.push_back(error_from(e, model.features.size()));
  for (JsonObject& t : o.objects("table")) {
    TableTerms terms;
    terms.error = t.text("error");
    terms.offset_um = t.number("offset_um");
    terms.terms = terms_from(t);
    terms.fit = figures_from(t.object("fit"));
    terms.held_out = figures_from(t.object("held_out"));
    model.table.push_back(std::move(terms));
  }
  model.table_lost_percent = o.number_or("table_lost_percent", 0.0);
  domain_from(o.object("domain"), model.domain, model.sensors.size());
  training_from(o.object("training"), model);
  candidates_from(o, model);
  if (JsonObject* quality = o.object_if("quality")) quality_from(*quality, model.quality);
  for (const char* known : {"valid", "findings", "runs_on_controller"}) o.raw(known);
  if (const json* machine = o.raw("machine")) model.machine = machine->dump();
  return model;
}

}  // namespace

nlohmann::json to_json(const Model& model) {
  json errors = json::array();
  for (std::size_t e = 0; e < model.errors.size(); ++e) errors.push_back(error_json(model, e));
  json valid = json::object();
  for (std::size_t s = 0; s < model.sensors.size(); ++s) {
    valid[model.sensors[s]] = {model.domain.low[s], model.domain.high[s]};
  }
  json out = {{"format", format_name},
              {"method", name_of(model.method)},
              {"asked", name_of(model.asked)},
              {"reason", model.reason},
              {"held_out", model.held_out},
              {"recordings", model.recordings},
              {"sensors", model.sensors},
              {"averaged", model.averaged},
              {"runs_on_controller", model.is_static()},
              {"errors", std::move(errors)},
              {"features", features_json(model)},
              {"table", table_json(model)},
              {"table_lost_percent", model.table_lost_percent},
              {"valid", std::move(valid)},
              {"domain",
               {{"channels", model.domain.channels},
                {"low", model.domain.low},
                {"high", model.domain.high},
                {"mean", list_of(model.domain.mean)},
                {"inverse", packed(model.domain.inverse)},
                {"limit", model.domain.limit}}},
              {"candidates", candidates_json(model)},
              {"quality",
               {{"rise_K", model.quality.rise_K},
                {"error_range_um", model.quality.error_range_um},
                {"cycles", model.quality.cycles},
                {"condition_number", model.quality.condition_number},
                {"advice", model.quality.advice}}},
              {"findings", to_json(model.findings)},
              {"training",
               {{"start_time_s", model.start_time_s},
                {"end_time_s", model.end.time_s},
                {"start_C", model.start_C},
                {"end_C", model.end_C},
                {"filtered", model.end.filtered},
                {"driving", model.end.driving}}}};
  if (!model.machine.empty()) out["machine"] = json::parse(model.machine);
  return out;
}

Result<Model> model_from_json(const nlohmann::json& document, const std::string& file,
                              std::vector<std::string>* warnings) {
  return from_json<Model>(document, file, warnings, model_from);
}

Result<Model> read_model(const std::filesystem::path& path, std::vector<std::string>* warnings) {
  ZD_TRY(const json document, read_json_file(path));
  return model_from_json(document, path.string(), warnings);
}

}  // namespace zerodrift::analysis
