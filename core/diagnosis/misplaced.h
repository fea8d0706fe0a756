#pragma once
// Does a sensor read what another place of its component would? A place in metres, or two cables exchanged, looks like
// missing physics that no law has.

#include <memory>
#include <optional>
#include <string>

#include "core/diagnosis/selection.h"

namespace zerodrift::diagnosis {

struct Misplaced {
  std::string channel;
  double described_mm = 0.0;
  double at_mm = 0.0;          // where it reads as if it sat
  std::string exchanged_with;  // the channel with which it changes places; empty: it alone
  std::string all_in;  // the unit that suits the places of all sensors of its component: "cm", "in", "m"; or empty
};

/// "misplaced:CHANNEL", "exchanged:CHANNEL:CHANNEL" or "places_in:UNIT".
std::string note_of(const Misplaced& found);

enum class Reach {
  aside,    // some per cent of the length to either side of where they are described: the sensors next to a joint that
            // is named, and those that are named as late or of another gain
  anywhere  // and before that every place where a sensor might be
};

/// The sensor whose place, changed, explains the recording far better than `best` does, beside what `best` names of
/// the machine or what is found missing with the sensor there; nothing where no place does, or where much is
/// left even so. `data`: with default widths. The models outlive the search.
class PlaceSearch {
 public:
  PlaceSearch(const Model& base, const Model& best, const std::shared_ptr<const Dataset>& data, Reach reach,
              const physics::RunFacts& facts, const SelectionOptions& limits, const TaskContext& context);
  ~PlaceSearch();
  PlaceSearch(const PlaceSearch&) = delete;
  PlaceSearch& operator=(const PlaceSearch&) = delete;

  /// Two exchanged, a unit, or a place that leaves nothing: asked before a wrong shape is.
  std::optional<Misplaced> at_once();

  /// Any place that leaves little.
  std::optional<Misplaced> beside_more();

 private:
  class Search;
  std::unique_ptr<Search> m_search;  // none: nothing is tried
};

}  // namespace zerodrift::diagnosis
