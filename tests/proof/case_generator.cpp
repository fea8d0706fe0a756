#include "tests/proof/case_generator.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "tests/proof/truth.h"

namespace zerodrift::proof {
namespace {

using recording::Recording;

Recording measure(const Truth& m, const Schedule& s, const Readings& r, Noise& noise, bool noisy,
                  const std::vector<double>& offsets) {
  Recording out;
  out.time_s = s.time;
  out.channels = {{"spindle_rpm", s.rpm}, {"coolant_on", s.coolant}, {"spindle_load_W", s.load}, {"ambient_C", s.room}};
  const double step = 0.05;
  for (std::size_t j = 0; j < m.sensors.size(); ++j) {
    std::vector<double> values = r.temperatures[j];
    for (std::size_t k = 0; noisy && k < values.size(); ++k) {
      values[k] = step * std::round((values[k] + offsets[j] + 0.05 * noise.normal()) / step);
      if (noise.uniform() < 5e-4) values[k] += noise.uniform(3, 9);
      if (noise.uniform() < 2e-3) values[k] = std::nan("");
    }
    out.channels.push_back({"T" + std::to_string(j + 1) + "_C", values});
  }
  for (const auto& [name, series] : {std::pair{"dZ_um", &r.dz}, std::pair{"dY_um", &r.dy}}) {
    std::vector<double> values = *series;
    for (double& v : values) v += noisy ? 0.3 * noise.normal() : 0.0;
    out.channels.push_back({name, values});
  }
  return out;
}

double rms_change(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t k = 0; k < a.size(); ++k) sum += (a[k] - b[k]) * (a[k] - b[k]);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

constexpr double temperature_noise_K = 0.055;
constexpr double displacement_noise_um = 0.36;

/// Hidden effects' change of each channel in noise widths: the largest names the worst channel.
std::pair<std::string, double> largest_change(const Readings& with, const Readings& without) {
  std::string worst;
  double largest = 0;
  const auto look = [&](const std::string& name, double change) {
    if (change > largest) largest = change, worst = name;
  };
  for (std::size_t j = 0; j < with.temperatures.size(); ++j) {
    look("T" + std::to_string(j + 1) + "_C",
         rms_change(with.temperatures[j], without.temperatures[j]) / temperature_noise_K);
  }
  look("dZ_um", rms_change(with.dz, without.dz) / displacement_noise_um);
  look("dY_um", rms_change(with.dy, without.dy) / displacement_noise_um);
  return {worst, largest};
}

/// All readings in noise widths; displacements against their own mean, for their zero is not known.
Eigen::MatrixXd in_noise_widths(const Readings& r) {
  const auto rows = static_cast<Eigen::Index>(r.dz.size());
  const auto sensors = static_cast<Eigen::Index>(r.temperatures.size());
  const auto column = [rows](const std::vector<double>& v) {
    return Eigen::Map<const Eigen::VectorXd>(v.data(), rows);
  };
  Eigen::MatrixXd out(rows, sensors + 2);
  for (Eigen::Index j = 0; j < sensors; ++j) {
    out.col(j) = column(r.temperatures[static_cast<std::size_t>(j)]) / temperature_noise_K;
  }
  for (const auto& [at, series] : {std::pair{sensors, &r.dz}, std::pair{sensors + 1, &r.dy}}) {
    out.col(at) = column(*series) / displacement_noise_um;
    out.col(at).array() -= out.col(at).mean();
  }
  return out;
}

Truth without(Truth m, const std::string& id) {
  rescale(m, id, 0.0);
  return m;
}

std::vector<std::string> drawn_effects(const std::string& what, Noise& noise) {
  std::vector<std::string> ids;
  if (what == "pair") {
    ids.push_back(listed()[1 + noise.index(listed().size() - 1)]);
    do ids.resize(1), ids.push_back(listed()[1 + noise.index(listed().size() - 1)]);
    while (ids[0] == ids[1] || (ids[0].rfind("sensor", 0) == 0 && ids[1].rfind("sensor", 0) == 0));
  } else if (what == "unlisted") {
    static const char* odd[] = {"unlisted:wandering_heat", "unlisted:creep", "unlisted:travelling_heat",
                                "unlisted:slack"};
    ids.push_back(odd[noise.index(4)]);
    if (ids.back() == "unlisted:travelling_heat" && noise.uniform() < 0.5) ids.back() = "unlisted:stiction";
  } else if (what != "none") {
    ids.push_back(what);
  }
  return ids;
}

/// A re-fit of what a user frees - conductivity, capacity, expansion, film, sources, ends - on a machine that hides
/// `rest` alone, whose size is free as well.
Rival rival_with(const Truth& rest, const std::vector<std::string>& hidden, const Schedule& schedule) {
  return [rest, hidden, schedule](const Eigen::VectorXd& z) {
    Truth m = rest;
    m.k *= std::exp(0.04 * z[0]);
    m.c *= std::exp(0.03 * z[1]);
    m.alpha *= std::exp(0.04 * z[2]);
    m.h *= std::exp(0.15 * z[3]);
    for (Eigen::Index q = 0; q < 3; ++q) m.scale[static_cast<std::size_t>(q)] *= std::exp(0.1 * z[4 + q]);
    m.end_h = std::max(0.0, m.end_h + 0.7 * rest.h * z[7]);
    for (const auto& id : hidden) rescale(m, id, std::max(0.0, 1.0 + z[8]));
    return in_noise_widths(run(m, schedule));
  };
}

/// How strongly effects of a machine show in a recording.
class Shown {
 public:
  Shown(const Truth& real, const std::vector<std::string>& ids, const std::string& id, const Schedule& schedule,
        bool after_refit)
      : m_schedule(schedule) {
    std::vector<std::string> others = ids;
    std::erase(others, id);
    const Truth rest = without(real, id);
    m_bare = run(rest, schedule);
    if (!after_refit) return;
    m_rival = rival_with(rest, others, schedule);
    m_slopes = sensitivities_of(m_rival, others.empty() ? 8 : 9, in_noise_widths(m_bare));
  }
  double operator()(const Truth& real) const {
    const Readings with = run(real, m_schedule);
    if (!m_rival) return largest_change(with, m_bare).second;
    return largest_rms(left_after_refit(in_noise_widths(with), m_rival, in_noise_widths(m_bare), m_slopes));
  }

 private:
  const Schedule& m_schedule;
  Readings m_bare;
  Rival m_rival;
  Eigen::MatrixXd m_slopes;
};

/// Sizes each hidden effect so that the channel it changes most moves by 3 to 30 noise widths (rms; by `left`, of what
/// a re-fit leaves), evenly in the logarithm, as far as plausible sizes allow; false where `rule` is not reached then.
/// Radiation is what its surface makes it.
bool size_effects(Truth& real, const std::vector<std::string>& ids, const Schedule& schedule, StrengthRule rule,
                  Noise& noise) {
  for (const auto& id : ids) {
    if (id == "convection" || id == "radiation") continue;
    const double wanted = 3.0 * std::pow(10.0, noise.uniform());
    const Shown shown(real, ids, id, schedule, rule == StrengthRule::left);
    double left = 1.6;  // times larger than drawn
    for (int round = 0; round < 2; ++round) {
      const double widths = shown(real);
      if (widths < 1e-6) return false;
      const double factor = std::clamp(wanted / widths, 0.1, left);
      left /= factor;
      rescale(real, id, factor);
    }
  }
  return std::all_of(ids.begin(), ids.end(), [&](const std::string& id) {
    if (id == "convection") return true;
    const double least = id == "radiation" && rule != StrengthRule::left ? 5.0 : least_strength;
    if (Shown(real, ids, id, schedule, false)(real) < least) return false;
    return rule == StrengthRule::raw || Shown(real, ids, id, schedule, true)(real) >= least_left(rule);
  });
}

/// A draught is as likely as each of listed(), from its own share of the draw: other seeds keep their cases.
std::string mixture(double draw, Noise& noise) {
  const double draught = 0.64 / (1.0 + static_cast<double>(listed().size()));
  return draw > 1.0 - draught ? "draught"
         : draw < 0.15        ? "none"
         : draw < 0.27        ? "pair"
         : draw < 0.36        ? "unlisted"
                              : listed()[noise.index(listed().size())];
}

}  // namespace

Case make_case(std::uint64_t seed, const std::string& kind, StrengthRule rule) {
  Noise noise(seed * 7919 + 17);
  for (int i = 0; i < 5; ++i) noise.uniform();
  Truth nominal = draw_machine(noise);
  nominal.wander_seed = seed;
  Truth real = nominal;
  perturb(real, noise);
  const double draw = noise.uniform();
  const std::string what = kind.empty() ? mixture(draw, noise) : kind;
  const std::vector<std::string> ids = drawn_effects(what, noise);
  const bool poor = noise.uniform() < 0.06;
  Case out;
  out.name = what + "-" + std::to_string(seed);
  std::vector<Schedule> schedules;
  bool shows = false;
  const int attempts = rule == StrengthRule::raw ? 8 : 3;
  for (int attempt = 0; attempt < attempts && !shows; ++attempt) {
    schedules = {make_schedule(noise, nominal, poor), make_schedule(noise, nominal, false)};
    Truth trial = real;
    out.hidden.clear();
    for (const auto& id : ids) out.hidden.push_back(hide(trial, id, noise, 1.0));
    shows = size_effects(trial, ids, schedules[0], rule, noise);
    if (shows) real = trial;
  }
  // Asked for by its id, what a re-fit takes in is hidden by its whole change.
  if (!shows) return make_case(seed + 1000003, kind, ids.front() == kind ? StrengthRule::raw : rule);
  Truth bare = real;
  for (const auto& id : ids) rescale(bare, id, 0.0);
  if (what == "convection") bare.h = bare.end_h = 0;
  if (what != "none") out.worst_channel = largest_change(run(real, schedules[0]), run(bare, schedules[0])).first;
  out.machine = describe(nominal, what != "convection");
  std::vector<double> offsets;
  for (std::size_t j = 0; j < real.sensors.size(); ++j) offsets.push_back(0.04 * std::clamp(noise.normal(), -2.0, 2.0));
  for (std::size_t i = 0; i < 2; ++i) {
    const Readings readings = run(real, schedules[i]);
    for (HiddenEffect& one : out.hidden) {
      if (i == 0 && one.id == "coolant") one.heat_W = readings.coolant_W;
    }
    out.recordings.push_back(measure(real, schedules[i], readings, noise, true, offsets));
    out.clean.push_back(measure(real, schedules[i], readings, noise, false, offsets));
    out.recordings.back().name = out.name + (i == 0 ? "-A" : "-B");
  }
  return out;
}

}  // namespace zerodrift::proof
