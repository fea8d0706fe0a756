#include "core/diagnosis/another_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/diagnosis/bodies.h"
#include "core/diagnosis/clock_jumps.h"
#include "core/diagnosis/confidence.h"
#include "core/diagnosis/diagnoser.h"
#include "core/diagnosis/parallel.h"

namespace zerodrift::diagnosis {
namespace {

/// What ran before the first row each recording shows for itself.
recording::Recording likelier_moved(const physics::Machine& machine, const recording::Recording& one, double late_s) {
  recording::Recording likeliest = with_inputs_moved(one, {late_s, 0.0});
  if (late_s > 0.0) return likeliest;
  const physics::Machine bodies = with_inner_bodies(machine);
  double most = log_evidence_of(bodies, likeliest);
  for (const double share : {0.25, 0.5, 0.75, 1.0}) {
    recording::Recording moved = with_inputs_moved(one, {late_s, share});
    const double evidence = log_evidence_of(bodies, moved);
    if (evidence <= most) continue;
    most = evidence;
    likeliest = std::move(moved);
  }
  return likeliest;
}

}  // namespace

recording::Recording with_inputs_moved(const recording::Recording& recording, const ClockOffset& offset) {
  recording::Recording moved = recording;
  for (std::size_t k = 0; k < recording.rows(); ++k) {
    const double acted_s = recording.time_s[k] + offset.late_s;
    const auto after = std::upper_bound(recording.time_s.begin(), recording.time_s.end(), acted_s + 1e-6);
    const bool before = after == recording.time_s.begin();
    const bool rests = before && acted_s < recording.time_s.front() + (1.0 - offset.rest_before) * offset.late_s;
    const auto row = static_cast<std::size_t>(after - recording.time_s.begin() - (before ? 0 : 1));
    for (std::size_t c = 0; c < recording.channels.size(); ++c) {
      if (!recording::is_input(recording.channels[c].kind())) continue;
      moved.channels[c].values[k] = rests ? 0.0 : recording.channels[c].values[row];
    }
  }
  return moved;
}

/// Followed from two rows to either side as long as the simulation explains more: none where a step says nothing, or
/// where what explains best as it is explains about as much.
ClockOffset Diagnoser::clock_offset() const {
  constexpr double least = 25.0;  // of log evidence, and it was sought out
  constexpr int farthest = 64;    // rows
  if (m_lumps_only || nothing_drives()) return {};
  struct Trial {
    int rows = 0;
    ClockOffset offset;
    double base = 0.0, best = 0.0;  // log evidence
    double most() const { return std::max(base, best); }
  };
  const auto tried = [&](const std::vector<int>& list) {
    std::vector<Trial> trials;
    for (const int rows : list) {
      const double late_s = rows * seconds_between_rows();
      trials.push_back({rows, {late_s, 0.0}});
      if (rows < 0) trials.push_back({rows, {late_s, 1.0}});
    }
    in_parallel(2 * trials.size(), [&](std::size_t i) {
      Trial& trial = trials[i / 2];
      (i % 2 == 0 ? trial.base : trial.best) =
          log_evidence_of((i % 2 == 0 ? m_selection.base : m_selection.best)->machine(),
                          with_inputs_moved(m_recordings.front(), trial.offset));
    });
    return *std::max_element(trials.begin(), trials.end(),
                             [](const auto& a, const auto& b) { return a.most() < b.most(); });
  };
  const Trial as_logged = tried({0});
  Trial best = tried({-2, 2});
  if (best.most() <= as_logged.most()) return {};
  while (2 * std::abs(best.rows) <= farthest) {
    const Trial next = tried({2 * best.rows});
    if (next.most() <= best.most()) break;
    best = next;
  }
  for (int step = std::abs(best.rows) / 2; step >= 1; step /= 2) {
    const Trial beside = tried({best.rows - step, best.rows + step});
    if (beside.most() > best.most()) best = beside;
  }
  return best.most() > as_logged.most() + least ? best.offset : ClockOffset{};
}

Result<Diagnosis> with_one_clock(Diagnosis answer, const physics::Machine& machine,
                                 std::vector<recording::Recording>& recordings, const DiagnoseOptions& options,
                                 const TaskContext& context) {
  const ClockOffset found = std::exchange(answer.clock, {});
  if (found.late_s == 0.0) return answer;
  std::vector<recording::Recording> moved;
  for (const auto& one : recordings) moved.push_back(likelier_moved(machine, one, found.late_s));
  ZD_TRY(Diagnosis again, Diagnoser(machine, moved, options, context).run());
  again.seconds += answer.seconds;
  if (again.verdict == Verdict::unexplained) {
    answer.seconds = again.seconds;
    return answer;
  }
  recordings = std::move(moved);
  again.clock = found;
  return again;
}

void tell_clock(Diagnosis& answer, const ClockOffset& found) {
  if (found.late_s == 0.0) return;
  for (FoundEffect& effect : answer.effects) effect.confidence *= doubt::corrected_number;
  const std::string seconds = fmt::format("{:.0f}", std::abs(found.late_s));
  const std::string id = found.late_s > 0.0 ? "clock_late" : "clock_early";
  answer.notes.push_back(id + ":" + seconds);
  answer.sentences.push_back(explain_note(id, {{"seconds", seconds}}));
}

}  // namespace zerodrift::diagnosis
