// What the rail says of each step.

#include <algorithm>

#include "app/desktop/application.h"
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
      return tr("Out of date: %1 changed").arg(stepName(status.reason));
  }
  return {};
}

void Application::updateSteps() {
  const auto job = m_bench->job();
  if (job == nullptr) {
    for (auto* presenter : m_presenters) {
      m_window->setStepState(presenter->id(), ui::StepState::blocked, tr("Not started"));
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
    const bool made = status.state == flow::StepState::current || status.state == flow::StepState::stale;
    if (presenter->working()) {
      m_window->setStepState(presenter->id(), ui::StepState::running,
                             step || standing.words.isEmpty() ? tr("Running") : standing.words);
    } else if (!all || (made && m_bench->damage())) {  // what of it still holds nobody can say
      m_window->setStepState(presenter->id(), ui::StepState::failed, tr("The job is damaged"));
    } else if (!standing.words.isEmpty()) {
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
