#include "core/diagnosis/answer/mistakes.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/diagnosis/answer/explain.h"
#include "core/diagnosis/description/corrected_value.h"

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

std::string mm(double value) {
  return fmt::format("{:.0f}", std::abs(value));
}

Note note_of_number(const DescriptionError& error, const physics::Machine& described) {
  const bool all_heat = error.kind == ErrorKind::heat;
  const std::string quantity = all_heat ? "heat" : quantity_of_number(error.other).substr(9);
  const std::size_t colon = error.other.find(':');
  std::string of = all_heat || colon == std::string::npos ? error.of : error.other.substr(colon + 1);
  if (of.empty()) of = described.components.front().id;
  const double tolerance = all_heat ? described.tolerances.heat_source_power : error.tolerance;
  return far_from_description(quantity, of, error.value, std::abs(std::log(error.value)) / tolerance);
}

std::map<std::string, std::string> facts_of(const DescriptionError& error) {
  switch (error.kind) {
    case ErrorKind::place:
      return {{"channel", error.of}, {"described", fmt::format("{:.4g}", error.described)}, {"at", mm(error.value)}};
    case ErrorKind::exchange:
      return {{"channel", error.of}, {"other", error.other}};
    case ErrorKind::unit:
      return {{"unit", error.other}};
    case ErrorKind::datum:
      if (error.value < 0.0) return {{"component", error.of}, {"fits", mm(error.value)}, {"nearer", "yes"}};
      return {{"component", error.of}, {"fits", mm(error.value)}};
    case ErrorKind::other_end:
      return {{"component", error.of}};
    case ErrorKind::length:
      return {{"component", error.of},
              {"described", mm(error.described)},
              {"bare", mm(error.described - error.low)},
              {"fits", mm(error.value)}};
    case ErrorKind::diameter:
      return {{"component", error.of}, {"described", mm(error.described)}, {"fits", mm(error.value)}};
    case ErrorKind::sign:
      return {{"channel", error.of}};
    case ErrorKind::absent_effect:
      return {{"effect", error.of}};
    case ErrorKind::clock:
      return {{"seconds", mm(error.value)}};
    case ErrorKind::heat:
    case ErrorKind::number:
      break;
  }
  return {};
}

}  // namespace

NoteCode code_of(const DescriptionError& error) {
  switch (error.kind) {
    case ErrorKind::place:
      return NoteCode::misplaced;
    case ErrorKind::exchange:
      return NoteCode::exchanged;
    case ErrorKind::unit:
      return NoteCode::places_in;
    case ErrorKind::datum:
      return NoteCode::datum;
    case ErrorKind::other_end:
      return NoteCode::other_end;
    case ErrorKind::length:
      return NoteCode::overlong;
    case ErrorKind::diameter:
      return NoteCode::diameter;
    case ErrorKind::sign:
      return NoteCode::sign_turned;
    case ErrorKind::absent_effect:
      return NoteCode::described_not_there;
    case ErrorKind::clock:
      return error.value < 0.0 ? NoteCode::clock_early : NoteCode::clock_late;
    case ErrorKind::heat:
    case ErrorKind::number:
      break;
  }
  return NoteCode::far_from_description;
}

void report_mistakes(const search::Posterior& posterior, const std::vector<double>& probability, Diagnosis& answer) {
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
    const NoteCode code = code_of(error);
    answer.notes.push_back(code == NoteCode::far_from_description ? note_of_number(error, described)
                                                                  : Note{code, facts_of(error)});
  }
}

}  // namespace zerodrift::diagnosis::answer
