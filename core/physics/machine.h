#pragma once
// The machine description "zerodrift-machine/1": rods and lumps, what heats them, what joins them, where the sensors
// sit. x runs along a rod from its fixed end (0) to its free end. SI inside formulas; the file's units stand in the
// names. What the file leaves open stays open here (std::optional): the diagnosis identifies it, the simulation says
// so.

#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/base/result.h"

namespace zerodrift::physics {

struct Material {
  double conductivity_W_mK = 0.0;
  double density_kg_m3 = 0.0;
  double heat_capacity_J_kgK = 0.0;
  double expansion_1_K = 0.0;
};

enum class SourceKind { motor, bearing, input, speed, nut, guide };

/// Cooling jacket of a motor, laminar flow: Nu = 1.86 (Re Pr D/L)^(1/3) (Sieder and Tate 1936).
struct CoolingJacket {
  double flow_L_min = 0.0;
  double channel_diameter_mm = 0.0;
  double channel_length_mm = 0.0;
  double area_mm2 = 0.0;
  double conductivity_W_mK = 0.6;
  double density_kg_m3 = 998.0;
  double heat_capacity_J_kgK = 4182.0;
  double viscosity_mm2_s = 1.0;
  double coolant_temperature_C = 20.0;
};

struct HeatSource {
  std::string id;
  SourceKind kind = SourceKind::motor;
  double from_mm = 0.0;  // rods only
  double to_mm = 0.0;
  double rated_power_W = 0.0;  // motor
  double efficiency = 1.0;
  double rated_speed_rpm = 1.0;
  std::optional<CoolingJacket> jacket;
  double mean_diameter_mm = 0.0;  // bearing (Palmgren)
  double f0 = 0.0;
  double f1 = 0.0;
  double load_N = 0.0;
  double oil_viscosity_mm2_s = 0.0;
  std::string channel;                      // input, speed, nut, guide
  double watts_per_unit = 0.0;              // input
  double friction_N = 0.0;                  // nut, guide
  std::vector<std::string> law;             // speed: "on", "n", "n2"
  std::map<std::string, double> law_watts;  // speed: heat of each term at full speed, when known
  double full_speed_rpm = 0.0;              // speed: what "n" = 1 means; 0: the recording's largest
  bool power_unknown = false;
  double scale = 1.0;  // correction of the whole source, written by a refined description
};

/// A rod is rarely one body: a shaft turns in its cartridge, and even solid steel is warmer where the heat enters than
/// at its axis. Then the rod's surface is one chain of cells and its inside another, joined along the whole length and
/// at the bearings; sensors and films sit on the surface, the length follows the inside.
struct InnerBody {
  double section_share = 0.5;                 // of the rod's section
  double coupling_W_mK = 500.0;               // per metre of rod, at rest
  double coupling_rise = 0.0;                 // how much more at full speed, relative; grows with the root of the speed
  double growth_share = 0.5;                  // the length is the inside's (1) or the surface's (0)
  std::map<std::string, double> heat_share;   // heat source -> the part of it that enters the inside
  std::map<std::string, double> contact_W_K;  // bearing -> across it
  /// Sensor -> what it shows above its section's mean, K per W of the source it sits on: the field there is not one of
  /// rings. With the source's nominal heat, late by near_lag_s.
  std::map<std::string, double> near_field_K_W;
  double near_lag_s = 60.0;
  bool shaft_in_cartridge = false;  // else solid
};

struct Component {
  std::string id;
  bool lump = false;
  bool prescribed = false;  // its measured temperature is a boundary
  double length_mm = 0.0;
  double outer_diameter_mm = 0.0;
  double bore_diameter_mm = 0.0;
  Material material;
  std::optional<double> heat_capacity_J_K;  // lumps
  std::optional<double> area_mm2;           // lumps: surface towards the room
  bool capacity_is_guessed = false;         // not described: identified (unknown_sizes.h)
  bool area_is_guessed = false;
  std::vector<HeatSource> sources;
  std::optional<InnerBody> inner;  // rods
  /// Rods: how much better each of as many equal stretches conducts along the rod than the described section; empty:
  /// all as described.
  std::vector<double> conduction_shares;
  double conduction_sigma = 0.0;  // of ln(share): how uneven the rod may be. Not in machine.json
  double section_m2() const;
  double perimeter_m() const;
  /// The source that a sensor at this place sits on, within a quarter of the diameter; null: none.
  const HeatSource* source_near(double position_mm) const;
};

struct CouplingEnd {
  std::string component;
  double position_mm = 0.0;
};

struct Coupling {
  CouplingEnd first;
  CouplingEnd second;
  std::optional<double> conductance_W_K;
};

/// What tells a coupling's parameter apart: the two components, and which of the couplings between them.
std::string coupling_name(const std::vector<Coupling>& couplings, std::size_t index);

struct Fluid {
  std::string id;
  std::string temperature_channel;
  std::string flow_channel;  // empty: none
  bool always_on = false;
};

/// The air around the machine.
struct Room {
  std::string channel = "ambient_C";    // empty: not logged
  std::optional<double> temperature_C;  // a known constant when not logged
  double sigma_C = 0.7;                 // how well the start temperature stands for it when not logged
};

struct Sensor {
  std::string channel;
  std::string component;  // "ambient": the room
  double position_mm = 0.0;
  double accuracy_C = 0.1;
  double lag_s = 0.0;        // how late it shows its part's temperature
  double lag_sigma_s = 0.0;  // how much later it may be; 0: as described. Not in machine.json
};

struct Displacement {
  std::string channel;
  std::string direction;
  std::string component;  // empty: unknown
  double sign = 1.0;
  double accuracy_um = 0.0;  // 1 sigma: what parts that are not described may add to it, slowly
};

/// One effect that the model includes beside conduction and the listed sources.
struct EffectSpec {
  std::string id;
  bool candidate = false;  // a hypothesis of the diagnosis: its strength may be 0; else part of the description
  std::map<std::string, double> numbers;
  std::map<std::string, std::string> words;                 // component, channel, region, law ...
  std::vector<std::pair<double, double>> intervals_s = {};  // in which it acts, of recording time; empty: always
  double log_prior = 0.0;  // of this form among all forms of the effect, natural logarithm

  double number_or(const std::string& key, double fallback) const;
  std::string word_or(const std::string& key, const std::string& fallback) const;
};

/// Relative, 1 sigma. The defaults are those of a catalogue machine.
struct Tolerances {
  double conductivity = 0.04;
  double heat_capacity = 0.03;
  double heat_source_power = 0.10;
  double film = 0.15;
  double expansion = 0.04;
  double conductance = 0.3;
  std::vector<std::string> raised;  // those that the description has smaller than anybody can know them
};

struct Machine {
  std::string file;  // for messages
  std::string name;
  std::optional<double> initial_temperature_C;
  /// At which the laws that change with temperature have the strength described; the start, where it is not stated. A
  /// law that was fitted to one recording has to be the same in the next, which starts on another morning.
  std::optional<double> reference_temperature_C;
  std::vector<Component> components;
  std::vector<Coupling> couplings;
  std::vector<Fluid> fluids;
  Room room;
  std::vector<EffectSpec> effects;
  Tolerances tolerances;
  std::vector<Sensor> sensors;
  std::vector<Displacement> displacements;
  double input_timing_sigma_s = 0.0;  // 0: not stated
  std::string document;               // the JSON text it was read from; unknown keys are kept there

  const Component* find(const std::string& id) const;
  const Sensor* sensor(const std::string& channel) const;
  const EffectSpec* effect(const std::string& id) const;
  /// The speed that stands for "full": the largest rated speed, 0 if none is named.
  double rated_speed_rpm() const;
};

/// Across its component, where a rod does not grow: Y, and X beside a displacement of the same component along Z or Y.
/// A component that is seen along X alone - the screw of a cross axis - grows there.
bool is_across(const Machine& machine, const Displacement& displacement);

/// Channels of measured temperatures that drive the simulation: the room, fluids, prescribed parts.
std::set<std::string> measured_boundaries(const Machine& machine);

Result<Machine> read_machine(const std::filesystem::path& path, std::vector<std::string>* warnings = nullptr);
Result<Machine> machine_from_json(const nlohmann::json& document, const std::string& file,
                                  std::vector<std::string>* warnings = nullptr);
/// The document it came from with the values of today; unknown keys are kept.
nlohmann::json to_json(const Machine& machine);

}  // namespace zerodrift::physics
