#pragma once
// Between a fitted model and a machine description: the description with the fitted values, the effects with theirs.

#include "core/diagnosis/model.h"

namespace zerodrift::diagnosis {

/// The description of today with the fitted values; candidates become described effects.
physics::Machine refined_machine(const Model& model);
/// A number of the description takes this value; what the description has no number for stays as it is.
void take_value(physics::Machine& machine, const physics::Parameter& parameter, double value);
/// A room that nobody logged is where the fitted recording showed it to be, so that a simulation of that recording
/// gives what was fitted. Not for other recordings: they have rooms of their own.
void state_room(physics::Machine& refined, const Model& model);
/// Predicts another recording with it: its own start (first samples) gives the sensors' offsets of that recording.
/// `hold`: share of a sample interval that already has the next sample's inputs; 0 as inputs are defined, else what
/// another recording of the same logger showed.
physics::Prediction predict_other(const physics::Machine& refined, const recording::Recording& recording, double hold);
/// Numbers of one effect of the model after the fit, without prior widths; sigma by key.
physics::EffectSpec fitted_effect(const Model& model, std::size_t index,
                                  std::map<std::string, double>* sigma = nullptr);

}  // namespace zerodrift::diagnosis
