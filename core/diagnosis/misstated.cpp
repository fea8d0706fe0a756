#include "core/diagnosis/misstated.h"

#include <algorithm>

#include "core/diagnosis/plausible.h"

namespace zerodrift::diagnosis {
namespace {

std::shared_ptr<Model> with_heat_times(const Model& model, const std::string& source_id, double factor) {
  physics::Machine machine = model.machine();
  for (physics::Component& component : machine.components) {
    for (physics::HeatSource& source : component.sources) {
      if (source.id == source_id) source.scale *= factor;
    }
  }
  auto moved = std::make_shared<Model>(std::move(machine), model.shared_data());
  moved->start_from(model, false);
  for (std::size_t i = 0; i < moved->unknowns(); ++i) {
    if (moved->unknown(i).key == "scale:" + source_id) moved->set_z(i, 0.0);
  }
  moved->fit({12, 0.05, true});
  return moved;
}

/// Fitted over described; 1 without it.
double factor_of(const Model& model, const std::string& source_id) {
  for (std::size_t i = 0; i < model.unknowns(); ++i) {
    if (model.unknown(i).key == "scale:" + source_id) return model.value(i) / model.unknown(i).mean;
  }
  return 1.0;
}

}  // namespace

std::shared_ptr<Model> fitted_without(const Model& best, const std::string& id) {
  physics::Machine machine = best.machine();
  std::erase_if(machine.effects, [&](const auto& spec) { return spec.candidate && spec.id == id; });
  auto without = std::make_shared<Model>(std::move(machine), best.shared_data());
  without->start_from(best, false);
  without->fit({12, 0.05, true});
  return without;
}

std::optional<Misstated> misstated_heat(const Model& best, const Model& without) {
  // Of 18 extra sources of a proof, one by chance where the motor is and in step with it was 5 behind what a motor
  // described so explains, the next 1.5 before it, all others more than 10; of 10 motors described so, all 6 behind.
  constexpr double hardly_worse = 3.0;
  constexpr double beyond_doubt = 1000.0;
  if (best.log_evidence() > without.log_evidence() + beyond_doubt) return std::nullopt;
  const std::vector<FarParameter> far = far_from_description(without);
  const auto heat =
      std::find_if(far.begin(), far.end(), [](const FarParameter& one) { return one.quantity == "quantity_heat"; });
  if (heat == far.end()) return std::nullopt;
  const std::shared_ptr<Model> first = with_heat_times(without, heat->of, heat->factor);
  const double more = factor_of(*first, heat->of);  // it still leaned towards what is described
  const std::shared_ptr<Model> last = with_heat_times(*first, heat->of, more);
  if (last->log_evidence() < best.log_evidence() - hardly_worse) return std::nullopt;
  return Misstated{heat->of, heat->factor * more};
}

}  // namespace zerodrift::diagnosis
