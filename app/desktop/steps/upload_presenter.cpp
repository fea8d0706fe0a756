#include "app/desktop/steps/upload_presenter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/desktop/ask.h"
#include "app/desktop/pin_dialog.h"
#include "app/desktop/table_export.h"
#include "app/desktop/upload_view.h"
#include "app/text/error_text.h"
#include "core/base/time_text.h"
#include "core/controller/table_history.h"
#include "core/controller/table_words.h"
#include "core/flow/flow.h"
#include "core/flow/rollback_and_switch.h"
#include "core/flow/steps/fit_step.h"
#include "core/flow/steps/inputs.h"
#include "ui/pages/upload_page.h"

namespace zerodrift::desktop {

using commissioning::NewArtefact;
using nlohmann::json;

namespace {

constexpr int sign_stands_min = 60;  // so long a sign check on the same machine is not repeated

}  // namespace

UploadPresenter::UploadPresenter(Workbench& bench, ui::UploadPage* page) : Presenter(bench, page), m_page(page) {
  connect(page, &ui::UploadPage::rollbackRequested, this, &UploadPresenter::rollBack);
  connect(page, &ui::Page::primaryTriggered, this, [this] {
    if (m_page->state().written) {
      Q_EMIT nextRequested();
    } else {
      askAndWrite({});
    }
  });
  connect(page, &ui::Page::secondaryTriggered, this, [this](const QString& action) {
    if (action == QStringLiteral("dryRun")) dryRun();
    if (action == QStringLiteral("sign")) checkSign();
    if (action == QStringLiteral("export")) exportTable();
  });
}

/// What was looked at, checked and written belongs to the job it was done in.
void UploadPresenter::forget() {
  m_preview.reset();
  m_correction.reset();
  m_goingBack.reset();
  m_lostTable.reset();
  m_sign.reset();
  m_signAt = {};
  m_dryRunAt = {};
  m_steps.clear();
  m_failed = false;
  m_previewOf = 0;
  m_log = {};
  m_afterPreview = nullptr;
}

long long UploadPresenter::latestModel(const commissioning::Job& job) {
  const auto latest = job.latest("model");
  return latest && *latest ? (*latest)->id : 0;
}

void UploadPresenter::enter() {
  readLog();
  // Looked at since: the machine holds another table than the one that was compared.
  const auto& look = bench().look();
  if (m_preview && look && look->table && !controller::is_marked(*look->table, m_preview->record.old_words)) {
    m_preview.reset();
  }
  refresh();
  // Reading the old table writes nothing: the comparison is there when the page opens.
  if (bench().has("model") && bench().connected() && !m_preview && !bench().tasks().running()) preview({});
}

void UploadPresenter::preview(Done done) {
  if (m_reading) {
    m_afterPreview = std::move(done);
    return;
  }
  const auto profile = bench().profile();
  const auto job = bench().job();
  if (!profile || job == nullptr) {
    show(Error{ErrorCode::step_blocked, {{"step", "upload"}, {"needs", "a connected machine"}}});
    if (done) done(false);
    return;
  }
  const auto model = latestModel(*job);
  m_reading = true;
  runTask<flow::UploadPreview>(
      tr("Reading the table in the machine"),
      [profile = *profile, job, table = chosenTable(),
       questions = bench().questions()](const TaskContext& context) -> Result<flow::UploadPreview> {
        ZD_TRY(auto devices,
               flow::Devices::open(profile, false, access::Permit::read_only(), questions->of(profile, context.stop)));
        return flow::preview_upload(*job, devices, table, context);
      },
      [this, model, done = std::move(done)](Result<flow::UploadPreview> seen) {
        const bool good = seen.has_value();
        if (good) {
          m_preview = std::move(*seen);
          m_previewOf = model;
        }
        m_reading = false;
        if (good && takeLostTable()) return preview(done);
        if (good) tellForeign();
        refresh();
        if (done) done(good);
        if (const Done after = std::exchange(m_afterPreview, {})) after(good);
      });
}

void UploadPresenter::dryRun() {
  preview([this](bool good) {
    if (!good || !m_preview) return;
    m_dryRunAt = QDateTime::currentDateTime();
    m_steps = m_preview->record.steps;
    const auto& record = m_preview->record;
    const auto registers = static_cast<int>(record.new_words.size());
    tell([registers, change_um = m_preview->largest_change_um,
          axis = QString::fromStdString(m_preview->largest_change_axis)] {
      return ui::Problem{
          ui::ProblemKind::success,
          tr("The dry run is good: the machine is ready, %1 fit, the largest change now would be %2 µm in %3.")
              .arg(tr("%n register(s)", nullptr, registers))
              .arg(change_um, 0, 'f', 1)
              .arg(axis),
          tr("Nothing was written, not even the switch."),
          {}};
    });
    bench().log(LogKind::good, tr("Dry run: %1, nothing written").arg(tr("%n register(s)", nullptr, registers)));
    refresh();
  });
}

QString UploadPresenter::machineId() const {
  const auto& workbench = bench();
  const auto& profile = workbench.profile();
  const auto& look = workbench.look();
  if (!profile) return {};
  return QString::fromStdString(profile->name) + QLatin1Char('/') +
         QString::number(look ? look->identity.serial : (m_preview ? m_preview->record.serial : 0U));
}

void UploadPresenter::noteSign(const controller::SignCheckRecord& record) {
  m_sign = record;
  m_signAt = QDateTime::currentDateTime();
  m_signMachine = machineId();
}

bool UploadPresenter::signStands() const {
  return m_sign && m_sign->result && m_signMachine == machineId() &&
         m_signAt.secsTo(QDateTime::currentDateTime()) < qint64{60} * sign_stands_min;
}

bool UploadPresenter::confirmed(const QString& heading, const QString& text, const QString& deed,
                                const QString& details) const {
  return !m_asking || askWithDetails(m_page, heading, text, deed, details);
}

std::function<void(const controller::UploadStep&)> UploadPresenter::observer() {
  // Called on the worker thread.
  return [this](const controller::UploadStep& step) {
    QMetaObject::invokeMethod(
        this, [this, step] { follow(step); }, Qt::QueuedConnection);
  };
}

void UploadPresenter::follow(const controller::UploadStep& step) {
  if (!m_writing) return;
  m_steps.push_back(step);
  refresh();
}

void UploadPresenter::write(Done done) {
  const auto profile = bench().profile();
  if (!profile || bench().job() == nullptr || !m_preview) return;
  const auto permit = permit_for(bench(), m_page, tr("Writing the table"));
  if (!permit) {
    if (done) done(false);
    return;
  }
  m_writing = true;
  m_failed = false;
  m_steps.clear();
  m_dryRunAt = {};
  refresh();
  flow::UploadStepOptions options;
  options.table = chosenTable();
  options.sign_check = !m_correction;
  if (signStands()) options.checked_signs = m_sign;
  options.observer = observer();
  options.sign_observer = [this](const controller::SignCheckRecord& record) {
    QMetaObject::invokeMethod(
        this,
        [this, record] {
          noteSign(record);
          refresh();
        },
        Qt::QueuedConnection);
  };
  // What a person agreed to is what is written: the same table over the same old one.
  options.consent = flow::Consent::by_asking([agreed = compensation::crc32_text(m_preview->table),
                                              over = m_preview->record.old_words](const flow::WriteQuestion& now) {
    return compensation::crc32_text(now.table->table) == agreed && now.table->record.old_words == over;
  });
  runStep(
      tr("Writing the table"),
      [profile = *profile, options, permit = *permit, questions = bench().questions()](
          commissioning::Job& job, const TaskContext& context) -> Result<NewArtefact> {
        ZD_TRY(auto devices, flow::Devices::open(profile, true, permit, questions->of(profile, context.stop)));
        return flow::upload(job, devices, options, context);
      },
      [this, done = std::move(done)](bool good) {
        m_writing = false;
        m_failed = !good;
        m_preview.reset();
        m_correction.reset();
        m_lostTable.reset();
        readLog();
        refresh();
        if (done) done(good);
      });
}

void UploadPresenter::writeCorrection(const compensation::Table& table, Done done) {
  m_correction = table;
  askAndWrite([this, done = std::move(done)](bool good) {
    m_correction.reset();
    m_preview.reset();  // a correction that was not agreed to is not what this page shows
    refresh();
    if (done) done(good);
  });
}

void UploadPresenter::rollBack(const QString& id) {
  const auto profile = bench().profile();
  const auto job = bench().job();
  if (!profile || job == nullptr || m_writing) return;
  runTask<flow::RollbackPreview>(
      tr("Reading the table in the machine"),
      [profile = *profile, job, id = id.toStdString()](const TaskContext& context) {
        return flow::preview_roll_back(*job, profile, id, context);
      },
      [this, model = latestModel(*job)](Result<flow::RollbackPreview> seen) {
        if (!seen) return;
        m_preview = std::move(seen->difference);
        m_previewOf = model;
        m_goingBack = std::move(seen->target);
        refresh();  // the difference stands on the page while it is asked
        askAndRollBack();
      });
}

void UploadPresenter::proposeRollback(int version) {
  m_page->showHistory(version);
}

void UploadPresenter::askAndRollBack() {
  const auto profile = bench().profile();
  const auto job = bench().job();
  const int version = m_goingBack->table.version;
  const auto& record = m_preview->record;
  const QString change = m_preview->largest_change_axis.empty()
                             ? tr("Nothing changes at the temperatures of this moment.")
                             : tr("The largest change now is %1 µm in %2.")
                                   .arg(m_preview->largest_change_um, 0, 'f', 1)
                                   .arg(QString::fromStdString(m_preview->largest_change_axis));
  const bool agreed = confirmed(
      tr("Go back to version %1 in %2?")
          .arg(version)
          .arg(tr("%1 (serial %2)").arg(QString::fromStdString(record.machine)).arg(record.serial)),
      tr("The table of version %1 is written again, as version %2, in place of version %3. %4 The switch is left as it "
         "is; nothing is taken out of the history.")
          .arg(version)
          .arg(record.sequence)
          .arg(record.old_sequence)
          .arg(change),
      tr("Go back"));
  const auto permit = agreed && profile && job != nullptr
                          ? permit_for(bench(), m_page, tr("Going back to version %1").arg(version))
                          : std::nullopt;
  if (!permit) {
    m_goingBack.reset();
    m_preview.reset();
    return enter();
  }
  m_writing = true;
  m_failed = false;
  m_steps.clear();
  m_dryRunAt = {};
  refresh();
  runStep(
      tr("Going back to version %1").arg(version),
      [profile = *profile, permit = *permit, target = *m_goingBack, watch = observer()](commissioning::Job& in,
                                                                                        const TaskContext& context) {
        return flow::roll_back(in, profile, permit, flow::Consent::given(), target, watch, context);
      },
      [this](bool good) {
        m_writing = false;
        m_failed = !good;
        m_preview.reset();
        m_goingBack.reset();
        enter();
      },
      From::elsewhere);
}

/// The log of the machine's tables as it is on this computer, with what the job knows beside it.
void UploadPresenter::readLog() {
  const auto job = bench().job();
  const json& machine = bench().body("machine");
  m_log = {};
  if (job == nullptr || !machine.is_object()) return;
  const auto serial = machine.at("identity").value("serial", 0U);
  if (auto log = controller::TableHistory().read(serial)) {
    m_log = controller::with_missing(std::move(*log), flow::tables_of(*job, serial));
  } else {
    show(log.error());
  }
}

void UploadPresenter::checkSign() {
  const auto profile = bench().profile();
  const auto job = bench().job();
  if (!profile || job == nullptr || m_writing) return;
  if (!confirmed(tr("Move the axes of %1 by 10 µm?").arg(QString::fromStdString(profile->name)),
                 tr("A test offset is written for X, Y and Z, one after the other, watched by the camera and taken "
                    "back."),
                 tr("Move"))) {
    return;
  }
  const auto permit = permit_for(bench(), m_page, tr("Checking the sign"));
  if (!permit) return;
  runTask<controller::SignCheckRecord>(
      tr("Checking the sign"),
      [profile = *profile, job, permit = *permit](const TaskContext& context) {
        return flow::try_signs(*job, profile, permit, flow::Consent::given(), context);
      },
      [this](Result<controller::SignCheckRecord> record) {
        if (record) {
          noteSign(*record);
          if (!record->result) show(record->result.error());
        }
        refresh();
      });
}

void UploadPresenter::exportTable() {
  std::optional<compensation::Table> table;
  if (m_preview) {
    table = m_preview->table;
  } else if (bench().job() != nullptr) {
    auto made = flow::table_of_job(*bench().job());
    if (!made) return show(made.error());
    table = std::move(*made);
  }
  if (!table) return;
  export_with_question(m_page, bench(), *table, nullptr, false, [this](const Error& error) { show(error); });
}

void UploadPresenter::tour(std::function<void(bool good)> done) {
  setAsking(false);
  askAndWrite(std::move(done));
}

}  // namespace zerodrift::desktop
