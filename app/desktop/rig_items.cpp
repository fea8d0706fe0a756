// A profile as the items of the form and the lines of the table.

#include <cmath>
#include <nlohmann/json.hpp>

#include "app/desktop/rig_words.h"
#include "core/base/json.h"
#include "core/base/json_path.h"
#include "core/controller/device_templates.h"
#include "core/controller/register_map.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using controller::ProfileDraft;
using nlohmann::json;
using ui::FormField;
using ui::FormItem;

namespace {

QString text_of_value(const json* value) {
  if (value == nullptr || value->is_null()) return {};
  if (value->is_string()) return QString::fromStdString(value->get<std::string>());
  if (value->is_number()) return QString::number(value->get<double>(), 'g', 10);
  if (value->is_array()) {
    QStringList list;
    for (const json& one : *value) list << text_of_value(&one);
    return list.join(QStringLiteral(", "));
  }
  return QString::fromStdString(json_text(*value));
}

/// Fields of one object of the document.
class RigFields {
 public:
  explicit RigFields(const json& object) : m_object(object) {}
  FormField& add(const char* key, const QString& label, const QString& unit = {}, const QString& empty = {}) {
    FormField field;
    field.key = QString::fromLatin1(key);
    field.label = label;
    field.unit = unit;
    field.empty = empty;
    field.value = text_of_value(node_at(m_object, key));
    m_list.append(field);
    return m_list.last();
  }
  FormField& choose(const char* key, const QString& label, const QStringList& choices, const QString& otherwise = {}) {
    FormField& field = add(key, label);
    field.choices = choices;
    field.closed = true;
    if (field.value.isEmpty()) field.value = otherwise;
    return field;
  }
  QVector<FormField> list() const { return m_list; }

 private:
  const json& m_object;
  QVector<FormField> m_list;
};

QString word_at(const json& object, const char* key) {
  return text_of_value(node_at(object, key));
}

void choose_kind(RigFields& fields, const std::vector<const char*>& kinds) {
  FormField& field = fields.choose("kind", RigWords::tr("Kind"), {});
  for (const char* kind : kinds) field.choices << kindWords(kind);
  field.value = kindWords(field.value.toStdString());
  if (!field.choices.contains(field.value)) field.choices.prepend(field.value);
}

void add_link(RigFields& fields, const json& device) {
  if (word_at(device, "kind") == QStringLiteral("modbus-tcp")) {
    fields.add("host", RigWords::tr("Address"), {}, RigWords::tr("192.168.1.20, or a name"));
    fields.add("port", RigWords::tr("Port"), {}, QStringLiteral("502"));
  } else {
    fields.add("device", RigWords::tr("Serial port"), {}, QStringLiteral("/dev/serial/by-id/..."));
    fields.add("baud", RigWords::tr("Speed"), RigWords::tr("baud"), QStringLiteral("19200"));
    fields.choose(
        "parity", RigWords::tr("Parity"),
        {QStringLiteral("N  (%1)").arg(RigWords::tr("none")), QStringLiteral("E  (%1)").arg(RigWords::tr("even")),
         QStringLiteral("O  (%1)").arg(RigWords::tr("odd"))},
        QStringLiteral("E"));
    fields.choose("stop_bits", RigWords::tr("Stop bits"), {QStringLiteral("1"), QStringLiteral("2")},
                  QStringLiteral("1"));
  }
  fields.add("unit", RigWords::tr("Unit number"), {}, QStringLiteral("1"));
}

void add_map(RigFields& fields, const ProfileDraft& draft, const std::string& place, const json& device) {
  FormField& name = fields.add("register_map", RigWords::tr("Register map"));
  for (const std::string& map : controller::shipped_register_maps()) name.choices << QString::fromStdString(map);
  name.tip = RigWords::tr("A map of this program, or a path to one beside the profile");
  if (device.contains("register_map_document")) {
    name.empty = RigWords::tr("its own, in the profile");
    name.tip = RigWords::tr("Registers that were changed here are a part of the profile. Another map replaces them.");
  }
  const auto map = draft.map_at(place);
  const std::string shown = map ? mainRegister(*map) : std::string();
  if (shown.empty() || place == "controller") return;
  const controller::Register& entry = map->registers.at(shown);
  const json values = controller::to_json(entry);
  const auto field = [&](const char* key, const QString& label) -> FormField& {
    FormField& made = fields.add((std::string("register.") + key).c_str(), label);
    made.value = text_of_value(node_at(values, key));
    made.tip = RigWords::tr("Of register %1").arg(QString::fromStdString(shown));
    return made;
  };
  field("address", RigWords::tr("First register")).value = QString::number(entry.address);
  FormField& function = field("function", RigWords::tr("Function"));
  function.choices = {QStringLiteral("holding  (3)"), QStringLiteral("input  (4)")};
  function.closed = true;
  function.value =
      entry.space == controller::RegisterSpace::input ? QStringLiteral("input") : QStringLiteral("holding");
  FormField& type = field("type", RigWords::tr("Type"));
  type.choices = QStringList{"int16", "uint16", "int32", "uint32", "float32"};
  type.closed = true;
  field("count", RigWords::tr("Values")).value = QString::number(entry.count);
  field("scale", RigWords::tr("Scale")).value = QString::number(entry.sign * entry.scale, 'g', 8);
}

void add_times(RigFields& fields, const QString& stale) {
  fields.add("timeout_ms", RigWords::tr("Time-out"), QStringLiteral("ms"), QStringLiteral("1000"));
  fields.add("poll_period_s", RigWords::tr("Read every"), QStringLiteral("s"), QStringLiteral("1"));
  fields.add("stale_after_s", RigWords::tr("Missing after"), QStringLiteral("s"), stale).tip =
      RigWords::tr("Age from which a value that was not renewed is missing");
}

FormItem control_item(const ProfileDraft& draft, const json& control, const std::string& place) {
  FormItem item{QString::fromStdString(place), RigWords::tr("Control"), 1};
  RigFields fields(control);
  choose_kind(fields, {"manual", "modbus-tcp", "modbus-rtu"});
  if (word_at(control, "kind") == QStringLiteral("manual")) {
    fields.add("serial", RigWords::tr("Serial number"), {}, RigWords::tr("of the machine"));
  } else {
    add_link(fields, control);
    add_map(fields, draft, place, control);
    fields.add("timeout_ms", RigWords::tr("Time-out"), QStringLiteral("ms"), QStringLiteral("1000"));
  }
  item.fields = fields.list();
  return item;
}

FormItem device_item(const ProfileDraft& draft, const json& device, const std::string& place) {
  FormItem item{QString::fromStdString(place), word_at(device, "id"), 1, false, true};
  RigFields fields(device);
  fields.add("id", RigWords::tr("Name"));
  const QString kind = word_at(device, "kind");
  if (kind == QStringLiteral("mqtt")) {
    fields.add("host", RigWords::tr("Broker"), {}, RigWords::tr("192.168.1.20, or a name"));
    fields.add("port", RigWords::tr("Port"), {}, RigWords::tr("1883, or 8883 with TLS"));
    FormField& tls = fields.choose("tls", RigWords::tr("TLS"), {RigWords::tr("no"), RigWords::tr("yes")});
    tls.value = tls.value == QStringLiteral("true") ? RigWords::tr("yes") : RigWords::tr("no");
    fields.add("ca_file", RigWords::tr("Authority"), {}, RigWords::tr("the system's"));
    fields.add("credentials_file", RigWords::tr("Login file"), {}, RigWords::tr("none")).tip =
        RigWords::tr("Beside the profile, with user and password; only its owner may read it");
    add_times(fields, RigWords::tr("three periods of the slowest sensor"));
  } else if (kind == QStringLiteral("mtconnect")) {
    fields.add("url", RigWords::tr("Address"), {}, QStringLiteral("http://192.168.1.40:5000/"));
    fields.add("credentials_file", RigWords::tr("Login file"), {}, RigWords::tr("none"));
    add_times(fields, QStringLiteral("10"));
  } else {
    choose_kind(fields, {"modbus-tcp", "modbus-rtu"});
    add_link(fields, device);
    add_map(fields, draft, place, device);
    add_times(fields, QStringLiteral("10"));
  }
  item.fields = fields.list();
  return item;
}

FormItem camera_item(const json& camera, const std::string& place) {
  FormItem item{QString::fromStdString(place), word_at(camera, "id"), 1, false, true};
  RigFields fields(camera);
  fields.add("id", RigWords::tr("Name"));
  fields.add("url", RigWords::tr("Address"), {}, QStringLiteral("http://..., rtsp://..., /dev/video0, aravis:*"));
  fields.add("axes", RigWords::tr("Axes"), {}, QStringLiteral("X, Z")).tip =
      RigWords::tr("Machine axes that are seen to the right and up; the calibration finds scale and rotation");
  fields.add("target_roi_px", RigWords::tr("Target region"), QStringLiteral("px")).tip =
      RigWords::tr("x, y, width, height; or draw it in the preview");
  const bool stream = word_at(camera, "url").contains(QStringLiteral("://"));
  const QString as_set = stream ? RigWords::tr("set in the camera itself") : RigWords::tr("as the camera is set");
  fields.add("exposure_us", RigWords::tr("Exposure"), QStringLiteral("µs"), as_set);
  fields.add("gain_db", RigWords::tr("Gain"), QStringLiteral("dB"), as_set);
  fields.add("um_per_px_nominal", RigWords::tr("Expected scale"), QStringLiteral("µm/px"), RigWords::tr("not known"));
  item.fields = fields.list();
  return item;
}

FormItem machine_fields(const json& document) {
  FormItem item{machine_item, RigWords::tr("Machine"), 0};
  RigFields fields(document);
  fields.add("name", RigWords::tr("Name"));
  for (const char* axis : {"X", "Y", "Z"}) {
    fields.add((std::string("measure_position_mm.") + axis).c_str(), RigWords::tr("Measuring position %1").arg(axis),
               QStringLiteral("mm"), RigWords::tr("needed before a run, here or in its plan"));
  }
  FormField& source = fields.choose("errors.source", RigWords::tr("Errors by"), {});
  source.choices = {RigWords::tr("cameras"), probesWords()};
  source.value = source.value == QStringLiteral("probes") ? probesWords() : RigWords::tr("cameras");
  fields.add("calibration_span_mm", RigWords::tr("Calibration span"), QStringLiteral("mm"), QStringLiteral("1.6"));
  item.fields = fields.list();
  return item;
}

json list_in(const json& document, const char* key) {
  const auto at = document.find(key);
  return at != document.end() && at->is_array() ? *at : json::array();
}

std::string numbered(const char* key, std::size_t index) {
  return std::string(key) + "[" + std::to_string(index) + "]";
}

QString scale_of(const ProfileDraft& draft, const controller::SignalRow& row) {
  if (row.source.device.empty()) return {};
  const auto map = draft.map_at(controller::place_of_device(draft.document(), row.source.device));
  if (!map) return {};
  const auto* entry = map->find(row.source.signal.substr(0, row.source.signal.find('[')));
  return entry == nullptr ? QString() : QString::number(entry->sign * entry->scale, 'g', 8);
}

/// Digits by what the unit deserves.
int digits_of(const controller::SignalRow& row) {
  using controller::SignalUse;
  if (row.use == SignalUse::sensor || row.use == SignalUse::ambient) return 2;
  if (row.use == SignalUse::position) return 3;
  return row.use == SignalUse::probe ? 1 : 0;
}

}  // namespace

std::string mainRegister(const controller::RegisterMap& map) {
  for (const char* name : {"temperature_C", "probe_um"}) {
    if (map.find(name) != nullptr) return name;
  }
  return map.registers.empty() ? std::string() : map.registers.begin()->first;
}

QVector<FormItem> rigItems(const ProfileDraft& draft) {
  const json& document = draft.document();
  QVector<FormItem> items = {machine_fields(document)};
  const std::string control = controller::place_of_device(document, "");
  if (const json* entry = control.empty() ? nullptr : node_at(document, control);
      entry != nullptr && entry->is_object())
    items.append(control_item(draft, *entry, control));
  items.append(ui::headingItem(RigWords::tr("Devices")));
  const json devices = list_in(document, "devices");
  for (std::size_t i = 0; i < devices.size(); ++i) {
    const std::string place = numbered("devices", i);
    if (devices[i].is_object() && place != control) items.append(device_item(draft, devices[i], place));
  }
  items.append(ui::headingItem(RigWords::tr("Cameras")));
  const json cameras = list_in(document, "cameras");
  for (std::size_t i = 0; i < cameras.size(); ++i) {
    if (cameras[i].is_object()) items.append(camera_item(cameras[i], numbered("cameras", i)));
  }
  return items;
}

QVector<ui::FormOffer> rigOffers() {
  QVector<ui::FormOffer> offers;
  for (const auto& one : controller::device_templates()) {
    offers.append({QStringLiteral("template:") + QString::fromStdString(one.name), templateWords(one.name)});
  }
  for (const char* kind : {"modbus-rtu", "modbus-tcp", "mqtt", "mtconnect"}) {
    offers.append({QString::fromLatin1(kind), kindWords(kind)});
  }
  offers.append({QStringLiteral("camera"), RigWords::tr("Camera")});
  return offers;
}

QStringList signalsOf(const ProfileDraft& draft, const std::string& device) {
  QStringList list;
  if (device.empty()) return list;
  const auto map = draft.map_at(controller::place_of_device(draft.document(), device));
  if (!map) return list;
  for (const auto& [name, entry] : map->registers) {
    for (int i = 1; i <= entry.count && list.size() < 200; ++i) {
      list << QString::fromStdString(entry.count == 1 ? name : numbered(name.c_str(), static_cast<std::size_t>(i)));
    }
  }
  return list;
}

QVector<ui::SignalLine> rigLines(const ProfileDraft& draft, const Watches& watches, const SaidSignals& said) {
  const json* control = node_at(draft.document(), controller::place_of_device(draft.document(), ""));
  const bool linked = control != nullptr && word_at(*control, "kind") != QStringLiteral("manual");
  QVector<ui::SignalLine> lines;
  SaidSignals offered = said;
  for (const controller::SignalRow& row : controller::signal_rows(draft.document())) {
    ui::SignalLine line;
    line.name = quantityWords(row);
    line.sensor = row.use == controller::SignalUse::sensor;
    if (line.sensor) line.label = word_at(*node_at(draft.document(), row.place), "label");
    const bool own = row.source.device.empty();
    line.device = !own ? QString::fromStdString(row.source.device) : linked ? controlWords() : QString();
    line.signal = QString::fromStdString(own && linked ? controller::control_signal(row) : row.source.signal);
    if (!own && !offered.contains(row.source.device)) {
      offered[row.source.device] = signalsOf(draft, row.source.device);
    }
    if (!own) line.offered = offered[row.source.device];
    line.scale = scale_of(draft, row);
    line.unit = QString::fromLatin1(controller::range_of(row.use).unit);
    line.unit.replace(QStringLiteral("C"), QStringLiteral("°C")).replace(QStringLiteral("um"), QStringLiteral("µm"));
    if (row.name == "A" || row.name == "C") line.unit = QStringLiteral("°");
    if (const auto watch = watches.find(row.place); watch != watches.end()) {
      const auto& seen = watch->second;
      const int digits = digits_of(row);
      line.value = std::isfinite(seen.last()) ? ui::fixedText(seen.last(), digits) : QStringLiteral("–");
      if (std::isfinite(seen.change()))
        line.change = RigWords::tr("%1 since reading began").arg(ui::fixedText(seen.change(), digits));
      line.judgement = judgementOf(seen.judgement());
      line.state = plausibilityWords(seen.judgement());
    }
    lines.append(line);
  }
  return lines;
}

}  // namespace zerodrift::desktop
