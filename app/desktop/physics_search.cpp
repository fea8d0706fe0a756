#include "app/desktop/physics_search.h"

#include <QProcess>
#include <QTemporaryDir>
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/json.h"
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
  machine.start(program, {QStringLiteral("--write-case"), folder, QStringLiteral("--conceal"), QStringLiteral("random"),
                          QStringLiteral("--seed"), QString::number(seed)});
  if (machine.waitForFinished(case_timeout_ms) && machine.exitCode() == 0) return {};
  const QString words = machine.state() == QProcess::NotRunning ? QString::fromUtf8(machine.readAllStandardError())
                                                                : machine.errorString();
  machine.kill();
  machine.waitForFinished(2000);
  return fail(ErrorCode::file_unreadable, {{"file", program.toStdString()}, {"detail", words.trimmed().toStdString()}});
}

}  // namespace

Result<NewArtefact> judged(const commissioning::Job& job, const std::string& effect, bool adopted, bool rejected) {
  ZD_TRY(const auto artefact, job.latest("physics"));
  if (!artefact) return fail(ErrorCode::step_blocked, {{"step", "physics"}, {"needs", "physics"}});
  ZD_TRY(json body, artefact->document());
  const auto put = [&](const char* list, bool inside) {
    auto ids = body.value(list, std::vector<std::string>{});
    std::erase(ids, effect);
    if (inside) ids.push_back(effect);
    body[list] = ids;
  };
  put("adopted", adopted);
  put("rejected", rejected);
  NewArtefact made;
  made.kind = artefact->kind;
  made.body = body.dump();
  for (const auto& input : artefact->inputs) made.inputs.push_back(input.id);
  for (const auto& name : artefact->blob_names) {
    ZD_TRY(auto bytes, job.blob(artefact->id, name));
    made.blobs.push_back({name, std::move(bytes)});
  }
  return made;
}

Result<Trial> blind_trial(const QString& program, int seed, const TaskContext& context) {
  const QTemporaryDir folder;
  ZD_CHECK(write_trial_case(program, folder.path(), seed, context));
  const auto file = [&](const char* name) { return folder.filePath(QString::fromLatin1(name)).toStdString(); };
  ZD_TRY(const auto machine, physics::read_machine(file("machine.json")));
  std::vector<recording::Recording> runs(2);
  ZD_TRY(runs[0], recording::read_recording(file("run.csv")));
  ZD_TRY(runs[1], recording::read_recording(file("second.csv")));
  diagnosis::DiagnoseOptions options;
  options.details = false;
  ZD_TRY(const Diagnosis found, diagnosis::diagnose(machine, runs, options, context));
  Trial trial;
  trial.answer = !found.effects.empty()                            ? found.effects.front().id
                 : found.verdict == diagnosis::Verdict::consistent ? "none"
                                                                   : "unexplained";
  if (!found.held_out.empty()) {
    const double before = pooled(found.held_out.front().nominal);
    if (before > 0) trial.improvement_percent = 100.0 * (1.0 - pooled(found.held_out.front().explained) / before);
  }
  // Only now, with the answer given, the seal is opened.
  ZD_TRY(const json answer, read_json_file(file("answer.json")));
  ZD_TRY(const json commitment, read_json_file(file("commitment.json")));
  const std::string promised = commitment.value("sha256", "");
  trial.sealed = promised == sha256_hex(answer.value("salt", "") + answer.value("committed_text", ""));
  const json hidden = answer.value("answer", json::object());
  trial.hidden = hidden.value("id", "");
  if (trial.hidden.empty()) trial.hidden = "none";
  return trial;
}

}  // namespace zerodrift::desktop
