// Draws concealed cases, diagnoses them, opens the answers and prints the table of the proof.
//   proof [--cases N] [--seed S] [--kind K] [--strength raw|shown|left] [--verbose] [--oracle] [--write DIR]
#include "app/proof/score.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "app/proof/oracle.h"
#include "core/base/json.h"
#include "core/diagnosis/diagnosis.h"
#include "core/recording/csv.h"
#include "tests/proof/case_generator.h"

namespace {

using zerodrift::proof::Case;
using zerodrift::proof::OpenedAnswer;

/// Rms of the noise alone; spikes are no noise.
double noise_between(const std::vector<double>& clean, const std::vector<double>& noisy) {
  constexpr double spike = 2.0;
  double sum = 0;
  int n = 0;
  for (std::size_t k = 0; k < clean.size(); ++k) {
    if (std::isfinite(noisy[k]) && std::abs(clean[k] - noisy[k]) < spike)
      sum += (clean[k] - noisy[k]) * (clean[k] - noisy[k]), ++n;
  }
  return std::sqrt(sum / std::max(1, n));
}

OpenedAnswer truth_of(const Case& one) {
  OpenedAnswer truth;
  truth.name = one.name;
  truth.worst_channel = one.worst_channel;
  for (const auto& hidden : one.hidden) {
    truth.unlisted = truth.unlisted || hidden.id.rfind("unlisted", 0) == 0;
    truth.effects.push_back({hidden.id, {}, hidden.channel, hidden.law});
    if (hidden.position_mm >= 0) truth.effects.back().position_mm = hidden.position_mm;
  }
  for (const auto& channel : one.clean[1].channels) {
    if (channel.kind() != zerodrift::recording::ChannelKind::temperature &&
        channel.kind() != zerodrift::recording::ChannelKind::error)
      continue;
    truth.floor[channel.name] = noise_between(channel.values, one.recordings[1].find(channel.name)->values);
  }
  return truth;
}

/// Of a case that went wrong: how much evidence each hidden effect has for one who knows it.
bool decidable(const zerodrift::physics::Machine& machine, const Case& one) {
  const auto truth = zerodrift::proof::told_the_truth(machine, one.recordings, truth_of(one).effects);
  std::string text;
  bool all = truth.beside.size() == one.hidden.size();
  for (const auto& [id, evidence] : truth.beside) {
    text += fmt::format(" {} {:.1f}", id, evidence);
    all = all && evidence > 10.0;
  }
  fmt::print("  told the truth: {:.1f} over none;{}{}\n", truth.evidence, text, all ? "" : " (undecidable)");
  return all;
}

}  // namespace

int main(int argc, char** argv) {
  int cases = 40;
  std::uint64_t seed = 1;
  std::string kind;
  zerodrift::proof::StrengthRule rule = zerodrift::proof::StrengthRule::raw;
  bool verbose = false;
  bool oracle = false;
  int undecidable = 0, undecidable_pairs = 0;
  std::string folder;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    if (a == "--cases" && i + 1 < argc) cases = std::atoi(argv[++i]);
    if (a == "--seed" && i + 1 < argc) seed = std::strtoull(argv[++i], nullptr, 10);
    if (a == "--kind" && i + 1 < argc) kind = argv[++i];
    if (a == "--strength" && i + 1 < argc) rule = zerodrift::proof::strength_rule_from(argv[++i]).value_or(rule);
    if (a == "--verbose") verbose = true;
    if (a == "--oracle") oracle = true;
    if (a == "--write" && i + 1 < argc) folder = argv[++i];
  }
  zerodrift::proof::Score score;
  for (int i = 0; i < cases; ++i) {
    const Case one = zerodrift::proof::make_case(seed + static_cast<std::uint64_t>(i), kind, rule);
    auto machine = zerodrift::physics::machine_from_json(one.machine, one.name);
    if (!machine) {
      fmt::print("{}: {}\n", one.name, zerodrift::describe(machine.error()));
      continue;
    }
    if (!folder.empty()) {
      static_cast<void>(zerodrift::write_json_file(folder + "/" + one.name + ".json", one.machine));
      for (const auto& r : one.recordings) {
        static_cast<void>(zerodrift::recording::write_recording(folder + "/" + r.name + ".csv", r));
      }
    }
    const auto d = zerodrift::diagnosis::diagnose(*machine, one.recordings, {false});
    if (!d) {
      fmt::print("{}: {}\n", one.name, zerodrift::describe(d.error()));
      score.add_failure(truth_of(one), "refused");
      continue;
    }
    OpenedAnswer truth = truth_of(one);
    if (!truth.unlisted) {
      const auto told = zerodrift::proof::told_the_truth(*machine, one.recordings, truth.effects);
      truth.reached = told.reached;
      truth.told_place_sigma_mm = told.place_sigma_mm;
      for (const auto& [id, evidence] : told.beside) truth.told = std::min(truth.told.value_or(evidence), evidence);
    }
    const auto judged = score.add(truth, zerodrift::diagnosis::to_json(*d));
    const bool wrong = judged.outcome != zerodrift::proof::Outcome::right && !one.hidden.empty();
    if (oracle && wrong && !truth.unlisted && !decidable(*machine, one)) {
      ++undecidable;
      if (one.hidden.size() == 2) ++undecidable_pairs;
    }
    if (!verbose) continue;
    std::string hides;
    for (const auto& h : one.hidden) {
      hides += h.id + (h.channel.empty() ? "" : "(" + h.channel + ")") +
               (h.position_mm >= 0 ? fmt::format("@{:.0f}", h.position_mm) : "") + " ";
    }
    std::string says;
    for (const auto& e : d->effects) {
      says += fmt::format("{}{}{} [{:.2f}, {:.0f}] ", e.id, e.channel.empty() ? "" : "(" + e.channel + ")",
                          e.position_mm ? fmt::format("@{:.0f}+-{:.0f}", *e.position_mm, e.position_sigma_mm) : "",
                          e.confidence, e.log_evidence_gain);
    }
    double in = 0, held = 0, rise = 0;
    int channels = 0;
    for (const auto& c : d->channels) {
      if (!c.temperature) continue;
      in += c.rms_explained;
      held += d->held_out[0].explained.at(c.channel);
      rise = std::max(rise, *std::max_element(c.explained.begin(), c.explained.end()) - c.explained.front());
      ++channels;
    }
    std::string rivals = fmt::format("rise {:.0f} K in {:.3f} held {:.3f} | ", rise, in / channels, held / channels);
    for (const auto& r : d->ambiguous_with) rivals += fmt::format("{}({:.1f}) ", r.id, r.behind);
    fmt::print("{:5} {:<40} -> {:<14} {:<50} a {:.2f}->{:.2f} ch {} ({}) {:.1f} s | {}\n",
               seed + static_cast<std::uint64_t>(i), one.hidden.empty() ? "none" : hides,
               std::string(name_of(d->verdict)), says, d->excess_before, d->excess_after,
               d->mismatch.channels.empty() ? "-" : d->mismatch.channels[0], one.worst_channel, d->seconds, rivals);
    std::fflush(stdout);
  }
  fmt::print("seed {}, strength {}\n{}", seed, zerodrift::proof::name_of(rule), score.text());
  if (oracle) {
    fmt::print("of those not right, undecidable even when told: {}, pairs among them {}\n", undecidable,
               undecidable_pairs);
  }
  return 0;
}
