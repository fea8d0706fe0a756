#include "core/report/wording.h"

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <regex>

#include "core/recording/import/importer.h"
#include "core/recording/recording.h"
#include "core/report/naming.h"

namespace zerodrift::report {

std::string channel_in_words(const std::string& channel, const Labels& labels) {
  using recording::ChannelKind;
  const std::string tag = tag_of(channel, labels);
  switch (recording::kind_of(channel)) {
    case ChannelKind::ambient:
      return tag;
    case ChannelKind::temperature: {
      const auto label = labels.find(channel);
      return label == labels.end() || label->second.empty() ? tag : tag + " " + label->second;
    }
    case ChannelKind::error:
      return "Error in " + tag;
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

std::string tag_of(const std::string& channel, const Labels& labels) {
  using recording::ChannelKind;
  const auto kind = recording::kind_of(channel);
  if (kind == ChannelKind::ambient) return "Room";
  const bool moves = kind == ChannelKind::error || kind == ChannelKind::tilt;
  if (const auto label = labels.find(channel); moves && label != labels.end() && !label->second.empty()) {
    return label->second;
  }
  if (!moves && kind != ChannelKind::temperature) return channel;
  const std::string tag = channel.substr(0, channel.rfind('_'));
  return kind == ChannelKind::error && tag.size() == 2 && tag[0] == 'd' ? tag.substr(1) : tag;
}

bool is_channel(const std::string& word, const Labels& labels) {
  static const std::regex known(R"(T[0-9]+_C|ambient_C|d[XYZ]_um|spindle_rpm|coolant_on|spindle_load_W)");
  return labels.contains(word) || std::regex_match(word, known);
}

void add_imported(Labels& labels, const nlohmann::json& kept) {
  const auto assigned = recording::assigned_in(kept);
  for (const auto& channel : assigned.channels) labels.try_emplace(channel);
  for (const auto* said : {&assigned.axes, &assigned.locations}) {
    for (const auto& [channel, words] : *said) labels[channel] = words;
  }
}

namespace {

/// Units as people read them, and no zero with a sign.
std::string with_units(const std::string& original) {
  static const std::regex micrometres(R"(\bum\b)");
  // A number of its own, not the one in "T17 C table drive".
  static const std::regex celsius(R"((^|[^A-Za-z0-9_.])([-+]?[0-9]+(\.[0-9]+)?) C\b)");
  static const std::regex signed_zero(R"((^|[^A-Za-z0-9_.])-(0(\.0+)?)(?![0-9.]))");
  const std::string text = std::regex_replace(std::regex_replace(original, micrometres, "µm"), celsius, "$1$2 °C");
  return std::regex_replace(text, signed_zero, "$1$2");
}

/// A Chinese character in UTF-8 (U+4000 to U+9FFF) begins here.
bool is_chinese(std::string_view text, std::size_t at) {
  return at + 2 < text.size() && text[at] >= '\xE4' && text[at] <= '\xE9';
}

bool ends_chinese(std::string_view text) {
  return text.size() >= 3 && is_chinese(text, text.size() - 3);
}

}  // namespace

std::string readable(const std::string& original, const Labels& labels) {
  return readable(original, labels, nullptr);
}

std::string readable(const std::string& original, const Labels& labels,
                     const std::function<std::string(const std::string&)>& name) {
  static const std::regex channels(R"(\b([A-Za-z]\w*_(C|um|urad)|spindle_rpm|coolant_on|spindle_load_W)\b)");
  const std::string text = with_units(original);
  std::string words;
  auto from = text.cbegin();
  for (std::sregex_iterator at(text.begin(), text.end(), channels), end; at != end; ++at) {
    if (!is_channel(at->str(), labels)) continue;
    words.append(from, text.cbegin() + at->position());
    std::string said = name ? name(at->str()) : channel_in_words(at->str(), labels);
    const bool begins = words.empty() || words.ends_with(". ") || words.ends_with(": ");
    const bool sensor = recording::kind_of(at->str()) == recording::ChannelKind::temperature;
    if (!name && !begins && !sensor) said.front() = static_cast<char>(std::tolower(said.front()));
    // The sentences leave a space beside a channel, as beside any word of another script; between Chinese ones is none.
    if (words.ends_with(' ') && ends_chinese(std::string_view(words).substr(0, words.size() - 1)) &&
        is_chinese(said, 0)) {
      words.pop_back();
    }
    words += said;
    from = text.cbegin() + at->position() + at->length();
    const std::string_view behind(text.data() + (from - text.cbegin()), static_cast<std::size_t>(text.cend() - from));
    if (behind.starts_with(' ') && is_chinese(behind, 1) && ends_chinese(said)) ++from;
    // Some sentences name the place already.
    const auto label = labels.find(at->str());
    const std::string place = label == labels.end() ? std::string() : label->second;
    const auto rest = static_cast<std::size_t>(text.cend() - from);
    for (const std::string& repeated : {" (" + place + ")", "（" + place + "）"}) {
      if (place.empty() || rest < repeated.size() || !std::equal(repeated.begin(), repeated.end(), from)) continue;
      from += static_cast<std::ptrdiff_t>(repeated.size());
      break;
    }
  }
  words.append(from, text.cend());
  return words;
}

}  // namespace zerodrift::report
