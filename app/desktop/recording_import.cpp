#include "app/desktop/recording_import.h"

#include <QCryptographicHash>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <QSettings>

#include "app/desktop/import_words.h"
#include "app/text/error_text.h"
#include "core/base/file.h"
#include "core/base/json.h"

namespace zerodrift::desktop {

using recording::HeaderMap;

namespace {

/// Files with the same columns share a map.
QString settings_key(const std::vector<std::string>& names) {
  QCryptographicHash hash(QCryptographicHash::Sha256);
  for (const std::string& name : names) hash.addData(QByteArray::fromStdString(name + '\n'));
  return QStringLiteral("importMaps/") + QString::fromLatin1(hash.result().toHex());
}

bool fits(const HeaderMap& map, const ImportReading& reading) {
  return !map.columns.empty() && map.names_without_column(reading.names, {}).empty();
}

}  // namespace

RecordingImport::RecordingImport(QWidget* window) : QObject(window), m_window(window) {}

RecordingImport::~RecordingImport() {
  m_reader.end();
}

QString RecordingImport::file() const {
  return QFileInfo(m_path).fileName();
}

void RecordingImport::open(const QString& path, const nlohmann::json& kept, const QVector<Place>& places) {
  if (m_dialog) m_dialog->reject();
  m_path = path;
  m_places = places;
  m_place = 0;
  m_kept = kept;
  m_bytes.reset();
  m_map = {};
  m_reading = {};
  m_reused = false;
  m_dialog = new ui::ImportDialog(m_window);
  m_dialog->setAttribute(Qt::WA_DeleteOnClose);
  connect(m_dialog, &ui::ImportDialog::columnEdited, this, &RecordingImport::editColumn);
  connect(m_dialog, &ui::ImportDialog::tableEdited, this, &RecordingImport::editTable);
  connect(m_dialog, &ui::ImportDialog::placeChosen, this, [this](int place) {
    m_place = place;
    refresh();
  });
  connect(m_dialog, &ui::ImportDialog::mapLoadRequested, this, &RecordingImport::loadMap);
  connect(m_dialog, &ui::ImportDialog::mapSaveRequested, this, &RecordingImport::saveMap);
  connect(m_dialog, &QDialog::accepted, this, &RecordingImport::take);
  read();
  refresh();
  m_dialog->open();
}

void RecordingImport::read() {
  m_dialog->setReading();
  m_again = m_reader.running();
  if (m_again) return;
  const auto work = [path = m_path.toStdString(), bytes = m_bytes, name = file().toStdString(), map = m_map](
                        const TaskContext&) -> Result<std::pair<std::shared_ptr<const std::string>, ImportReading>> {
    auto kept = bytes;
    if (kept == nullptr) {
      ZD_TRY(kept, read_file(path).map(
                       [](std::string text) { return std::make_shared<const std::string>(std::move(text)); }));
    }
    auto reading = read_for_import(*kept, name, map);
    return std::pair(std::move(kept), std::move(reading));
  };
  m_reader.start<std::pair<std::shared_ptr<const std::string>, ImportReading>>(
      tr("Reading the file"), work, [this, path = m_path](auto made) {
        if (!m_dialog) return;              // cancelled meanwhile
        if (path != m_path) return read();  // another file was opened meanwhile
        if (made) {
          m_bytes = made->first;
          return showReading(std::move(made->second));
        }
        ImportReading reading;
        reading.problem = made.error();
        showReading(std::move(reading));
      });
}

void RecordingImport::showReading(ImportReading reading) {
  m_reading = std::move(reading);
  if (m_again || reuseMap()) return read();
  refresh();
}

/// The map of the last file with these columns, or of the run in the job; once for each file.
bool RecordingImport::reuseMap() {
  if (m_reused || m_reading.names.empty()) return false;
  m_reused = true;
  const QString text = QSettings().value(settings_key(m_reading.names)).toString();
  for (const auto& document : {parse_json(text.toStdString(), "map").value_or(nlohmann::json()), m_kept}) {
    const auto map = recording::header_map_from_json(document, "map", nullptr);
    if (!map || !fits(*map, m_reading)) continue;
    m_map = *map;
    return true;
  }
  return false;
}

void RecordingImport::refresh() {
  if (!m_dialog) return;
  ui::ImportState state = import_state(m_reading, m_map);
  state.file = file();
  state.take = m_places.value(m_place).take;
  state.place = m_place;
  for (const Place& place : std::as_const(m_places)) {
    if (!place.name.isEmpty()) state.places << place.name;
  }
  state.reading = m_reader.running();
  if (state.ready) state.notes.prepend(tr("It must have been recorded with the compensation off."));
  if (m_bytes == nullptr && !m_reading.problem) {
    state.form = tr("Reading the file");
    state.ready = false;
  }
  m_dialog->setState(state);
}

void RecordingImport::editColumn(int row, const ui::ImportColumn& before, const ui::ImportColumn& column) {
  const auto at = static_cast<std::size_t>(row);
  if (at >= m_reading.keys.size()) return;
  change_map(m_map, m_reading.keys[at], before, column);
  read();
}

void RecordingImport::editTable(const ui::ImportTable& table) {
  m_map.table.decimal = table.decimal.toStdString();
  m_map.table.separator = table.separator.toStdString();
  m_map.table.sheet = table.sheet.toStdString();
  m_map.missing.clear();
  for (const QString& word : table.missing) m_map.missing.push_back(word.toStdString());
  read();
}

void RecordingImport::loadMap() {
  const QString path =
      QFileDialog::getOpenFileName(m_dialog, tr("Header map"), QFileInfo(m_path).path(), tr("Header maps (*.json)"));
  if (path.isEmpty()) return;
  const auto map = recording::read_header_map(path.toStdString(), nullptr);
  if (map) {
    m_map = *map;
    return read();
  }
  ui::ImportState state = m_dialog->state();
  const ErrorText text = textOf(map.error(), Reader::window);
  state.sentence = text.sentence;
  state.remedy = text.remedy;
  m_dialog->setState(state);
}

void RecordingImport::saveMap() {
  if (!m_reading.imported) return;
  const QString proposal = QDir(QFileInfo(m_path).path()).filePath(QFileInfo(m_path).completeBaseName() + "-map.json");
  const QString path = QFileDialog::getSaveFileName(m_dialog, tr("Save map"), proposal, tr("Header maps (*.json)"));
  if (path.isEmpty()) return;
  if (const Status written = write_json_file(path.toStdString(), recording::map_of(*m_reading.imported, m_map));
      !written) {
    m_reading.problem = written.error();
    refresh();
  }
}

void RecordingImport::take() {
  if (!m_reading.imported) return;
  if (!m_map.columns.empty() || !m_map.time.columns.empty()) {
    QSettings().setValue(settings_key(m_reading.names), QString::fromStdString(json_text(recording::to_json(m_map))));
  }
  Q_EMIT taken(m_reading.imported->recording, file(), how_imported(*m_reading.imported, m_map), m_place);
}

}  // namespace zerodrift::desktop
