#include "core/report/doubts.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "core/base/error_json.h"
#include "core/base/json.h"
#include "core/report/limits.h"

namespace zerodrift::report {

using nlohmann::json;

namespace {

/// The page on which an artefact is made, in words.
const char* step_of(const std::string& kind) {
  static const std::map<std::string, const char*> steps = {{"machine", "Machine"},
                                                           {"calibration", "Calibrate"},
                                                           {"warmup", "Warm-up"},
                                                           {"sensors", "Sensors"},
                                                           {"model", "Fit"},
                                                           {"physics", "Physics"},
                                                           {"upload", "Upload"},
                                                           {"verification", "Verify"},
                                                           {"axis_table", "Axis errors"}};
  const auto at = steps.find(kind);
  return at == steps.end() ? kind.c_str() : at->second;
}

/// Gathers doubts about one artefact after the other.
std::string in_words(const Source& source, const Error& error) {
  const auto fact = [&](const char* key) {
    const auto at = error.context.find(key);
    return at == error.context.end() ? std::string("-") : source.in_words(at->second);
  };
  switch (error.code) {
    case ErrorCode::not_enough_data:
      return source.tell("too little data: {} has {}, {} needed", fact("what"), fact("found"), fact("needed"));
    case ErrorCode::channel_missing:
      return source.tell("{} is missing", fact("channel"));
    case ErrorCode::sensor_dead:
      return source.tell("{} gives no samples", fact("sensor"));
    case ErrorCode::no_variation:
      return source.tell("{} never changes", fact("what"));
    case ErrorCode::data_does_not_fit:
      return source.tell("{} does not fit: found {}, expected {}", fact("what"), fact("found"), fact("expected"));
    case ErrorCode::machine_silent:
    case ErrorCode::machine_link_lost:
    case ErrorCode::machine_unreachable:
    case ErrorCode::machine_gateway:
      return source.say("the controller did not answer");
    default:
      return source.tell("the program could not do it ({})", name_of(error.code));
  }
}

/// Of {"said", "code", "context"}: what was not done, and why.
std::string what_failed(const Source& source, const json& problem) {
  const auto error = error_from_json(problem);
  if (!error) return json_text(problem);
  if (problem.value("said", "") == "no_correction") return source.tell("no correction: {}", in_words(source, *error));
  return source.tell("What the simulation lacks was not searched: {}", in_words(source, *error));
}

/// A text of a step; what failed stands at its end, by code and facts.
std::string told(const Source& source, const std::string& text) {
  const std::size_t colon = text.find(": ");
  const auto error = colon == std::string::npos ? std::nullopt : error_described(text.substr(colon + 2));
  return source.in_words(error ? text.substr(0, colon + 2) + in_words(source, *error) : text);
}

class Doubts {
 public:
  explicit Doubts(const Source& source) : m_source(source) {}

  /// The artefact that the next doubts are about; null when the job has none.
  const json* about(const char* kind) {
    m_kind = kind;
    const auto* artefact = m_source.find(kind);
    return artefact == nullptr ? nullptr : &artefact->body;
  }

  template <class... Args>
  void add(Verdict verdict, const char* detail, const char* words, const Args&... args) {
    m_all.push_back({verdict, m_source.tell(words, args...), m_source.trace(m_kind, detail)});
  }

  /// As pages judge: up to a quarter above the limit is doubtful, more is bad. Nothing for a value that is not there.
  template <class... Args>
  void at_most(double value, double limit, const char* detail, const char* words, const Args&... args) {
    if (!(std::abs(value) > limit)) return;
    add(std::abs(value) > 1.25 * limit ? Verdict::bad : Verdict::doubtful, detail, words, args...);
  }

  void problems(const json& body) {
    for (const auto& problem : body.value("problems", json::array())) {
      const std::string text =
          problem.is_string() ? told(m_source, problem.get<std::string>()) : what_failed(m_source, problem);
      m_all.push_back({Verdict::doubtful, text, m_source.trace(m_kind, "problems")});
    }
  }

  std::vector<Doubt> take() { return std::move(m_all); }

 private:
  const Source& m_source;
  std::string m_kind;
  std::vector<Doubt> m_all;
};

void about_head(const Source& source, Doubts& doubts) {
  doubts.about("head");
  if (!source.header().engineer.empty()) return;
  doubts.add(Verdict::doubtful, "engineer",
             "Nobody is named as the engineer who did this work. Enter the name on the Report page "
             "(on the command line: --engineer).");
}

void about_machine(Doubts& doubts) {
  const json* body = doubts.about("machine");
  if (body == nullptr) return;
  doubts.problems(*body);
  // Never worse than doubtful: a sensor by a motor that always holds is always warmer, and does no harm.
  if (const double spread_K = number_of(*body, "spread_K"); spread_K > limits::spread_K) {
    doubts.add(Verdict::doubtful, "spread_K",
               "When the commissioning began the sensors differed by {} K (limit {} K): as far as the machine was "
               "still settling, the "
               "drift that was under way already is not in the figures.",
               shown(spread_K, 2), shown(limits::spread_K, 1));
  }
  doubts.at_most(number_of(*body, "round_trip_ms"), limits::round_trip_ms, "round_trip_ms",
                 "An answer of the controller took {} ms (limit {} ms).", shown(number_of(*body, "round_trip_ms"), 0),
                 shown(limits::round_trip_ms, 0));
  doubts.at_most(number_of(*body, "clock_difference_s"), limits::clock_difference_s, "clock_difference_s",
                 "The controller's clock differed from the computer's by {} s (limit {} s).",
                 shown(number_of(*body, "clock_difference_s"), 1), shown(limits::clock_difference_s, 0));
}

void about_calibration(Doubts& doubts) {
  const json* body = doubts.about("calibration");
  if (body == nullptr || text_of(*body, "source") == "probes") return;
  doubts.problems(*body);
  for (const auto& camera : body->value("cameras", json::array())) {
    doubts.at_most(number_of(camera, "rms_um"), limits::calibration_rms_um, "rms_um",
                   "Camera {}: the calibration left {} µm rms (limit {} µm).", text_of(camera, "id"),
                   shown(number_of(camera, "rms_um"), 2), shown(limits::calibration_rms_um, 1));
  }
  if (body->value("reference_target", false)) return;
  doubts.add(Verdict::doubtful, "reference_target",
             "No fixed reference target stood in every camera's view: the drift of camera and holder is part of the "
             "figures, some 2 µm for each K that 100 mm of aluminium warm up.");
}

void about_run(const Source& source, const char* kind, const char* name, Doubts& doubts) {
  const json* body = doubts.about(kind);
  if (body == nullptr) return;
  doubts.problems(*body);
  const std::string run = source.say(name);
  const auto lost = body->value("lost_samples", 0LL);
  const auto expected = lost + body->value("rows", 0LL);
  if (lost > 0) {
    const double hole_s = longest_hole_s(source.run_of(kind));
    const bool harmless = hole_s <= limits::harmless_hole_s;
    doubts.add(hole_s > limits::worst_hole_s ? Verdict::bad : Verdict::doubtful, "lost_samples",
               harmless ? "{}: {} of {} samples were lost, never for longer than {} s of machine time. Temperatures "
                          "change over minutes: this changes no figure noticeably."
                        : "{}: {} of {} samples were lost, once for {} s of machine time. What the machine did "
                          "meanwhile is not in the model.",
               run, lost, expected, shown(hole_s, 0));
  }
  const int refused = body->value("refused", 0);
  if (refused > 0) {
    doubts.add(Verdict::doubtful, "refused", "{}: {} of {} measurements of the error were refused or incomplete.", run,
               refused, body->value("measurements", 0));
  }
}

void about_sensors(Doubts& doubts) {
  const json* body = doubts.about("sensors");
  if (body == nullptr) return;
  doubts.problems(*body);
  const double condition = number_of(body->value("condition_number", json::object()), "chosen");
  // Ridge holds what rises together; what a single coefficient says is lost all the same.
  if (condition > limits::condition_number) {
    doubts.add(Verdict::doubtful, "condition_number",
               "The kept sensors are much alike: condition number {} (up to {} each coefficient is sure). Their single "
               "coefficients mean "
               "little; what they predict together is judged by the error on unseen data.",
               shown(condition, 0), shown(limits::condition_number, 0));
  }
  const json price = body->value("price", json::object());
  const double kept_um = number_of(price, "held_out_rms_um");
  const double all_um = number_of(price, "all_rms_um");
  doubts.at_most(kept_um, limits::unseen_error_um, "price",
                 "The kept sensors leave {} µm rms on unseen stretches (limit {} µm).", shown(kept_um, 1),
                 shown(limits::unseen_error_um, 1));
  const double lost_percent = all_um > 0.0 ? 100.0 * (kept_um / all_um - 1.0) : 0.0;
  if (lost_percent <= limits::lost_against_all_percent || kept_um - all_um <= limits::lost_against_all_um) return;
  doubts.at_most(lost_percent, limits::lost_against_all_percent, "price",
                 "With all sensors the error on unseen stretches would be {} µm rms, with those kept it is {} µm: "
                 "{} % lost (limit {} %).",
                 shown(all_um, 2), shown(kept_um, 2), shown(lost_percent, 0),
                 shown(limits::lost_against_all_percent, 0));
}

void about_model(const Source& source, Doubts& doubts) {
  const json* body = doubts.about("model");
  if (body == nullptr) return;
  doubts.problems(*body);
  double peak_um = 0.0;
  for (const auto& figure : body->value("figures", json::array())) {
    peak_um = std::fmax(peak_um, number_of(figure, "peak_held_out_um"));
  }
  doubts.at_most(peak_um, limits::attainable_peak_um, "peak_held_out_um",
                 "On data it has not seen the model leaves up to {} µm (limit {} µm).", shown(peak_um, 1),
                 shown(limits::attainable_peak_um, 1));
  const json model = body->value("model", json::object());
  const json quality = model.value("quality", json::object());
  const double range_um = number_of(quality, "error_range_um");
  const double removed = range_um > 0.0 ? 100.0 * (1.0 - peak_um / range_um) : std::nan("");
  if (removed < limits::removed_percent) {
    doubts.add(removed < limits::removed_percent / 1.25 ? Verdict::bad : Verdict::doubtful, "quality",
               "Of the largest error the model removes {} % on unseen data (at least {} % wanted).", shown(removed, 0),
               shown(limits::removed_percent, 0));
  }
  for (const auto& error : model.value("errors", json::array())) {
    const double coverage = 100.0 * number_of(error.value("band", json::object()), "measured_coverage");
    const bool stated = number_of(error.value("band", json::object()), "stated_coverage") > 0.0;
    if (!stated || !(coverage < limits::coverage_percent)) continue;
    doubts.add(Verdict::doubtful, "band", "{}: only {} % of the measurements lie inside the stated band.",
               source.in_words(text_of(error, "error")), shown(coverage, 0));
  }
  for (const auto& advice : quality.value("advice", json::array())) {
    if (advice.is_string()) doubts.add(Verdict::doubtful, "advice", "{}", source.in_words(advice.get<std::string>()));
  }
  const std::string stop = source.say(".");
  for (const auto& finding : model.value("findings", json::array())) {
    std::string text = source.in_words(text_of(finding, "text"));
    if (text.empty()) continue;
    const std::string stored = text_of(finding, "text");
    const bool named = is_channel(stored.substr(0, stored.find(' ')), source.labels());  // as its maker wrote it
    if (!named) text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
    doubts.add(Verdict::doubtful, "findings", "{}", text.ends_with(stop) ? text : text + stop);
  }
}

void about_physics(Doubts& doubts) {
  const json* body = doubts.about("physics");
  if (body == nullptr) return;
  doubts.problems(*body);
  if (text_of(body->value("diagnosis", json::object()), "verdict") != "unexplained") return;
  doubts.add(Verdict::doubtful, "verdict",
             "The heat simulation lacks something that none of the known effects explains; see Physics.");
}

/// A correction and a rollback move nothing for a look of their own: what an earlier write showed holds for them.
bool signs_were_seen_before(const Source& source) {
  const auto uploads = source.artefacts().find("upload");
  return uploads != source.artefacts().end() &&
         std::any_of(uploads->second.begin(), uploads->second.end(), [](const auto& one) {
           return one.body.value("sign_check", json()).is_object() && one.body["sign_check"].value("passed", false);
         });
}

void about_upload(const Source& source, Doubts& doubts) {
  const json* body = doubts.about("upload");
  if (body == nullptr) return;
  doubts.problems(*body);
  const json sign = body->value("sign_check", json());
  if (!sign.is_object() && signs_were_seen_before(source)) return;
  if (!sign.is_object()) {
    doubts.add(Verdict::doubtful, "sign_check",
               "Before the table was written no camera watched in which direction the controller moves.");
  } else if (!sign.value("passed", false)) {
    doubts.add(Verdict::bad, "sign_check", "The camera saw a move against the direction that was commanded.");
  }
}

/// Axes that the table written before would have served better in the same run; false: none, or another run says
/// otherwise.
bool about_version_before(const json& body, Doubts& doubts) {
  const json before = body.value("version_before", json());
  if (!before.is_object()) return false;
  bool worse = false;
  for (const auto& axis : list_of(before, "axes")) {
    if (!axis.value("worse", false)) continue;
    worse = true;
    doubts.add(Verdict::doubtful, "version_before",
               "With table version {} the error left in {} would have been {} µm RMS in this run instead of {} µm.",
               text_of(before, "version"), text_of(axis, "axis"), shown(number_of(axis, "rms_before_um"), 1),
               shown(number_of(axis, "rms_now_um"), 1));
  }
  if (!worse) return false;
  if (before.value("contradicted", false)) {
    doubts.add(Verdict::doubtful, "version_before", "Which of the last two tables is better changes from run to run.");
    return false;
  }
  return true;
}

void about_verification(const Source& source, Doubts& doubts) {
  const json* body = doubts.about("verification");
  if (body == nullptr) return;
  const double limit_um = number_of(*body, "limit_um");
  for (const auto& axis : directions_of(*body, "peak_error_after_um")) {
    const double before_um = number_of(*body, "peak_error_before_um", axis);
    const double after_um = number_of(*body, "peak_error_after_um", axis);
    if (after_um > limit_um) {
      doubts.add(Verdict::bad, "peak_error_after_um",
                 "With the compensation the error in {} reached {} µm (limit {} µm).", axis, shown(after_um, 1),
                 shown(limit_um, 1));
    }
    if (number_of(*body, "removed_percent", axis) < 0.0) {
      doubts.add(after_um > limit_um ? Verdict::bad : Verdict::doubtful, "removed_percent",
                 "{} became worse: its largest error was {} µm without and {} µm with the compensation, over the same "
                 "minutes of the runs.",
                 axis, shown(before_um, 1), shown(after_um, 1));
    }
    constexpr double least_removed_percent = 85.0;
    const double removed_percent = number_of(*body, "removed_percent", axis);
    if (before_um > limit_um && removed_percent >= 0.0 && removed_percent < least_removed_percent) {
      doubts.add(Verdict::doubtful, "removed_percent", "Of the largest error in {} {} % was removed (at least {} %).",
                 axis, shown(removed_percent, 0), shown(least_removed_percent, 0));
    }
    const double end_before_um = number_of(*body, "end_error_before_um", axis);
    const double end_after_um = number_of(*body, "end_error_after_um", axis);
    if (end_after_um > end_before_um) {
      doubts.add(Verdict::doubtful, "end_error_after_um",
                 "At the end {} was worse with the compensation ({} µm) than without ({} µm).", axis,
                 shown(end_after_um, 1), shown(end_before_um, 1));
    }
  }
  about_run(source, "verification", "Verification run", doubts);
  if (about_version_before(*body, doubts)) return;  // what to write next is then the version before
  if (!body->value("corrected_table", json()).is_object()) return;
  doubts.add(Verdict::doubtful, "corrected_table",
             "The verification proposes a correction of the model that has not been written and proved.");
}

/// Results that were made from something which was made anew since. A step may have taken several of a kind, of which
/// one must be the latest.
void about_age(const Source& source, Doubts& doubts) {
  for (const auto& [kind, all] : source.artefacts()) {
    if (kind == "report") continue;  // an earlier report is no part of this one
    const LoadedArtefact& artefact = all.back();
    std::map<std::string, bool> fresh;
    for (const auto& input : artefact.inputs) {
      const auto* latest = source.find(input.kind);
      fresh[input.kind] |= latest == nullptr || latest->content_hash == input.content_hash;
    }
    for (const auto& [input, is_fresh] : fresh) {
      if (is_fresh) continue;
      doubts.about(kind.c_str());
      doubts.add(Verdict::bad, "inputs", "{}: this result was made before \"{}\" was made anew. Do the step again.",
                 source.say(step_of(kind)), source.say(step_of(input)));
    }
  }
}

void about_writes(const Source& source, Doubts& doubts) {
  doubts.about("upload");
  for (const auto& entry : source.audit()) {
    if (entry.result == "started" || entry.result == "done") continue;
    doubts.add(Verdict::doubtful, "audit", "A write to the machine was refused or failed at {}: {} {} ({}).", entry.utc,
               source.say(entry.action), source.say(entry.subject), source.say(entry.result));
  }
  if (!source.audit_is_whole()) {
    doubts.add(Verdict::bad, "audit", "The record of writes to the machine was changed afterwards.");
  }
}

}  // namespace

std::vector<Doubt> doubts_of(const Source& source) {
  Doubts doubts(source);
  about_head(source, doubts);
  about_machine(doubts);
  about_calibration(doubts);
  about_run(source, "warmup", "Warm-up run", doubts);
  about_sensors(doubts);
  about_model(source, doubts);
  about_physics(doubts);
  about_upload(source, doubts);
  about_verification(source, doubts);
  about_age(source, doubts);
  about_writes(source, doubts);
  auto all = doubts.take();
  std::stable_partition(all.begin(), all.end(), [](const Doubt& doubt) { return doubt.verdict == Verdict::bad; });
  return all;
}

}  // namespace zerodrift::report
