#include "app/desktop/moment.h"

#include <QCoreApplication>
#include <QLocale>

namespace zerodrift::desktop {
namespace {

struct Moment {
  Q_DECLARE_TR_FUNCTIONS(Moment)
};

QDateTime moment_of(const std::string& utc) {
  return QDateTime::fromString(QString::fromStdString(utc), Qt::ISODateWithMs);
}

QString written(const QDateTime& moment, const QString& format) {
  return moment.isValid() ? QLocale().toString(moment.toLocalTime(), format) : QString();
}

}  // namespace

QString momentText(const QDateTime& moment) {
  return written(moment, Moment::tr("d MMM yyyy, HH:mm", "date and time, as QLocale writes it"));
}

QString momentText(const std::string& utc) {
  return momentText(moment_of(utc));
}

QString shortMomentText(const std::string& utc) {
  return written(moment_of(utc), Moment::tr("d MMM HH:mm", "date and time, as QLocale writes it"));
}

}  // namespace zerodrift::desktop
