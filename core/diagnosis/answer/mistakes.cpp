#include "core/diagnosis/answer/mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/description/corrected_value.h"
#include "core/diagnosis/explain.h"

namespace zerodrift::diagnosis::answer {
namespace {

/// Sensors or sizes are not as described: what would be named beside that waits until it is corrected.
bool is_of_set_up(ErrorKind kind) {
  return kind == ErrorKind::place || kind == ErrorKind::exchange || kind == ErrorKind::unit ||
         kind == ErrorKind::datum || kind == ErrorKind::other_end || kind == ErrorKind::length ||
         kind == ErrorKind::diameter;
}

double mass_of(const search::Posterior& posterior, const std::vector<double>& probability, const std::string& name) {
  double mass = 0.0;
  for (std::size_t i = 0; i < probability.size(); ++i) {
    const auto& errors = posterior.explanations[i].fit->model().hypothesis().errors;
    if (std::any_of(errors.begin(), errors.end(), [&](const auto& one) { return name_of(one) == name; }))
      mass += probability[i];
  }
  return mass;
}

/// As the sentence of a number far from what is described has it.
FarParameter far_of(const DescriptionError& error, const physics::Machine& described) {
  FarParameter far;
  const bool all_heat = error.kind == ErrorKind::heat;
  far.quantity = all_heat ? "quantity_heat" : quantity_of_number(error.other);
  const std::size_t colon = error.other.find(':');
  far.of = all_heat || colon == std::string::npos ? error.of : error.other.substr(colon + 1);
  if (far.of.empty()) far.of = described.components.front().id;
  far.factor = error.value;
  far.widths = std::abs(std::log(error.value)) / (all_heat ? described.tolerances.heat_source_power : error.tolerance);
  return far;
}

std::string mm(double value) {
  return fmt::format("{:.0f}", std::abs(value));
}

Sentence sentence_of(const DescriptionError& error) {
  switch (error.kind) {
    case ErrorKind::place:
      return explain_note("misplaced", {{"channel", error.of},
                                        {"other", ""},
                                        {"unit", ""},
                                        {"described", fmt::format("{:.4g}", error.described)},
                                        {"at", mm(error.value)}});
    case ErrorKind::exchange:
      return explain_note("exchanged", {{"channel", error.of}, {"other", error.other}});
    case ErrorKind::unit:
      return explain_note("places_in", {{"unit", error.other}});
    case ErrorKind::datum:
      return explain_note(error.value < 0.0 ? "datum_nearer" : "datum",
                          {{"component", error.of}, {"fits", mm(error.value)}});
    case ErrorKind::other_end:
      return explain_note("other_end", {{"component", error.of}});
    case ErrorKind::length:
      return explain_note("overlong", {{"component", error.of},
                                       {"described", mm(error.described)},
                                       {"bare", mm(error.described - error.low)},
                                       {"fits", mm(error.value)}});
    case ErrorKind::diameter:
      return explain_note("diameter",
                          {{"component", error.of}, {"described", mm(error.described)}, {"fits", mm(error.value)}});
    case ErrorKind::sign:
      return explain_note("sign_turned", {{"channel", error.of}});
    case ErrorKind::absent_effect:
      return explain_note("described_not_there", {{"name", error.of}});
    case ErrorKind::clock:
      return explain_note(name_of(error), {{"seconds", mm(error.value)}});
    case ErrorKind::heat:
    case ErrorKind::number:
      break;
  }
  return {};
}

std::string note_of(const DescriptionError& error, const FarParameter& far) {
  if (error.kind == ErrorKind::heat || error.kind == ErrorKind::number)
    return fmt::format("far_from_description:{}:{}:{:.3g}", far.quantity.substr(9), far.of, far.factor);
  if (error.kind == ErrorKind::clock) return name_of(error) + ":" + mm(error.value);
  return name_of(error);
}

}  // namespace

void tell_mistakes(const search::Posterior& posterior, const std::vector<double>& probability, Diagnosis& answer) {
  const inference::Fit& best = *posterior.explanations.front().fit;
  const physics::Machine& described = posterior.evidence->machine();
  std::vector<DescriptionError> named;
  for (std::size_t i = 0; i < best.model().hypothesis().errors.size(); ++i) {
    DescriptionError error = description::fitted_error(best, i);
    if (mass_of(posterior, probability, name_of(error)) >= posterior.evidence->settings().named_from)
      named.push_back(std::move(error));
  }
  if (named.empty()) return;
  const auto any = [&](auto which) { return std::any_of(named.begin(), named.end(), which); };
  answer.wrong_set_up = any([](const auto& one) { return is_of_set_up(one.kind); });
  if (answer.wrong_set_up) answer.effects.clear();
  // The clock is set right, and a joint that conducts otherwise than drawn is a fault of the machine.
  const bool of_description =
      any([](const DescriptionError& one) { return one.kind != ErrorKind::clock && one.other != "conductance_W_K"; });
  const bool sign = any([](const auto& one) { return one.kind == ErrorKind::sign; });
  if (answer.wrong_set_up || sign || (answer.effects.empty() && of_description)) {
    answer.verdict = Verdict::unexplained;
    answer.doubtful = true;
  } else if (answer.effects.empty()) {
    const bool left = std::any_of(answer.channels.begin(), answer.channels.end(),
                                  [](const auto& one) { return one.verdict == ChannelVerdict::unexplained; });
    answer.verdict = left ? Verdict::unexplained : Verdict::consistent;
  }
  for (const DescriptionError& error : named) {
    const bool number = error.kind == ErrorKind::heat || error.kind == ErrorKind::number;
    const FarParameter far = number ? far_of(error, described) : FarParameter{};
    answer.notes.push_back(note_of(error, far));
    // The verdict says that alone.
    if (error.kind == ErrorKind::absent_effect && answer.doubtful) continue;
    answer.sentences.push_back(number ? explain_far(far) : sentence_of(error));
  }
}

}  // namespace zerodrift::diagnosis::answer
