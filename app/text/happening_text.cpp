#include "app/text/happening_text.h"

#include <QCoreApplication>
#include <QStringList>
#include <array>

#include "app/text/core_text.h"

namespace zerodrift {
namespace {

struct Row {
  const char* name;
  const char* words;
};

constexpr std::array rows = {
    Row{"gap", QT_TRANSLATE_NOOP("happenings", "gap in the recording")},
    Row{"interrupted", QT_TRANSLATE_NOOP("happenings", "recording interrupted")},
    Row{"machine_busy", QT_TRANSLATE_NOOP("happenings", "controller busy")},
    Row{"machine_gateway", QT_TRANSLATE_NOOP("happenings", "gateway without an answer from the controller")},
    Row{"machine_failed", QT_TRANSLATE_NOOP("happenings", "controller failed at a request")},
    Row{"machine_silent", QT_TRANSLATE_NOOP("happenings", "controller silent")},
    Row{"machine_bad_reply", QT_TRANSLATE_NOOP("happenings", "reply that does not belong to the question")},
    Row{"machine_link_lost", QT_TRANSLATE_NOOP("happenings", "connection to the controller lost")},
    Row{"machine_unreachable", QT_TRANSLATE_NOOP("happenings", "controller not reachable")},
    Row{"machine_not_stopped", QT_TRANSLATE_NOOP("happenings", "machine could not be stopped")},
    Row{"reply_in_pieces", QT_TRANSLATE_NOOP("happenings", "reply in pieces")},
    Row{"sensor_stuck", QT_TRANSLATE_NOOP("happenings", "sensor stuck")},
    Row{"sensor_dead", QT_TRANSLATE_NOOP("happenings", "sensor dead")},
    Row{"sensor_spiking", QT_TRANSLATE_NOOP("happenings", "sensor with spikes")},
    Row{"sensor_jumped", QT_TRANSLATE_NOOP("happenings", "sensor jumped")},
    Row{"sensor_swapped", QT_TRANSLATE_NOOP("happenings", "sensors swapped")},
    Row{"camera_frozen", QT_TRANSLATE_NOOP("happenings", "camera frozen")},
    Row{"camera_silent", QT_TRANSLATE_NOOP("happenings", "camera silent")},
    Row{"camera_unreachable", QT_TRANSLATE_NOOP("happenings", "camera not reachable")},
    Row{"camera_exchanged", QT_TRANSLATE_NOOP("happenings", "another camera than before")},
    Row{"camera_ambiguous", QT_TRANSLATE_NOOP("happenings", "several cameras")},
    Row{"camera_setting", QT_TRANSLATE_NOOP("happenings", "camera refuses a setting")},
    Row{"camera_format", QT_TRANSLATE_NOOP("happenings", "pixel format not read")},
    Row{"target_refused", QT_TRANSLATE_NOOP("happenings", "measurement refused")},
    Row{"target_partly_covered", QT_TRANSLATE_NOOP("happenings", "target partly occluded")},
    Row{"reference_lost", QT_TRANSLATE_NOOP("happenings", "reference mark not seen")},
    Row{"measuring_stretched", QT_TRANSLATE_NOOP("happenings", "measuring period stretched")},
    Row{"too_few_measurements", QT_TRANSLATE_NOOP("happenings", "too few measurements expected")},
    Row{"error_leapt", QT_TRANSLATE_NOOP("happenings", "leap of the error, refused")},
    Row{"leap_confirmed", QT_TRANSLATE_NOOP("happenings", "slip of the target, confirmed")},
    Row{"camera_late", QT_TRANSLATE_NOOP("happenings", "camera later than known")},
    Row{"disk_full", QT_TRANSLATE_NOOP("happenings", "disk full")},
};

QString wordsOf(const std::string& name) {
  for (const Row& row : rows) {
    if (name == row.name) return QCoreApplication::translate("happenings", row.words);
  }
  return QString::fromStdString(name).replace(QLatin1Char('_'), QLatin1Char(' '));
}

}  // namespace

QString textOf(const acquisition::Happening& happening) {
  QString text = wordsOf(happening.name);
  if (!happening.what.empty()) {
    QStringList what;
    for (const auto& one : happening.what) what << coreText(one);
    text += QStringLiteral(" (%1)").arg(what.join(QStringLiteral("; ")));
  }
  text = happening.count == 1
             ? QCoreApplication::translate("happenings", "%1, once").arg(text)
             : QCoreApplication::translate("happenings", "%1, %2 times").arg(text).arg(happening.count);
  return happening.overcome ? QCoreApplication::translate("happenings", "%1, asked again").arg(text) : text;
}

QString markOf(ErrorCode sensorFault) {
  const std::string name(name_of(sensorFault));
  return coreText(name.substr(name.find('_') + 1));
}

}  // namespace zerodrift
