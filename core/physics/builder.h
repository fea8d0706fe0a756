#pragma once
// Makes the thermal network of a machine for one run. Effects use it to put in their terms; everything that every
// machine has (conduction, capacities, listed sources, couplings, sensors, displacements) is put in by build_network.

#include <string>
#include <vector>

#include "core/physics/effects/effect.h"
#include "core/physics/network.h"
#include "core/recording/recording.h"

namespace zerodrift::physics {

inline constexpr double m_per_mm = 1e-3;
/// A lump of unknown capacity: only ratios to it can be identified.
inline constexpr double stand_in_capacity_J_K = 1000.0;

struct BuildOptions {
  int cells = 0;  // of a rod; 0: 40, or more where a described source is narrow
};

/// What an effect does to the friction of one bearing.
struct BearingModifier {
  enum class Kind { viscosity, preload_temperature, preload_speed, preload_constant, run_in } kind;
  int parameter = 0;
  int second_parameter = -1;  // run_in: ln of the time constant
  double reference_C = 0.0;
};

class NetworkBuilder {
 public:
  NetworkBuilder(const Machine& machine, const recording::Recording& inputs, const BuildOptions& options);

  const Machine& machine() const { return m_machine; }
  const recording::Recording& inputs() const { return m_inputs; }
  Network& network() { return m_network; }
  const Network::Place& place(const std::string& component) const;
  double reference_C(const std::string& component) const;  // initial temperature
  double mean_initial_C() const { return m_mean_initial_C; }
  /// At which a law has the strength described: the machine's, or the start.
  double law_reference_C() const { return m_machine.reference_temperature_C.value_or(m_mean_initial_C); }

  int add_parameter(Parameter parameter);
  /// A parameter of an effect: for a candidate with the effect's own prior, for a described effect around its value
  /// with the film tolerance; `value` is the default when the spec has no such number.
  int effect_parameter(const EffectSpec& spec, int index, std::string_view key, double value = 0.0);
  /// From and to of each of the effect's intervals, one after the other. A candidate's edges may move: each by its own
  /// "edge_prior_sigma".
  std::vector<int> interval_parameters(const EffectSpec& spec, int index);
  /// "position_mm" of an effect that may stand anywhere along a rod but at its very ends; in the middle unless `spec`
  /// says.
  int place_parameter(const EffectSpec& spec, int index, const Component& rod);
  /// Index of the held input; a channel that the recording lacks reads 0.
  int held(const std::string& channel);
  int linear(const std::string& channel);
  int signal(Signal signal);
  int room();  // environment
  int environment(Environment environment);
  int probe(Probe probe);
  int conductivity(const std::string& component) const { return m_conductivity.at(component); }
  /// Parameter by which the conduction between cells `face - 1` and `face` of a rod differs from its conductivity; -1:
  /// none.
  int conduction_share(const std::string& component, int face) const;
  int capacity(const std::string& component) const { return m_capacity.at(component); }
  /// Adds a node of its own (a body behind a surface); returns its index.
  int add_node(double volume, int capacity_parameter, double initial_C);

  Term source_over(const std::string& component, double from_mm, double to_mm) const;
  Term film_over(const std::string& component, double from_mm, double to_mm) const;
  /// A source whose Gaussian shape moves with a position parameter.
  /// From the fixed end of a rod to a place that is a parameter.
  Term film_up_to(const std::string& component, int place_parameter) const;
  Term source_at(const std::string& component, int place_parameter, double width_mm) const;
  Probe probe_at(const std::string& component, double position_mm) const;
  Probe mean_probe(const std::string& component) const;
  Term& add(Term term);
  /// Heat of a rod with an inside enters both: `share` (a parameter) of it the inside. A rod of one body takes it
  /// whole.
  void add_heat(const std::string& component, Term term, int share);
  /// The share for an effect's own heat, -1 where the rod is one body.
  int heat_share_of_effect(const EffectSpec& spec, int index, const std::string& component);
  void modify_bearing(const std::string& source, BearingModifier modifier);
  /// The source heats `node`, which passes it on through the parameter `contact` in W/K.
  void put_body_before(const std::string& source, int node, int contact);
  /// The listed source's term, null if it has none yet.
  Term* term(const std::string& label);
  int held_speed() { return held("spindle_rpm"); }
  std::vector<std::string> rods() const;

  void build();

 private:
  void add_components();
  void add_rod(const Component& component);
  void add_cells(const Component& component, int first, int count, double section_m2, const char* label);
  void add_inner_body(const Component& component, Network::Place& at);
  void add_contact(const Component& component, const HeatSource& bearing, int rise);
  void add_near_field(const Component& component, const Sensor& sensor, Observation& seen);
  Probe length_probe(const Network::Place& at, int first, double factor) const;
  void add_lump(const Component& component);
  void add_initial_state();
  void add_start_shapes(const Network::Place& at, double above_K);
  void add_past();
  void add_past_shape(const std::string& key, const std::string& component, double above_K,
                      const std::vector<double>& left_K);
  void add_sources();
  void add_source(const Component& component, const HeatSource& source);
  void join_body(const Component& component, const Term& spread, const std::string& source, int share);
  void add_couplings();
  void wandering_room(Environment& room);
  void add_sensors();
  void add_displacements();

  const Machine& m_machine;
  const recording::Recording& m_inputs;
  BuildOptions m_options;
  Network m_network;
  std::map<std::string, int> m_conductivity;
  std::map<std::string, std::vector<int>> m_conduction_shares;  // of each stretch of a rod
  std::map<std::string, int> m_capacity;
  std::map<std::string, double> m_initial_C;
  std::map<std::string, std::vector<BearingModifier>> m_modifiers;
  struct SourceBody {
    int node = 0;
    int contact = 0;  // parameter
  };
  std::map<std::string, SourceBody> m_bodies;
  std::map<std::string, int> m_heat_share;  // source -> parameter
  double m_mean_initial_C = 20.0;
  int m_room = -1;
};

Network build_network(const Machine& machine, const recording::Recording& inputs, const BuildOptions& options = {});

/// Heat of a listed source in W at given inputs and bearing temperature, by its nominal law.
double nominal_heat_W(const HeatSource& source, double input, double full_speed_rpm);
/// The initial temperature of each component: the description's, or the first samples.
std::map<std::string, double> initial_temperatures(const Machine& machine, const recording::Recording& inputs);
/// Their mean over what nothing else heats.
double mean_initial_temperature_C(const Machine& machine, const recording::Recording& inputs);

}  // namespace zerodrift::physics
