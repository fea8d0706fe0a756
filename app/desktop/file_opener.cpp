#include "app/desktop/file_opener.h"

#include <QDir>
#include <QFile>
#include <QFileDialog>
#include <QFileInfo>

#include "app/desktop/application.h"
#include "app/desktop/file_kind.h"
#include "app/desktop/import_words.h"
#include "app/desktop/steps/axis_errors_presenter.h"
#include "app/desktop/steps/machine_presenter.h"
#include "app/desktop/steps/physics_presenter.h"
#include "app/desktop/steps/warmup_presenter.h"
#include "app/text/error_text.h"
#include "core/base/resources.h"
#include "core/flow/steps/import_step.h"
#include "core/recording/import/importer.h"
#include "ui/widgets/recording_list.h"

namespace zerodrift::desktop {
namespace {

const char* const sample_name = "samples/sample.zdj";

/// "folder/name.zdj", or with a number when that is there already.
QString free_job_path(const QString& name) {
  const QString begin = MachinePresenter::jobsFolder() + QLatin1Char('/') + name;
  QString path = begin + QStringLiteral(".zdj");
  for (int n = 2; QFileInfo::exists(path); ++n) path = QStringLiteral("%1-%2.zdj").arg(begin).arg(n);
  return path;
}

}  // namespace

FileOpener::FileOpener(Application& application) : QObject(&application), m_application(application) {}

void FileOpener::open(const QStringList& paths) {
  for (const QString& path : paths) openOne(path);
}

void FileOpener::openOne(const QString& path) {
  if (m_application.bench().tasks().running()) {
    say(tr("%1 was not opened, because %2 is running.")
            .arg(QFileInfo(path).fileName(), m_application.bench().tasks().name()),
        tr("Wait until it has ended, or end it, and open the file then."));
    return;
  }
  if (const Status idle = m_application.bench().idle(); !idle) return show(idle.error());
  if (!QFileInfo::exists(path)) {
    show(Error{ErrorCode::file_not_found, {{"file", path.toStdString()}}});
    return;
  }
  switch (kind_of_file(path)) {
    case FileKind::job:
      return m_application.openJob(path);
    case FileKind::profile:
      return openProfile(path);
    case FileKind::plan:
      return openPlan(path);
    case FileKind::machine:
      return openMachine(path);
    case FileKind::laser:
      return openTable(path);
    case FileKind::recording:
      return openRecording(path);
    case FileKind::unknown:
      return say(tr("%1 is none of the files that can be opened here.").arg(QFileInfo(path).fileName()),
                 tr("Jobs (.zdj), connection profiles, plans and machine descriptions (.json), laser reports (.csv, "
                    ".rtl, .REN, .pos) and recordings (.csv, .txt, .lvm, .xlsx) can."));
  }
}

void FileOpener::openProfile(const QString& path) {
  const Status loaded = m_application.bench().loadProfile(path.toStdString());
  m_application.openPage(QStringLiteral("machine"));
  if (!loaded) show(loaded.error());
}

void FileOpener::openPlan(const QString& path) {
  const auto plan = acquisition::read_plan(path.toStdString());
  auto* warmup = qobject_cast<WarmupPresenter*>(m_application.presenter(QStringLiteral("warmup")));
  m_application.openPage(warmup->id());
  if (!plan) return show(plan.error());
  warmup->propose(*plan);
}

void FileOpener::openMachine(const QString& path) {
  auto* physics = qobject_cast<PhysicsPresenter*>(m_application.presenter(QStringLiteral("physics")));
  m_application.openPage(physics->id());
  physics->describe(path);
}

/// A table without a time is a laser's. On the page that waits for a recording it is one.
void FileOpener::openTable(const QString& path) {
  if (m_application.window().currentPage()->id() == QStringLiteral("warmup")) return openRecording(path);
  auto* axes = qobject_cast<AxisErrorsPresenter*>(m_application.presenter(QStringLiteral("axis_errors")));
  m_application.openPage(axes->id());
  axes->load(path);
}

void FileOpener::chooseRecording() {
  auto& window = m_application.window();
  const QString path =
      QFileDialog::getOpenFileName(&window, tr("Import a recording"), m_application.bench().folder(),
                                   tr("Recordings (*.csv *.txt *.tsv *.dat *.lvm *.xlsx);;All files (*)"));
  if (!path.isEmpty()) openRecording(path);
}

void FileOpener::openRecording(const QString& path) {
  auto& bench = m_application.bench();
  const auto& kept = bench.body("warmup");
  if (m_asking) {
    if (m_import == nullptr) {
      m_import = new RecordingImport(&m_application.window());
      connect(
          m_import, &RecordingImport::taken, this,
          [this](const auto& run, const QString& name, const auto& how, int place) { takeAt(place, run, name, how); });
    }
    const bool mapped = kept.is_object() && kept.contains("import");
    m_import->open(path, mapped ? kept["import"].value("map", nlohmann::json()) : nlohmann::json(), places());
    return;
  }
  const auto imported = recording::import_file(path.toStdString());
  if (!imported) return show(imported.error());
  const QString name = QFileInfo(path).fileName();
  if (const Status fit = flow::fit_for_warmup(imported->recording, name.toStdString(), false); !fit) {
    return show(fit.error());
  }
  take(imported->recording, name, how_imported(*imported, {}));
}

/// Beside the run of a job from files only in each role, or in its place.
QVector<RecordingImport::Place> FileOpener::places() const {
  const auto& bench = m_application.bench();
  const bool run = bench.has("warmup");
  if (bench.job() == nullptr) return {{{}, tr("Use in a new job")}};
  if (!run || bench.kind() != commissioning::JobKind::files) {
    return {{{}, run ? tr("Replace the run") : tr("Use this recording")}};
  }
  QVector<RecordingImport::Place> all;
  for (const QString& role : ui::RecordingList::roleNames()) all.append({role, tr("Add the recording")});
  all.append({tr("first run, in its place"), tr("Replace the run")});
  return all;
}

void FileOpener::takeAt(int place, const recording::Recording& run, const QString& name, const nlohmann::json& how) {
  const bool beside = place < places().size() - 1;
  if (!beside) return take(run, name, how);
  auto* warmup = qobject_cast<WarmupPresenter*>(m_application.presenter(QStringLiteral("warmup")));
  m_application.openPage(warmup->id());
  warmup->addRecording(run, name, how, static_cast<ui::RecordingUse>(place));
}

void FileOpener::take(const recording::Recording& run, const QString& name, const nlohmann::json& how) {
  auto& bench = m_application.bench();
  if (bench.job() == nullptr) {
    auto* machine = qobject_cast<MachinePresenter*>(m_application.presenter(QStringLiteral("machine")));
    machine->newJob(free_job_path(QFileInfo(name).completeBaseName()));
    if (bench.job() == nullptr) return;
    if (const Status said = bench.setKind(commissioning::JobKind::files); !said) return show(said.error());
  }
  m_application.openPage(QStringLiteral("warmup"));
  const auto kept = bench.takeIn("warmup", [&](commissioning::Job& job, const TaskContext&) {
    return flow::import_warmup(job, run, name.toStdString(), how);
  });
  if (!kept) show(kept.error());
}

void FileOpener::openSample() {
  if (const Status idle = m_application.bench().idle(); !idle) return show(idle.error());
  const auto sample = find_resource(sample_name);
  if (!sample) return show(sample.error());
  const QString copy = free_job_path(tr("sample"));
  QFile source(QString::fromStdString(sample->string()));
  if (!source.copy(copy)) {
    return show(Error{ErrorCode::file_not_writable,
                      {{"file", copy.toStdString()}, {"detail", source.errorString().toStdString()}}});
  }
  // An installed file may not be written; its copy must be.
  QFile::setPermissions(copy, QFile::ReadOwner | QFile::WriteOwner | QFile::ReadGroup | QFile::ReadOther);
  m_application.openJob(copy);
}

void FileOpener::say(const QString& sentence, const QString& remedy) {
  m_application.window().currentPage()->setProblem({ui::ProblemKind::note, sentence, remedy, {}});
  m_application.bench().log(LogKind::warning, sentence);
}

void FileOpener::show(const Error& error) {
  const ErrorText text = textOf(error, Reader::window);
  m_application.window().currentPage()->setProblem({ui::ProblemKind::failure, text.sentence, text.remedy, {}});
  m_application.bench().log(LogKind::bad, text.sentence);
}

}  // namespace zerodrift::desktop
