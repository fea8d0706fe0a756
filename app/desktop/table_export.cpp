#include "app/desktop/table_export.h"

#include <QCoreApplication>
#include <QDir>
#include <QFileDialog>
#include <QFileInfo>
#include <algorithm>

#include "app/text/core_text.h"
#include "core/base/file.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using controller::ExportFormat;

namespace {

struct TableExport {
  Q_DECLARE_TR_FUNCTIONS(TableExport)
};

/// As in a list of file kinds.
QString filter_of(const ExportFormat& format) {
  return name_of_format(format) + QStringLiteral(" (*)");
}

QString id_of(const ExportFormat& format) {
  return QString::fromUtf8(format.id.data(), static_cast<int>(format.id.size()));
}

Status write_one(const ExportFormat& format, const compensation::Table& table, const controller::ExportOptions& options,
                 const QString& path, bool one_point, WrittenExport& out) {
  ZD_TRY(const auto made, one_point ? controller::write_one_point(format, table, options)
                                    : controller::write_table(format, table, options));
  for (const auto& file : made.files) {
    const std::string name = path.toStdString() + file.suffix;
    ZD_CHECK(write_file(name, file.text));
    out.files << QString::fromStdString(name);
  }
  for (const auto& line : made.losses) out.losses << coreText(line);
  for (const auto& line : made.confirm) out.confirm << coreText(line);
  out.loss_um = std::max(out.loss_um, made.loss_um);
  return {};
}

}  // namespace

QString name_of_format(const ExportFormat& format) {
  if (format.id == "linuxcnc") return TableExport::tr("LinuxCNC: screw compensation of one joint");
  if (format.id == "sinumerik-thermal") return TableExport::tr("SINUMERIK: temperature compensation");
  if (format.id == "sinumerik-leadscrew") return TableExport::tr("SINUMERIK: leadscrew error compensation");
  if (format.id == "fanuc") return TableExport::tr("FANUC: pitch error compensation");
  if (format.id == "heidenhain") return TableExport::tr("HEIDENHAIN: axis error compensation");
  return id_of(format);
}

Result<WrittenExport> write_export(const ExportFormat& format, const compensation::Table& table, const QString& path,
                                   bool one_point) {
  const bool one_axis = format.id == "linuxcnc" || format.id == "heidenhain";
  WrittenExport out;
  std::vector<std::string> axes;
  for (const auto& [name, axis] : table.axes) {
    if (axis.points.size() >= 2) axes.push_back(name);
  }
  if (!one_axis || axes.size() < 2) {
    controller::ExportOptions options;
    if (one_axis && axes.size() == 1) options.axis = axes.front();
    ZD_CHECK(write_one(format, table, options, path, one_point, out));
    return out;
  }
  const QFileInfo file(path);
  for (const auto& axis : axes) {
    controller::ExportOptions options;
    options.axis = axis;
    const QString ending = file.suffix().isEmpty() ? QString() : QLatin1Char('.') + file.suffix();
    const QString own = file.path() + QLatin1Char('/') + file.completeBaseName() + QLatin1Char('_') +
                        QString::fromStdString(axis) + ending;
    ZD_CHECK(write_one(format, table, options, own, one_point, out));
  }
  return out;
}

bool export_with_question(QWidget* parent, Workbench& bench, const compensation::Table& table,
                          const ExportFormat* format, bool one_point, const std::function<void(const Error&)>& show) {
  const QString own = TableExport::tr("Zerodrift table (*.json)");
  QStringList filters = {own};
  if (format == nullptr) {
    for (const auto& one : controller::export_formats()) filters << filter_of(one);
  } else {
    filters = {filter_of(*format)};
  }
  QString chosen;
  const QString name = format == nullptr ? QStringLiteral("/table.json") : QLatin1Char('/') + id_of(*format);
  const QString path = QFileDialog::getSaveFileName(parent, TableExport::tr("Export"), bench.folder() + name,
                                                    filters.join(QStringLiteral(";;")), &chosen);
  if (path.isEmpty()) return false;
  if (format == nullptr && chosen != own) {
    for (const auto& one : controller::export_formats()) {
      if (chosen == filter_of(one)) format = &one;
    }
  }
  if (format == nullptr) {
    if (const Status written = compensation::write_table_file(path.toStdString(), table); !written) {
      show(written.error());
      return false;
    }
    bench.log(LogKind::good, TableExport::tr("Table saved: %1").arg(path));
    return true;
  }
  const auto written = write_export(*format, table, path, one_point);
  if (!written) {
    show(written.error());
    return false;
  }
  bench.log(LogKind::good, TableExport::tr("Exported: %1").arg(ui::listText(written->files)));
  for (const auto& line : written->losses) bench.log(LogKind::warning, TableExport::tr("Lost: %1").arg(line));
  for (const auto& line : written->confirm) {
    bench.log(
        LogKind::warning,
        (one_point ? TableExport::tr("Expect: %1") : TableExport::tr("Confirm on one point first: %1")).arg(line));
  }
  return true;
}

}  // namespace zerodrift::desktop
