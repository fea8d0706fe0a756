#include "app/proof/concealed_case.h"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/machine/description.h"
#include "app/machine/parameters.h"
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

/// The judged readings in noise widths; a displacement against its own mean, for nobody knows where a nest's zero was.
Eigen::MatrixXd in_noise_widths(const Recording& recording) {
  std::vector<Eigen::VectorXd> columns;
  for (const auto& channel : recording.channels) {
    if (!is_judged(channel)) continue;
    const auto rows = static_cast<Eigen::Index>(channel.values.size());
    columns.push_back(Eigen::Map<const Eigen::VectorXd>(channel.values.data(), rows) / noise_of(channel.name));
    if (channel.kind() == recording::ChannelKind::error) columns.back().array() -= columns.back().mean();
  }
  Eigen::MatrixXd out(columns.front().size(), static_cast<Eigen::Index>(columns.size()));
  for (std::size_t j = 0; j < columns.size(); ++j) out.col(static_cast<Eigen::Index>(j)) = columns[j];
  return out;
}

/// One machine under one plan without noise. What does not depend on the drawn sizes is recorded once.
class QuietMachine {
 public:
  QuietMachine(std::uint64_t seed, CaseOptions run) : m_seed(seed), m_run(std::move(run)) { m_run.noisy = false; }

  Recording record(const HiddenEffects& hidden) const { return record_case(hidden, m_seed, m_run); }
  const Recording& record_bare(const HiddenEffects& bare) {
    if (!m_bare) m_bare = record(bare);
    return *m_bare;
  }

  /// What a re-fit without one effect leaves of the recording `with` everything, in noise widths. `rest` is what else
  /// is hidden, in a pair of any size.
  double left_of(const Recording& with, const HiddenEffects& rest, const HiddenEffects& bare, bool pair) {
    const Eigen::MatrixXd none = in_noise_widths(record_bare(bare));
    if (m_slopes.size() == 0) m_slopes = sensitivities_of(rival_with(bare), ordinary, none);
    if (!pair) return largest_rms(left_after_refit(in_noise_widths(with), rival_with(rest), none, m_slopes));
    const Eigen::MatrixXd other = in_noise_widths(record(rest));
    Eigen::MatrixXd slopes(m_slopes.rows(), ordinary + 1);
    slopes << m_slopes, (other - none).reshaped();
    return largest_rms(left_after_refit(in_noise_widths(with), rival_with(rest), other, std::move(slopes)));
  }

 private:
  static constexpr int ordinary = static_cast<int>(machine::ordinary_numbers.size());

  /// z: the ordinary numbers in their tolerances; one more is the relative change of what `rest` hides.
  Rival rival_with(const HiddenEffects& rest) const {
    return [this, rest](const Eigen::VectorXd& z) {
      CaseOptions run = m_run;
      for (int i = 0; i < ordinary; ++i) {
        run.built_otherwise.push_back(z[i] * machine::ordinary_numbers[static_cast<std::size_t>(i)].tolerance);
      }
      std::vector<HiddenEffect> list = rest.list();
      for (HiddenEffect& effect : list) effect.size *= z.size() > ordinary ? std::max(0.0, 1.0 + z[ordinary]) : 1.0;
      return in_noise_widths(record_case(HiddenEffects(std::move(list)), m_seed, run));
    };
  }

  std::uint64_t m_seed;
  CaseOptions m_run;
  std::optional<Recording> m_bare;
  Eigen::MatrixXd m_slopes;  // of the machine that hides nothing
};

/// Draws sizes until each effect shows; false when this machine's run cannot show them.
bool hide_effects(ConcealedCase& one, const std::vector<std::string>& ids, StrengthRule rule, Noise& noise) {
  QuietMachine quiet(one.machine_seed, one.run);
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
    HiddenEffects bare = one.hidden;
    for (const auto& id : ids) bare = without(bare, id);
    const Recording with = quiet.record(one.hidden);
    const auto [worst_channel, all] = largest_change(with, quiet.record_bare(bare));
    double weakest = ids.size() > 1 ? 1e300 : all;
    for (const auto& id : ids) {
      if (ids.size() > 1)
        weakest = std::min(weakest, largest_change(with, quiet.record(without(one.hidden, id))).second);
    }
    if (weakest < least_strength) continue;
    double left = weakest;
    std::string hidden_by_refit;
    for (const auto& id : ids) {
      left = std::min(left, quiet.left_of(with, without(one.hidden, id), bare, ids.size() > 1));
      if (left >= least_left(rule)) continue;
      hidden_by_refit = id;
      break;
    }
    if (!hidden_by_refit.empty()) {
      one.truth.put_aside.push_back(hidden_by_refit);
      if (left < 0.2 * least_left(rule)) return false;  // no size that is usual of it makes up for that
      continue;
    }
    one.truth.worst_channel = worst_channel;
    one.truth.strength = std::min(all, weakest);
    one.truth.left = left;
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
                 {"left", one.truth.left},
                 {"put_aside", one.truth.put_aside},
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

ConcealedCase draw_case(std::uint64_t seed, int index, StrengthRule rule) {
  Noise noise(seed * 1000003ULL + static_cast<std::uint64_t>(index) * 7919ULL + 29);
  const std::string kind = drawn_kind(noise);
  return draw_case(seed, index, kind, noise.uniform() < 0.06, rule);
}

ConcealedCase draw_case(std::uint64_t seed, int index, const std::string& kind, bool one_speed, StrengthRule rule) {
  Noise noise(seed * 998244353ULL + static_cast<std::uint64_t>(index) * 104729ULL + 71);
  ConcealedCase one;
  one.name = fmt::format("case-{:03}", index + 1);
  // One speed without coolant cannot show every effect: then another is drawn, at last with a richer run.
  constexpr int draws = 20;
  for (int draw = 0;; ++draw) {
    one.machine_seed = 1 + noise.index(1ULL << 20U);
    one.run.one_speed = one_speed && draw < draws;
    const auto ids = ids_of(kind, noise);
    if (ids.empty() || hide_effects(one, ids, rule, noise)) break;
    // Asked for by its id: what a re-fit takes in on every machine is hidden by its whole change.
    if (draw == 2 && ids.front() == kind) rule = StrengthRule::raw;
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
  truth.left = answer.value("left", 0.0);
  truth.put_aside = answer.value("put_aside", std::vector<std::string>{});
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
