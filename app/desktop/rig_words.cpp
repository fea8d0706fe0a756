#include "app/desktop/rig_words.h"

#include <array>

namespace zerodrift::desktop {

using controller::Plausibility;
using controller::SignalUse;

namespace {

constexpr std::array<const char*, 5> device_kinds = {"modbus-tcp", "modbus-rtu", "mqtt", "mtconnect", "manual"};

}  // namespace

QString kindWords(const std::string& kind) {
  if (kind == "modbus-tcp") return RigWords::tr("Modbus TCP");
  if (kind == "modbus-rtu") return RigWords::tr("Modbus RTU, serial line");
  if (kind == "mqtt") return RigWords::tr("MQTT broker");
  if (kind == "mtconnect") return RigWords::tr("MTConnect agent");
  if (kind == "manual") return RigWords::tr("By hand, no link");
  return QString::fromStdString(kind);
}

std::string kindOf(const QString& words) {
  for (const char* kind : device_kinds) {
    if (kindWords(kind) == words) return kind;
  }
  return words.toStdString();
}

QString templateWords(const std::string& name) {
  if (name == "temperature-module-8-pt100") return RigWords::tr("8 × PT100, hundredths of a degree");
  if (name == "temperature-module-8-pt100-tenths") return RigWords::tr("8 × PT100, tenths of a degree");
  if (name == "temperature-module-8-ds18b20") return RigWords::tr("8 × DS18B20");
  if (name == "probe-amplifier") return RigWords::tr("Probe amplifier, 5 channels");
  if (name == "probe-amplifier-4") return RigWords::tr("Probe amplifier, 4 channels");
  return QString::fromStdString(name);
}

QString quantityWords(const controller::SignalRow& row) {
  const QString name = QString::fromStdString(row.name);
  switch (row.use) {
    case SignalUse::sensor:
      return name;
    case SignalUse::ambient:
      return RigWords::tr("Room temperature");
    case SignalUse::speed:
      return RigWords::tr("Spindle speed");
    case SignalUse::load:
      return RigWords::tr("Spindle load");
    case SignalUse::coolant:
      return RigWords::tr("Coolant");
    case SignalUse::compensation_state:
      return RigWords::tr("Compensation switch");
    case SignalUse::position:
      return RigWords::tr("Position %1").arg(name);
    case SignalUse::probe:
      return RigWords::tr("Probe %1").arg(name);
  }
  return name;
}

QString plausibilityWords(Plausibility judgement) {
  switch (judgement) {
    case Plausibility::unknown:
      return {};
    case Plausibility::ok:
      return RigWords::tr("plausible");
    case Plausibility::unchanged:
      return RigWords::tr("never changes");
    case Plausibility::out_of_range:
      return RigWords::tr("out of range");
    case Plausibility::missing:
      return RigWords::tr("no value");
  }
  return {};
}

ui::Judgement judgementOf(Plausibility judgement) {
  switch (judgement) {
    case Plausibility::ok:
      return ui::Judgement::ok;
    case Plausibility::unchanged:
      return ui::Judgement::warn;
    case Plausibility::out_of_range:
    case Plausibility::missing:
      return ui::Judgement::bad;
    case Plausibility::unknown:
      break;
  }
  return ui::Judgement::none;
}

QString probesWords() {
  return RigWords::tr("displacement probes");
}

QString controlWords() {
  return RigWords::tr("the control");
}

}  // namespace zerodrift::desktop
