#include "core/commissioning/job_kind.h"

#include <array>
#include <nlohmann/json.hpp>

namespace zerodrift::commissioning {
namespace {

constexpr std::array kinds = {JobKind::machine, JobKind::manual, JobKind::files};
constexpr const char* artefact_kind = "job";

}  // namespace

std::string_view name_of(JobKind kind) {
  switch (kind) {
    case JobKind::machine:
      return "machine";
    case JobKind::manual:
      return "manual";
    case JobKind::files:
      return "files";
  }
  return "";
}

Result<JobKind> kind_of(const Job& job) {
  ZD_TRY(const auto kept, job.latest(artefact_kind));
  if (!kept) return JobKind::machine;
  ZD_TRY(const nlohmann::json body, kept->document());
  const auto at = body.find("kind");
  const std::string name = at != body.end() && at->is_string() ? at->get<std::string>() : "";
  for (const JobKind kind : kinds) {
    if (name == name_of(kind)) return kind;
  }
  return fail(ErrorCode::job_damaged,
              {{"file", job.path().string()}, {"detail", "the kind of the job is " + (name.empty() ? "-" : name)}});
}

Status set_kind(Job& job, JobKind kind) {
  ZD_TRY(const JobKind now, kind_of(job));
  if (now == kind) return {};
  return job.put(NewArtefact::of(artefact_kind, {{"kind", name_of(kind)}})).map([](const auto&) {});
}

}  // namespace zerodrift::commissioning
