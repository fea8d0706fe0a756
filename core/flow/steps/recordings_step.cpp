#include "core/flow/steps/recordings_step.h"

#include <algorithm>
#include <array>

#include "core/base/json.h"
#include "core/flow/steps/import_step.h"
#include "core/flow/steps/inputs.h"

namespace zerodrift::flow {

using commissioning::NewArtefact;
using nlohmann::json;
using recording::ChannelKind;
using recording::Recording;

namespace {

constexpr const char* kind_of_list = "recordings";
constexpr std::array roles = {RecordingRole::training, RecordingRole::other_day, RecordingRole::cooling};

int count_of(const Recording& run, ChannelKind kind) {
  return static_cast<int>(std::count_if(run.channels.begin(), run.channels.end(), [&](const auto& channel) {
    return channel.kind() == kind && recording::present_count(channel) > 0;
  }));
}

/// Two runs of one name could not be told apart in an answer.
std::string free_name(const std::string& file, const std::vector<FurtherRecording>& others) {
  const std::string base = file.substr(0, file.rfind('.'));
  std::string name = base;
  const auto taken = [&] {
    return std::any_of(others.begin(), others.end(), [&](const auto& other) { return other.name == name; });
  };
  for (int n = 2; taken(); ++n) name = base + " " + std::to_string(n);
  return name;
}

Status same_channels(const Recording& run, const Recording& warmup, const std::string& file) {
  const auto known = warmup.names(ChannelKind::temperature);
  const bool one = std::any_of(known.begin(), known.end(), [&](const auto& name) { return run.find(name) != nullptr; });
  if (one) return {};
  const auto list = [](const std::vector<std::string>& names) {
    std::string text;
    for (const auto& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
  };
  return fail(ErrorCode::data_does_not_fit, {{"what", file},
                                             {"found", list(run.names(ChannelKind::temperature))},
                                             {"expected", "a channel of the warm-up run: " + list(known)}});
}

Result<std::vector<Recording>> runs_of(const commissioning::Job& job,
                                       const std::function<bool(const FurtherRecording&, const Recording&)>& wanted) {
  ZD_TRY(const auto list, further_recordings(job));
  std::vector<Recording> runs;
  for (const auto& one : list) {
    ZD_TRY(Recording run, job.read_series(one.series));
    run.name = one.name;
    if (wanted(one, run)) runs.push_back(std::move(run));
  }
  return runs;
}

}  // namespace

std::string_view name_of(RecordingRole role) {
  switch (role) {
    case RecordingRole::training:
      return "training";
    case RecordingRole::other_day:
      return "other_day";
    case RecordingRole::cooling:
      return "cooling";
  }
  return "";
}

Result<RecordingRole> recording_role_from(std::string_view name) {
  const auto at = std::find_if(roles.begin(), roles.end(), [&](RecordingRole role) { return name_of(role) == name; });
  if (at != roles.end()) return *at;
  return fail(ErrorCode::bad_argument, {{"what", "the role of a recording"},
                                        {"found", std::string(name)},
                                        {"expected", "training, other_day or cooling"}});
}

json to_json(const std::vector<FurtherRecording>& recordings) {
  json list = json::array();
  for (const auto& one : recordings) {
    list.push_back({{"name", one.name},
                    {"role", name_of(one.role)},
                    {"series", one.series},
                    {"file", one.file},
                    {"import", one.import},
                    {"rows", one.rows},
                    {"duration_s", one.duration_s},
                    {"temperatures", one.temperatures},
                    {"errors", one.errors}});
  }
  return {{"recordings", std::move(list)}};
}

Result<std::vector<FurtherRecording>> recordings_from_json(const json& body) {
  return from_json<std::vector<FurtherRecording>>(body, "the job's recordings", nullptr, [](JsonObject& root) {
    std::vector<FurtherRecording> list;
    for (JsonObject& o : root.objects("recordings")) {
      FurtherRecording one;
      one.name = o.text("name");
      const auto role = recording_role_from(o.text("role"));
      if (!role) o.reject("role", o.text("role"), "training, other_day or cooling");
      one.role = *role;
      one.series = static_cast<commissioning::SeriesId>(o.number("series", positive));
      one.file = o.text_or("file", "");
      if (const json* how = o.raw("import")) one.import = *how;
      one.rows = static_cast<long long>(o.number_or("rows", 0.0, not_negative));
      one.duration_s = o.number_or("duration_s", 0.0, not_negative);
      one.temperatures = o.integer_or("temperatures", 0, 0, 100000);
      one.errors = o.integer_or("errors", 0, 0, 100000);
      list.push_back(std::move(one));
    }
    return list;
  });
}

Result<std::vector<FurtherRecording>> further_recordings(const commissioning::Job& job) {
  ZD_TRY(const auto kept, job.latest(kind_of_list));
  if (!kept) return std::vector<FurtherRecording>{};
  ZD_TRY(const json body, kept->document());
  return recordings_from_json(body);
}

NewArtefact with_recordings(const std::vector<FurtherRecording>& recordings) {
  return NewArtefact::of(kind_of_list, to_json(recordings));
}

Result<NewArtefact> add_recording(commissioning::Job& job, const Recording& run, const std::string& file,
                                  RecordingRole role, const json& how) {
  ZD_CHECK(fit_for_warmup(run, file, false));
  ZD_TRY(const Input warmup, need(job, kind_of_list, "warmup"));
  ZD_TRY(const Recording first, run_of(job, warmup));
  ZD_CHECK(same_channels(run, first, file));
  ZD_TRY(auto list, further_recordings(job));
  FurtherRecording one;
  one.name = free_name(file, list);
  one.role = role;
  one.file = file;
  one.import = how;
  one.rows = static_cast<long long>(run.rows());
  one.duration_s = run.time_s.back() - run.time_s.front();
  one.temperatures = count_of(run, ChannelKind::temperature);
  one.errors = count_of(run, ChannelKind::error);
  ZD_TRY(one.series, keep_run(job, run, std::string(name_of(role)), json::object()));
  list.push_back(std::move(one));
  return with_recordings(list);
}

std::string lacks_for_fit(const Recording& run, const Recording& warmup) {
  for (const ChannelKind kind : {ChannelKind::temperature, ChannelKind::error}) {
    for (const auto& name : warmup.names(kind)) {
      const auto* channel = run.find(name);
      if (channel == nullptr || recording::present_count(*channel) == 0) return name;
    }
  }
  return {};
}

Result<std::vector<Recording>> training_runs(const commissioning::Job& job, const Recording& warmup) {
  ZD_TRY(auto more, runs_of(job, [&](const FurtherRecording& one, const Recording& run) {
           return one.role != RecordingRole::other_day && lacks_for_fit(run, warmup).empty();
         }));
  more.insert(more.begin(), warmup);
  return more;
}

Result<std::vector<Recording>> further_runs(const commissioning::Job& job) {
  return runs_of(job, [](const FurtherRecording&, const Recording&) { return true; });
}

Result<std::vector<Recording>> test_runs(const commissioning::Job& job, const Recording& warmup) {
  return runs_of(job, [&](const FurtherRecording& one, const Recording& run) {
    return one.role == RecordingRole::other_day && lacks_for_fit(run, warmup).empty();
  });
}

}  // namespace zerodrift::flow
