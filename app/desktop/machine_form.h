#pragma once
// The guided form in which a machine is described: holds machine.json while it is edited, has every change checked by
// its reader, offers typical values. The dialog itself knows no physics.

#include <QObject>
#include <QPointer>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/recording/recording.h"
#include "ui/widgets/machine_dialog.h"

namespace zerodrift::desktop {

/// What of the recording the form offers.
struct FormChannels {
  std::vector<std::string> temperatures;
  std::vector<std::string> rooms;
  std::vector<std::string> errors;
  std::vector<std::string> inputs;
};
FormChannels form_channels(const recording::Recording& run);

/// A start: a rod with the sensors along it, its end giving the errors.
nlohmann::json start_description(const FormChannels& channels);
/// The items of the form and the drawing; problems are not in them yet.
QVector<ui::FormItem> form_items(const nlohmann::json& machine, const FormChannels& channels);
ui::Sketch form_sketch(const nlohmann::json& machine, const QString& current);

/// "components[0].heat_sources[1]" in the document; null where there is nothing.
nlohmann::json* form_node(nlohmann::json& machine, const std::string& path);
/// Takes a value as it was entered; what cannot be one of the field stays as text, for the reader to refuse.
void form_edit(nlohmann::json& machine, const std::string& path, const std::string& key, const std::string& value);
/// Adds "rod", "lump", "source", "coupling", "sensor" or "displacement"; returns its path.
std::string form_add(nlohmann::json& machine, const std::string& kind, const std::string& current,
                     const FormChannels& channels);
void form_remove(nlohmann::json& machine, const std::string& path);

class MachineForm : public QObject {
  Q_OBJECT

 public:
  explicit MachineForm(QWidget* window);
  /// `machine`: what to begin with; null: a start made from the channels.
  void open(const nlohmann::json& machine, const FormChannels& channels);
  /// Null: it is not open.
  ui::MachineDialog* dialog() const { return m_dialog; }
  const nlohmann::json& machine() const { return m_machine; }

 Q_SIGNALS:
  void taken(const nlohmann::json& machine);

 private:
  void change(const std::function<void()>& edit);
  void undo();
  void load();
  void save();
  void refresh();
  void tellProblem(ui::MachineFormState& state) const;
  void tellProblem(ui::MachineFormState& state, const Error& error) const;
  QVector<ui::FormOffer> offers() const;

  QWidget* m_window;
  QPointer<ui::MachineDialog> m_dialog;
  nlohmann::json m_machine;
  FormChannels m_channels;
  QString m_current;
  struct Before {
    nlohmann::json machine;
    QString current;
  };
  std::vector<Before> m_before;
};

}  // namespace zerodrift::desktop
