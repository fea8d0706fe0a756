#pragma once
// Which other places a search for misplaced sensors tries (misplaced.h).

#include <memory>
#include <string>
#include <vector>

#include "core/diagnosis/misplaced.h"
#include "core/diagnosis/model.h"

namespace zerodrift::diagnosis {

inline constexpr int tried_per_rod = 16;  // places of one sensor

enum class Mistake {
  another_place,
  a_little_aside,  // by a few per cent of the length: more usual
  typical          // an exchange, or described numbers in another unit: nothing is free to suit the data
};

struct Trial {
  Misplaced what;
  Mistake kind = Mistake::another_place;
  std::shared_ptr<Model> fit;
};

bool is_exchange(const Trial& trial);

/// The same sensor at much the same place.
bool same_place(const Trial& a, const Trial& b);

const physics::Component& rod_of(const Trial& trial);

/// The machine with its sensors where `what` has them.
physics::Machine placed(physics::Machine machine, const Misplaced& what);

/// Every place of the sensors that are missed most by the base or by what explains the recording best (`best`, and
/// `sound`: without faults of sensors), or that are said to be at fault; every exchange; every unit.
std::vector<Trial> places_anywhere(const Model& base, const Model& best, const Model& sound);

physics::Machine without_sensor_faults(physics::Machine machine);

/// Places beside those described, and the machine without what they pass for.
struct Suspicion {
  std::vector<Trial> trials;
  physics::Machine without;
};

std::vector<Suspicion> aside_of_what_is_named(const Model& base, const Model& best);

}  // namespace zerodrift::diagnosis
