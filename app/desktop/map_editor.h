#pragma once
// The register map on the machine page: a draft that is edited, read live and, when it is saved, used.

#include <QObject>
#include <optional>

#include "app/desktop/workbench.h"
#include "ui/pages/machine_page.h"

namespace zerodrift::desktop {

class MapEditor : public QObject {
  Q_OBJECT

 public:
  MapEditor(Workbench& bench, ui::MachinePage* page);

  /// Rows, names and notes; values from the last look.
  void fill(ui::MachineState& state);
  bool changed() const { return m_changed; }
  /// Takes a list or a map as the draft.
  Status import(const QString& path);
  /// Writes the draft and lets the profile use it.
  Status save(const QString& path);

 Q_SIGNALS:
  void draftChanged();
  void refused(const zerodrift::Error& error);

 private:
  void load();
  void edit(int row, int column, const QString& text);
  void add();
  void remove(int row);
  void chooseImport();
  void chooseSave();
  void watch();
  Status take(const nlohmann::json& document);
  std::vector<std::string> order() const;

  Workbench& m_bench;
  ui::MachinePage* m_page;
  std::optional<controller::RegisterMap> m_draft;
  std::string m_of;  // the profile and map the draft was made from
  bool m_changed = false;
  bool m_shown = false;
};

}  // namespace zerodrift::desktop
