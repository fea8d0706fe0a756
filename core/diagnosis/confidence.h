#pragma once
// How sure an answer is: the evidence against its rivals, and beyond that what is known of the recording or the
// description that such evidence cannot see. Each factor is what the proof and recordings with faults put into them
// left of the share of right answers.

#include "core/diagnosis/diagnosis.h"
#include "core/physics/machine.h"

namespace zerodrift::diagnosis {

namespace doubt {

// Evidence is tempered: its unit is worth a third of what independent noise would make it (the proof's reliability).
constexpr double temperature = 3.0;
constexpr double most = 0.99;

// Of the recording: the smallest that applies.
constexpr double unlogged_coolant = 0.5;  // coolant that ran without being logged is a draught, as far as one can tell
constexpr double unknown_past = 0.7;      // a start not at rest that a short run does not outlast: a third was wrong
constexpr double never_moved = 0.7;       // no speed, coolant or load that ever changed
constexpr double corrected_number = 0.8;  // a number of the description had to be changed first
constexpr double at_its_limit = 0.5;      // of what an effect can be: of 235 right answers none was
constexpr double room_jumps = 0.5;  // in one row, as the draught begins: air takes minutes, a sensor that is moved not
constexpr double apart_clocks = 0.5;  // of inputs and sensors: of three answers all were wrong
constexpr double coarse_rows = 0.5;   // rows too far apart: of nine answers six were wrong
constexpr double guessed_room = 0.9;  // of 27 answers to runs robbed of the room's column three were wrong
constexpr double fitted_start = 0.9;  // a start not at rest that the run outlasts
// Besides.
constexpr double more_is_missing = 0.8;  // beyond what is named
constexpr double far_numbers = 0.5;      // of the description, out of all tolerance: it may stand for what is wrong
constexpr double or_a_number = 0.5;      // at most, where one wrong number explains as much
constexpr double worse_elsewhere = 0.5;  // of lumps, and beside what happened once: other runs do not refute them
constexpr double imitated = 0.4;         // unexplained: whatever the library lacks is imitated as well as it can be
constexpr double unknown_machine = 0.7;  // lumps about its sensors take up whatever flows between them

}  // namespace doubt

/// Lowers the confidence of all effects by what is known of the whole answer.
void doubt_whole(Diagnosis& diagnosis, const physics::Machine& machine);

}  // namespace zerodrift::diagnosis
