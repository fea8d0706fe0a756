#include "app/desktop/file_opener.h"

#include <QDir>
#include <QFile>
#include <QFileInfo>

#include "app/desktop/application.h"
#include "app/desktop/ask.h"
#include "app/desktop/file_kind.h"
#include "app/desktop/steps/axis_errors_presenter.h"
#include "app/desktop/steps/machine_presenter.h"
#include "app/desktop/steps/warmup_presenter.h"
#include "app/text/error_text.h"
#include "core/base/resources.h"
#include "core/flow/steps/import_step.h"
#include "core/recording/csv.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/progress_strip.h"

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
    case FileKind::laser: {
      auto* axes = qobject_cast<AxisErrorsPresenter*>(m_application.presenter(QStringLiteral("axis_errors")));
      m_application.openPage(axes->id());
      axes->load(path);
      return;
    }
    case FileKind::recording:
      return openRecording(path);
    case FileKind::unknown:
      return say(tr("%1 is none of the files that can be opened here.").arg(QFileInfo(path).fileName()),
                 tr("Jobs (.zdj), connection profiles and plans (.json), laser reports (.csv, .rtl, .REN, .pos) and "
                    "recordings (.csv with time_s) can."));
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

void FileOpener::openRecording(const QString& path) {
  auto& bench = m_application.bench();
  const auto run = recording::read_recording(path.toStdString());
  if (!run) return show(run.error());
  const QString name = QFileInfo(path).fileName();
  if (const Status fit = flow::fit_for_warmup(*run, name.toStdString()); !fit) return show(fit.error());
  const QString size =
      tr("%1 rows over %2.").arg(run->rows()).arg(ui::durationText(run->time_s.back() - run->time_s.front()));
  const QString where = bench.job() == nullptr ? tr("A new job is made for it.")
                        : bench.has("warmup")  ? tr("It takes the place of the warm-up run that this job has.")
                                               : QString();
  if (m_asking && !ask(&m_application.window(), tr("Use %1 as the warm-up run?").arg(name),
                       ui::sentencesText({size, where, tr("It must have been recorded with the compensation off.")}),
                       tr("Use it"))) {
    return;
  }
  if (bench.job() == nullptr) {
    auto* machine = qobject_cast<MachinePresenter*>(m_application.presenter(QStringLiteral("machine")));
    machine->newJob(free_job_path(QFileInfo(path).completeBaseName()));
    if (bench.job() == nullptr) return;
  }
  m_application.openPage(QStringLiteral("warmup"));
  const auto kept = bench.takeIn("warmup", [&](commissioning::Job& job, const TaskContext&) {
    return flow::import_warmup(job, *run, name.toStdString());
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
  const ErrorText text = textOf(error);
  m_application.window().currentPage()->setProblem({ui::ProblemKind::failure, text.sentence, text.remedy, {}});
  m_application.bench().log(LogKind::bad, text.sentence);
}

}  // namespace zerodrift::desktop
