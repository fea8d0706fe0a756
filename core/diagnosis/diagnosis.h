#pragma once
// What did the simulation leave out? From a machine description and a recording: where and when they differ (mismatch),
// which effect explains it (effects, rivals, confidence), the description with it (refined), and how much better it
// fits, on data used for the fit and on recordings that were not. "Nothing is missing" and "unexplained" are answers
// too. Everything the Physics page draws is here as data; sentences are made from `Sentence`
// (core/diagnosis/sentences.h) where they are read.

#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/analysis/findings.h"
#include "core/base/task_context.h"
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
  double excess_refitted = 0.0, excess_explained = 0.0;  // block excess, about 1 when nothing is missing
  double score = 0.0;                                    // for naming the channel with the largest mismatch
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
  double usual = 0.0;   // width of what there usually is of it
  double at_rpm = 0.0;  // where it grows with the speed: at this one
};

struct SuggestedExperiment {
  Sentence text;
  std::string id;
  double distance = 0.0;  // expected evidence between the two rivals
  std::string plan_json;  // a warm-up plan
};

/// What was wrong with a recording, and what was done about it.
struct RunFinding {
  std::string recording;
  analysis::Finding finding;
};

/// Of what drives the machine to everything else.
struct ClockOffset {
  double late_s = 0.0;       // below zero: it was logged before it acted
  double rest_before = 0.0;  // share of the time before its first row in which nothing ran; then as in that row
};

struct Diagnosis {
  Verdict verdict = Verdict::consistent;
  Mismatch mismatch;
  std::vector<FoundEffect> effects;
  std::vector<std::string> tried;  // ids of the best explanation, sorted; also where it was not good enough
  std::vector<std::string> forms;  // of the same, in the same order: id and words (law, bearing, channel ...)
  std::vector<double> sizes;       // of the same: first amplitude, in its own unit
  double unusual_start = 0.0;      // the largest start that one of them needs, over how far it usually is off
  bool refuted = false;            // unexplained because it makes a held-out recording worse
  ClockOffset clock;               // with what drives the machine moved by it the recording is explained better
  bool wrong_set_up = false;       // unexplained because places or a size are not as described
  bool doubtful = false;           // unexplained because the description is bent beyond what units and sizes can be off
  std::vector<Rival> ambiguous_with;
  std::optional<SuggestedExperiment> suggested;
  std::vector<ChannelReport> channels;
  std::vector<double> time_s;
  std::vector<HeldOut> held_out;
  std::vector<Detectable> detectable;
  std::optional<HeatMap> heat;
  std::vector<Sentence> sentences;
  std::vector<std::string> notes;
  std::vector<RunFinding> findings;
  double drift_factor = 1.0;  // slow discrepancy chosen by evidence, relative to the default
  double excess_before = 0.0, excess_after = 0.0;
  double seconds = 0.0;
  physics::Machine refined;
};

struct DiagnoseOptions {
  bool details = true;  // heat map, experiment, detectable limits
};

/// The first recording is fitted; the others are held out. Where what was fitted misses one of them by far, that one is
/// fitted instead if the first then bears it out (contradiction.h; note "fitted_instead:NAME"). Where the fitted one
/// leaves an effect in doubt or can hardly tell two apart, the others decide with it (elsewhere.h; note
/// "decided_with_others:ID"); what is fitted is fitted to the first alone, but a place is told with what all recordings
/// show of it where all fit (the refined description keeps the first's). Note "heat_falls_with_speed:CHANNEL": no law
/// has such heat, and nothing is named there. Note "far_from_description:QUANTITY:OF:FACTOR": the fit moved a number of
/// the description by more than four of its tolerances. Note "misstated:QUANTITY:OF:FACTOR": with that number times so
/// much, the recording is explained as well without an effect that is named (misstated.h). Note "room_jumps": at the
/// moment when a draught is said to begin. Note "at_its_limit:ID": that effect is at the limit of what it can be. Note
/// "sensor_alone:CHANNEL": nothing is missing without that sensor. Note "inputs_late" or "inputs_early": what drives
/// the machine is recorded a row or more after or before it acts; "clock_late:S" or "clock_early:S": it was, by S s,
/// and was moved to when it acted (another_clock.h). Note "sign_turned:CHANNEL": the displacement follows the
/// description with its sign turned. Note "moved_elsewhere:CHANNEL": only another recording shows that something moves
/// the nose that the description has not. Note "shows_too_little": nothing is found missing, but most effects of usual
/// size would not have shown. Note "misplaced:CHANNEL", "exchanged:CHANNEL:CHANNEL" or "places_in:UNIT": the sensors
/// are not where the description has them (misplaced.h); "misplaced_or_faulty:ID": or that sensor is at fault.
/// "overlong:COMPONENT", "other_end:COMPONENT", "datum:COMPONENT" or "diameter:COMPONENT": nor is that part of the
/// shape described (wrong_geometry.h). Note "clock_jumped:RECORDING:S:S": at that time it was set ahead by so much
/// (clock_jumps.h). Note "input_gaps:RECORDING:COLUMN": that input was not logged all the time. Note
/// "load_in_other_unit:RECORDING:UNIT": its load would be one in kW or %, and is next to nothing in W. Note
/// "warm_start:COMPONENT": it was not at rest when the recording began. Note "held_out_differs:RECORDING:CHANNEL": that
/// recording does not fit this machine. Note "room_not_logged": the recording lacks the room's channel. Note
/// "inputs_not_logged:COLUMN, COLUMN": unexplained or a draught, and it lacks these. Note "not_recorded:COLUMN,COLUMN":
/// sensors and displacements that it lacks. Note "settles_by_itself:CHANNEL": a displacement moves by itself and slows
/// down, and nothing shows that it follows the room. Note "no_excitation": nothing moves, or nothing drives the
/// machine. Note "never_driven:ID,ID": what drives them never acted. Note "coarse_rows": switching times are hardly
/// known. Note "never_changes:RECORDING:CHANNEL": a displacement that repeats one value while the machine moves; it is
/// not used. Note "few_sensors:COMPONENT:COUNT": so few see where along it something happens. Note
/// "tolerances_raised:KEY,KEY": the description has them smaller than such numbers can be known. Note
/// "counts_from_each_start": oil and preload, and the refined description states no reference temperature.
Result<Diagnosis> diagnose(const physics::Machine& machine, const std::vector<recording::Recording>& recordings,
                           const DiagnoseOptions& options = {}, const TaskContext& context = {});

/// diagnosis.json.
nlohmann::json to_json(const Diagnosis& diagnosis);

}  // namespace zerodrift::diagnosis
