#pragma once
// What the sections read: the latest artefacts of a job, parsed once, and the runs they name.

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
  std::vector<commissioning::InputRef> inputs;
  nlohmann::json body;
};

class Source {
 public:
  static Result<Source> load(const commissioning::Job& job, Words words);

  /// Null when the job has none yet.
  const LoadedArtefact* find(const std::string& kind) const;
  /// The run an artefact names by its "series"; null when there is none.
  const recording::Recording* run_of(const std::string& kind) const;
  Trace trace(const std::string& kind, std::string detail) const;
  std::string say(const char* text) const { return m_words ? m_words(text) : std::string(text); }

  /// A sentence of core with units and channels as people read them, see core/report/wording.h.
  std::string in_words(const std::string& text) const { return readable(text, m_labels); }
  std::string channel_in_words(const std::string& channel) const { return report::channel_in_words(channel, m_labels); }

  const commissioning::JobHeader& header() const { return m_header; }
  const std::vector<commissioning::AuditEntry>& audit() const { return m_audit; }
  bool audit_is_whole() const { return m_audit_is_whole; }
  const std::map<std::string, LoadedArtefact>& artefacts() const { return m_artefacts; }

 private:
  Words m_words;
  Labels m_labels;
  commissioning::JobHeader m_header;
  std::map<std::string, LoadedArtefact> m_artefacts;
  std::map<std::string, recording::Recording> m_runs;
  std::vector<commissioning::AuditEntry> m_audit;
  bool m_audit_is_whole = true;
};

/// Longest time between two rows; 0 without a run.
double longest_hole_s(const recording::Recording* run);
/// "12.3"; a dash when it is not a number.
std::string shown(double value, int digits);
/// body[key] as a number, NaN when it is not there.
double number_of(const nlohmann::json& body, const std::string& key);
/// body[key][direction].
double number_of(const nlohmann::json& body, const std::string& key, const std::string& direction);
std::string text_of(const nlohmann::json& body, const std::string& key);
/// The directions X, Y, Z for which the object body[key] holds a number.
std::vector<std::string> directions_of(const nlohmann::json& body, const std::string& key);
/// Curves of the channels over hours.
std::vector<Curve> curves_of(const recording::Recording& run, const std::vector<std::string>& channels, bool points);

}  // namespace zerodrift::report
