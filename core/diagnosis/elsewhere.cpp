#include "core/diagnosis/elsewhere.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>

#include "core/diagnosis/bodies.h"
#include "core/diagnosis/parallel.h"
#include "core/diagnosis/selection.h"

namespace zerodrift::diagnosis {
namespace {

struct Elsewhere {
  double evidence = 0.0;
  double left = 0.0;           // what is slow where it fits worst
  double strain = 0.0;         // of the machine that the recordings before have shown, where it is most
  std::vector<ModelPtr> fits;  // in each of them, with what all before have shown
};

/// In another recording with what is known of the machine, at the misfit that suits it, as in the first recording.
ModelPtr fitted_there(const Model& fit, const Model& known, const std::shared_ptr<const Dataset>& usual,
                      Sensors sensors) {
  Model there(fit.machine(), usual);
  there.learn_from(known, sensors);
  there.fit({10, 0.1, true});
  auto suited = std::make_shared<Dataset>(with_discrepancy(*usual, ordinary_discrepancy(*usual, there.prediction())));
  auto own = std::make_shared<Model>(fit.machine(), std::move(suited));
  own->learn_from(known, sensors);
  own->continue_from(there);
  own->fit({12, 0.05, true});
  return own;
}

Elsewhere elsewhere(const Model& fit, const OtherRecordings& others, Sensors sensors = Sensors::anew) {
  Elsewhere sum;
  const Model* known = &fit;
  for (const auto& usual : others) {
    sum.fits.push_back(fitted_there(fit, *known, usual, sensors));
    known = sum.fits.back().get();
    sum.evidence += known->log_evidence_total();
    sum.left = std::max(sum.left, excess_of(*known).largest);
    sum.strain = std::max(sum.strain, known->strain());
  }
  return sum;
}

/// A machine whose numbers all had to change is another one, though it fits. The same one, in five of a hundred and ten
/// sealed cases whose prediction missed by far: at most 2.0; others, by twos: 2.3, 5 to 130. What stands for many parts
/// as one lump each is known too badly to be bent.
bool of_another(const Elsewhere& there) {
  constexpr double bent = 5.0;
  return there.strain > bent && !of_lumps_alone(there.fits.front()->machine());
}

}  // namespace

bool happened_once(const Model& model) {
  return std::any_of(model.machine().effects.begin(), model.machine().effects.end(),
                     [](const auto& spec) { return physics::happens_once(spec.id); });
}

bool worth_naming(const Model& model) {
  constexpr double usual = 0.2;  // of the width of what is usual
  const int last = static_cast<int>(model.machine().effects.size()) - 1;
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    const physics::Parameter& unknown = model.unknown(i);
    if (unknown.effect != last || !unknown.amplitude) continue;
    if (std::abs(model.value(i)) >= usual * unknown.sigma) return true;
  }
  return false;
}

bool stands_still(const Model& model, std::size_t effect) {
  constexpr double least_swing = 0.2;  // of the mean: on for more than nine tenths of the time
  if (model.machine().effects[effect].id != "chiller_cycle") return false;
  std::map<std::string, double> found;
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    if (model.unknown(i).effect == static_cast<int>(effect)) found[model.unknown(i).key] = model.value(i);
  }
  return std::hypot(found["sine_W"], found["cosine_W"]) < least_swing * std::abs(found["mean_W"]);
}

bool within_tolerance(const Model& model) {
  constexpr double sound_gain = 0.01;
  constexpr double widths = 2.0;
  const int last = static_cast<int>(model.machine().effects.size()) - 1;
  if (last < 0) return false;
  if (stands_still(model, static_cast<std::size_t>(last))) return true;
  const std::string& id = model.machine().effects.back().id;
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    const physics::Parameter& unknown = model.unknown(i);
    if (unknown.effect != last || !unknown.amplitude) continue;
    if (id == "sensor_gain") return std::abs(model.value(i)) < sound_gain;
    if (id == "bearing_preload" && unknown.key != "growth_1_K") {
      return std::abs(model.value(i)) < widths * model.machine().tolerances.heat_source_power;
    }
  }
  return false;
}

void ask_elsewhere(std::vector<ModelPtr>& models, const Model& without, const OtherRecordings& others) {
  if (models.empty()) return;
  // The last is the one that the others are measured by.
  std::vector<Elsewhere> there(models.size() + 1);
  in_parallel(there.size(), [&](std::size_t i) {
    there[i] = elsewhere(i < models.size() ? *models[i] : without, others);
    there[i].fits.clear();
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < models.size(); ++i) {
    const bool fits = there[i].left <= least_evident;
    models[i]->elsewhere = fits ? there[i].evidence - there.back().evidence : 0.0;
    if (fits) models[kept++] = models[i];
  }
  models.resize(kept);
}

bool borne_out(const Model& fit, const Model& without, const OtherRecordings& others, double most_left) {
  constexpr double least = 3.0;  // twenty to one
  const Elsewhere there = elsewhere(fit, others);
  return there.left <= most_left && !of_another(there) && there.evidence - elsewhere(without, others).evidence > least;
}

bool fits_elsewhere(const Model& fit, const std::shared_ptr<const Dataset>& other) {
  const Elsewhere there = elsewhere(fit, {other});
  return there.left <= least_evident && !of_another(there);
}

SeenByAll seen_by_all(const Model& fit, const OtherRecordings& others) {
  Elsewhere anew = elsewhere(fit, others, Sensors::anew);
  Elsewhere the_same = elsewhere(fit, others, Sensors::the_same);
  constexpr double mounted_anew = 3.0;  // twenty to one: as a rule sensors stay where they are
  const bool same = the_same.evidence > anew.evidence - mounted_anew;
  Elsewhere& there = same ? the_same : anew;
  if (there.left > least_evident) return {};
  return {std::move(there.fits), same ? Sensors::the_same : Sensors::anew};
}

std::string moved_elsewhere(const Model& fit, const OtherRecordings& others) {
  for (const auto& usual : others) {
    const std::vector<Discrepancy> asked =
        likely_discrepancy(*usual, fitted_there(fit, fit, usual, Sensors::anew)->prediction());
    const std::string* moved = nullptr;
    bool warmer = false;
    for (std::size_t c = 0; c < asked.size(); ++c) {
      const MeasuredChannel& channel = usual->channels[c];
      if (channel.samples == 0 || !asked[c].asks_for_more()) continue;
      warmer = warmer || channel.temperature;
      if (moved == nullptr && !channel.temperature) moved = &channel.name;
    }
    if (moved != nullptr && !warmer) return *moved;
  }
  return {};
}

double evidence_of(const Model& model) {
  return model.log_evidence() + model.elsewhere;
}

}  // namespace zerodrift::diagnosis
