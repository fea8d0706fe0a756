#pragma once
// The report as data: sections of figures, texts, tables and plots, each with a trace to the artefact it came from.
// Writers (PDF, HTML, CSV in app/reporting) draw it; nothing here knows how.

#include <functional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace zerodrift::report {

/// Which artefact and which rows a figure came from, for example {"verification", 12, "largest |dZ_um|, row 113"}.
struct Trace {
  std::string artefact;  // kind, for example "warmup"
  long long id = 0;      // row of the artefact in the job
  std::string detail;
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

struct Table {
  std::string id;
  std::string title;
  std::vector<std::string> header;
  std::vector<std::vector<std::string>> rows;
  Trace trace;
};

struct Curve {
  std::string name;
  std::vector<double> x;
  std::vector<double> y;  // NaN: gap
  bool points = false;    // drawn as points instead of a line
};

struct Plot {
  std::string id;
  std::string title;
  std::string x_label;
  std::string y_label;
  std::vector<Curve> curves;
  Trace trace;
};

using Block = std::variant<Text, Figures, Table, Plot>;

struct Section {
  std::string id;
  std::string title;
  std::vector<Block> blocks;
};

struct Report {
  std::string title;
  std::vector<std::pair<std::string, std::string>> header;  // machine, serial, customer, engineer, date
  std::vector<Section> sections;
  std::string signature_png;  // drawn by the engineer; empty: not signed
  std::string provenance;     // one line for every page's foot: job hash, program version
};

/// Words in the reader's language: given the English text, returns the translation.
using Words = std::function<std::string(const char*)>;

}  // namespace zerodrift::report
