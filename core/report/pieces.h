#pragma once
// Small pieces that many sections are made of.

#include <string>
#include <vector>

#include "core/report/report.h"
#include "core/report/source.h"

namespace zerodrift::report {

/// A number in a table that can be traced under its id.
Cell cell(double value, int digits, std::string id, Trace trace);
/// A figure without a verdict.
Figure figure(std::string id, std::string label, std::string value, std::string unit, Trace trace);
/// One that may be at most `limit`: above it bad, said in words.
Figure judged(const Source& source, Figure made, double value, double limit, int digits);
/// The trace of a figure read from samples of a run: the artefact and the rows.
Trace of_rows(const Source& source, const LoadedArtefact& artefact, const std::string& kind, std::string detail,
              std::vector<TraceRow> rows);
/// No line leads over a pause in which nothing was measured; x in hours since the run's start.
void break_at_pauses(const LoadedRun& run, std::vector<Curve>& curves);
/// The plan's steps and what happened in a run, to be drawn behind its curves.
void add_course(const Source& source, const LoadedArtefact& artefact, Plot& plot);
/// Notes, pauses, gaps and problems of a run, numbered as they are marked in its plots.
struct Happening {
  int number = 0;
  double time_s = 0.0;
  std::string what;  // in the reader's language
  std::string text;
};
/// What the search in the physics found, in its sentences; nothing where none was made.
void add_verdict_of_physics(const Source& source, Section& section);
std::vector<Happening> happenings_of(const Source& source, const LoadedRun& run);

}  // namespace zerodrift::report
