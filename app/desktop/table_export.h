#pragma once
// Writes a table into the files of a controller, chosen by the user; what is lost and what must be confirmed is said.

#include <QWidget>

#include "app/desktop/workbench.h"
#include "core/controller/exports/export_format.h"

namespace zerodrift::desktop {

/// As people call it: "FANUC: pitch error compensation".
QString name_of_format(const controller::ExportFormat& format);

struct WrittenExport {
  QStringList files{};
  QStringList losses{};
  QStringList confirm{};
  double loss_um = 0.0;
};

/// Formats with one axis a file are written once for each axis that has points; the axis then stands in the name.
Result<WrittenExport> write_export(const controller::ExportFormat& format, const compensation::Table& table,
                                   const QString& path, bool one_point);

/// Asks for the format (when `format` is null) and the file. False when the user gave up or it failed; errors through
/// `show`.
bool export_with_question(QWidget* parent, Workbench& bench, const compensation::Table& table,
                          const controller::ExportFormat* format, bool one_point,
                          const std::function<void(const Error&)>& show);

}  // namespace zerodrift::desktop
