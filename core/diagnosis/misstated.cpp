#include "core/diagnosis/misstated.h"

#include <algorithm>

#include "core/diagnosis/refined.h"
#include "core/diagnosis/selection.h"

namespace zerodrift::diagnosis {
namespace {

std::shared_ptr<Model> fitted_like(physics::Machine machine, const Model& like) {
  auto model = std::make_shared<Model>(std::move(machine), like.shared_data());
  model->start_from(like, false);
  for (std::size_t i = 0; i < model->unknowns(); ++i) {
    // What is described as it was fitted is where it is described.
    for (std::size_t k = 0; k < like.unknowns(); ++k) {
      const physics::Parameter& now = model->unknown(i);
      const physics::Parameter& before = like.unknown(k);
      if (now.key == before.key && now.component == before.component && now.effect == before.effect &&
          now.mean != before.mean) {
        model->set_z(i, 0.0);
      }
    }
  }
  model->fit({12, 0.05, true});
  return model;
}

bool is_describable(const FarParameter& number) {
  return number.quantity != "quantity_film";
}

physics::Machine described_as_fitted(const Model& model, std::size_t unknown) {
  physics::Machine machine = model.machine();
  take_value(machine, model.unknown(unknown), model.value(unknown));
  return machine;
}

}  // namespace

std::optional<Misstated> as_if_described(const Model& model) {
  const std::vector<FarParameter> far = far_from_description(model);
  const auto number = std::find_if(far.begin(), far.end(), is_describable);
  if (number == far.end()) return std::nullopt;
  const physics::Parameter& as_described = model.unknown(number->unknown);
  Misstated found{*number, fitted_like(described_as_fitted(model, number->unknown), model)};
  for (std::size_t i = 0; i < found.fit->unknowns(); ++i) {
    const physics::Parameter& now = found.fit->unknown(i);
    if (now.key != as_described.key || now.component != as_described.component) continue;
    // The first fit leaned towards what is described.
    found.number.factor = found.fit->value(i) / as_described.mean;
    found.fit = fitted_like(described_as_fitted(*found.fit, i), *found.fit);
    break;
  }
  return found;
}

std::shared_ptr<Model> fitted_without(const Model& best, const std::string& id) {
  physics::Machine machine = best.machine();
  std::erase_if(machine.effects, [&](const auto& spec) { return spec.candidate && spec.id == id; });
  return fitted_like(std::move(machine), best);
}

std::optional<Misstated> misstated_instead(const Model& best, const Model& without) {
  // Of 18 extra sources of a proof, one by chance where the motor is and in step with it was 5 behind what a motor
  // described so explains, the next 1.5 before it, all others more than 10; of 10 motors described so, all 6 behind.
  constexpr double hardly_worse = 3.0;
  constexpr double much = 1000.0;
  constexpr double explains_little = 10.0;  // as excess: then no number can
  const bool beyond_doubt = best.log_evidence() > without.log_evidence() + much;
  if (beyond_doubt && excess_of(without).largest > explains_little) return std::nullopt;
  std::optional<Misstated> found = as_if_described(without);
  if (!found || found->fit->log_evidence() < best.log_evidence() - hardly_worse) return std::nullopt;
  return found;
}

}  // namespace zerodrift::diagnosis
