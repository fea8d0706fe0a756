#include "tests/proof/case_generator.h"

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

/// Hidden effects' change of each channel in noise widths: the largest names the worst channel.
std::pair<std::string, double> largest_change(const Readings& with, const Readings& without) {
  std::string worst;
  double largest = 0;
  const auto look = [&](const std::string& name, double change) {
    if (change > largest) largest = change, worst = name;
  };
  for (std::size_t j = 0; j < with.temperatures.size(); ++j) {
    look("T" + std::to_string(j + 1) + "_C", rms_change(with.temperatures[j], without.temperatures[j]) / 0.055);
  }
  look("dZ_um", rms_change(with.dz, without.dz) / 0.36);
  look("dY_um", rms_change(with.dy, without.dy) / 0.36);
  return {worst, largest};
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

/// Sizes each hidden effect so that the channel it changes most moves by 3 to 30 noise widths (rms), evenly in the
/// logarithm, as far as plausible sizes allow; false where they do not reach 2.5. Radiation is what its surface makes
/// it.
bool size_effects(Truth& real, const std::vector<std::string>& ids, const Schedule& schedule, Noise& noise) {
  for (const auto& id : ids) {
    if (id == "convection" || id == "radiation") continue;
    const double wanted = 3.0 * std::pow(10.0, noise.uniform());
    const Readings bare = run(without(real, id), schedule);
    double left = 1.6;  // times larger than drawn
    for (int round = 0; round < 2; ++round) {
      const double shown = largest_change(run(real, schedule), bare).second;
      if (shown < 1e-6) return false;
      const double factor = std::clamp(wanted / shown, 0.1, left);
      left /= factor;
      rescale(real, id, factor);
    }
  }
  const Readings all = run(real, schedule);
  return std::all_of(ids.begin(), ids.end(), [&](const std::string& id) {
    return id == "convection" ||
           largest_change(all, run(without(real, id), schedule)).second > (id == "radiation" ? 5.0 : 2.5);
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

Case make_case(std::uint64_t seed, const std::string& kind) {
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
  for (int attempt = 0; attempt < 8 && !shows; ++attempt) {
    schedules = {make_schedule(noise, nominal, poor), make_schedule(noise, nominal, false)};
    Truth trial = real;
    out.hidden.clear();
    for (const auto& id : ids) out.hidden.push_back(hide(trial, id, noise, 1.0));
    shows = size_effects(trial, ids, schedules[0], noise);
    if (shows) real = trial;
  }
  if (!shows) return make_case(seed + 1000003, kind);
  Truth bare = real;
  for (const auto& id : ids) rescale(bare, id, 0.0);
  if (what == "convection") bare.h = bare.end_h = 0;
  if (what != "none") out.worst_channel = largest_change(run(real, schedules[0]), run(bare, schedules[0])).first;
  out.machine = describe(nominal, what != "convection");
  std::vector<double> offsets;
  for (std::size_t j = 0; j < real.sensors.size(); ++j) offsets.push_back(0.04 * std::clamp(noise.normal(), -2.0, 2.0));
  for (std::size_t i = 0; i < 2; ++i) {
    const Readings readings = run(real, schedules[i]);
    out.recordings.push_back(measure(real, schedules[i], readings, noise, true, offsets));
    out.clean.push_back(measure(real, schedules[i], readings, noise, false, offsets));
    out.recordings.back().name = out.name + (i == 0 ? "-A" : "-B");
  }
  return out;
}

}  // namespace zerodrift::proof
