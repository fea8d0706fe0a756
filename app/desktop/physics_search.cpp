#include "app/desktop/physics_search.h"

#include <QProcess>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/desktop/child_process.h"
#include "core/base/hash.h"
#include "core/base/json.h"
#include "core/diagnosis/diagnosis.h"
#include "core/physics/simulate.h"
#include "core/recording/csv.h"

namespace zerodrift::desktop {

using commissioning::NewArtefact;
using diagnosis::Diagnosis;
using nlohmann::json;

namespace {

constexpr int case_timeout_ms = 120000;

/// Root mean square over the temperature channels.
double pooled(const std::map<std::string, double>& rms) {
  double sum = 0.0;
  int count = 0;
  for (const auto& [channel, value] : rms) {
    if (recording::kind_of(channel) != recording::ChannelKind::temperature || !std::isfinite(value)) continue;
    sum += value * value;
    ++count;
  }
  return count > 0 ? std::sqrt(sum / count) : std::nan("");
}

Status write_trial_case(const QString& program, const QString& folder, int seed, const TaskContext& context) {
  context.progress(0.05, "the virtual machine hides an effect");
  QProcess machine;
  end_with_parent(machine);
  machine.start(program, {QStringLiteral("--write-case"), folder, QStringLiteral("--conceal"), QStringLiteral("random"),
                          QStringLiteral("--seed"), QString::number(seed)});
  if (machine.waitForFinished(case_timeout_ms) && machine.exitCode() == 0) return {};
  const QString words = machine.state() == QProcess::NotRunning ? QString::fromUtf8(machine.readAllStandardError())
                                                                : machine.errorString();
  machine.kill();
  machine.waitForFinished(2000);
  return fail(ErrorCode::file_unreadable, {{"file", program.toStdString()}, {"detail", words.trimmed().toStdString()}});
}

std::filesystem::path file_in(const TrialCase& trial, const char* name) {
  return trial.folder->filePath(QString::fromLatin1(name)).toStdString();
}

}  // namespace

Judgements judgements_of(const json& body) {
  if (!body.is_object()) return {};
  return {body.value("adopted", std::vector<std::string>{}), body.value("rejected", std::vector<std::string>{})};
}

Result<NewArtefact> judged(const commissioning::Job& job, const Judgements& judgements) {
  ZD_TRY(const auto artefact, job.latest("physics"));
  if (!artefact) return fail(ErrorCode::step_blocked, {{"step", "physics"}, {"needs", "physics"}});
  ZD_TRY(json body, artefact->document());
  body["adopted"] = judgements.adopted;
  body["rejected"] = judgements.rejected;
  NewArtefact made;
  made.kind = artefact->kind;
  made.body = json_text(body);
  for (const auto& input : artefact->inputs) made.inputs.push_back(input.id);
  for (const auto& name : artefact->blob_names) {
    ZD_TRY(auto bytes, job.blob(artefact->id, name));
    made.blobs.push_back({name, std::move(bytes)});
  }
  return made;
}

Result<TrialCase> make_trial(const QString& program, int seed, const TaskContext& context) {
  TrialCase trial;
  trial.folder = std::make_shared<ScratchFolder>();
  ZD_CHECK(write_trial_case(program, trial.folder->path(), seed, context));
  ZD_TRY(const json commitment, read_json_file(file_in(trial, "commitment.json")));
  trial.seal = commitment.value("sha256", "");
  ZD_TRY(const auto machine, physics::read_machine(file_in(trial, "machine.json")));
  ZD_TRY(trial.recorded, recording::read_recording(file_in(trial, "run.csv")));
  ZD_TRY(auto simulation, physics::simulate(machine, trial.recorded, context));
  trial.simulated = std::move(simulation.prediction);
  return trial;
}

Result<TrialAnswer> answer_trial(const TrialCase& trial, const TaskContext& context) {
  ZD_TRY(const auto machine, physics::read_machine(file_in(trial, "machine.json")));
  std::vector<recording::Recording> runs = {trial.recorded};
  ZD_TRY(runs.emplace_back(), recording::read_recording(file_in(trial, "second.csv")));
  diagnosis::DiagnoseOptions options;
  options.details = false;
  ZD_TRY(const Diagnosis found, diagnosis::diagnose(machine, runs, options, context));
  TrialAnswer answer;
  if (found.verdict == diagnosis::Verdict::missing_effect) {
    for (const auto& effect : found.effects) answer.effects += (answer.effects.empty() ? "" : "+") + effect.id;
    if (!found.effects.empty()) answer.confidence = found.effects.front().confidence;
  } else {
    answer.effects = found.verdict == diagnosis::Verdict::consistent ? "none" : "unexplained";
  }
  if (!found.held_out.empty()) {
    const double before = pooled(found.held_out.front().nominal);
    if (before > 0) answer.improvement_percent = 100.0 * (1.0 - pooled(found.held_out.front().explained) / before);
  }
  answer.refined.time_s = found.time_s;
  for (const auto& channel : found.channels) answer.refined.ensure(channel.channel).values = channel.explained;
  return answer;
}

Result<OpenedSeal> open_trial(const TrialCase& trial) {
  ZD_TRY(const json answer, read_json_file(file_in(trial, "answer.json")));
  OpenedSeal opened;
  opened.kept = trial.seal == sha256_hex(answer.value("salt", "") + answer.value("committed_text", ""));
  opened.hidden = answer.value("answer", json::object()).value("id", "none");
  return opened;
}

bool same_effect(const std::string& hidden, const std::string& answer) {
  const std::string first = answer.substr(0, answer.find('+'));
  return first == hidden || (hidden == "standing_heat" && first == "extra_heat_source");
}

}  // namespace zerodrift::desktop
