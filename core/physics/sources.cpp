#include "core/physics/sources.h"

#include <cmath>

namespace zerodrift::physics {
namespace {

/// Palmgren's torque, N mm (contract formula; Harris, Rolling Bearing Analysis, ch. 14).
double viscous_torque_Nmm(const HeatSource& source, double nu_n) {
  const double dm3 = std::pow(source.mean_diameter_mm, 3);
  return nu_n >= 2000.0 ? 1e-7 * source.f0 * std::pow(nu_n, 2.0 / 3.0) * dm3 : 160e-7 * source.f0 * dm3;
}

constexpr double watts_per_rpm_Nmm = 1.047e-4;

}  // namespace

double jacket_conductance_W_K(const CoolingJacket& jacket) {
  const double diameter_m = 1e-3 * jacket.channel_diameter_mm;
  const double section_m2 = 0.25 * 3.14159265358979 * diameter_m * diameter_m;
  const double velocity_m_s = jacket.flow_L_min / 60000.0 / section_m2;
  const double viscosity_m2_s = 1e-6 * jacket.viscosity_mm2_s;
  const double reynolds = velocity_m_s * diameter_m / viscosity_m2_s;
  const double prandtl = viscosity_m2_s * jacket.density_kg_m3 * jacket.heat_capacity_J_kgK / jacket.conductivity_W_mK;
  const double ratio = jacket.channel_diameter_mm / jacket.channel_length_mm;
  const double nusselt = 1.86 * std::cbrt(reynolds * prandtl * ratio);
  return nusselt * jacket.conductivity_W_mK / diameter_m * 1e-6 * jacket.area_mm2;
}

Law motor_law(const HeatSource& source, int speed_input) {
  const double watts_per_rpm = source.rated_power_W * (1.0 - source.efficiency) / source.rated_speed_rpm;
  const double jacket_W_K = source.jacket ? jacket_conductance_W_K(*source.jacket) : 0.0;
  const double coolant_C = source.jacket ? source.jacket->coolant_temperature_C : 0.0;
  return [=](const LawPoint& at) {
    Strength s;
    s.by_parameter[0] = watts_per_rpm * std::abs(at.held[speed_input]);
    s.value = at.values[0] * s.by_parameter[0];
    if (jacket_W_K > 0.0) {
      s.value -= jacket_W_K * (at.driver_C - coolant_C);
      s.by_driver = -jacket_W_K;
    }
    return s;
  };
}

Law bearing_law(const HeatSource& source, int speed_input, double full_speed_rpm,
                const std::vector<BearingModifier>& modifiers) {
  using Kind = BearingModifier::Kind;
  return [=](const LawPoint& at) {
    Strength s;
    const double n = std::abs(at.held[speed_input]);
    if (n == 0.0) return s;
    const double relative = n / full_speed_rpm;
    double log_viscosity = 0.0;
    double log_viscosity_by_driver = 0.0;
    double load = 1.0;
    double load_by_driver = 0.0;
    double run_in = 1.0;
    std::size_t at_value = 1;
    for (const auto& m : modifiers) {
      const double p = at.values[at_value];
      const double rise_K = at.driver_C - m.reference_C;
      if (m.kind == Kind::viscosity) {
        log_viscosity -= p * rise_K;
        log_viscosity_by_driver -= p;
      } else if (m.kind == Kind::preload_temperature) {
        load += p * rise_K;
        load_by_driver += p;
      } else if (m.kind == Kind::preload_speed) {
        load += p * relative * relative;
      } else if (m.kind == Kind::preload_constant) {
        load += p;
      } else {
        run_in += p * std::exp(-at.time_s / std::exp(at.values[at_value + 1]));
      }
      at_value += m.second_parameter >= 0 ? 2 : 1;
    }
    const bool lifted = load <= 0.0;
    if (lifted) load = 0.0;
    const double nu_n = source.oil_viscosity_mm2_s * std::exp(log_viscosity) * n;
    const double viscous = watts_per_rpm_Nmm * n * viscous_torque_Nmm(source, nu_n);
    const double viscous_by_log = nu_n >= 2000.0 ? viscous * 2.0 / 3.0 : 0.0;
    const double loaded = watts_per_rpm_Nmm * n * source.f1 * source.load_N * source.mean_diameter_mm;
    const double heat_W = (viscous + loaded * load) * run_in;
    const double scale = at.values[0];
    s.value = scale * heat_W;
    s.by_parameter[0] = heat_W;
    s.by_driver =
        scale * run_in * (viscous_by_log * log_viscosity_by_driver + (lifted ? 0.0 : loaded * load_by_driver));
    at_value = 1;
    for (const auto& m : modifiers) {
      const double rise_K = at.driver_C - m.reference_C;
      double& by = s.by_parameter[at_value];
      const double by_load = lifted ? 0.0 : scale * run_in * loaded;
      if (m.kind == Kind::viscosity) by = -scale * run_in * viscous_by_log * rise_K;
      if (m.kind == Kind::preload_temperature) by = by_load * rise_K;
      if (m.kind == Kind::preload_speed) by = by_load * relative * relative;
      if (m.kind == Kind::preload_constant) by = by_load;
      if (m.kind == Kind::run_in) {
        const double tau_s = std::exp(at.values[at_value + 1]);
        const double decay = std::exp(-at.time_s / tau_s);
        by = scale * (viscous + loaded * load) * decay;
        s.by_parameter[at_value + 1] = by * at.values[at_value] * at.time_s / tau_s;
        ++at_value;
      }
      ++at_value;
    }
    return s;
  };
}

Law input_law(double watts_per_unit, int input) {
  return [=](const LawPoint& at) {
    Strength s;
    s.by_parameter[0] = watts_per_unit * at.held[input];
    s.value = at.values[0] * s.by_parameter[0];
    return s;
  };
}

Law friction_law(double friction_N, int feed_input) {
  return [=](const LawPoint& at) {
    Strength s;
    s.by_parameter[0] = friction_N * std::abs(at.held[feed_input]) / 60000.0;  // mm/min -> m/s
    s.value = at.values[0] * s.by_parameter[0];
    return s;
  };
}

double speed_term(const std::string& term, double speed_rpm, double full_speed_rpm) {
  const double relative = std::abs(speed_rpm) / full_speed_rpm;
  if (term == "constant") return 1.0;
  if (term == "on") return relative > 0.01 ? 1.0 : 0.0;
  return term == "n" ? relative : relative * relative;
}

Law speed_law(const std::vector<std::string>& law, int speed_input, double full_speed_rpm) {
  return [=](const LawPoint& at) {
    Strength s;
    for (std::size_t i = 0; i < law.size(); ++i) {
      s.by_parameter[i] = speed_term(law[i], at.held[speed_input], full_speed_rpm);
      s.value += at.values[i] * s.by_parameter[i];
    }
    return s;
  };
}

}  // namespace zerodrift::physics
