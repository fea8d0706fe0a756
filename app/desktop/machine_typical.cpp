#include "app/desktop/machine_typical.h"

#include <QCoreApplication>
#include <array>
#include <cmath>

namespace zerodrift::desktop {

using nlohmann::json;

namespace {

struct Typical {
  Q_DECLARE_TR_FUNCTIONS(Typical)
};

struct Material {
  const char* name;
  double conductivity_W_mK;
  double density_kg_m3;
  double heat_capacity_J_kgK;
  double expansion_1_K;
};

// At 20 degrees Celsius, as engineering handbooks list them; a grade differs by some per cent.
constexpr std::array materials = {
    Material{QT_TRANSLATE_NOOP("Typical", "Steel, unalloyed"), 45.0, 7850.0, 460.0, 1.15e-5},
    Material{QT_TRANSLATE_NOOP("Typical", "Bearing steel 100Cr6"), 42.0, 7830.0, 460.0, 1.2e-5},
    Material{QT_TRANSLATE_NOOP("Typical", "Stainless steel"), 15.0, 7900.0, 500.0, 1.6e-5},
    Material{QT_TRANSLATE_NOOP("Typical", "Grey cast iron"), 50.0, 7200.0, 500.0, 1.05e-5},
    Material{QT_TRANSLATE_NOOP("Typical", "Nodular cast iron"), 35.0, 7100.0, 510.0, 1.15e-5},
    Material{QT_TRANSLATE_NOOP("Typical", "Aluminium alloy"), 160.0, 2700.0, 900.0, 2.35e-5},
    Material{QT_TRANSLATE_NOOP("Typical", "Brass"), 115.0, 8450.0, 380.0, 1.9e-5},
    Material{QT_TRANSLATE_NOOP("Typical", "Mineral casting"), 2.0, 2300.0, 850.0, 1.5e-5},
    Material{QT_TRANSLATE_NOOP("Typical", "Granite"), 3.0, 2800.0, 800.0, 7e-6},
    Material{QT_TRANSLATE_NOOP("Typical", "Invar"), 11.0, 8100.0, 500.0, 1.5e-6},
};

// Boundary dimensions of dimension series 10 (ISO 15): bore and outside diameter in mm. The mean is that of both.
struct Bearing {
  const char* name;
  int bore_mm;
  int outside_mm;
};
constexpr std::array bearings = {Bearing{"7006", 30, 55},  Bearing{"7008", 40, 68},   Bearing{"7010", 50, 80},
                                 Bearing{"7012", 60, 95},  Bearing{"7014", 70, 110},  Bearing{"7016", 80, 125},
                                 Bearing{"7018", 90, 140}, Bearing{"7020", 100, 150}, Bearing{"7024", 120, 180}};

QString typical_choice(double value, const QString& what) {
  return QStringLiteral("%1  (%2)").arg(QString::number(value, 'g', 8), what);
}

json json_of_material(const Material& one) {
  return {{"conductivity_W_mK", one.conductivity_W_mK},
          {"density_kg_m3", one.density_kg_m3},
          {"heat_capacity_J_kgK", one.heat_capacity_J_kgK},
          {"expansion_1_K", one.expansion_1_K}};
}

}  // namespace

QStringList material_names() {
  QStringList names;
  for (const Material& one : materials) names << Typical::tr(one.name);
  return names;
}

json material_of(const QString& name) {
  for (const Material& one : materials) {
    if (Typical::tr(one.name) == name) return json_of_material(one);
  }
  return nullptr;
}

QString material_name(const json& material) {
  for (const Material& one : materials) {
    if (material == json_of_material(one)) return Typical::tr(one.name);
  }
  return {};
}

QStringList bearing_sizes() {
  QStringList list;
  for (const Bearing& one : bearings) {
    list << typical_choice(
        0.5 * (one.bore_mm + one.outside_mm),
        Typical::tr("%1, %2 × %3").arg(QString::fromLatin1(one.name)).arg(one.bore_mm).arg(one.outside_mm));
  }
  return list;
}

// Palmgren's f0 of angular contact ball bearings by lubrication, as bearing makers' catalogues give it.
QStringList bearing_lubrications() {
  return {typical_choice(1.7, Typical::tr("one row, oil mist or oil and air")),
          typical_choice(2.0, Typical::tr("one row, grease")), typical_choice(3.3, Typical::tr("one row, oil bath")),
          typical_choice(6.6, Typical::tr("two rows, oil bath"))};
}

QStringList oil_viscosities() {
  return {typical_choice(18.0, Typical::tr("spindle grease, warm")), typical_choice(22.0, "ISO VG 22"),
          typical_choice(32.0, "ISO VG 32"), typical_choice(46.0, "ISO VG 46"), typical_choice(68.0, "ISO VG 68")};
}

QStringList film_coefficients() {
  return {typical_choice(5.0, Typical::tr("still air, inside a cover")), typical_choice(10.0, Typical::tr("workshop")),
          typical_choice(25.0, Typical::tr("moved air, fan"))};
}

QStringList contact_conductances() {
  return {typical_choice(2.0, Typical::tr("through balls or rollers")),
          typical_choice(10.0, Typical::tr("small flange, bolted")),
          typical_choice(100.0, Typical::tr("large face, bolted and greased"))};
}

QStringList lump_capacities() {
  return {typical_choice(4600.0, Typical::tr("10 kg of steel")), typical_choice(23000.0, Typical::tr("50 kg of steel")),
          typical_choice(100000.0, Typical::tr("200 kg of cast iron"))};
}

QStringList sensor_accuracies() {
  return {typical_choice(0.1, Typical::tr("calibrated")),
          typical_choice(0.3, Typical::tr("resistance thermometer, class B")),
          typical_choice(1.5, Typical::tr("thermocouple"))};
}

json typical_source(const std::string& kind) {
  if (kind == "motor") {
    return {{"kind", kind}, {"rated_power_W", 5500}, {"efficiency", 0.9}, {"rated_speed_rpm", 8000}};
  }
  if (kind == "bearing") {
    return {{"kind", kind}, {"mean_diameter_mm", 65}, {"f0", 2.0},
            {"f1", 0.001},  {"load_N", 400},          {"oil_viscosity_mm2_s", 18}};
  }
  if (kind == "input") return {{"kind", kind}, {"power_unknown", true}, {"watts_per_unit", 1.0}};
  if (kind == "speed") return {{"kind", kind}, {"power_unknown", true}, {"law", {"on", "n", "n2"}}};
  return {{"kind", kind}, {"friction_N", 100}};
}

}  // namespace zerodrift::desktop
