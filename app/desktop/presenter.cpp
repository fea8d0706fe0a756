#include "app/desktop/presenter.h"

#include "app/text/error_text.h"

namespace zerodrift::desktop {

Presenter::Presenter(Workbench& bench, ui::Page* page) : QObject(page), m_bench(bench), m_page(page) {
  connect(page, &ui::Page::cancelRequested, this, [this] { m_bench.tasks().cancel(); });
}

void Presenter::show(const Error& error) {
  if (error.code == ErrorCode::cancelled) {
    m_page->setProblem({ui::ProblemKind::note, textOf(error).sentence, textOf(error).remedy, {}});
    return;
  }
  const ErrorText text = textOf(error);
  m_page->setProblem({ui::ProblemKind::failure, text.sentence, text.remedy, {}});
  m_bench.log(LogKind::bad, text.sentence);
}

void Presenter::runStep(const QString& name, std::function<Result<commissioning::NewArtefact>(const TaskContext&)> work,
                        std::function<void(bool good)> done) {
  auto* progress = new QObject(this);
  const auto finish = [this, progress, done = std::move(done)](const Result<commissioning::NewArtefact>& made) {
    progress->deleteLater();
    m_page->clearProgress();
    Status kept = made ? m_bench.keep(*made) : Status(fail(made.error()));
    if (!kept) show(kept.error());
    refresh();
    if (done) done(kept.has_value());
  };
  m_page->clearProblem();
  connect(&m_bench.tasks(), &TaskRunner::progressed, progress,
          [this, name](double fraction, const QString&, double secondsLeft) {
            m_page->setProgress(name, fraction, secondsLeft < 0 ? std::nullopt : std::optional<double>(secondsLeft));
          });
  if (m_bench.tasks().start<commissioning::NewArtefact>(name, std::move(work), finish)) {
    m_page->setProgress(name, -1.0);
    return;
  }
  delete progress;
  show(Error{ErrorCode::machine_busy, {{"what", tr("%1 is still running").arg(m_bench.tasks().name()).toStdString()}}});
}

}  // namespace zerodrift::desktop
