// A door stands open for a while: between two moments the film is stronger, more so at one end where the air comes from
// there, and the air may be colder than the logged room.
#include "core/physics/effects/laws.h"

namespace zerodrift::physics {
namespace draught {

constexpr double two_minutes_s = 120.0;  // edges of a draught of one interval

/// Along a rod the film is h (1 + t (x / L - 1/2)).
void tilt_film(Term& film, int tilt) {
  film.place_parameter = tilt;
  film.reshape = [even = film.weights](double t, std::vector<double>& weights, std::vector<double>& by_tilt) {
    weights = by_tilt = even;
    const double cells = static_cast<double>(even.size());
    for (std::size_t i = 0; i < even.size(); ++i) {
      by_tilt[i] *= (static_cast<double>(i) + 0.5) / cells - 0.5;
      weights[i] += t * by_tilt[i];
    }
  };
}

void add(NetworkBuilder& builder, const EffectSpec& spec, int index) {
  const bool by_conductance = spec.numbers.count("conductance_W_K") != 0;
  const int strength = builder.effect_parameter(spec, index, by_conductance ? "conductance_W_K" : "h_W_m2K");
  const bool listed = !spec.intervals_s.empty();
  const std::vector<int> edges = listed ? builder.interval_parameters(spec, index)
                                        : std::vector<int>{builder.effect_parameter(spec, index, "from_s"),
                                                           builder.effect_parameter(spec, index, "to_s")};
  Environment air = builder.network().environments[builder.room()];
  air.name = "draught";
  if (spec.numbers.count("colder_K") != 0) air.parts.push_back({builder.effect_parameter(spec, index, "colder_K"), -1});
  const int environment = builder.environment(std::move(air));
  const int tilt = spec.numbers.count("film_tilt") != 0 ? builder.effect_parameter(spec, index, "film_tilt") : -1;
  for_components(builder, spec, [&](const Component& component) {
    if (!by_conductance && !has_surface(component)) return;
    Term film = builder.film_over(component.id, 0.0, component.length_mm);
    if (by_conductance)
      for (double& weight : film.weights) weight = 1.0 / static_cast<double>(film.weights.size());
    film.label = component.id + "/draught";
    film.environment = environment;
    if (tilt >= 0 && !component.lump) tilt_film(film, tilt);
    add_in_intervals(builder, film, strength, edges, listed ? edge_of(spec) : two_minutes_s);
  });
}

std::vector<EffectSpec> candidates(const Machine& machine, const RunFacts& facts) {
  std::vector<EffectSpec> list;
  bool surface = false;
  bool rod = false;
  for (const auto& component : machine.components) {
    const bool here = !component.prescribed && has_surface(component);
    surface = surface || here;
    rod = rod || (here && !component.lump);
  }
  if (!surface || facts.duration_s < 3600.0) return list;
  const double width_s = facts.duration_s / 8.0;
  const auto window = [&](double from_s, double to_s) {
    EffectSpec spec{"draught", true, {}, {}};
    spec.numbers = {{"h_W_m2K", 0.0},
                    {"from_s", from_s},
                    {"to_s", to_s},
                    {"from_s_prior_sigma", 0.5 * width_s},
                    {"to_s_prior_sigma", 0.5 * width_s},
                    {"colder_K", 0.0}};
    if (rod) spec.numbers["film_tilt"] = 0.0;
    list.push_back(std::move(spec));
  };
  for (int i = 0; i < 8; ++i) window(i * width_s, (i + 1) * width_s);
  // Nobody closed it again while the machine was watched.
  for (int i = 1; i < 8; ++i) window(i * width_s, facts.duration_s + 2.0 * width_s);
  return list;
}

}  // namespace draught

extern const Effect draught_effect;
const Effect draught_effect = {"draught",
                               "a draught or an open door",
                               "-h_d (1 + t (x / L - 1/2)) P (T - (T_room + dT)) for t in [t1, t2]",
                               "open door or gate: films of 5 to 40 W/(m2 K) more, air some kelvin colder",
                               "All surfaces cool together during one stretch of time that no logged input explains. "
                               "Coolant or compressed air that is not logged looks the same",
                               "room_sensor_fault coolant",
                               {{"h_W_m2K", 15.0, 0.0, 200.0, true},
                                {"conductance_W_K", 1.0, 0.0, 200.0, true},
                                {"from_s", 1800.0, 0.0, 1e6},
                                {"to_s", 1800.0, 0.0, 1e6},
                                {"colder_K", 3.0, -20.0, 20.0},
                                {"film_tilt", 1.0, -2.0, 2.0}},
                               {"h_W_m2K", "conductance_W_K"},
                               draught::add,
                               draught::candidates,
                               {},
                               {.log_rarity = -3.0, .once = true, .requires_id = "convection", .event = Event::film}};

}  // namespace zerodrift::physics
