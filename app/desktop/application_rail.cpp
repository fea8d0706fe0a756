// What the rail says of each step.

#include <algorithm>

#include "app/desktop/application.h"
#include "app/desktop/run_presenter.h"
#include "app/text/error_text.h"
#include "core/flow/flow.h"

namespace zerodrift::desktop {
namespace {

ui::StepState shown(flow::StepState state) {
  switch (state) {
    case flow::StepState::blocked:
      return ui::StepState::blocked;
    case flow::StepState::ready:
      return ui::StepState::ready;
    case flow::StepState::current:
      return ui::StepState::current;
    case flow::StepState::stale:
      return ui::StepState::stale;
    case flow::StepState::not_needed:
      return ui::StepState::notNeeded;
  }
  return ui::StepState::blocked;
}

}  // namespace

QString Application::wordsOf(const flow::StepStatus& status) const {
  switch (status.state) {
    case flow::StepState::blocked:
      return tr("Not started");
    case flow::StepState::ready:
      return tr("Ready");
    case flow::StepState::current:
      return tr("Done");
    case flow::StepState::stale:
      return tr("Out of date: %1", "which step changed").arg(stepName(status.reason));
    case flow::StepState::not_needed:
      return tr("Not needed");
  }
  return {};
}

void Application::tellNeed(Presenter& presenter, bool needed) {
  const QString id = presenter.id();
  QString reason;
  QStringList kept;
  QString action;
  const bool from_files = m_bench->kind() == commissioning::JobKind::files;
  if (needed) {
  } else if (!from_files && (id == QStringLiteral("upload") || id == QStringLiteral("verify"))) {
    reason = tr("The recording holds no error, so there is nothing to compensate.");
  } else if (id == QStringLiteral("machine")) {
    reason = tr("This job is made from files: no machine is connected, and nothing is written to one.");
    kept << QStringLiteral("job");
    action = tr("Use a machine with this job");
  } else if (id == QStringLiteral("calibrate")) {
    reason = tr("The errors of an imported recording are measured already: there is no camera to calibrate.");
  } else if (id == QStringLiteral("upload")) {
    reason = tr("There is no controller to write to. Export gives the table as a file that a controller loads.");
    kept << QStringLiteral("export");
  } else if (id == QStringLiteral("verify")) {
    reason =
        tr("What is left can only be measured on the machine, with the table active. The Fit page says what to "
           "expect on data that the model has not seen.");
  } else if (id == QStringLiteral("sensors") || id == QStringLiteral("fit")) {
    reason = tr("The recording holds no error, so there is nothing to fit. Its heat can be explained, in Physics.");
  } else {
    reason = tr("Compensating from this computer needs a connected machine.");
  }
  presenter.page()->setNotNeeded(reason, kept, action);
}

void Application::updateSteps() {
  const auto job = m_bench->job();
  if (job == nullptr) {
    for (auto* presenter : m_presenters) {
      m_window->setStepState(presenter->id(), ui::StepState::blocked, tr("Not started"));
      tellNeed(*presenter, true);
    }
    m_window->setJob(tr("No job"), {});
    return;
  }
  const flow::Flow flow;  // the states point into it
  const auto all = flow.status(*job);
  for (auto* presenter : m_presenters) {
    const std::string id = presenter->id().toStdString();
    const Presenter::Standing standing = presenter->standing();
    flow::StepStatus status;
    bool step = false;  // of the job
    if (all) {
      const auto at = std::find_if(all->begin(), all->end(), [&](const auto& one) { return one.step->id == id; });
      step = at != all->end();
      if (step) status = *at;
    }
    // The compensator on this computer is no step: it needs a machine all the same.
    const bool from_files = m_bench->kind() == commissioning::JobKind::files;
    if (from_files && id == "compensator") status.state = flow::StepState::not_needed;
    const bool needed = status.state != flow::StepState::not_needed;
    tellNeed(*presenter, needed);
    const bool made = status.state == flow::StepState::current || status.state == flow::StepState::stale;
    if (presenter->working()) {
      const auto* run = qobject_cast<const RunPresenter*>(presenter);
      const bool waits = run != nullptr && run->running() && m_bench->lost();
      m_window->setStepState(presenter->id(), ui::StepState::running,
                             waits                              ? tr("Controller lost")
                             : step || standing.words.isEmpty() ? tr("Running")
                                                                : standing.words);
    } else if (!all || (made && m_bench->damage())) {  // what of it still holds nobody can say
      m_window->setStepState(presenter->id(), ui::StepState::failed, tr("The job is damaged"));
    } else if (needed && !standing.words.isEmpty()) {
      m_window->setStepState(presenter->id(), standing.state, standing.words);
    } else {
      m_window->setStepState(presenter->id(), shown(status.state), wordsOf(status));
    }
  }
  const auto header = job->header().value_or(commissioning::JobHeader{});
  const QString name = header.machine.empty() ? tr("New job") : QString::fromStdString(header.machine);
  m_window->setJob(name, QString::fromStdString(job->path().filename().string()));
}

}  // namespace zerodrift::desktop
