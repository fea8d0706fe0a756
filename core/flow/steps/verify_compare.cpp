#include "core/flow/steps/verify_compare.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace zerodrift::flow {

using nlohmann::json;

namespace {

constexpr double told_worse_um = 0.15;  // rms: less is within what the camera may be wrong by from run to run

/// Measured minus applied in this direction, where both are there; false where nothing was applied or recorded.
bool take_out_applied(recording::Recording& run, const std::string& axis) {
  auto* error = run.find("d" + axis + "_um");
  const auto* applied_nm = run.find("applied_" + axis + "_nm");
  if (error == nullptr || applied_nm == nullptr || recording::present_count(*applied_nm) == 0) return false;
  for (std::size_t r = 0; r < run.rows(); ++r) {
    if (std::isnan(error->values[r])) continue;
    error->values[r] -= 1e-3 * recording::value_at(run, *applied_nm, run.time_s[r]);
  }
  return true;
}

struct Size {
  double peak_um = 0.0;
  double squares = 0.0;
  int count = 0;

  void add(double value_um) {
    peak_um = std::max(peak_um, std::abs(value_um));
    squares += value_um * value_um;
    ++count;
  }
  double rms_um() const { return count > 0 ? std::sqrt(squares / count) : 0.0; }
};

}  // namespace

VerificationReference reference_of(const recording::Recording& verification, const recording::Recording& warmup) {
  VerificationReference reference{verification, true};
  for (const char* axis : {"X", "Y", "Z"}) {
    const auto* error = verification.find("d" + std::string(axis) + "_um");
    if (error == nullptr || recording::present_count(*error) == 0) continue;
    if (!take_out_applied(reference.without, axis)) return {warmup, false};
  }
  return reference;
}

std::vector<AxisAgainstBefore> against_before(const ResidualSamples& samples, const compensation::Table& now,
                                              const compensation::Table& before) {
  std::vector<AxisAgainstBefore> axes;
  for (const auto& [axis, measured] : samples) {
    Size size_now;
    Size size_before;
    for (const auto& sample : measured) {
      if (std::isnan(sample.residual_um)) continue;
      const auto error_of = [&sample, &axis = axis](const compensation::Table& table) -> double {
        if (!table.axes.contains(axis)) return 0.0;
        return compensation::error_um(table, axis, sample.position_mm, compensation::Approach::up, sample.temperatures)
            .value_or(std::nan(""));
      };
      // What a table says more is compensated more: left before = left now + said now - said before.
      const double left_before = sample.residual_um + error_of(now) - error_of(before);
      if (std::isnan(left_before)) continue;
      size_now.add(sample.residual_um);
      size_before.add(left_before);
    }
    if (size_now.count == 0) continue;
    const bool worse = size_now.rms_um() > size_before.rms_um() + told_worse_um;
    axes.push_back({axis, size_before.rms_um(), size_now.rms_um(), size_before.peak_um, size_now.peak_um, worse});
  }
  return axes;
}

namespace {

using Words = std::vector<std::uint16_t>;

/// The registers of every table that this job has put into the machine, by artefact.
std::map<commissioning::ArtefactId, Words> words_of(const std::vector<commissioning::Artefact>& uploads) {
  std::map<commissioning::ArtefactId, Words> words;
  for (const auto& one : uploads) {
    const auto body = one.document();
    if (body && body->contains("record")) words[one.id] = body->at("record").value("new_words", Words{});
  }
  return words;
}

/// An earlier verification that found the table of now worse than the one before it.
bool was_judged_otherwise(const commissioning::Job& job, const std::map<commissioning::ArtefactId, Words>& words,
                          commissioning::ArtefactId now, commissioning::ArtefactId before) {
  const auto same = [&](const json& id, commissioning::ArtefactId other) {
    const auto at = id.is_number_integer() ? words.find(id.get<commissioning::ArtefactId>()) : words.end();
    return at != words.end() && !at->second.empty() && at->second == words.at(other);
  };
  const auto verifications = job.history("verification");
  if (!verifications) return false;
  for (const auto& one : *verifications) {
    const auto body = one.document();
    const json judged = body ? body->value("version_before", json()) : json();
    if (!judged.is_object() || !judged.contains("uploads") || judged["uploads"].size() != 2) continue;
    const json axes = judged.value("axes", json::array());
    const bool worse =
        std::any_of(axes.begin(), axes.end(), [](const json& axis) { return axis.value("worse", false); });
    if (worse && same(judged["uploads"][0], before) && same(judged["uploads"][1], now)) return true;
  }
  return false;
}

}  // namespace

json version_before(const commissioning::Job& job, commissioning::ArtefactId upload, const ResidualSamples& samples,
                    const compensation::Table& now) {
  const auto uploads = job.history("upload");
  if (!uploads) return nullptr;
  std::optional<json> former;
  commissioning::ArtefactId former_id = 0;
  for (const auto& one : *uploads) {
    if (one.id >= upload) break;
    if (auto body = one.document()) former = std::move(*body), former_id = one.id;
  }
  if (!former || !former->contains("table")) return nullptr;
  const auto table = compensation::table_from_json(former->at("table"), "the table before");
  if (!table || table->axes.empty()) return nullptr;
  json axes = json::array();
  for (const auto& axis : against_before(samples, now, *table)) {
    axes.push_back({{"axis", axis.axis},
                    {"rms_before_um", axis.rms_before_um},
                    {"rms_now_um", axis.rms_now_um},
                    {"peak_before_um", axis.peak_before_um},
                    {"peak_now_um", axis.peak_now_um},
                    {"worse", axis.worse}});
  }
  const auto words = words_of(*uploads);
  const bool contradicted =
      words.contains(upload) && words.contains(former_id) && was_judged_otherwise(job, words, upload, former_id);
  return {{"version", former->value("version", 0)},
          {"uploads", {upload, former_id}},
          {"contradicted", contradicted},
          {"axes", std::move(axes)}};
}

std::vector<std::string> furthest_outside(const recording::Recording& run, const compensation::Table& table) {
  constexpr double beyond_noise_K = 0.5;  // a single reading beyond by less says nothing
  constexpr std::size_t most_named = 3;
  std::vector<std::pair<double, std::string>> found;
  for (const auto& [sensor, range] : table.valid) {
    const auto* channel = run.find(sensor);
    if (channel == nullptr) continue;
    double beyond_K = beyond_noise_K;
    double at_C = std::nan("");
    for (const double value_C : channel->values) {
      const double by_K = std::max(range.low_C - value_C, value_C - range.high_C);
      if (by_K > beyond_K) beyond_K = by_K, at_C = value_C;
    }
    if (std::isnan(at_C)) continue;
    for (auto& text : compensation::outside_valid_range(table, {{sensor, at_C}})) found.emplace_back(beyond_K, text);
  }
  std::sort(found.rbegin(), found.rend());
  if (found.size() > most_named) found.resize(most_named);
  std::vector<std::string> texts;
  for (auto& [beyond_K, text] : found) texts.push_back(std::move(text));
  return texts;
}

}  // namespace zerodrift::flow
