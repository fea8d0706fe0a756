// Draws concealed cases, diagnoses them, opens the answers and prints the table of the proof.
//   proof [--cases N] [--seed S] [--kind K] [--verbose] [--write DIR]
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <set>

#include "core/base/json.h"
#include "core/diagnosis/diagnosis.h"
#include "core/recording/csv.h"
#include "tests/proof/case_generator.h"

namespace {

using zerodrift::diagnosis::Diagnosis;
using zerodrift::diagnosis::Verdict;
using zerodrift::proof::Case;

struct Tally {
  int good = 0, all = 0;
  void add(bool ok) { good += ok ? 1 : 0, ++all; }
  std::string text() const { return fmt::format("{}/{} ({:.2f})", good, all, all > 0 ? double(good) / all : 0.0); }
};

double median(std::vector<double> v) {
  if (v.empty()) return 0;
  std::sort(v.begin(), v.end());
  return v[v.size() / 2];
}

double rms_of(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  int n = 0;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (std::isfinite(a[k]) && std::isfinite(b[k]) && std::abs(a[k] - b[k]) < 3.0 + 20.0)
      sum += (a[k] - b[k]) * (a[k] - b[k]), ++n;
  }
  return std::sqrt(sum / std::max(1, n));
}

struct Score {
  Tally named, all_right, pairs, quiet, missed, unlisted, channel;
  std::vector<double> location, seconds, held_T, held_Z, held_Y, floor_T, floor_Z, floor_Y;
  std::vector<std::pair<double, bool>> confidence;
  std::map<std::string, std::map<std::string, int>> confusion;
};

std::string answer_of(const Diagnosis& d) {
  if (d.verdict == Verdict::consistent) return "consistent";
  std::string text = d.verdict == Verdict::unexplained ? "unexplained" : "";
  if (d.verdict == Verdict::missing_effect) {
    for (const auto& e : d.effects) text += (text.empty() ? "" : "+") + e.id;
  }
  return text;
}

void count(Score& score, const Case& one, const Diagnosis& d) {
  std::set<std::string> truth, answer;
  for (const auto& h : one.hidden) truth.insert(h.id);
  for (const auto& e : d.effects) answer.insert(e.id);
  const bool none = one.hidden.empty();
  const bool odd = !none && one.hidden[0].id.rfind("unlisted", 0) == 0;
  std::string truth_text = none ? "none" : "";
  for (const auto& h : one.hidden) truth_text += (truth_text.empty() ? "" : "+") + h.id;
  ++score.confusion[truth_text][answer_of(d)];
  score.seconds.push_back(d.seconds);
  if (none) {
    score.quiet.add(d.verdict == Verdict::consistent);
    score.named.add(d.verdict == Verdict::consistent);
    score.all_right.add(d.verdict == Verdict::consistent);
  } else if (odd) {
    score.unlisted.add(d.verdict == Verdict::unexplained);
    score.named.add(d.verdict == Verdict::unexplained);
    score.all_right.add(d.verdict == Verdict::unexplained);
  } else {
    const bool says = d.verdict == Verdict::missing_effect && !d.effects.empty();
    const bool top = says && truth.count(d.effects[0].id) != 0;
    score.named.add(top);
    score.all_right.add(says && answer == truth);
    score.missed.add(d.verdict == Verdict::consistent);
    if (one.hidden.size() == 2) score.pairs.add(says && answer == truth);
    if (says) score.confidence.emplace_back(d.effects[0].confidence, top);
    for (const auto& h : one.hidden) {
      for (const auto& e : d.effects) {
        if (e.id == h.id && h.position_mm >= 0 && e.position_mm)
          score.location.push_back(std::abs(*e.position_mm - h.position_mm));
      }
    }
  }
  if (!none && d.verdict != Verdict::consistent) {
    score.channel.add(!d.mismatch.channels.empty() && d.mismatch.channels[0] == one.worst_channel);
  }
  if (d.held_out.empty() || odd) return;
  for (const auto& [channel, rms] : d.held_out[0].explained) {
    const auto* clean = one.clean[1].find(channel);
    const auto* noisy = one.recordings[1].find(channel);
    const double floor = rms_of(clean->values, noisy->values);
    (channel[0] == 'T' ? score.held_T : channel == "dZ_um" ? score.held_Z : score.held_Y).push_back(rms);
    (channel[0] == 'T' ? score.floor_T : channel == "dZ_um" ? score.floor_Z : score.floor_Y).push_back(floor);
  }
}

double expected_calibration_error(const std::vector<std::pair<double, bool>>& list) {
  double sum = 0;
  for (int bin = 0; bin < 5; ++bin) {
    double confidence = 0, right = 0;
    int n = 0;
    for (const auto& [c, ok] : list) {
      if (std::min(4, static_cast<int>(c * 5)) != bin) continue;
      confidence += c;
      right += ok ? 1 : 0;
      ++n;
    }
    if (n > 0) sum += std::abs(confidence - right);
  }
  return list.empty() ? 0 : sum / static_cast<double>(list.size());
}

}  // namespace

int main(int argc, char** argv) {
  int cases = 40;
  std::uint64_t seed = 1;
  std::string kind;
  bool verbose = false;
  std::string folder;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    if (a == "--cases" && i + 1 < argc) cases = std::atoi(argv[++i]);
    if (a == "--seed" && i + 1 < argc) seed = std::strtoull(argv[++i], nullptr, 10);
    if (a == "--kind" && i + 1 < argc) kind = argv[++i];
    if (a == "--verbose") verbose = true;
    if (a == "--write" && i + 1 < argc) folder = argv[++i];
  }
  Score score;
  for (int i = 0; i < cases; ++i) {
    const Case one = zerodrift::proof::make_case(seed + static_cast<std::uint64_t>(i), kind);
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
      continue;
    }
    count(score, one, *d);
    if (!verbose) continue;
    std::string truth;
    for (const auto& h : one.hidden) {
      truth += h.id + (h.channel.empty() ? "" : "(" + h.channel + ")") +
               (h.position_mm >= 0 ? fmt::format("@{:.0f}", h.position_mm) : "") + " ";
    }
    std::string says;
    for (const auto& e : d->effects) {
      says +=
          fmt::format("{}{}{} [{:.2f}, {:.0f}] ", e.id, e.channel.empty() ? "" : "(" + e.channel + ")",
                      e.position_mm ? fmt::format("@{:.0f}", *e.position_mm) : "", e.confidence, e.log_evidence_gain);
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
    fmt::print("{:5} {:<40} -> {:<14} {:<50} a {:.2f}->{:.2f} f{} ch {} ({}) {:.1f} s | {}\n",
               seed + static_cast<std::uint64_t>(i), one.hidden.empty() ? "none" : truth,
               std::string(name_of(d->verdict)), says, d->excess_before, d->excess_after, d->drift_factor,
               d->mismatch.channels.empty() ? "-" : d->mismatch.channels[0], one.worst_channel, d->seconds, rivals);
    std::fflush(stdout);
  }
  fmt::print("cases {} from seed {}\n", cases, seed);
  fmt::print("named right (top-1)         {}\nall effects right           {}\ntwo effects, both named     {}\n",
             score.named.text(), score.all_right.text(), score.pairs.text());
  fmt::print(
      "quiet when nothing missing  {}\ncalled consistent           {}\nunlisted called unexplained {}\nworst channel "
      "named         {}\n",
      score.quiet.text(), score.missed.text(), score.unlisted.text(), score.channel.text());
  fmt::print("location median {:.1f}, worst {:.1f} mm ({})\n", median(score.location),
             score.location.empty() ? 0 : *std::max_element(score.location.begin(), score.location.end()),
             score.location.size());
  fmt::print("held-out T {:.3f} (noise {:.3f}) dZ {:.2f} ({:.2f}) dY {:.2f} ({:.2f})\n", median(score.held_T),
             median(score.floor_T), median(score.held_Z), median(score.floor_Z), median(score.held_Y),
             median(score.floor_Y));
  fmt::print("confidence: expected calibration error {:.3f}; seconds median {:.2f}\n",
             expected_calibration_error(score.confidence), median(score.seconds));
  for (const auto& [truth, answers] : score.confusion) {
    fmt::print("  {:<44}", truth);
    for (const auto& [answer, n] : answers) fmt::print(" {} x{}", answer, n);
    fmt::print("\n");
  }
  return 0;
}
