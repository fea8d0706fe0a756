#pragma once
// What the sections read: the artefacts of a job, parsed once, and the runs they name.

#include <fmt/format.h>

#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/commissioning/job.h"
#include "core/recording/recording.h"
#include "core/report/report.h"
#include "core/report/wording.h"

namespace zerodrift::report {

struct LoadedArtefact {
  long long id = 0;
  std::string created_utc;
  std::string content_hash;
  std::string made_by;
  std::string engineer;
  std::vector<commissioning::InputRef> inputs;
  nlohmann::json body;
};

struct LoadedRun {
  commissioning::SeriesInfo info;
  recording::Recording samples;
  std::vector<commissioning::Event> events;
};

class Source {
 public:
  static Result<Source> load(const commissioning::Job& job, Words words);

  /// The latest of a kind; null when the job has none yet.
  const LoadedArtefact* find(const std::string& kind) const;
  /// All of a kind, oldest first.
  const std::vector<LoadedArtefact>& history(const std::string& kind) const;
  /// The run an artefact names by its "series"; null when there is none.
  const LoadedRun* run(const LoadedArtefact* artefact) const;
  const recording::Recording* run_of(const std::string& kind) const;

  Trace trace(const std::string& kind, std::string detail) const;
  /// A value that stands in the artefact's body.
  Trace at(const std::string& kind, const std::string& pointer) const;

  std::string say(const std::string& text) const { return m_words ? m_words(text) : text; }
  template <class... Args>
  std::string tell(const std::string& text, const Args&... args) const {
    return fmt::format(fmt::runtime(say(text)), args...);
  }
  /// A sentence of core in the reader's language, with units and channels as people read them (core/report/wording.h).
  std::string in_words(const std::string& text) const;
  /// The same for one that is in the reader's language already.
  std::string with_names(const std::string& text) const;
  std::string channel_in_words(const std::string& channel) const;
  const Labels& labels() const { return m_labels; }

  const commissioning::JobHeader& header() const { return m_header; }
  const std::vector<commissioning::HeaderChange>& header_changes() const { return m_header_changes; }
  const std::vector<commissioning::AuditEntry>& audit() const { return m_audit; }
  bool audit_is_whole() const { return m_audit_is_whole; }
  const std::map<std::string, std::vector<LoadedArtefact>>& artefacts() const { return m_artefacts; }
  const std::string& created_utc() const { return m_created_utc; }

 private:
  Words m_words;
  Labels m_labels;
  commissioning::JobHeader m_header;
  std::vector<commissioning::HeaderChange> m_header_changes;
  std::map<std::string, std::vector<LoadedArtefact>> m_artefacts;
  std::map<commissioning::SeriesId, LoadedRun> m_runs;
  std::vector<commissioning::AuditEntry> m_audit;
  bool m_audit_is_whole = true;
  std::string m_created_utc;
};

/// Longest time between two rows; 0 without a run.
double longest_hole_s(const recording::Recording* run);
/// "12.3", never "-0.0"; a dash when it is not a number.
std::string shown(double value, int digits);
/// body[key] as a number, NaN when it is not there.
double number_of(const nlohmann::json& body, const std::string& key);
/// body[key][direction].
double number_of(const nlohmann::json& body, const std::string& key, const std::string& direction);
std::string text_of(const nlohmann::json& body, const std::string& key);
/// body[key] as a list; empty when it is none.
nlohmann::json list_of(const nlohmann::json& body, const std::string& key);
/// body[key] as an object; empty when it is none.
nlohmann::json object_of(const nlohmann::json& body, const std::string& key);
/// The directions X, Y, Z for which the object body[key] holds a number.
std::vector<std::string> directions_of(const nlohmann::json& body, const std::string& key);
/// "2026-11-21 07:28" of "2026-11-21T07:28:29.437Z".
std::string minute_of(const std::string& utc);

/// Curves of the channels over hours; errors in the colours of their axes.
std::vector<Curve> curves_of(const recording::Recording& run, const std::vector<std::string>& channels, bool points,
                             const Labels& labels = {});
Hue hue_of(const std::string& channel, const Labels& labels = {});

/// Samples of a run that decide a figure.
TraceRow row_of(const LoadedRun& run, const std::string& channel, std::size_t row);
struct Extremes {
  std::optional<std::size_t> lowest, highest, largest;  // rows; largest: of the magnitude
  double low = 0.0, high = 0.0;

  double range() const { return high - low; }
};
/// Over the rows up to `until_s` after the run's start.
Extremes extremes_of(const recording::Recording& run, const std::string& channel, double until_s);

}  // namespace zerodrift::report
