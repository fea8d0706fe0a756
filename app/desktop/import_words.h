#pragma once
// Between the importer and its dialog: what a column is in words, and what a choice in the dialog means for the map.

#include "app/desktop/recording_import.h"

namespace zerodrift::desktop {

/// One reading with this map.
ImportReading read_for_import(const std::string& bytes, const std::string& file, const recording::HeaderMap& map);
ui::ImportState import_state(const ImportReading& reading, const recording::HeaderMap& map);
/// `before`: as the column was shown when it was changed.
void change_map(recording::HeaderMap& map, const std::string& key, const ui::ImportColumn& before,
                const ui::ImportColumn& column);
/// What the job keeps of an import, as the command `import` does.
nlohmann::json how_imported(const recording::Imported& imported, const recording::HeaderMap& map);

}  // namespace zerodrift::desktop
