#pragma once
// What went wrong in a run, in words: "controller busy, 12 times, asked again". Translatable.

#include <QString>

#include "core/acquisition/happening.h"

namespace zerodrift {

QString textOf(const acquisition::Happening& happening);

/// One word beside a sensor's reading: "dead" of sensor_dead.
QString markOf(ErrorCode sensorFault);

}  // namespace zerodrift
