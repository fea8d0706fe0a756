#include "core/diagnosis/apart.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/diagnosis/contradiction.h"
#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/explain.h"

namespace zerodrift::diagnosis {
namespace {

using physics::Machine;

/// The part of the description that concerns one component; displacements of unknown origin stay out.
Machine part_of(const Machine& whole, const std::string& id) {
  Machine part = whole;
  std::erase_if(part.components, [&](const auto& component) { return component.id != id; });
  std::erase_if(part.sensors,
                [&](const auto& sensor) { return sensor.component != id && sensor.component != "ambient"; });
  std::erase_if(part.displacements, [&](const auto& displacement) { return displacement.component != id; });
  std::erase_if(part.effects, [&](const auto& spec) { return spec.word_or("component", id) != id; });
  return part;
}

/// By how much a part is off without what was found, in widths of noise: its worst channel.
double size_of(const Diagnosis& part) {
  double largest = 0.0;
  for (const auto& channel : part.channels)
    largest = std::max(largest, channel.rms_refitted / std::max(1e-9, channel.noise));
  return largest;
}

/// Worst part first: place, time and heat are told of the worst.
Mismatch mismatch_of(std::vector<std::pair<double, Mismatch>> parts) {
  std::erase_if(parts, [](const auto& part) { return part.second.channels.empty(); });
  std::stable_sort(parts.begin(), parts.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
  if (parts.empty()) return {};
  Mismatch all = parts.front().second;
  for (std::size_t i = 1; i < parts.size(); ++i) {
    const auto& more = parts[i].second.channels;
    all.channels.insert(all.channels.end(), more.begin(), more.end());
  }
  return all;
}

/// Channels that stay unexplained, with nothing named of their part and beside something.
struct Unexplained {
  std::vector<std::string> without, beside;
};

void merge(Diagnosis& all, Diagnosis part, std::size_t described, Unexplained& left) {
  for (std::size_t i = described; i < part.refined.effects.size(); ++i)
    all.refined.effects.push_back(part.refined.effects[i]);
  for (auto& component : all.refined.components) {
    for (const auto& fitted : part.refined.components) {
      if (fitted.id == component.id) component = fitted;
    }
  }
  if (part.verdict == Verdict::unexplained) {
    for (const auto& channel : part.mismatch.channels) {
      all.notes.push_back("unexplained:" + channel);
      (part.effects.empty() ? left.without : left.beside).push_back(channel);
    }
    for (const auto& note : part.notes) {
      if (note.starts_with("heat_falls_with_speed")) all.notes.push_back(note);
    }
  }
  for (const auto& note : part.notes) {
    const bool worse = note.starts_with("held_out_worse:");
    if (worse || note.starts_with("far_from_description:")) all.notes.push_back(note);
  }
  std::copy_if(part.sentences.begin(), part.sentences.end(), std::back_inserter(all.sentences),
               [](const Sentence& sentence) { return sentence.id.starts_with("held_out_worse"); });
  const auto append = [](auto& to, auto& from) { to.insert(to.end(), from.begin(), from.end()); };
  append(all.effects, part.effects);
  append(all.ambiguous_with, part.ambiguous_with);
  append(all.channels, part.channels);
  all.time_s = part.time_s;
  if (all.held_out.empty()) all.held_out.resize(part.held_out.size());
  for (std::size_t i = 0; i < part.held_out.size(); ++i) {
    all.held_out[i].recording = part.held_out[i].recording;
    all.held_out[i].nominal.merge(part.held_out[i].nominal);
    all.held_out[i].refitted.merge(part.held_out[i].refitted);
    all.held_out[i].explained.merge(part.held_out[i].explained);
  }
  all.excess_before = std::max(all.excess_before, part.excess_before);
  all.excess_after = std::max(all.excess_after, part.excess_after);
  all.seconds += part.seconds;
}

}  // namespace

bool falls_apart(const Machine& machine) {
  return machine.components.size() > 6 && machine.couplings.empty() &&
         std::all_of(machine.components.begin(), machine.components.end(), [](const auto& c) { return c.lump; });
}

Result<Diagnosis> diagnose_apart(const Machine& machine, const std::vector<recording::Recording>& recordings,
                                 const DiagnoseOptions& options, const TaskContext& context) {
  Diagnosis all;
  all.refined = machine;
  int unexplained = 0;
  Unexplained left;
  std::vector<std::string> assumed;
  std::vector<std::pair<double, Mismatch>> mismatches;
  for (std::size_t i = 0; i < machine.components.size(); ++i) {
    const Machine part = part_of(machine, machine.components[i].id);
    if (part.sensors.empty()) continue;
    TaskContext quiet = context;
    quiet.report = nullptr;
    DiagnoseOptions brief = options;
    brief.details = false;
    Result<Diagnosis> found = Diagnoser(part, recordings, brief, quiet).run();
    // A lump that stands for many parts misses every other run by more than its noise. Only where this run shows
    // nothing of a part is another one asked.
    if (found && found->verdict == Verdict::consistent)
      found = settled(std::move(*found), part, recordings, brief, quiet);
    ZD_TRY(Diagnosis result, std::move(found));
    unexplained += result.verdict == Verdict::unexplained ? 1 : 0;
    for (const auto& note : result.notes) {
      if (note.starts_with("capacity_unknown:")) assumed.push_back(machine.components[i].id);
    }
    mismatches.emplace_back(size_of(result), result.mismatch);
    merge(all, std::move(result), part.effects.size(), left);
    context.progress(static_cast<double>(i + 1) / static_cast<double>(machine.components.size()), "parts");
    if (context.cancelled()) return fail(ErrorCode::cancelled);
  }
  all.verdict = !all.effects.empty() ? Verdict::missing_effect
                : unexplained > 0    ? Verdict::unexplained
                                     : Verdict::consistent;
  all.mismatch = mismatch_of(std::move(mismatches));
  all.sentences.insert(all.sentences.begin(), explain_verdict(all));
  const auto tell = [&](const char* id, const char* fact, const std::vector<std::string>& names) {
    if (!names.empty()) all.sentences.push_back(explain_note(id, {{fact, fmt::format("{}", fmt::join(names, ", "))}}));
  };
  if (!all.effects.empty()) tell("lumps_unexplained", "channels", left.without);
  tell("lumps_left", "channels", left.beside);
  if (!all.effects.empty()) tell("capacity_unknown", "parts", assumed);
  return all;
}

}  // namespace zerodrift::diagnosis
