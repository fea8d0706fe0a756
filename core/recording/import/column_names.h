#pragma once
// What a column's name and unit say: the channel it becomes, and a channel that it looks like.

#include <optional>
#include <string>
#include <string_view>

#include "core/base/result.h"
#include "core/recording/import/units.h"

namespace zerodrift::recording {

struct StatedUnit {
  std::string unit;  // as written; empty: none
  std::string from;  // "name", "units-row", "block"
};

struct NamedChannel {
  std::string channel;
  double scale = 1.0;
  double offset = 0.0;
};

/// The channel that a column becomes without a map: its own name, with the contract's unit in place of the one stated.
/// unit_conflict where the name and another place state units that differ.
Result<NamedChannel> channel_from(const std::string& header, const std::string& label, const StatedUnit& stated,
                                  std::size_t place, const std::string& file);
/// The contract's unit in a channel's name ("T1_C", "spindle_rpm"), or nothing.
std::optional<Unit> unit_of_channel(std::string_view channel);
/// A channel of the contract that the column looks like, or "".
std::string proposal_for(const std::string& header, const std::string& label, const std::string& channel,
                         const std::optional<Unit>& unit);

}  // namespace zerodrift::recording
