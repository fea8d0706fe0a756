#include "app/desktop/machine_form.h"

#include <QDir>
#include <QFileDialog>

#include "app/text/core_text.h"
#include "app/text/error_text.h"
#include "core/base/json.h"
#include "core/physics/machine.h"

namespace zerodrift::desktop {

using nlohmann::json;

MachineForm::MachineForm(QWidget* window) : QObject(window), m_window(window) {}

void MachineForm::open(const json& machine, const FormChannels& channels) {
  if (m_dialog) m_dialog->reject();
  m_channels = channels;
  m_machine = machine.is_object() ? machine : start_description(channels);
  m_before.clear();
  m_current = QStringLiteral("components[0]");
  m_dialog = new ui::MachineDialog(m_window);
  m_dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(m_dialog, &ui::MachineDialog::selected, this, [this](const QString& path) {
    m_current = path;
    refresh();
  });
  connect(m_dialog, &ui::MachineDialog::edited, this,
          [this](const QString& path, const QString& key, const QString& value) {
            change([&] { form_edit(m_machine, path.toStdString(), key.toStdString(), value.trimmed().toStdString()); });
          });
  connect(m_dialog, &ui::MachineDialog::addRequested, this, [this](const QString& kind) {
    change([&] {
      m_current = QString::fromStdString(form_add(m_machine, kind.toStdString(), m_current.toStdString(), m_channels));
    });
  });
  connect(m_dialog, &ui::MachineDialog::removeRequested, this, [this](const QString& path) {
    change([&] {
      form_remove(m_machine, path.toStdString());
      m_current.clear();
    });
  });
  connect(m_dialog, &ui::MachineDialog::undoRequested, this, &MachineForm::undo);
  connect(m_dialog, &ui::MachineDialog::openRequested, this, &MachineForm::load);
  connect(m_dialog, &ui::MachineDialog::exportRequested, this, &MachineForm::save);
  connect(m_dialog, &ui::MachineDialog::languageChanged, this, &MachineForm::refresh);
  connect(m_dialog, &QDialog::accepted, this, [this] { Q_EMIT taken(m_machine); });
  refresh();
  m_dialog->open();
}

void MachineForm::change(const std::function<void()>& edit) {
  Before before{m_machine, m_current};
  edit();
  if (before.machine != m_machine) m_before.push_back(std::move(before));
  refresh();
}

void MachineForm::undo() {
  if (m_before.empty()) return;
  m_machine = std::move(m_before.back().machine);
  m_current = m_before.back().current;
  m_before.pop_back();
  refresh();
}

void MachineForm::load() {
  const QString path = QFileDialog::getOpenFileName(m_dialog, tr("Open a machine description"), QDir::homePath(),
                                                    tr("Machine descriptions (*.json)"));
  if (path.isEmpty()) return;
  const auto machine = read_json_file(path.toStdString());
  if (machine && machine->is_object()) return change([&] { m_machine = *machine; });
  ui::MachineFormState state = m_dialog->state();
  const Error wrong{ErrorCode::wrong_format,
                    {{"file", path.toStdString()}, {"found", "no object"}, {"expected", "zerodrift-machine/1"}}};
  const ErrorText text = textOf(machine ? wrong : machine.error(), Reader::window);
  state.sentence = text.sentence;
  state.remedy = text.remedy;
  m_dialog->setState(state);
}

void MachineForm::save() {
  const QString path = QFileDialog::getSaveFileName(m_dialog, tr("Export the description"),
                                                    QDir::homePath() + QStringLiteral("/machine.json"),
                                                    tr("Machine descriptions (*.json)"));
  if (path.isEmpty()) return;
  if (const Status written = write_json_file(path.toStdString(), m_machine); !written) {
    ui::MachineFormState state = m_dialog->state();
    tellProblem(state, written.error());
    m_dialog->setState(state);
  }
}

QVector<ui::FormOffer> MachineForm::offers() const {
  const auto parts = m_machine.find("components");
  const bool some = parts != m_machine.end() && parts->is_array() && !parts->empty();
  return {{QStringLiteral("rod"), tr("Rod: spindle, screw, ram")},
          {QStringLiteral("lump"), tr("Lump: housing, column, motor body")},
          {QStringLiteral("source"), tr("Heat source of the selected part"), some},
          {QStringLiteral("coupling"), tr("Coupling of two parts"), some && parts->size() > 1},
          {QStringLiteral("sensor"), tr("Temperature sensor")},
          {QStringLiteral("displacement"), tr("Displacement")}};
}

void MachineForm::refresh() {
  if (!m_dialog) return;
  ui::MachineFormState state;
  state.items = form_items(m_machine, m_channels);
  const auto there = [&](const QString& path) {
    return std::any_of(state.items.begin(), state.items.end(), [&](const auto& one) { return one.path == path; });
  };
  if (m_current.isEmpty() || !there(m_current)) m_current = QStringLiteral("machine");
  state.current = m_current;
  state.sketch = form_sketch(m_machine, m_current);
  state.offers = offers();
  state.canUndo = !m_before.empty();
  tellProblem(state);
  m_dialog->setState(state);
}

void MachineForm::tellProblem(ui::MachineFormState& state) const {
  const auto read = physics::machine_from_json(m_machine, "machine.json");
  if (!read) tellProblem(state, read.error());
}

/// At its field where the form has one for it.
void MachineForm::tellProblem(ui::MachineFormState& state, const Error& error) const {
  const ErrorText text = textOf(error, Reader::window);
  state.sentence = text.sentence;
  state.remedy = text.remedy;
  const auto at = error.context.find("key");
  if (at == error.context.end()) return;
  const QString key = QString::fromStdString(at->second);
  const auto expected = error.context.find("expected");
  const QString wanted = expected == error.context.end() ? QString() : coreText(expected->second);
  for (ui::FormItem& item : state.items) {
    for (ui::FormField& field : item.fields) {
      const QString full =
          item.path == QStringLiteral("machine") ? field.key : item.path + QLatin1Char('.') + field.key;
      if (full != key) continue;
      field.problem = tr("Expected: %1").arg(wanted);
      state.sentence = error.code == ErrorCode::json_missing_key
                           ? tr("%1, %2: something must be entered.").arg(item.title, field.label)
                           : tr("%1, %2: this value cannot be.").arg(item.title, field.label);
      state.remedy = field.problem;
      return;
    }
  }
}

}  // namespace zerodrift::desktop
