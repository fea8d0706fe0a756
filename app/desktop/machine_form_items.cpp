// machine.json as the items and fields of the form.

#include <QCoreApplication>

#include "app/desktop/machine_form.h"
#include "app/desktop/machine_typical.h"

namespace zerodrift::desktop {

using nlohmann::json;
using ui::FormField;
using ui::FormItem;

namespace {

struct FormWords {
  Q_DECLARE_TR_FUNCTIONS(FormWords)
};

QString text_at(const json& object, const std::string& key) {
  const auto at = object.find(key);
  if (at == object.end() || at->is_null()) return {};
  if (at->is_string()) return QString::fromStdString(at->get<std::string>());
  if (at->is_number()) return QString::number(at->get<double>(), 'g', 10);
  if (at->is_boolean()) return at->get<bool>() ? FormWords::tr("yes") : FormWords::tr("no");
  return QString::fromStdString(at->dump());
}

json list_at(const json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_array() ? *at : json::array();
}

QStringList texts_of(const std::vector<std::string>& names) {
  QStringList list;
  for (const auto& name : names) list << QString::fromStdString(name);
  return list;
}

QStringList part_names(const json& machine, bool ambient) {
  QStringList list;
  for (const auto& part : list_at(machine, "components")) list << text_at(part, "id");
  if (ambient) list << QStringLiteral("ambient");
  return list;
}

bool is_lump(const json& part) {
  return part.is_object() && part.value("kind", json()) == "lump";
}

/// Fields of one object, in the order they are added.
class Fields {
 public:
  explicit Fields(const json& object) : m_object(object) {}
  FormField& add(const char* key, const QString& label, const QString& unit = {}) {
    FormField field;
    field.key = QString::fromLatin1(key);
    field.label = label;
    field.unit = unit;
    field.value = text_at(m_object, key);
    m_list.append(field);
    return m_list.last();
  }
  FormField& choose(const char* key, const QString& label, const QStringList& choices, bool closed = false) {
    FormField& field = add(key, label);
    field.choices = choices;
    field.closed = closed;
    if (closed && !field.choices.contains(field.value)) field.choices.prepend(field.value);
    return field;
  }
  QVector<FormField> list() const { return m_list; }

 private:
  const json& m_object;
  QVector<FormField> m_list;
};

const QString unit_mm = QStringLiteral("mm");

void add_rod(Fields& fields, const json& part) {
  fields.add("length_mm", FormWords::tr("Length"), unit_mm).tip =
      FormWords::tr("From the fixed end, where it is held along x, to its free end");
  fields.add("outer_diameter_mm", FormWords::tr("Outer diameter"), unit_mm);
  fields.add("bore_diameter_mm", FormWords::tr("Bore"), unit_mm).empty = FormWords::tr("none");
  const json material = part.value("material", json::object());
  FormField& named = fields.choose("material", FormWords::tr("Material"), material_names(), true);
  const QString known = material_name(material);
  named.choices.removeAll(named.value);
  named.value = known.isEmpty() ? FormWords::tr("other") : known;
  if (known.isEmpty()) named.choices.prepend(named.value);
  const auto number = [&](const char* key, const QString& label, const QString& unit) {
    fields.add(key, label, unit).value = text_at(material, std::string(key).substr(std::string("material.").size()));
  };
  number("material.conductivity_W_mK", FormWords::tr("Conductivity"), QStringLiteral("W/(m K)"));
  number("material.density_kg_m3", FormWords::tr("Density"), QStringLiteral("kg/m³"));
  number("material.heat_capacity_J_kgK", FormWords::tr("Heat capacity"), QStringLiteral("J/(kg K)"));
  number("material.expansion_1_K", FormWords::tr("Expansion"), QStringLiteral("1/K"));
}

void add_lump(Fields& fields) {
  const QString identified = FormWords::tr("not known: it is identified");
  FormField& capacity = fields.add("heat_capacity_J_K", FormWords::tr("Heat capacity"), QStringLiteral("J/K"));
  capacity.choices = lump_capacities();
  capacity.empty = identified;
  fields.add("area_mm2", FormWords::tr("Surface"), QStringLiteral("mm²")).empty = identified;
  FormField& boundary = fields.choose("prescribed", FormWords::tr("Its temperature is given"),
                                      {FormWords::tr("no"), FormWords::tr("yes")}, true);
  boundary.choices.removeAll(QString());
  if (boundary.value.isEmpty()) boundary.value = FormWords::tr("no");
  boundary.tip =
      FormWords::tr("The measured temperature is taken as it is, and not simulated: a bed, a cooling circuit");
}

FormItem part_item(const json& part, const std::string& path, int number) {
  FormItem item;
  item.path = QString::fromStdString(path);
  item.title = text_at(part, "id");
  item.depth = 1;
  item.removable = true;
  item.part = number;
  Fields fields(part);
  fields.add("id", FormWords::tr("Name"));
  if (is_lump(part)) {
    add_lump(fields);
  } else {
    add_rod(fields, part);
  }
  item.fields = fields.list();
  return item;
}

QStringList source_kinds() {
  const auto named = [](const char* kind, const QString& words) {
    return QStringLiteral("%1  (%2)").arg(QString::fromLatin1(kind), words);
  };
  return {named("motor", FormWords::tr("losses of a motor")),
          named("bearing", FormWords::tr("friction of a bearing")),
          named("nut", FormWords::tr("friction of a screw nut")),
          named("guide", FormWords::tr("friction of a guide")),
          named("input", FormWords::tr("watts by a logged channel")),
          named("speed", FormWords::tr("an unknown heat that follows the speed"))};
}

void add_source_kind(Fields& fields, const json& source, const FormChannels& channels) {
  const json kind = source.value("kind", json());
  const QStringList inputs = texts_of(channels.inputs);
  if (kind == "motor") {
    fields.add("rated_power_W", FormWords::tr("Rated power"), QStringLiteral("W"));
    fields.add("efficiency", FormWords::tr("Efficiency")).choices = {QStringLiteral("0.85"), QStringLiteral("0.9"),
                                                                     QStringLiteral("0.95")};
    fields.add("rated_speed_rpm", FormWords::tr("Rated speed"), QStringLiteral("rpm"));
  } else if (kind == "bearing") {
    fields.add("mean_diameter_mm", FormWords::tr("Mean diameter"), unit_mm).choices = bearing_sizes();
    fields.add("f0", FormWords::tr("Lubrication f0")).choices = bearing_lubrications();
    fields.add("f1", FormWords::tr("Load factor f1")).choices = {QStringLiteral("0.0005"), QStringLiteral("0.001")};
    fields.add("load_N", FormWords::tr("Load, preload"), QStringLiteral("N"));
    fields.add("oil_viscosity_mm2_s", FormWords::tr("Oil viscosity"), QStringLiteral("mm²/s")).choices =
        oil_viscosities();
  } else if (kind == "input") {
    fields.choose("channel", FormWords::tr("Channel"), inputs);
    fields.add("watts_per_unit", FormWords::tr("Heat for each unit"), QStringLiteral("W"));
  } else if (kind == "speed") {
    fields.choose("channel", FormWords::tr("Channel"), inputs).empty = QStringLiteral("spindle_rpm");
  } else {
    fields.choose("channel", FormWords::tr("Channel"), inputs);
    fields.add("friction_N", FormWords::tr("Friction"), QStringLiteral("N"));
  }
  if (kind == "input" || kind == "motor" || kind == "bearing") {
    FormField& unknown = fields.choose("power_unknown", FormWords::tr("Its size is not known"),
                                       {FormWords::tr("no"), FormWords::tr("yes")}, true);
    unknown.choices.removeAll(QString());
    if (unknown.value.isEmpty()) unknown.value = FormWords::tr("no");
  }
}

FormItem source_item(const json& source, const std::string& path, bool lump, int part, const FormChannels& channels) {
  FormItem item;
  item.path = QString::fromStdString(path);
  item.title = text_at(source, "id");
  item.depth = 2;
  item.removable = true;
  item.part = part;
  Fields fields(source);
  fields.add("id", FormWords::tr("Name"));
  FormField& kind = fields.add("kind", FormWords::tr("Kind"));
  kind.choices = source_kinds();
  kind.closed = true;
  if (!lump) {
    fields.add("from_mm", FormWords::tr("From"), unit_mm).tip = FormWords::tr("Place from the fixed end of the part");
    fields.add("to_mm", FormWords::tr("To"), unit_mm);
  }
  add_source_kind(fields, source, channels);
  item.fields = fields.list();
  return item;
}

bool on_rod(const json& machine, const QString& part) {
  for (const auto& one : list_at(machine, "components")) {
    if (text_at(one, "id") == part) return !is_lump(one);
  }
  return false;
}

FormItem sensor_item(const json& machine, const json& sensor, const std::string& path, const FormChannels& channels) {
  FormItem item;
  item.path = QString::fromStdString(path);
  item.title = text_at(sensor, "channel");
  item.depth = 1;
  item.removable = true;
  Fields fields(sensor);
  std::vector<std::string> all = channels.temperatures;
  all.insert(all.end(), channels.rooms.begin(), channels.rooms.end());
  fields.choose("channel", FormWords::tr("Channel"), texts_of(all));
  fields.choose("component", FormWords::tr("On"), part_names(machine, true), true).tip =
      FormWords::tr("ambient: it measures the room");
  if (on_rod(machine, text_at(sensor, "component"))) fields.add("position_mm", FormWords::tr("Position"), unit_mm);
  FormField& accuracy = fields.add("accuracy_C", FormWords::tr("Accuracy"), QStringLiteral("K"));
  accuracy.choices = sensor_accuracies();
  accuracy.empty = QStringLiteral("0.1");
  fields.add("lag_s", FormWords::tr("Lag"), QStringLiteral("s")).empty = QStringLiteral("0");
  item.fields = fields.list();
  return item;
}

FormItem displacement_item(const json& machine, const json& one, const std::string& path,
                           const FormChannels& channels) {
  FormItem item;
  item.path = QString::fromStdString(path);
  item.title = text_at(one, "channel");
  item.depth = 1;
  item.removable = true;
  Fields fields(one);
  fields.choose("channel", FormWords::tr("Channel"), texts_of(channels.errors));
  fields.choose("direction", FormWords::tr("Direction"), {"X", "Y", "Z", "unknown"}, true);
  fields.choose("component", FormWords::tr("Expansion of"), part_names(machine, false), true);
  FormField& sign = fields.add("sign", FormWords::tr("Sign"));
  sign.choices = {QStringLiteral("1"), QStringLiteral("-1")};
  sign.empty = QStringLiteral("1");
  sign.tip = FormWords::tr("-1: it counts against the growth of the part");
  fields.add("accuracy_um", FormWords::tr("What else may move it"), QStringLiteral("µm")).empty = QStringLiteral("0");
  item.fields = fields.list();
  return item;
}

FormItem coupling_item(const json& machine, const json& coupling, const std::string& path) {
  FormItem item;
  item.path = QString::fromStdString(path);
  item.depth = 1;
  item.removable = true;
  Fields fields(coupling);
  QStringList names;
  const json ends = list_at(coupling, "between");
  for (std::size_t e = 0; e < 2; ++e) {
    const json end = e < ends.size() && ends[e].is_object() ? ends[e] : json::object();
    const std::string key = "between[" + std::to_string(e) + "].";
    const QString part = text_at(end, "component");
    names << part;
    FormField& which =
        fields.choose((key + "component").c_str(), e == 0 ? FormWords::tr("First part") : FormWords::tr("Second part"),
                      part_names(machine, false), true);
    which.choices.removeAll(QString());
    which.value = part;
    if (on_rod(machine, part)) {
      fields.add((key + "position_mm").c_str(), FormWords::tr("at"), unit_mm).value = text_at(end, "position_mm");
    }
  }
  FormField& conductance = fields.add("conductance_W_K", FormWords::tr("Conductance"), QStringLiteral("W/K"));
  conductance.choices = contact_conductances();
  conductance.empty = FormWords::tr("not known: it is identified");
  item.title = names.join(QStringLiteral(" – "));
  item.fields = fields.list();
  return item;
}

FormItem machine_item(const json& machine) {
  FormItem item;
  item.path = QStringLiteral("machine");
  item.title = FormWords::tr("Machine");
  Fields fields(machine);
  fields.add("name", FormWords::tr("Name"));
  FormField& film =
      fields.add("effect_parameters.convection.h_W_m2K", FormWords::tr("Film to the air"), QStringLiteral("W/(m² K)"));
  film.choices = film_coefficients();
  film.empty = FormWords::tr("none");
  const json parameters = machine.value("effect_parameters", json::object());
  if (parameters.is_object() && parameters.contains("convection") && parameters["convection"].is_object()) {
    film.value = text_at(parameters["convection"], "h_W_m2K");
  }
  fields.add("initial_temperature_C", FormWords::tr("Temperature at the start"), QStringLiteral("°C")).empty =
      FormWords::tr("the first sample");
  item.fields = fields.list();
  return item;
}

}  // namespace

QVector<FormItem> form_items(const json& machine, const FormChannels& channels) {
  QVector<FormItem> items{machine_item(machine)};
  const auto indexed = [](const char* list, std::size_t i) {
    return std::string(list) + "[" + std::to_string(i) + "]";
  };
  const json parts = list_at(machine, "components");
  items.append(ui::headingItem(FormWords::tr("Parts and their heat")));
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const std::string path = indexed("components", p);
    items.append(part_item(parts[p], path, static_cast<int>(p)));
    const json sources = list_at(parts[p], "heat_sources");
    for (std::size_t s = 0; s < sources.size(); ++s) {
      items.append(source_item(sources[s], path + "." + indexed("heat_sources", s), is_lump(parts[p]),
                               static_cast<int>(p), channels));
    }
  }
  const auto add = [&](const char* key, const QString& title, const auto& make) {
    const json list = list_at(machine, key);
    if (!list.empty()) items.append(ui::headingItem(title));
    for (std::size_t i = 0; i < list.size(); ++i) items.append(make(list[i], indexed(key, i)));
  };
  add("couplings", FormWords::tr("Couplings"),
      [&](const json& one, const std::string& path) { return coupling_item(machine, one, path); });
  add("sensors", FormWords::tr("Temperature sensors"),
      [&](const json& one, const std::string& path) { return sensor_item(machine, one, path, channels); });
  add("displacements", FormWords::tr("Displacements"),
      [&](const json& one, const std::string& path) { return displacement_item(machine, one, path, channels); });
  return items;
}

}  // namespace zerodrift::desktop
