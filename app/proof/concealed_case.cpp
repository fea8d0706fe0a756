#include "app/proof/concealed_case.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/machine/description.h"
#include "core/base/json.h"
#include "core/base/noise.h"
#include "core/recording/csv.h"

namespace zerodrift::proof {
namespace {

using machine::CaseOptions;
using machine::HiddenEffect;
using machine::HiddenEffects;
using nlohmann::json;
using recording::Recording;

constexpr double least_strength = 2.5;
constexpr double temperature_noise_K = 0.102;  // 0.1 C white and steps of 1/16 C
constexpr double displacement_noise_um = 0.2;
constexpr double no_film_W_m2K = 0.45;  // a machine without convection: what bright metal radiates

double noise_of(const std::string& channel) {
  return channel.front() == 'T' ? temperature_noise_K : displacement_noise_um;
}

bool is_judged(const recording::Channel& channel) {
  const auto kind = channel.kind();
  return kind == recording::ChannelKind::temperature || kind == recording::ChannelKind::error;
}

/// Everything but the effect `id`; the convection that a description lacks is in every machine, so it shrinks instead.
HiddenEffects without(const HiddenEffects& hidden, const std::string& id) {
  std::vector<HiddenEffect> rest;
  for (HiddenEffect effect : hidden.list()) {
    if (effect.id == id && id != "convection") continue;
    if (effect.id == id) effect.size = no_film_W_m2K;
    rest.push_back(std::move(effect));
  }
  return HiddenEffects(std::move(rest));
}

/// The channel that changes most between two noise-free recordings, and by how many noise widths (rms).
std::pair<std::string, double> largest_change(const Recording& a, const Recording& b) {
  std::pair<std::string, double> largest{"", 0.0};
  for (const auto& channel : a.channels) {
    if (!is_judged(channel)) continue;
    const auto& other = b.find(channel.name)->values;
    double sum = 0.0;
    for (std::size_t k = 0; k < other.size(); ++k) sum += std::pow(channel.values[k] - other[k], 2);
    const double widths = std::sqrt(sum / static_cast<double>(other.size())) / noise_of(channel.name);
    if (widths > largest.second) largest = {channel.name, widths};
  }
  return largest;
}

std::vector<std::string> ids_of(const std::string& kind, Noise& noise) {
  const auto listed = machine::concealable_effects();
  const auto odd = machine::unlisted_effects();
  const auto any = [&noise](auto table) { return std::string(table[noise.index(table.size())].id); };
  if (kind == "none") return {};
  if (kind == "unlisted") return {any(odd)};
  if (kind == "single") return {any(listed)};
  if (kind != "pair") return {kind};
  // Convection is left out of pairs: beside it everything else is small.
  std::vector<std::string> pair;
  while (pair.size() < 2) {
    const std::string id = any(listed);
    const bool sensor = id.rfind("sensor", 0) == 0;
    const bool clash = !pair.empty() && (pair[0] == id || (sensor && pair[0].rfind("sensor", 0) == 0));
    if (id != "convection" && !clash) pair.push_back(id);
  }
  return pair;
}

std::string drawn_kind(Noise& noise) {
  const double draw = noise.uniform();
  return draw < 0.15 ? "none" : draw < 0.27 ? "pair" : draw < 0.36 ? "unlisted" : "single";
}

/// Draws sizes until each effect shows; false when this machine's run cannot show them.
bool hide_effects(ConcealedCase& one, const std::vector<std::string>& ids, Noise& noise) {
  CaseOptions clean = one.run;
  clean.noisy = false;
  constexpr int attempts = 8;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    std::vector<HiddenEffect> drawn;
    for (const auto& id : ids) {
      HiddenEffect effect = *machine::draw_effect(id, noise.index(1ULL << 40U));
      // Sizes from below what the tables call typical, growing until the effect shows.
      if (!effect.is("convection")) effect.size *= std::exp(noise.uniform(-0.7, 0.3)) * (1.0 + 0.2 * attempt);
      if (effect.is("radiation")) effect.size = std::min(effect.size, 1.0);
      drawn.push_back(std::move(effect));
    }
    one.hidden = HiddenEffects(std::move(drawn));
    const Recording with = record_case(one.hidden, one.machine_seed, clean);
    double weakest = 1e300;
    HiddenEffects bare = one.hidden;
    for (const auto& id : ids) {
      const Recording other = record_case(without(one.hidden, id), one.machine_seed, clean);
      weakest = std::min(weakest, largest_change(with, other).second);
      bare = without(bare, id);
    }
    if (weakest < least_strength) continue;
    std::tie(one.truth.worst_channel, one.truth.strength) =
        largest_change(with, record_case(bare, one.machine_seed, clean));
    one.truth.strength = std::min(one.truth.strength, weakest);
    return true;
  }
  return false;
}

/// Rms of the sensors' noise in the second recording: the floor under every prediction.
void set_floor(ConcealedCase& one) {
  const Recording noisy = record_case(one.hidden, one.machine_seed, {.second = true});
  const Recording clean = record_case(one.hidden, one.machine_seed, {.second = true, .noisy = false});
  for (const auto& channel : clean.channels) {
    if (!is_judged(channel)) continue;
    const auto& seen = noisy.find(channel.name)->values;
    double sum = 0.0;
    for (std::size_t k = 0; k < seen.size(); ++k) sum += std::pow(channel.values[k] - seen[k], 2);
    one.truth.floor[channel.name] = std::sqrt(sum / static_cast<double>(seen.size()));
  }
}

void close_seal(ConcealedCase& one) {
  json answer = {{"case", one.name},
                 {"machine_seed", one.machine_seed},
                 {"hidden", machine::to_json(one.hidden)},
                 {"effects", json::array()},
                 {"unlisted", one.truth.unlisted},
                 {"one_speed", one.run.one_speed},
                 {"worst_channel", one.truth.worst_channel},
                 {"strength", one.truth.strength},
                 {"floor", one.truth.floor}};
  for (const auto& effect : one.truth.effects) {
    answer["effects"].push_back({{"id", effect.id},
                                 {"position_mm", effect.position_mm ? json(*effect.position_mm) : json()},
                                 {"channel", effect.channel},
                                 {"law", effect.law}});
  }
  one.seal = machine::seal(json_text(answer));
}

/// The parameters with which an effect was hidden.
json sizes_of(const json& answer, const std::string& id) {
  const json hidden = answer.value("hidden", json::object());
  const json list = hidden.contains("effects") ? hidden.at("effects") : json::array({hidden});
  for (const auto& effect : list) {
    if (effect.value("id", "") == id) return effect.value("parameters", json::object());
  }
  return json::object();
}

/// Lost samples and spikes as a real logger has them, in three cases of ten.
void spoil(Recording& recording, Noise noise) {
  if (noise.uniform() > 0.3) return;
  for (auto& channel : recording.channels) {
    if (channel.kind() != recording::ChannelKind::temperature) continue;
    for (double& value : channel.values) {
      if (noise.uniform() < 5e-4) value += noise.uniform(3.0, 9.0);
      if (noise.uniform() < 2e-3) value = std::nan("");
    }
  }
}

}  // namespace

ConcealedCase draw_case(std::uint64_t seed, int index) {
  Noise noise(seed * 1000003ULL + static_cast<std::uint64_t>(index) * 7919ULL + 29);
  const std::string kind = drawn_kind(noise);
  return draw_case(seed, index, kind, noise.uniform() < 0.06);
}

ConcealedCase draw_case(std::uint64_t seed, int index, const std::string& kind, bool one_speed) {
  Noise noise(seed * 998244353ULL + static_cast<std::uint64_t>(index) * 104729ULL + 71);
  ConcealedCase one;
  one.name = fmt::format("case-{:03}", index + 1);
  // One speed without coolant cannot show every effect: then another is drawn, at last with a richer run.
  constexpr int draws = 20;
  for (int draw = 0;; ++draw) {
    one.machine_seed = 1 + noise.index(1ULL << 20U);
    one.run.one_speed = one_speed && draw < draws;
    const auto ids = ids_of(kind, noise);
    if (ids.empty() || hide_effects(one, ids, noise)) break;
  }
  for (const HiddenEffect& effect : one.hidden.list()) {
    TrueEffect known{effect.id, std::nullopt, "", effect.law};
    if (effect.position_mm > 0.0) known.position_mm = effect.position_mm;
    if (effect.sensor > 0) known.channel = fmt::format("T{}_C", effect.sensor);
    one.truth.unlisted = one.truth.unlisted || effect.id.rfind("unlisted:", 0) == 0;
    one.truth.effects.push_back(std::move(known));
  }
  one.truth.name = one.name;
  set_floor(one);
  close_seal(one);
  return one;
}

Recording recording_of(const ConcealedCase& one, const CaseOptions& run) {
  Recording recording = record_case(one.hidden, one.machine_seed, run);
  spoil(recording, Noise(one.machine_seed * 31ULL + (run.second ? 1 : 0)));
  return recording;
}

Status write_case_files(const ConcealedCase& one, const std::filesystem::path& folder) {
  std::error_code failed;
  std::filesystem::create_directories(folder, failed);
  if (failed) {
    return fail(ErrorCode::file_not_writable, {{"file", folder.string()}, {"detail", failed.message()}});
  }
  ZD_CHECK(write_json_file(folder / "machine.json", machine::machine_description(one.hidden)));
  ZD_CHECK(recording::write_recording(folder / "recording.csv", recording_of(one, one.run)));
  return recording::write_recording(folder / "second.csv", recording_of(one, {.second = true}));
}

Result<OpenedAnswer> truth_from(const std::string& sealed_text, const std::string& file) {
  ZD_TRY(const json answer, parse_json(sealed_text, file));
  OpenedAnswer truth;
  truth.name = answer.at("case");
  truth.unlisted = answer.at("unlisted");
  truth.worst_channel = answer.at("worst_channel");
  truth.strength = answer.at("strength");
  truth.floor = answer.at("floor").get<std::map<std::string, double>>();
  for (const auto& effect : answer.at("effects")) {
    TrueEffect known{effect.at("id"), std::nullopt, effect.at("channel"), effect.at("law")};
    if (effect.at("position_mm").is_number()) known.position_mm = effect.at("position_mm").get<double>();
    const json sizes = sizes_of(answer, known.id);
    for (const auto& [name, value] : sizes.items()) {
      if (value.is_number()) known.sizes[name] = value.get<double>();
    }
    truth.effects.push_back(std::move(known));
  }
  return truth;
}

}  // namespace zerodrift::proof
