#include "core/flow/flow.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/commissioning/job.h"
#include "core/recording/recording.h"

namespace zerodrift::flow {

using commissioning::Artefact;
using commissioning::ArtefactId;
using commissioning::InputRef;
using commissioning::Job;

namespace {

bool takes(const Artefact& made, std::string_view kind) {
  return std::any_of(made.inputs.begin(), made.inputs.end(), [&](const InputRef& input) { return input.kind == kind; });
}

/// A list of further recordings that is empty again: as if there had never been one.
bool says_nothing(const Artefact& latest) {
  if (latest.kind != "recordings") return false;
  const auto body = latest.document();
  return body && body->is_object() && body->value("recordings", nlohmann::json()) == nlohmann::json::array();
}

/// What is new about a kind since the artefact was made. A step may have taken several of a kind, of which one must be
/// the latest.
std::optional<Reason> outdated(const Artefact& made, const std::string& kind, const Artefact& latest, bool optional) {
  ArtefactId used = 0;
  for (const InputRef& input : made.inputs) {
    if (input.kind != kind) continue;
    if (input.content_hash == latest.content_hash) return std::nullopt;
    used = std::max(used, input.id);
  }
  if (used != 0) return Reason{Cause::changed, kind, {}, used, latest.id};
  // Not an input at all: the step did without it, or it came later.
  if (optional && latest.id > made.id && !says_nothing(latest)) return Reason{Cause::added, kind, {}, 0, latest.id};
  return std::nullopt;
}

/// Not where the warm-up run is there and has no channel of an error.
Result<bool> may_hold_errors(const Job& job) {
  ZD_TRY(const auto warmup, job.latest("warmup"));
  if (!warmup) return true;
  ZD_TRY(const auto body, warmup->document());
  const auto run = body.is_object() ? body.value("series", commissioning::SeriesId{0}) : 0;
  ZD_TRY(const auto all, job.series());
  const auto at = std::find_if(all.begin(), all.end(), [&](const auto& series) { return series.id == run; });
  return at == all.end() || std::any_of(at->channels.begin(), at->channels.end(), [](const std::string& channel) {
           return recording::kind_of(channel) == recording::ChannelKind::error;
         });
}

}  // namespace

std::string_view name_of(StepState state) {
  switch (state) {
    case StepState::blocked:
      return "blocked";
    case StepState::ready:
      return "ready";
    case StepState::current:
      return "current";
    case StepState::stale:
      return "stale";
    case StepState::not_needed:
      return "not_needed";
  }
  return "";
}

Flow::Flow(std::span<const StepInfo> steps) : m_steps(steps.begin(), steps.end()) {}

std::string Flow::maker_of(std::string_view kind) const {
  const auto at =
      std::find_if(m_steps.begin(), m_steps.end(), [&](const StepInfo& step) { return step.makes == kind; });
  return at == m_steps.end() ? std::string() : at->id;
}

Result<Flow::Scope> Flow::scope_of(const Job& job) {
  Scope scope;
  ZD_TRY(const commissioning::JobKind kind, commissioning::kind_of(job));
  scope.controller = kind != commissioning::JobKind::files;
  ZD_TRY(scope.errors, may_hold_errors(job));
  return scope;
}

bool Flow::spares(std::string_view kind, const Scope& scope) const {
  return std::any_of(m_steps.begin(), m_steps.end(),
                     [&](const StepInfo& step) { return step.makes == kind && !scope.covers(step); });
}

StepStatus Flow::status_of(const StepInfo& step, const LatestOf& latest, const StateOf& made_by) const {
  StepStatus status;
  status.step = &step;
  const auto spared = [&](const std::string& kind) {
    const auto at = made_by.find(kind);
    return at != made_by.end() && at->second == StepState::not_needed;
  };
  const auto& made = latest.at(step.makes);
  if (made) status.artefact = made->id;
  bool blocked = false;
  const auto look = [&](const std::string& kind, bool optional) {
    const auto at = latest.find(kind);
    if (at == latest.end() || !at->second) {
      if (optional || spared(kind)) return;
      blocked = true;
      status.reasons.push_back({Cause::missing, kind, maker_of(kind), 0, 0});
      return;
    }
    const Artefact& input = *at->second;
    auto reason = made ? outdated(*made, kind, input, optional) : std::nullopt;
    const bool stale_input = made_by.at(kind) == StepState::stale && (!made || takes(*made, kind));
    if (!reason && stale_input) reason = Reason{Cause::upstream, kind, {}, made ? input.id : 0, input.id};
    if (!reason) return;
    reason->step = maker_of(kind);
    status.reasons.push_back(std::move(*reason));
  };
  for (const std::string& kind : step.needs) look(kind, false);
  for (const std::string& kind : step.uses) look(kind, true);
  if (!status.reasons.empty()) status.reason = status.reasons.front().kind;
  if (blocked) {
    status.state = StepState::blocked;
  } else if (!made) {
    status.state = StepState::ready;
  } else {
    status.state = status.reasons.empty() ? StepState::current : StepState::stale;
  }
  return status;
}

Result<std::vector<StepStatus>> Flow::status(const Job& job) const {
  LatestOf latest;
  for (const StepInfo& step : m_steps) {
    ZD_TRY(latest[step.makes], job.latest(step.makes));
  }
  StateOf made_by;
  ZD_TRY(const Scope scope, scope_of(job));
  std::vector<StepStatus> all;
  for (const StepInfo& step : m_steps) {
    all.push_back(status_of(step, latest, made_by));
    if (!scope.covers(step)) all.back() = {&step, StepState::not_needed, {}, {}, all.back().artefact};
    made_by[step.makes] = all.back().state;
  }
  return all;
}

const StepStatus* Flow::next(const std::vector<StepStatus>& status) {
  const auto at = std::find_if(status.begin(), status.end(), [](const StepStatus& one) {
    return !one.step->branch && one.state != StepState::current && one.state != StepState::not_needed;
  });
  return at == status.end() ? nullptr : &*at;
}

Result<const StepInfo*> Flow::find(std::string_view id) const {
  const auto step = std::find_if(m_steps.begin(), m_steps.end(), [&](const StepInfo& one) { return one.id == id; });
  if (step != m_steps.end()) return &*step;
  return fail(ErrorCode::bad_argument,
              {{"what", "step"}, {"found", std::string(id)}, {"expected", "a step of the flow"}});
}

Result<Artefact> Flow::take_in(Job& job, std::string_view id, const StepRun& run, const TaskContext& context) const {
  ZD_CHECK(find(id).map([](auto) {}));
  ZD_TRY(const commissioning::NewArtefact made, run(job, context));
  if (context.cancelled()) return fail(ErrorCode::cancelled);
  return job.put(made);
}

Result<Artefact> Flow::perform(Job& job, std::string_view id, const StepRun& run, const TaskContext& context) const {
  ZD_TRY(const StepInfo* step, find(id));
  ZD_TRY(const Scope scope, scope_of(job));
  std::vector<InputRef> held;
  std::string missing;
  const auto hold = [&](const std::string& kind, bool optional) -> Status {
    ZD_TRY(const auto artefact, job.latest(kind));
    if (artefact) {
      held.push_back({artefact->id, kind, artefact->content_hash});
    } else if (!optional) {
      missing += (missing.empty() ? "" : ", ") + kind;
    }
    return {};
  };
  for (const std::string& kind : step->needs) ZD_CHECK(hold(kind, spares(kind, scope)));
  for (const std::string& kind : step->uses) ZD_CHECK(hold(kind, true));
  if (!missing.empty()) return fail(ErrorCode::step_blocked, {{"step", std::string(id)}, {"needs", missing}});

  ZD_TRY(commissioning::NewArtefact made, run(job, context));
  if (context.cancelled()) return fail(ErrorCode::cancelled);
  // A step lists inputs itself when it takes others than the latest; the rest is what there was when it began.
  std::vector<std::string> listed;
  for (const ArtefactId given : made.inputs) {
    ZD_TRY(const Artefact artefact, job.artefact(given));
    listed.push_back(artefact.kind);
  }
  for (const InputRef& input : held) {
    if (std::find(listed.begin(), listed.end(), input.kind) == listed.end()) made.inputs.push_back(input.id);
  }
  return job.put(made);
}

StepStatus status_of(const Job& job, std::string_view id) {
  static const Flow flow;  // the steps it points to must outlive the answer
  const auto all = flow.status(job);
  if (!all) return {};
  const auto at = std::find_if(all->begin(), all->end(), [&](const StepStatus& one) { return one.step->id == id; });
  return at == all->end() ? StepStatus{} : *at;
}

}  // namespace zerodrift::flow
