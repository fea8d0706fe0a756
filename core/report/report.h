#pragma once
// The report as data: sections of figures, texts, tables and plots, each with a trace to the artefact it came from.
// Writers (PDF, HTML, CSV in app/reporting) draw it; nothing here knows how.

#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace zerodrift::report {

/// One sample of a run that a figure was read from.
struct TraceRow {
  long long series = 0;
  long long row = 0;  // from 0, as in the exported CSV below its header
  double time_s = 0.0;
  std::string channel;
  double value = 0.0;
};

/// Which artefact and which rows a figure came from, for example {"verification", 12, "largest |dZ_um|", "/peak.../Z",
/// {row 113}}. The detail is for programs and support: it is the same in every language.
struct Trace {
  std::string artefact;  // kind, for example "warmup"
  long long id = 0;      // row of the artefact in the job
  std::string detail;
  std::string pointer{};         // JSON pointer (RFC 6901) into the artefact's body; empty: computed from the rows
  std::vector<TraceRow> rows{};  // the samples that decide it
};

enum class Verdict { none, good, doubtful, bad };

struct Figure {
  std::string id;  // stable name, for example "peak_after_Z_um"
  std::string label;
  std::string value;  // text with the digits its uncertainty deserves
  std::string unit;
  std::string limit;  // "at most 5 um", or empty
  Verdict verdict = Verdict::none;
  Trace trace;
};

struct Text {
  std::string text;
  bool warning = false;
  Verdict verdict = Verdict::doubtful;  // of a warning
  Trace trace{};                        // of a warning: where it comes from
};

struct Figures {
  std::vector<Figure> figures;
};

/// A cell of a table; with an id it is a figure of its own, which can be traced.
struct Cell {
  Cell(std::string words) : text(std::move(words)) {}  // NOLINT: rows are lists of texts
  Cell(const char* words) : text(words) {}             // NOLINT
  Cell(std::string words, std::string name, Trace from)
      : text(std::move(words)), id(std::move(name)), trace(std::move(from)) {}

  std::string text;
  std::string id{};
  Trace trace{};
  Verdict verdict = Verdict::none;
};

struct Table {
  std::string id;
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<Cell>> rows;
  Trace trace;
};

/// Colours mean the same on paper as in the window; `order`: one after the other.
enum class Hue { order, x, y, z, room, muted };
enum class Stroke { solid, dashed, thin };

struct Curve {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;  // NaN: gap
  bool points = false;    // drawn as points instead of a line
  Hue hue = Hue::order;
  Stroke stroke = Stroke::solid;
};

/// A stretch of x behind the curves, for example a step of the plan; the darker the larger `strength` (0 to 1).
struct Stretch {
  double from = 0.0;
  double to = 0.0;
  double strength = 0.0;
  std::string text;  // above it, when there is room
};

/// Something that happened at x: a thin line with its text above.
struct Mark {
  double x = 0.0;
  std::string text;
};

enum class Width { full, half };  // two halves stand side by side

struct Plot {
  std::string id;
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
  Trace trace;
  std::vector<Stretch> stretches{};
  std::vector<Mark> marks{};
  double limit = 0.0;  // drawn as a band from -limit to +limit; 0: none
  Width width = Width::full;
};

/// Values over x (columns) and y (rows, the first at the bottom), coloured around zero.
struct HeatMap {
  std::string id;
  std::string title;
  std::string x_label;
  std::string y_label;
  std::string unit;
  double x_from = 0.0;
  double x_to = 1.0;
  double y_from = 0.0;
  double y_to = 1.0;
  std::vector<std::vector<double>> rows;              // NaN: unknown
  std::vector<std::pair<double, std::string>> ticks;  // sensors along y
  Trace trace;
};

using Block = std::variant<Text, Figures, Table, Plot, HeatMap>;

struct Section {
  std::string id;
  std::string title;
  std::vector<Block> blocks;
};

struct Report {
  std::string title;
  std::vector<std::pair<std::string, std::string>> header;  // machine, serial, customer, engineer, date
  std::vector<Section> sections;
  std::vector<std::string> company{};  // that made it, at the head: name and address, a line each
  std::string logo_png{};              // of the company; empty: none
  std::string signature_png{};         // drawn by the engineer; empty: not signed
  std::string provenance{};            // one line for every page's foot: job hash, program version
  std::string language = "en";         // BCP 47
  std::string made_utc{};              // ISO 8601, of the last result: the same job gives the same file
  std::string contents{};              // heading of the list of contents; empty: no such list
  std::string origins{};               // heading of the list of traces
};

/// Words in the reader's language: given the English text, returns the translation.
using Words = std::function<std::string(const std::string&)>;

}  // namespace zerodrift::report
