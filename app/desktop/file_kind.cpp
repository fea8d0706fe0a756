#include "app/desktop/file_kind.h"

#include <QFile>
#include <QFileInfo>
#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/compensation/laser.h"
#include "core/recording/import/importer.h"

namespace zerodrift::desktop {
namespace {

FileKind kind_of_json(const QString& path) {
  const auto document = read_json_file(path.toStdString());
  if (!document || !document->is_object()) return FileKind::unknown;
  if (document->contains("controller")) return FileKind::profile;
  if (document->contains("steps")) return FileKind::plan;
  if (document->value("format", nlohmann::json()) == "zerodrift-machine/1" || document->contains("components")) {
    return FileKind::machine;
  }
  return FileKind::unknown;
}

/// The laser's reader knows its own tables. What else has a time is a recording; what has none is left to the laser's,
/// which asks what the columns are.
FileKind kind_of_table(const QString& path) {
  constexpr qint64 enough_bytes = 65536;
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return FileKind::laser;
  QByteArray head = file.read(enough_bytes);
  // Its last row may be cut.
  if (!file.atEnd() && head.contains('\n')) head.truncate(head.lastIndexOf('\n') + 1);
  const std::string bytes = head.toStdString();
  const std::string name = path.toStdString();
  const auto table = recording::parse_source_table(bytes, name);
  if (table && table->column("time_s") >= 0) return FileKind::recording;
  if (compensation::parse_laser(bytes, name)) return FileKind::laser;
  const auto time = table ? recording::read_time(*table, {}, std::vector<std::string>(table->columns()))
                          : Result<recording::TimeReading>(fail(ErrorCode::time_missing));
  if (time) return time->rule == "interval" ? FileKind::laser : FileKind::recording;
  // A time that is there but asks for a word of the user.
  return time.error().code == ErrorCode::time_missing ? FileKind::laser : FileKind::recording;
}

}  // namespace

FileKind kind_of_file(const QString& path) {
  const QFileInfo info(path);
  if (info.exists() && !info.isFile()) return FileKind::unknown;  // a pipe would keep the window waiting
  const QString ending = info.suffix().toLower();
  if (ending == QStringLiteral("zdj")) return FileKind::job;
  if (ending == QStringLiteral("json")) return kind_of_json(path);
  if (ending == QStringLiteral("rtl") || ending == QStringLiteral("ren") || ending == QStringLiteral("pos"))
    return FileKind::laser;
  if (ending == QStringLiteral("xlsx") || ending == QStringLiteral("lvm")) return FileKind::recording;
  for (const char* table : {"csv", "txt", "tsv", "dat", "asc"}) {
    if (ending == QLatin1String(table)) return kind_of_table(path);
  }
  return FileKind::unknown;
}

}  // namespace zerodrift::desktop
