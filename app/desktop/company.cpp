#include "app/desktop/company.h"

#include <QBuffer>
#include <QSettings>

namespace zerodrift::desktop {
namespace {

const QString address_key = QStringLiteral("report/company");
const QString logo_key = QStringLiteral("report/logo");

QByteArray png_of(const QImage& image) {
  QByteArray bytes;
  QBuffer buffer(&bytes);
  buffer.open(QIODevice::WriteOnly);
  if (!image.isNull()) image.save(&buffer, "PNG");
  return bytes;
}

}  // namespace

ui::Company keptCompany() {
  const QSettings settings;
  return {settings.value(address_key).toString(),
          QImage::fromData(QByteArray::fromBase64(settings.value(logo_key).toByteArray()), "PNG")};
}

void keepCompany(const ui::Company& company) {
  QSettings settings;
  settings.setValue(address_key, company.address);
  settings.setValue(logo_key, png_of(company.logo).toBase64());
}

void signWith(const ui::Company& company, report::Report& report) {
  for (const QString& line : company.address.split(QLatin1Char('\n'), Qt::SkipEmptyParts)) {
    report.company.push_back(line.trimmed().toStdString());
  }
  report.logo_png = png_of(company.logo).toStdString();
}

bool askCompany(QWidget* parent) {
  ui::CompanyDialog dialog(keptCompany(), parent);
  if (dialog.exec() != QDialog::Accepted) return false;
  keepCompany(dialog.company());
  return true;
}

}  // namespace zerodrift::desktop
