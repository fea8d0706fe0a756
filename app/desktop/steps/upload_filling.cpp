// What the upload page shows, from the job, the preview of the next upload and the last one.

#include <QCoreApplication>
#include <cmath>

#include "app/desktop/moment.h"
#include "app/desktop/steps/upload_presenter.h"
#include "app/desktop/upload_view.h"
#include "app/text/core_text.h"
#include "core/controller/table_words.h"
#include "core/flow/flow.h"
#include "core/flow/steps/fit_step.h"
#include "core/flow/steps/inputs.h"
#include "ui/pages/upload_page.h"

namespace zerodrift::desktop {

using nlohmann::json;

namespace {

std::vector<controller::UploadStep> steps_from(const json& states) {
  std::vector<controller::UploadStep> steps;
  for (const auto& entry : states) {
    for (int i = 0; i <= static_cast<int>(controller::UploadState::restore_failed); ++i) {
      const auto state = static_cast<controller::UploadState>(i);
      if (entry.value("state", "") == controller::name_of(state))
        steps.push_back({state, {}, entry.value("detail", "")});
    }
  }
  return steps;
}

QString expressed(const compensation::Table& table) {
  bool terms = false;
  bool points = false;
  for (const auto& [name, axis] : table.axes) {
    terms = terms || !axis.terms.empty();
    points = points || !axis.points.empty();
  }
  return terms && points ? UploadPresenter::tr("temperature terms and position points")
         : points        ? UploadPresenter::tr("position points")
                         : UploadPresenter::tr("temperature terms");
}

}  // namespace

ui::Stage UploadPresenter::signStage(const ui::SignCheckResult& sign) const {
  ui::Stage stage{tr("Sign seen by the camera")};
  if (sign.measured) {
    stage.state = sign.judgement == ui::Judgement::bad ? ui::StageState::failed : ui::StageState::done;
    stage.detail = sign.note;
  } else if (m_writing) {
    stage.state = m_steps.empty() ? ui::StageState::running : ui::StageState::skipped;
  }
  return stage;
}

bool UploadPresenter::isWritten() const {
  const auto& workbench = bench();
  if (!workbench.has("upload")) return false;
  return flow::status_of(*workbench.job(), "upload").state == flow::StepState::current;
}

void UploadPresenter::fillFromPreview(ui::UploadState& state) const {
  const auto& record = m_preview->record;
  state.oldVersion = record.old_sequence;
  state.newVersion = record.sequence;
  state.largestChange_um = m_preview->largest_change_um;
  if (!m_dryRunAt.isNull() && !m_writing)
    state.stagesNote = tr("dry run %1").arg(m_dryRunAt.toString(QStringLiteral("HH:mm")));
  state.registers = static_cast<double>(record.new_words.size());
  state.steepest_um_per_K = steepest_um_per_K(m_preview->table);
  state.warnings = warningsInWords();
}

void UploadPresenter::fillFromArtefact(ui::UploadState& state, const json& body) const {
  state.writtenEmpty =
      controller::is_empty_table(body.at("record").value("new_words", std::vector<std::uint16_t>{}).size());
  // Another table, not written yet; or nothing, after going back to before the first one.
  state.written = isWritten() && !m_correction && !m_goingBack && !machineHoldsAnother() && !state.writtenEmpty;
  const auto& job = *bench().job();
  state.proved = flow::status_of(job, "verify").state == flow::StepState::current;
  const auto upload = job.latest("upload");
  if (!state.offline.isEmpty() && upload && *upload) state.asOf = momentText((*upload)->created_utc);
  const json record = body.value("record", json::object());
  if (!m_sign) state.sign = sign_of(body.value("sign_check", json()));
  if (showsPreview(state.written)) return;
  state.stagesNote.clear();
  if (const int version = body.value("version", 0); version > 0) state.newVersion = version;
  state.oldVersion = record.value("old_sequence", 0);
  state.largestChange_um = body.value("largest_change_um", std::nan(""));
  state.registers = body.value("registers", std::nan(""));
  if (!m_correction && (m_steps.empty() || !m_dryRunAt.isNull()))
    state.stages = stages_of(steps_from(body.value("states", json::array())), false, false);
}

void UploadPresenter::fillHistory(ui::UploadState& state) const {
  const auto& workbench = bench();
  const auto profile = flow::profile_of(*workbench.job(), "upload");
  if (!profile) return;
  std::optional<controller::ActiveTable> active;
  if (m_preview) {
    active = controller::ActiveTable{m_preview->record.old_words, m_preview->record.old_sequence, 0};
  } else if (const json& body = workbench.body("upload"); body.is_object()) {
    // Away from the machine the job's table is taken for the active one as long as nothing says otherwise.
    const controller::ActiveTable written{body.at("record").value("new_words", std::vector<std::uint16_t>{}),
                                          body.value("version", 0), 0};
    const bool last = !m_log.entries.empty() && m_log.entries.back().version == written.sequence &&
                      controller::holds(m_log.entries.back(), written);
    if (last) active = written;
  }
  state.history = history_of(m_log, active, *profile);
  state.rollbackBlocked = state.offline;
}

void UploadPresenter::refresh() {
  ui::UploadState state;
  const auto job = bench().job();
  if (job == nullptr || !bench().has("model")) {
    state.blocked = tr("Fit the model first: the table is made from it.");
    m_page->setState(state);
    return;
  }
  if (m_previewOf != latestModel(*job) && !m_writing) {
    m_preview.reset();
    m_lostTable.reset();
  }
  const auto profile = flow::profile_of(*job, "upload");
  const auto artefact = job->latest("model");
  const auto model = flow::model_of(**artefact);
  const json& body = bench().body("upload");
  state.changeLimit_um = profile ? profile->max_um : 200.0;
  state.steepestLimit_um_per_K = profile ? profile->max_um_per_K : 50.0;
  if (const auto& look = bench().look(); look && look->identity.table_capacity_registers > 0) {
    state.capacity = look->identity.table_capacity_registers;
  }
  state.writing = m_writing;
  state.offline = offlineReason();
  state.machineName = profile ? QString::fromStdString(profile->name) : QString();
  state.stages = stages_of(m_steps, m_writing, m_failed);
  if (m_sign) {
    state.sign = sign_of(*m_sign);
    state.sign.note = tr("checked %1").arg(m_signAt.toString(QStringLiteral("HH:mm")));
  }
  if (m_preview) fillFromPreview(state);
  if (body.is_object()) fillFromArtefact(state, body);
  if (profile && model) {
    compensation::Table old_table;
    compensation::Table table;
    if (showsPreview(state.written)) {
      old_table = m_preview->record.old_table;
      table = m_preview->table;
    } else if (state.written) {
      table = compensation::table_from_json(body.at("table"), "the uploaded table").value_or(compensation::Table{});
      const auto words = body.at("record").value("old_words", std::vector<std::uint16_t>{});
      old_table = controller::decode_table(words, *profile).value_or(compensation::Table{});
    } else {
      table = flow::table_of_job(*job).value_or(compensation::Table{});
    }
    state.axes = axes_of(old_table, table, *profile, bench().warmupRun());
    if (std::isnan(state.steepest_um_per_K)) state.steepest_um_per_K = steepest_um_per_K(table);
    if (!model->is_static()) {
      state.lost << tr("the model's memory of the past (its static part is written)");
    }
    state.expressed = expressed(table);
  }
  fillHistory(state);
  if (!m_correction) state.stages.prepend(signStage(state.sign));
  m_page->setState(state);
}

}  // namespace zerodrift::desktop
