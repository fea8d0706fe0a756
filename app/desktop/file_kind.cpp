#include "app/desktop/file_kind.h"

#include <QFile>
#include <QFileInfo>
#include <QRegularExpression>
#include <nlohmann/json.hpp>

#include "core/base/json.h"

namespace zerodrift::desktop {
namespace {

FileKind kind_of_json(const QString& path) {
  const auto document = read_json_file(path.toStdString());
  if (!document || !document->is_object()) return FileKind::unknown;
  if (document->contains("controller")) return FileKind::profile;
  if (document->contains("steps")) return FileKind::plan;
  return FileKind::unknown;
}

/// A recording begins with a header whose first column is the time; anything else in a table is taken for a laser
/// report, whose reader knows many makes and says what it misses.
FileKind kind_of_table(const QString& path) {
  constexpr qint64 header_bytes = 16384;
  QFile file(path);
  if (!file.open(QIODevice::ReadOnly)) return FileKind::laser;
  QString header = QString::fromUtf8(file.read(header_bytes));
  header = header.section(QLatin1Char('\n'), 0, 0).remove(QChar(0xFEFF));
  const QStringList columns = header.split(QRegularExpression(QStringLiteral("[,;\\t]")));
  return columns.size() > 1 && columns.front().trimmed().remove(QLatin1Char('"')) == QStringLiteral("time_s")
             ? FileKind::recording
             : FileKind::laser;
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
  if (ending == QStringLiteral("csv") || ending == QStringLiteral("txt")) return kind_of_table(path);
  return FileKind::unknown;
}

}  // namespace zerodrift::desktop
