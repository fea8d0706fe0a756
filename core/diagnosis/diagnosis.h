#pragma once
// What did the simulation leave out? From a machine description and a recording: where and when they differ (mismatch),
// which effect explains it (effects, rivals, confidence), the description with it (refined), and how much better it
// fits, on data used for the fit and on recordings that were not. "Nothing is missing" and "unexplained" are answers
// too. Everything the Physics page draws is here as data; sentences are made from `Sentence`
// (core/diagnosis/answer/sentences.h) where they are read.

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/analysis/findings.h"
#include "core/base/task_context.h"
#include "core/diagnosis/inference/settings.h"
#include "core/physics/machine.h"
#include "core/recording/recording.h"

namespace zerodrift::diagnosis {

enum class Verdict { consistent, missing_effect, unexplained };
std::string_view name_of(Verdict verdict);

/// One fact in words: an id of the text catalogue and its numbers. `english` is the sentence in English.
struct Sentence {
  std::string id;
  std::map<std::string, std::string> facts;
  std::string english;
};

/// What an effect brings into the machine, W, on average while it acts; what it takes away is negative.
struct EffectHeat {
  double mean_W = 0.0;
  double sigma_W = 0.0;
};

struct FoundEffect {
  std::string id;
  std::string component;
  std::optional<double> position_mm;
  double position_sigma_mm = 0.0;
  std::optional<std::pair<double, double>> between_mm;  // where it is known too badly for a point: 95 % lie between
  std::string channel;
  std::map<std::string, double> parameters;
  std::map<std::string, double> sigma;
  std::map<std::string, double> at_rpm;                // the speed at which a figure holds that grows with it
  std::map<std::string, std::string> words;            // law, region, driver ...
  std::vector<std::pair<double, double>> intervals_s;  // in which it acts; empty: all the time
  std::string recording;                               // of an effect that happened once: in which
  double confidence = 0.0;
  double log_evidence_gain = 0.0;
  std::vector<std::string> bounds_reached;
  std::map<std::string, double> contribution;  // channel -> rms of what the effect changes, K or um
  std::optional<EffectHeat> heat;              // of effects that bring or take any
  Sentence explanation;
};

struct Rival {
  std::string id;
  std::string component;
  std::optional<double> position_mm;
  std::string channel;
  double behind = 0.0;  // log evidence behind the best
  Sentence why;
};

enum class ChannelVerdict { consistent, explained, unexplained };
std::string_view name_of(ChannelVerdict verdict);

/// Everything about one channel that is drawn or told.
struct ChannelReport {
  std::string channel;
  bool temperature = true;
  std::vector<double> measured, nominal, refitted, explained;
  double rms_nominal = 0.0, rms_refitted = 0.0, rms_explained = 0.0, noise = 0.0;
  /// What is left beyond noise, over what a good description leaves; more than 1: it is unexplained.
  double excess_refitted = 0.0, excess_explained = 0.0;
  ChannelVerdict verdict = ChannelVerdict::consistent;
  std::vector<std::pair<double, double>> time_s;  // where it is off most, if it is
  double missing_heat_W = 0.0;                    // of its part, where one has heat
};

/// Heat that the nominal simulation lacks, W per column, for the eye.
struct HeatMap {
  std::string component;
  std::vector<double> position_mm;
  std::vector<double> time_s;
  std::vector<std::vector<double>> watts;  // [position][time]
};

struct Mismatch {
  std::vector<std::string> channels;  // worst first
  std::string component;
  std::optional<std::pair<double, double>> position_mm;
  double best_position_mm = 0.0;
  std::vector<std::pair<double, double>> time_s;
  std::string regime;
  double missing_heat_W = 0.0;  // mean size over time at its place; negative where heat is taken away
  std::vector<double> scan_position_mm, scan_evidence;  // one point source with a free history, along the rod
};

struct HeldOut {
  std::string recording;
  std::map<std::string, double> nominal, refitted, explained;  // rms by channel
};

/// The smallest size of an effect that this recording would have shown.
struct Detectable {
  std::string id;
  std::string key;
  double value = 0.0;
  double usual = 0.0;   // standard deviation of what there usually is of it
  double at_rpm = 0.0;  // where it grows with the speed: at this one
};

struct SuggestedExperiment {
  Sentence text;
  std::string id;
  double distance = 0.0;  // expected log evidence between the two rivals
  std::string plan_json;  // a warm-up plan
};

/// What was wrong with a recording, and what was done about it.
struct RunFinding {
  std::string recording;
  analysis::Finding finding;
};

/// What a reader of the answer has to know beside it, with its facts.
enum class NoteCode {
  // Of a `recording`
  missing_channel,       // `channel`: a sensor or a displacement that it lacks
  unknown_columns,       // `columns` that the description does not name
  lacks_column,          // `column` that `other` has: left out
  lacks_what_other_has,  // `column` that `other` has: not simulated
  left_out,              // `what`: only the longest part beside a long gap is used
  input_gaps,            // `column`, `percent`: an input that was not logged all the time
  load_in_other_unit,    // `unit`, `most`: the load would be one in it, and is next to nothing in W
  clock_jumped,          // `at`, `by` (min): the logger's clock was set ahead
  never_changes,         // `channel`, `value`, `um` simulated: it repeats one value; not used
  // What was assumed
  room_given,
  room_is_initial_temperature,
  room_not_logged,      // `column`
  capacity_unknown,     // `components`: watts and conductances are in proportion to what was assumed
  conductance_unknown,  // `component`: the coupling
  warm_start,           // `component`, `above` (K): not at rest when the recording began
  tolerances_raised,    // `keys`: stated smaller than such numbers can be known
  // What the recordings cannot show
  no_excitation,      // nothing moves, or nothing drives the machine
  shows_too_little,   // nothing is found missing, but most effects of usual size would not have shown
  never_driven,       // `effects`: what drives them never acted
  cannot_show,        // `effects`: not even as strong as they can be
  not_recorded,       // `columns`: sensors and displacements that no recording has
  inputs_not_logged,  // `columns`: unexplained or an open door, and these are not there
  few_sensors,        // `component`, `count`: so few see where along it something happens
  coarse_rows,        // `seconds` between rows: switching times are hardly known
  // Mistakes in the description or the wiring
  misplaced,             // `channel`, `described`, `at` (mm)
  exchanged,             // `channel`, `other`
  places_in,             // `unit`
  datum,                 // `component`, `fits` (mm), `nearer`
  other_end,             // `component`
  overlong,              // `component`, `described`, `bare`, `fits` (mm)
  diameter,              // `component`, `described`, `fits` (mm)
  sign_turned,           // `channel`
  described_not_there,   // `effect`
  clock_late,            // `seconds`
  clock_early,           // `seconds`
  far_from_description,  // `quantity`, `of`, `factor`, `sigmas` of its tolerance
};
std::string_view name_of(NoteCode code);

struct Note {
  NoteCode code = NoteCode::no_excitation;
  std::map<std::string, std::string> facts;
};

/// One explanation that was fitted, and how far it is behind the likeliest.
struct Tried {
  std::vector<std::string> effects;   // ids
  std::vector<std::string> mistakes;  // codes of notes
  double probability = 0.0;
  double behind = 0.0;  // log posterior odds
};

struct Diagnosis {
  Verdict verdict = Verdict::consistent;
  Mismatch mismatch;
  std::vector<FoundEffect> effects;
  std::vector<Tried> tried;   // likeliest first
  bool wrong_set_up = false;  // unexplained because places or a size are not as described
  bool doubtful = false;      // unexplained because the description is bent beyond what units and sizes can be off
  std::vector<Rival> ambiguous_with;
  std::optional<SuggestedExperiment> suggested;
  std::vector<ChannelReport> channels;
  std::vector<double> time_s;
  std::vector<HeldOut> held_out;
  std::vector<Detectable> detectable;
  std::optional<HeatMap> heat;
  std::vector<Sentence> sentences;
  std::vector<Note> notes;
  std::vector<RunFinding> findings;
  double excess_before = 0.0, excess_after = 0.0;
  double seconds = 0.0;
  physics::Machine refined;
};

struct DiagnoseOptions {
  bool details = true;  // heat map, experiment, detectable limits
};

/// All recordings are one body of evidence: the machine's numbers are shared, start, room, offsets and timing are each
/// recording's own. bad_argument without a recording or with settings that contradict each other; data_does_not_fit or
/// not_enough_data where nothing can be compared; cancelled.
Result<Diagnosis> diagnose(const physics::Machine& machine, const std::vector<recording::Recording>& recordings,
                           const DiagnoseOptions& options = {}, const TaskContext& context = {},
                           const DiagnosisSettings& settings = {});

/// diagnosis.json.
nlohmann::json to_json(const Diagnosis& diagnosis);

}  // namespace zerodrift::diagnosis
