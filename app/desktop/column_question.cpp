#include "app/desktop/column_question.h"

#include <QCoreApplication>
#include <QSettings>
#include <algorithm>
#include <array>
#include <cmath>

#include "app/text/error_text.h"
#include "ui/widgets/column_dialog.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using compensation::LaserColumn;
using compensation::LaserMapping;
using compensation::LaserPreview;

namespace {

struct ColumnQuestion {
  Q_DECLARE_TR_FUNCTIONS(ColumnQuestion)
};

// In the order of the dialog's lists.
constexpr std::array<double, 3> position_units_mm = {1.0, 1e-3, 25.4};
constexpr std::array<double, 6> error_units_um = {1.0, 1000.0, 25400.0, 0.0254, 25.4, 2.54};

/// -1: none of the list, then the guess stays.
template <std::size_t N>
int unit_of(const std::array<double, N>& units, double value) {
  constexpr double rounding = 1e-9;
  const auto at =
      std::find_if(units.begin(), units.end(), [&](double unit) { return std::abs(value - unit) < rounding * unit; });
  return at == units.end() ? -1 : static_cast<int>(at - units.begin());
}

QString settings_key(const LaserPreview& preview) {
  const QByteArray name =
      QByteArray::fromStdString(compensation::signature_of(preview)).toBase64(QByteArray::Base64UrlEncoding);
  return QStringLiteral("laserColumns/") + QString::fromLatin1(name);
}

ui::ColumnChoice choice_of(const LaserMapping& mapping) {
  ui::ColumnChoice choice;
  for (const LaserColumn column : mapping.columns) choice.roles.append(static_cast<int>(column));
  choice.positionUnit = unit_of(position_units_mm, mapping.mm_per_position);
  choice.errorUnit = unit_of(error_units_um, mapping.um_per_error);
  choice.negated = mapping.negated;
  choice.order = mapping.direction_from_order;
  return choice;
}

LaserMapping mapping_of(const ui::ColumnChoice& choice, const LaserMapping& guess) {
  LaserMapping mapping = guess;
  for (std::size_t i = 0; i < mapping.columns.size(); ++i) {
    mapping.columns[i] = static_cast<LaserColumn>(choice.roles.value(static_cast<int>(i)));
  }
  if (choice.positionUnit >= 0) {
    mapping.mm_per_position = position_units_mm.at(static_cast<std::size_t>(choice.positionUnit));
  }
  if (choice.errorUnit >= 0) mapping.um_per_error = error_units_um.at(static_cast<std::size_t>(choice.errorUnit));
  mapping.negated = choice.negated;
  mapping.direction_from_order = choice.order;
  return mapping;
}

void judge(ui::ColumnDialog& dialog, const std::string& bytes, const std::string& file, const LaserMapping& mapping) {
  compensation::LaserOptions options;
  options.mapping = mapping;
  const auto report = compensation::parse_laser(bytes, file, options);
  if (!report) {
    const ErrorText text = textOf(report.error(), Reader::window);
    return dialog.setVerdict(ui::sentencesText({text.sentence, text.remedy}), false);
  }
  double low = INFINITY;
  double high = -INFINITY;
  for (const auto& reading : report->readings) {
    low = std::min(low, reading.deviation_um);
    high = std::max(high, reading.deviation_um);
  }
  const QString both =
      report->bidirectional() ? ColumnQuestion::tr("both directions") : ColumnQuestion::tr("one direction");
  dialog.setVerdict(ColumnQuestion::tr("%1 targets from %2 to %3 mm, %4; errors from %5 to %6 µm")
                        .arg(report->targets_mm.size())
                        .arg(report->targets_mm.front())
                        .arg(report->targets_mm.back())
                        .arg(both)
                        .arg(low, 0, 'f', 1)
                        .arg(high, 0, 'f', 1),
                    true);
}

}  // namespace

std::optional<LaserMapping> remembered_mapping(const LaserPreview& preview) {
  const QString text = QSettings().value(settings_key(preview)).toString();
  auto mapping = compensation::mapping_from_text(text.toStdString(), preview.names.size());
  // Separator and place of the table are the file's own.
  if (mapping) {
    mapping->separator = preview.guess.separator;
    mapping->first_line = preview.guess.first_line;
    mapping->decimal_comma = preview.guess.decimal_comma;
  }
  return mapping;
}

void remember_mapping(const LaserPreview& preview, const LaserMapping& mapping) {
  QSettings().setValue(settings_key(preview), QString::fromStdString(compensation::text_of(mapping)));
}

std::optional<LaserMapping> ask_columns(QWidget* parent, const std::string& bytes, const std::string& file,
                                        const LaserPreview& preview) {
  QStringList names;
  for (const auto& name : preview.names) names << QString::fromStdString(name);
  QVector<QStringList> rows;
  for (const auto& cells : preview.rows) {
    QStringList row;
    for (const auto& cell : cells) row << QString::fromStdString(cell);
    rows.append(row);
  }
  const LaserMapping first = remembered_mapping(preview).value_or(preview.guess);
  ui::ColumnDialog dialog(names, rows, choice_of(first), parent);
  const auto look = [&] { judge(dialog, bytes, file, mapping_of(dialog.choice(), preview.guess)); };
  QObject::connect(&dialog, &ui::ColumnDialog::changed, &dialog, look);
  look();
  if (dialog.exec() != QDialog::Accepted) return std::nullopt;
  const LaserMapping mapping = mapping_of(dialog.choice(), preview.guess);
  remember_mapping(preview, mapping);
  return mapping;
}

}  // namespace zerodrift::desktop
