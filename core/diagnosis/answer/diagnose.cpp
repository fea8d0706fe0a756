#include <fmt/format.h>

#include <array>
#include <chrono>

#include "core/base/memory.h"
#include "core/diagnosis/answer/assess.h"
#include "core/diagnosis/description/inner_bodies.h"
#include "core/diagnosis/diagnosis.h"
#include "core/diagnosis/input/checked_runs.h"

namespace zerodrift::diagnosis {

std::string_view name_of(Verdict verdict) {
  return verdict == Verdict::consistent    ? "consistent"
         : verdict == Verdict::unexplained ? "unexplained"
                                           : "missing_effect";
}

std::string_view name_of(ChannelVerdict verdict) {
  return verdict == ChannelVerdict::consistent    ? "consistent"
         : verdict == ChannelVerdict::unexplained ? "unexplained"
                                                  : "explained";
}

std::string_view name_of(NoteCode code) {
  constexpr std::array names{"missing_channel",
                             "unknown_columns",
                             "lacks_column",
                             "lacks_what_other_has",
                             "left_out",
                             "input_gaps",
                             "load_in_other_unit",
                             "clock_jumped",
                             "never_changes",
                             "room_given",
                             "room_is_initial_temperature",
                             "room_not_logged",
                             "capacity_unknown",
                             "conductance_unknown",
                             "warm_start",
                             "tolerances_raised",
                             "no_excitation",
                             "shows_too_little",
                             "never_driven",
                             "cannot_show",
                             "not_recorded",
                             "inputs_not_logged",
                             "few_sensors",
                             "coarse_rows",
                             "misplaced",
                             "exchanged",
                             "places_in",
                             "datum",
                             "other_end",
                             "overlong",
                             "diameter",
                             "sign_turned",
                             "described_not_there",
                             "clock_late",
                             "clock_early",
                             "far_from_description"};
  static_assert(names.size() == static_cast<std::size_t>(NoteCode::far_from_description) + 1);
  return names.at(static_cast<std::size_t>(code));
}

Result<Diagnosis> diagnose(const physics::Machine& machine, const std::vector<recording::Recording>& recordings,
                           const DiagnoseOptions& options, const TaskContext& context,
                           const DiagnosisSettings& settings) {
  if (recordings.empty())
    return fail(ErrorCode::bad_argument, {{"what", "recordings"}, {"found", "none"}, {"expected", "at least one"}});
  ZD_CHECK(settings.check());
  keep_freed_memory();
  const auto began = std::chrono::steady_clock::now();
  ZD_TRY(const CheckedRuns runs, checked_runs(machine, recordings));
  const auto evidence =
      std::make_shared<const inference::Evidence>(with_inner_bodies(machine), runs.recordings, settings, context.stop);
  ZD_TRY(const search::Posterior posterior, search::stepwise_search(evidence, context));
  Diagnosis answer = answer::assess(posterior, machine, runs, options);
  if (context.cancelled()) return fail(ErrorCode::cancelled);
  answer.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - began).count();
  context.progress(1.0, "done");
  return answer;
}

}  // namespace zerodrift::diagnosis
