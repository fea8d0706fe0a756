#include "core/report/wording.h"

#include <algorithm>
#include <cctype>
#include <regex>

#include "core/recording/recording.h"

namespace zerodrift::report {

std::string channel_in_words(const std::string& channel, const Labels& labels) {
  using recording::ChannelKind;
  const std::string tag = channel.substr(0, channel.find('_'));
  switch (recording::kind_of(channel)) {
    case ChannelKind::ambient:
      return "Room";
    case ChannelKind::temperature: {
      const auto label = labels.find(channel);
      return label == labels.end() || label->second.empty() ? tag : tag + " " + label->second;
    }
    case ChannelKind::error:
      return tag.size() == 2 && tag[0] == 'd' ? "Error in " + tag.substr(1) : channel;
    case ChannelKind::tilt:
      return "Tilt " + tag;
    case ChannelKind::speed:
      return "Spindle speed";
    case ChannelKind::coolant:
      return "Coolant";
    case ChannelKind::load:
      return "Spindle load";
    case ChannelKind::feed:
    case ChannelKind::input:
      break;
  }
  return channel;
}

std::string readable(const std::string& original, const Labels& labels) {
  static const std::regex channels(R"(\b(T[0-9]+_C|ambient_C|d[XYZ]_um|spindle_rpm|coolant_on|spindle_load_W)\b)");
  static const std::regex micrometres(R"(\bum\b)");
  // A number of its own, not the one in "T17 C table drive".
  static const std::regex celsius(R"((^|[^A-Za-z0-9_.])([-+]?[0-9]+(\.[0-9]+)?) C\b)");
  const std::string text = std::regex_replace(std::regex_replace(original, micrometres, "µm"), celsius, "$1$2 °C");
  std::string words;
  auto from = text.cbegin();
  for (std::sregex_iterator at(text.begin(), text.end(), channels), end; at != end; ++at) {
    words.append(from, text.cbegin() + at->position());
    std::string name = channel_in_words(at->str(), labels);
    const bool begins = words.empty() || words.ends_with(". ") || words.ends_with(": ");
    if (!begins && at->str().front() != 'T') name.front() = static_cast<char>(std::tolower(name.front()));
    words += name;
    from = text.cbegin() + at->position() + at->length();
    // Some sentences name the place already.
    const auto label = labels.find(at->str());
    const std::string place = label == labels.end() ? std::string() : " (" + label->second + ")";
    const auto rest = static_cast<std::size_t>(text.cend() - from);
    if (!place.empty() && rest >= place.size() && std::equal(place.begin(), place.end(), from)) {
      from += static_cast<std::ptrdiff_t>(place.size());
    }
  }
  words.append(from, text.cend());
  return words;
}

}  // namespace zerodrift::report
