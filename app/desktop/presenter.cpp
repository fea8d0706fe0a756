#include "app/desktop/presenter.h"

#include "app/text/error_text.h"
#include "core/flow/flow.h"

namespace zerodrift::desktop {

using commissioning::Artefact;

Presenter::Presenter(Workbench& bench, ui::Page* page) : QObject(page), m_bench(bench), m_page(page) {
  connect(page, &ui::Page::cancelRequested, this, [this] { m_bench.tasks().cancel(); });
}

void Presenter::showOnly(const Error& error) {
  tell([error] {
    const ErrorText text = textOf(error, Reader::window);
    const bool cancelled = error.code == ErrorCode::cancelled;
    return ui::Problem{cancelled ? ui::ProblemKind::note : ui::ProblemKind::failure, text.sentence, text.remedy, {}};
  });
}

void Presenter::show(const Error& error) {
  showOnly(error);
  if (error.code != ErrorCode::cancelled) m_bench.log(LogKind::bad, textOf(error, Reader::window).sentence);
}

void Presenter::tell(std::function<ui::Problem()> problem) {
  const ui::Problem now = problem();
  m_page->setProblem(now);
  m_told = std::move(problem);
  m_toldText = now.sentence;
}

void Presenter::languageChanged() {
  const QString shown = m_page->problem().sentence;
  if (m_told && !shown.isEmpty() && shown == m_toldText) tell(m_told);
  refresh();
}

void Presenter::whenIdle(std::function<void()> act) {
  if (!m_bench.tasks().running()) {
    act();
    return;
  }
  connect(&m_bench.tasks(), &TaskRunner::finished, this, std::move(act), Qt::SingleShotConnection);
}

QObject* Presenter::beginTask(const QString& name) {
  m_page->clearProblem();
  if (m_bench.tasks().running()) return nullptr;  // its progress is another page's
  m_working = true;
  auto* progress = new QObject(this);
  connect(&m_bench.tasks(), &TaskRunner::progressed, progress,
          [this, name](double fraction, const QString&, double secondsLeft) {
            m_page->setProgress(name, fraction, secondsLeft < 0 ? std::nullopt : std::optional<double>(secondsLeft),
                                cancellable());
            if (const QString waits = waitsFor(); !waits.isEmpty()) m_page->setWaiting(waits);
          });
  m_page->setProgress(name, -1.0, std::nullopt, cancellable());
  return progress;
}

void Presenter::endTask(QObject* progress) {
  if (progress == nullptr) return;
  m_working = false;
  progress->deleteLater();
  progress->disconnect();
  m_page->clearProgress();
}

Presenter::Standing Presenter::tableStanding() const {
  const auto held = m_bench.heldTable();
  if (held != HeldTable::none && held != HeldTable::another) return {};
  if (m_bench.job() == nullptr || !m_bench.has("upload")) return {};
  if (flow::status_of(*m_bench.job(), id().toStdString()).state != flow::StepState::current) return {};
  return {held == HeldTable::none ? tr("The machine holds none") : tr("The machine holds another")};
}

QString Presenter::offlineReason() const {
  if (!m_bench.connected()) return tr("No machine is connected: connect it on the Machine page.");
  return m_bench.lost() ? tr("The controller does not answer.") : QString();
}

void Presenter::runStep(const QString& name, flow::StepRun work, std::function<void(bool good)> done, From from) {
  const auto job = m_bench.job();
  const std::string step = id().toStdString();
  const auto perform = [job, step, from, work = std::move(work)](const TaskContext& context) -> Result<Artefact> {
    if (job == nullptr) return fail(ErrorCode::step_blocked, {{"step", step}, {"needs", "a job"}});
    const flow::Flow flow;
    return from == From::job ? flow.perform(*job, step, work, context) : flow.take_in(*job, step, work, context);
  };
  runTask<Artefact>(name, perform, [this, done = std::move(done)](const Result<Artefact>& made) {
    if (made) m_bench.announce(*made);
    // What is kept renews the open page by itself.
    if (!made || !m_page->isVisible()) refresh();
    if (done) done(made.has_value());
  });
}

}  // namespace zerodrift::desktop
