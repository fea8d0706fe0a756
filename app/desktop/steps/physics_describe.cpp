// How the physics page comes to a description of the machine: a file, or a start made from the sensors.

#include <QDir>
#include <QFileDialog>
#include <QFileInfo>

#include "app/desktop/machine_form.h"
#include "app/desktop/steps/physics_presenter.h"
#include "core/base/json.h"
#include "core/flow/steps/describe_step.h"

namespace zerodrift::desktop {

void PhysicsPresenter::takeDescription(const nlohmann::json& machine, const QString& file) {
  m_page->clearProblem();
  const auto kept = bench().takeIn("describe", [&](commissioning::Job& job, const TaskContext&) {
    return flow::take_description(job, machine, file.toStdString());
  });
  if (!kept) return show(kept.error());
  m_component = 0;
  refresh();
}

void PhysicsPresenter::describe(const QString& path) {
  if (const Status idle = bench().idle(); !idle) return show(idle.error());
  if (!bench().has("warmup")) {
    show(Error{ErrorCode::step_blocked, {{"step", "describe"}, {"needs", "warmup"}}});
    return;
  }
  const auto machine = read_json_file(path.toStdString());
  if (!machine) return show(machine.error());
  takeDescription(*machine, QFileInfo(path).fileName());
}

void PhysicsPresenter::chooseDescription() {
  const QString path = QFileDialog::getOpenFileName(m_page, tr("Open a machine description"), bench().folder(),
                                                    tr("Machine descriptions (*.json)"));
  if (!path.isEmpty()) describe(path);
}

void PhysicsPresenter::describeByLumps() {
  if (const Status idle = bench().idle(); !idle) return show(idle.error());
  const auto header = bench().job()->header().value_or(commissioning::JobHeader{});
  const std::string name = header.machine.empty() ? tr("A lump for each sensor").toStdString() : header.machine;
  takeDescription(flow::lump_for_each_sensor(bench().warmupRun(), name), tr("a lump for each sensor"));
}

void PhysicsPresenter::describeByForm() {
  if (const Status idle = bench().idle(); !idle) return show(idle.error());
  if (m_form == nullptr) {
    m_form = new MachineForm(m_page->window());
    m_form->setParent(this);
    connect(m_form, &MachineForm::taken, this,
            [this](const nlohmann::json& machine) { takeDescription(machine, QStringLiteral("machine.json")); });
  }
  const auto own = flow::description_of(*bench().job());
  const nlohmann::json machine = own && *own ? (*own)->machine : nlohmann::json();
  m_form->open(machine, form_channels(bench().warmupRun()));
}

}  // namespace zerodrift::desktop
