#pragma once
// From the identifiers of files and logs to what people read: "T14_C" is "T14 Spindle nose", "um" is "µm".

#include <map>
#include <string>

namespace zerodrift::report {

/// Channel -> what stands beside its tag, for example "T14_C" -> "Spindle nose".
using Labels = std::map<std::string, std::string>;

/// "T14 Spindle nose", "Room", "Error in Y", "Spindle speed"; another channel is left as it is.
std::string channel_in_words(const std::string& channel, const Labels& labels);
/// A sentence of core with its units and channels as people read them.
std::string readable(const std::string& original, const Labels& labels);

}  // namespace zerodrift::report
