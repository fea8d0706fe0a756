#include "core/report/wording.h"

#include <algorithm>
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

std::string readable(const std::string& text, const Labels& labels) {
  static const std::regex channels(R"(\b(T[0-9]+_C|ambient_C|d[XYZ]_um|spindle_rpm|coolant_on|spindle_load_W)\b)");
  static const std::regex micrometres(R"(\bum\b)");
  static const std::regex celsius(R"(([0-9]) C\b)");
  std::string words;
  auto from = text.cbegin();
  for (std::sregex_iterator at(text.begin(), text.end(), channels), end; at != end; ++at) {
    words.append(from, text.cbegin() + at->position());
    words += channel_in_words(at->str(), labels);
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
  words = std::regex_replace(words, micrometres, "µm");
  return std::regex_replace(words, celsius, "$1 °C");
}

}  // namespace zerodrift::report
