#pragma once
// Typical values of a machine's parts, as data sheets and handbooks give them: materials, spindle bearings by size,
// oils, films, contacts.

#include <QStringList>
#include <nlohmann/json.hpp>
#include <string>

namespace zerodrift::desktop {

/// Names of the materials, and the material of a name; null for another word.
QStringList material_names();
nlohmann::json material_of(const QString& name);
/// The material whose numbers these are; "" for others.
QString material_name(const nlohmann::json& material);

/// As choices of a field: the value, then what it is, in brackets.
QStringList bearing_sizes();         // mean diameter
QStringList bearing_lubrications();  // f0
QStringList oil_viscosities();
QStringList film_coefficients();
QStringList contact_conductances();
QStringList lump_capacities();
QStringList sensor_accuracies();

/// A heat source of this kind with typical values, without id and place.
nlohmann::json typical_source(const std::string& kind);

}  // namespace zerodrift::desktop
