#pragma once
// The machine as a thermal network: nodes with heat capacities (the cells of the rods, the lumps), and terms - heat
// sources, films towards a surrounding, links between nodes - whose strengths follow laws of the inputs and of the
// state:
//   C dT/dt = sum links u w (T_other - T) + sum films u a (E - T) + sum sources u w
// Strengths are W, W/(m2 K) times m2, W/K; the weights carry the geometry. Each law also gives its derivatives, so that
// the tangent-linear model is exact. What sensors and probes show is a list of observations on top.

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "core/physics/machine.h"
#include "core/physics/parameter.h"

namespace zerodrift::physics {

inline constexpr int max_law_parameters = 16;

/// Where a law is evaluated.
struct LawPoint {
  const double* held = nullptr;    // the held inputs, in the order of Network::held_channels
  const double* values = nullptr;  // the term's own parameters
  double driver_C = 0.0;           // weighted temperature of the driver nodes
  double environment_C = 0.0;
  double time_s = 0.0;
};

struct Strength {
  double value = 0.0;
  double by_driver = 0.0;
  double by_environment = 0.0;
  std::array<double, max_law_parameters> by_parameter{};
};

using Law = std::function<Strength(const LawPoint&)>;

enum class TermKind { source, film, link };
enum class LawKind {
  constant,  // parameters only
  inputs,    // parameters and held inputs
  time,      // also the time
  state      // also temperatures: evaluated every step
};

struct Link {
  int first = 0;
  int second = 0;
  double weight = 1.0;
};

struct Term {
  TermKind kind = TermKind::source;
  LawKind law_kind = LawKind::inputs;
  std::string label;            // "spindle/front_bearing", for the balance and for the heat drivers
  int first_node = 0;           // source, film: weights over consecutive nodes
  std::vector<double> weights;  // source: share of the heat; film: m2
  std::vector<Link> links;      // link
  std::vector<std::pair<int, double>> driver;
  int environment = -1;         // film
  std::vector<int> parameters;  // indices into Network::parameters, at most max_law_parameters
  Law law;
  int place_parameter = -1;  // the weights depend on this position in mm
  std::function<void(double place_mm, std::vector<double>& weights, std::vector<double>& by_place_mm)> reshape;
};

/// A surrounding temperature: a series linear between samples, plus a constant, plus parameters times basis series.
struct Environment {
  std::string name;
  int series = -1;  // index into Network::linear_channels
  double constant_C = 0.0;
  struct Part {
    int parameter = 0;
    int basis = -1;  // index into Network::signals, -1: constant 1
  };
  std::vector<Part> parts;
};

/// A series known before the simulation: a function of the inputs at each sample.
struct Signal {
  std::string name;
  std::function<double(const double* held, const double* linear, double time_s)> value;
};

/// g * lag(u) or g * (lag1(u) - lag2(lag1(u))) added to a displacement; u is a signal or a probe minus its reference.
struct StructureTerm {
  int gain = -1;  // parameter, um per unit of the driver
  int lag = -1;   // parameter tau in s, -1: none
  int second_lag = -1;
  int initial = -1;  // parameter: by how much the lagged driver differs from the driver at the start
  int signal = -1;
  int probe = -1;
  double probe_reference = 0.0;
  double factor = 1.0;
};

/// Where the temperature steps between two nodes, a sensor between them reads one side's: strength * probe beside what
/// is straight between the nodes.
struct StepTerm {
  int probe = -1;               // difference of the two nodes
  std::vector<int> parameters;  // of the law
  Law law;
};

struct Observation {
  std::string channel;
  bool temperature = true;
  int probe = -1;          // index into Network::probes, -1: only structure terms
  double reference = 0.0;  // temperature: of the gain; displacement: probe value at the initial temperature
  int inner_probe = -1;    // mixed in by the parameter inner_share: (1 - s) probe + s inner_probe
  int inner_share = -1;
  int scale = -1;  // parameter: multiplies (probe - reference), displacements only
  int offset = -1;
  int lag_s = -1;         // parameter: sensor lag in s
  int gain = -1;          // parameter: relative error of the gain
  double accuracy = 0.0;  // um: what the description says that it leaves out of a displacement, slowly changing
  std::vector<StructureTerm> structure;
  std::vector<StepTerm> steps;  // temperatures only
};

/// A linear functional of the node temperatures.
using Probe = std::vector<std::pair<int, double>>;

struct InitialPart {
  int parameter = 0;
  Probe nodes;  // node, weight
};

struct Network {
  std::vector<Parameter> parameters;
  std::vector<double> volume;  // heat capacity of a node = volume * capacity parameter, or volume alone
  std::vector<int> capacity_parameter;
  std::vector<double> initial_C;
  std::vector<InitialPart> initial_parts;
  std::vector<Term> terms;
  std::vector<Environment> environments;
  std::vector<std::string> held_channels;
  std::vector<std::string> linear_channels;
  std::vector<Signal> signals;
  std::vector<Probe> probes;
  std::vector<Observation> observations;
  int hold_parameter = -1;  // share of a sample interval that already has the next sample's inputs
  double full_speed_rpm = 1.0;
  std::vector<std::string> notes;  // what had to be assumed, as codes: "room_constant", "no_excitation" ...

  struct Place {
    std::string component;
    int first = 0;
    int count = 0;
    double cell_m = 0.0;       // 0: lump
    int inner = -1;            // first node of the inside, -1: one body
    double inner_share = 0.0;  // of the section
  };
  std::vector<Place> places;

  std::size_t nodes() const { return volume.size(); }
  const Place* place(const std::string& component) const;
  const Observation* observation(const std::string& channel) const;
  Observation* observation(const std::string& channel);
  std::vector<double> start_values() const;
};

}  // namespace zerodrift::physics
