// The recordings of a job from files only: shown, renamed, given another role, added, removed; each change can be
// taken back.

#include <nlohmann/json.hpp>

#include "app/desktop/steps/warmup_presenter.h"
#include "core/flow/flow.h"
#include "ui/pages/warmup_page.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/progress_strip.h"

namespace zerodrift::desktop {

using flow::FurtherRecording;
using flow::RecordingRole;

std::vector<FurtherRecording> WarmupPresenter::recordings() const {
  const auto job = bench().job();
  return job == nullptr ? std::vector<FurtherRecording>{}
                        : flow::further_recordings(*job).value_or(std::vector<FurtherRecording>{});
}

void WarmupPresenter::wireRecordings() {
  connect(m_page, &ui::WarmupPage::recordingShown, this, [this](int index) {
    m_recording = index;
    refresh();
  });
  connect(m_page, &ui::WarmupPage::recordingRenamed, this, [this](int index, const QString& name) {
    changeRecording(index, [&](FurtherRecording& one) { one.name = name.toStdString(); });
  });
  connect(m_page, &ui::WarmupPage::recordingRoleChosen, this, [this](int index, ui::RecordingUse use) {
    changeRecording(index, [&](FurtherRecording& one) { one.role = static_cast<RecordingRole>(use); });
  });
  connect(m_page, &ui::WarmupPage::recordingRemoved, this, [this](int index) {
    auto all = recordings();
    if (index < 1 || index > static_cast<int>(all.size())) return;
    m_recordingsBefore.push_back(all);
    all.erase(all.begin() + index - 1);
    changeRecordings(all);
  });
}

void WarmupPresenter::changeRecording(int index, const std::function<void(FurtherRecording&)>& change) {
  auto all = recordings();
  if (index < 1 || index > static_cast<int>(all.size())) return;
  m_recordingsBefore.push_back(all);
  change(all[static_cast<std::size_t>(index) - 1]);
  changeRecordings(all);
}

void WarmupPresenter::changeRecordings(const std::vector<FurtherRecording>& recordings) {
  m_recording = std::min(m_recording, static_cast<int>(recordings.size()));
  const auto kept =
      bench().takeIn("recordings", [&](commissioning::Job&, const TaskContext&) -> Result<commissioning::NewArtefact> {
        return flow::with_recordings(recordings);
      });
  if (!kept) show(kept.error());
}

void WarmupPresenter::addRecording(const recording::Recording& run, const QString& name, const nlohmann::json& how,
                                   ui::RecordingUse use) {
  const auto before = recordings();
  m_recording = static_cast<int>(before.size()) + 1;
  const auto kept = bench().takeIn("recordings", [&](commissioning::Job& job, const TaskContext&) {
    return flow::add_recording(job, run, name.toStdString(), static_cast<RecordingRole>(use), how);
  });
  if (kept) return m_recordingsBefore.push_back(before);
  m_recording = 0;
  show(kept.error());
}

void WarmupPresenter::fillRecordings(ui::WarmupState& state) {
  const auto all = recordings();
  if (all.empty()) return;
  const auto& first = bench().warmupRun();
  const auto size = [](double duration_s, int temperatures, int errors) {
    return ui::listText(
        {ui::durationText(duration_s), tr("%n temperatures", nullptr, temperatures), tr("%n errors", nullptr, errors)});
  };
  state.recordings.append({QString::fromStdString(bench().body("warmup").value("file", "")),
                           {},
                           size(state.elapsed_s, state.temperatures, state.errors)});
  m_recording = std::min(m_recording, static_cast<int>(all.size()));
  state.shownRecording = m_recording;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const FurtherRecording& one = all[i];
    const QString length = size(one.duration_s, one.temperatures, one.errors);
    ui::RecordingRow row{QString::fromStdString(one.name), static_cast<ui::RecordingUse>(one.role), length};
    state.recordings.append(row);
    if (static_cast<int>(i) + 1 != m_recording) continue;
    feed().setImported(true);
    if (showSeries(one.series)) feed().showHappened({}, 0, 0);
    const auto run = bench().job()->read_series(one.series);
    const std::string lacks = run ? flow::lacks_for_fit(*run, first) : std::string();
    const QString use = !lacks.empty() ? tr("For the physics alone: it has no %1.").arg(bench().tagOf(lacks))
                        : one.role == RecordingRole::other_day ? tr("Tests the fit; explained by the physics.")
                                                               : tr("Fitted too; explained by the physics.");
    state.recordings.last().words = length + QStringLiteral(" · ") + use;
    state.elapsed_s = one.duration_s;
    state.samples = one.rows;
    state.temperatures = one.temperatures;
    state.errors = one.errors;
    state.largestError_um = one.errors > 0 ? feed().largestError_um() : std::nan("");
    state.largestErrorAxis = one.errors > 0 ? feed().largestErrorAxis() : QString();
  }
}

}  // namespace zerodrift::desktop
