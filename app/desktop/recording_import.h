#pragma once
// The dialog in which a logger's file becomes a recording: reads it as the command `import` does, with each change of
// the map, and remembers the map for files with the same columns.

#include <QObject>
#include <QPointer>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "app/tasks/task_runner.h"
#include "core/recording/import/importer.h"
#include "ui/widgets/import_dialog.h"

namespace zerodrift::desktop {

/// What one reading of the file gave: its table, and the recording or what stands in its way.
struct ImportReading {
  recording::TableForm form;
  std::vector<std::string> names;              // of the columns; "" where there is none
  std::vector<std::string> keys;               // by which a map calls them
  std::vector<std::vector<std::string>> rows;  // the first
  std::vector<std::size_t> times;              // columns of the time, where it could be read
  std::optional<recording::Imported> imported;
  std::optional<Error> problem;
};

class RecordingImport : public QObject {
  Q_OBJECT

 public:
  explicit RecordingImport(QWidget* window);
  ~RecordingImport() override;

  /// Reads the file and shows what it is. `kept`: the map of the run that the job holds, used when its columns are
  /// here. `places`: where in the job it can go, and what the button says for each; the first is proposed.
  struct Place {
    QString name;  // empty where there is one place alone
    QString take;
  };
  void open(const QString& path, const nlohmann::json& kept, const QVector<Place>& places);
  /// Null: nothing is being imported.
  ui::ImportDialog* dialog() const { return m_dialog; }

 Q_SIGNALS:
  /// `how`: what the job keeps of it; the map is in it.
  void taken(const zerodrift::recording::Recording& run, const QString& name, const nlohmann::json& how, int place);

 private:
  void read();
  void showReading(ImportReading reading);
  bool reuseMap();
  void refresh();
  void editColumn(int row, const ui::ImportColumn& before, const ui::ImportColumn& column);
  void editTable(const ui::ImportTable& table);
  void loadMap();
  void saveMap();
  void take();
  QString file() const;

  QWidget* m_window;
  QPointer<ui::ImportDialog> m_dialog;
  TaskRunner m_reader;
  QString m_path;
  QVector<Place> m_places;
  int m_place = 0;
  std::shared_ptr<const std::string> m_bytes;
  recording::HeaderMap m_map;
  nlohmann::json m_kept;
  ImportReading m_reading;
  bool m_again = false;   // the map changed while it was read
  bool m_reused = false;  // looked for a map already
};

}  // namespace zerodrift::desktop
