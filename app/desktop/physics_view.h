#pragma once
// From the artefact "physics", the run and the machine description to what the physics page draws.

#include <nlohmann/json_fwd.hpp>

#include "core/commissioning/job.h"
#include "core/controller/profile.h"
#include "core/physics/machine.h"
#include "core/recording/recording.h"
#include "ui/pages/physics_page.h"

namespace zerodrift::desktop {

/// The recording, the simulation of it, and the simulation with what was found (empty until the search).
struct Compared {
  recording::Recording recorded;
  recording::Recording simulated;
  recording::Recording refined;
};
/// Empty recordings where the job has none.
Compared compared_of(const commissioning::Job& job, const recording::Recording& recorded);

/// The rods of the machine with sources and sensors; `body` adds the recommended region and the place of the mismatch.
QVector<ui::DrawnComponent> components_of(const physics::Machine& machine, const nlohmann::json& body);
QVector<ui::SimulatedChannel> channels_of(const Compared& runs, const physics::Machine& machine,
                                          const nlohmann::json& body);
/// What the search located, in W; before it, and again when effects were adopted, recorded minus simulated at the
/// sensors, in K, linear between them.
ui::HeatMapData heat_of(const nlohmann::json& body, const physics::Machine& machine, const std::string& component,
                        const Compared& runs);
void fill_explanations(const nlohmann::json& body, const Compared& runs, ui::PhysicsState& state);
/// A stored sentence {"id", "facts"} in the language of the window; `english` where nothing but the text was stored.
QString sentence_of(const nlohmann::json& stored, const std::string& english);
/// The sentences of an object that keeps them as "said" and in English as "sentences".
QString sentences_of(const nlohmann::json& body);
/// "extra_heat_source" as words.
QString effect_name(const std::string& id);
/// "coolant+sensor_lag" as words.
QString effects_in_words(const std::string& ids);
/// The temperatures of a blind trial's run; `refined` may be empty.
QVector<ui::TrialCurve> trial_curves(const recording::Recording& recorded, const recording::Recording& simulated,
                                     const recording::Recording& refined);

}  // namespace zerodrift::desktop
