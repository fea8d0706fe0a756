#pragma once
// What a commissioning is made of: artefacts (results of steps, with their inputs), series (runs of samples with
// events) and the audit trail (everything written to a machine). All of it is history: nothing is changed or removed.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/base/clock.h"
#include "core/base/result.h"

namespace zerodrift::commissioning {

using ArtefactId = std::int64_t;
using SeriesId = std::int64_t;

struct Blob {
  std::string name;  // "template.png"
  std::string bytes;
};

/// The state of an input when the artefact was made from it.
struct InputRef {
  ArtefactId id = 0;
  std::string kind;
  std::string content_hash;
};

/// What a step hands over to be kept.
struct NewArtefact {
  std::string kind;                // "calibration", "clusters", "model" ...
  std::string body;                // JSON text
  std::vector<ArtefactId> inputs;  // what it was made from
  std::vector<Blob> blobs;         // files that belong to it
  /// Top-level keys of the body that are kept but do not count for equality: readings of the moment, such as a round
  /// trip time. Without this, looking at a machine again would make everything made from it stale.
  std::vector<std::string> observed;

  static NewArtefact of(std::string kind, const nlohmann::json& body, std::vector<ArtefactId> inputs = {},
                        std::vector<Blob> blobs = {});
};

struct Artefact {
  ArtefactId id = 0;
  std::string kind;
  std::string body;          // JSON text, keys in order
  std::string content_hash;  // SHA-256 of kind, body without `observed`, blobs: equal results, equal hashes
  std::string input_hash;    // SHA-256 of the inputs' hashes
  std::string made_by;       // program and version
  std::string engineer;
  std::string created_utc;  // ISO 8601
  std::vector<InputRef> inputs;
  std::vector<std::string> blob_names;

  Result<nlohmann::json> document() const;
};

enum class SeriesState { open, finished, aborted };

struct SeriesInfo {
  SeriesId id = 0;
  std::string name;
  std::vector<std::string> channels;
  std::string details;  // JSON text: the plan and whatever the recorder needs to go on
  SeriesState state = SeriesState::open;
  std::string made_by;
  std::string engineer;
  std::string started_utc;
  std::string last_utc;      // of the last commit
  std::string content_hash;  // when it has ended
  std::int64_t rows = 0;     // on the disk
};

struct Event {
  double time_s = 0.0;  // of the series
  std::string kind;     // "pause", "resume", "note", "problem", "gap" ...
  std::string text;
  std::string details = "{}";  // JSON text
  std::string utc;             // set by the job
};

/// One write to a machine. Written before (result "started") and after it, so that a crash between shows.
struct AuditEntry {
  std::string machine;  // name and serial
  std::string action;   // "push table", "compensation on" ...
  std::string subject;  // what it was done to
  std::string old_value;
  std::string new_value;
  std::string result;  // "started", "done", or the error's identifier
  // set by the job
  std::int64_t id = 0;
  std::string utc;
  std::string engineer;
  std::string hash;  // chained: SHA-256 of the previous entry's hash and this entry
};

struct JobHeader {
  std::string machine;
  std::string serial;
  std::string customer;
  std::string engineer;
  std::string notes;
};

struct HeaderChange {
  std::string utc;
  std::string engineer;
  std::string key;
  std::string old_value;
  std::string new_value;
};

/// What Job::check went through and what it found.
struct CheckReport {
  int artefacts = 0;
  int chunks = 0;
  int open_rows = 0;
  int audit_entries = 0;
  std::vector<Error> problems;
  bool ok() const { return problems.empty(); }
};

}  // namespace zerodrift::commissioning
