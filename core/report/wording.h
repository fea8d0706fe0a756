#pragma once
// From the identifiers of files and logs to what people read: "T14_C" is "T14 Spindle nose", "um" is "µm".

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <string>

namespace zerodrift::report {

/// Channel -> what stands beside its tag, for example "T14_C" -> "Spindle nose"; for a displacement the axis it is of:
/// "probe2_um" -> "Z".
using Labels = std::map<std::string, std::string>;

/// "T14 Spindle nose", "Room", "Error in Y", "Spindle speed"; another channel is left as it is.
std::string channel_in_words(const std::string& channel, const Labels& labels);
/// Where there is little room: "T14", "Z", "Room"; the name without its unit for the rest.
std::string tag_of(const std::string& channel, const Labels& labels);
/// Whether a word of a sentence is a channel: by its form, or because it has a label.
bool is_channel(const std::string& word, const Labels& labels);
/// Adds the channels of an imported run: what was kept of its import (core/recording/import).
void add_imported(Labels& labels, const nlohmann::json& kept);
/// A sentence of core with its units and channels as people read them.
std::string readable(const std::string& original, const Labels& labels);

}  // namespace zerodrift::report
