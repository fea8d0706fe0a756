#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "core/base/hash.h"
#include "core/base/json.h"
#include "core/commissioning/artefact_hash.h"
#include "core/commissioning/job_store.h"

namespace zerodrift::commissioning {
namespace {

using nlohmann::json;

std::string input_hash_of(const std::vector<InputRef>& inputs) {
  std::string text;
  for (const InputRef& input : inputs) text += input.kind + " " + input.content_hash + "\n";
  return sha256_hex(text);
}

Result<std::vector<InputRef>> inputs_of(Database& database, ArtefactId id) {
  ZD_TRY(Statement rows, database.prepare("SELECT i.input, a.kind, i.content_hash FROM artefact_input i "
                                          "JOIN artefact a ON a.id = i.input WHERE i.artefact = ? ORDER BY i.input"));
  rows.bind(1, id);
  std::vector<InputRef> inputs;
  for (;;) {
    ZD_TRY(const bool row, rows.step());
    if (!row) return inputs;
    inputs.push_back({rows.integer(0), rows.text(1), rows.text(2)});
  }
}

}  // namespace

std::string text_of_keys(const std::vector<std::string>& keys) {
  return json_text(json(keys));
}

std::vector<std::string> keys_from(const std::string& text) {
  const json list = json::parse(text, nullptr, false);
  std::vector<std::string> keys;
  if (!list.is_array()) return keys;
  for (const json& key : list) {
    if (key.is_string()) keys.push_back(key.get<std::string>());
  }
  return keys;
}

// Lengths keep two different artefacts from having the same text to hash.
std::string content_hash_of(std::string_view kind, std::string_view body, const std::vector<std::string>& observed,
                            const std::map<std::string, std::string>& blob_hashes) {
  std::string counted(body);
  if (!observed.empty()) {
    json document = json::parse(body, nullptr, false);
    if (document.is_object()) {
      for (const std::string& key : observed) document.erase(key);
      counted = json_text(document);
    }
  }
  std::string text = fmt::format("{}:{}\n{}:{}\n", kind.size(), kind, counted.size(), counted);
  for (const auto& [name, hash] : blob_hashes) text += fmt::format("{}:{} {}\n", name.size(), name, hash);
  return sha256_hex(text);
}

NewArtefact NewArtefact::of(std::string kind, const json& body, std::vector<ArtefactId> inputs,
                            std::vector<Blob> blobs) {
  return {std::move(kind), json_text(body), std::move(inputs), std::move(blobs), {}};
}

Result<json> Artefact::document() const {
  return parse_json(body, kind);
}

Result<Artefact> Job::put(const NewArtefact& artefact) {
  const std::scoped_lock lock(m_store->mutex);
  ZD_CHECK(m_store->writable());
  Database& database = *m_store->database;
  m_store->newest.erase(artefact.kind);
  std::map<std::string, std::string> blob_hashes;
  for (const Blob& blob : artefact.blobs) blob_hashes[blob.name] = sha256_hex(blob.bytes);

  ZD_TRY(Transaction transaction, Transaction::begin(database));
  std::vector<InputRef> inputs;
  for (const ArtefactId id : artefact.inputs) {
    ZD_TRY(const Artefact input, m_store->read_artefact(id));
    inputs.push_back({id, input.kind, input.content_hash});
  }
  std::sort(inputs.begin(), inputs.end(), [](const InputRef& a, const InputRef& b) { return a.id < b.id; });
  inputs.erase(std::unique(inputs.begin(), inputs.end(), [](auto& a, auto& b) { return a.id == b.id; }), inputs.end());

  ZD_TRY(const std::string engineer, m_store->header_value("engineer"));
  ZD_TRY(Statement add,
         database.prepare("INSERT INTO artefact (kind, body, content_hash, input_hash, made_by, engineer, "
                          "created_utc, observed, body_hash) VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?)"));
  add.bind(1, artefact.kind).bind(2, artefact.body);
  add.bind(3, content_hash_of(artefact.kind, artefact.body, artefact.observed, blob_hashes));
  add.bind(4, input_hash_of(inputs)).bind(5, program_name()).bind(6, engineer).bind(7, now_text());
  ZD_CHECK(add.bind(8, text_of_keys(artefact.observed)).bind(9, sha256_hex(artefact.body)).run());
  const ArtefactId id = database.last_row_id();
  for (const InputRef& input : inputs) {
    ZD_TRY(Statement link, database.prepare("INSERT INTO artefact_input (artefact, input, content_hash) "
                                            "VALUES (?, ?, ?)"));
    ZD_CHECK(link.bind(1, id).bind(2, input.id).bind(3, input.content_hash).run());
  }
  for (const Blob& blob : artefact.blobs) {
    ZD_TRY(Statement keep, database.prepare("INSERT INTO blob (artefact, name, sha256, bytes) VALUES (?, ?, ?, ?)"));
    ZD_CHECK(keep.bind(1, id).bind(2, blob.name).bind(3, blob_hashes[blob.name]).bind_bytes(4, blob.bytes).run());
  }
  ZD_CHECK(transaction.commit());
  return m_store->read_artefact(id);
}

Result<Artefact> Job::Store::read_artefact(ArtefactId id) const {
  ZD_TRY(Statement rows, database->prepare("SELECT kind, body, content_hash, input_hash, made_by, engineer, "
                                           "created_utc, body_hash FROM artefact WHERE id = ?"));
  ZD_TRY(const bool row, rows.bind(1, id).step());
  if (!row) {
    return fail(ErrorCode::bad_argument,
                {{"what", "artefact"}, {"found", std::to_string(id)}, {"expected", "one that is in the job"}});
  }
  Artefact artefact{id,           rows.text(0), rows.text(1), rows.text(2), rows.text(3),
                    rows.text(4), rows.text(5), rows.text(6), {},           {}};
  const std::string body_hash = rows.text(7);  // none in artefacts of the first version
  if (!body_hash.empty() && sha256_hex(artefact.body) != body_hash) {
    return fail(ErrorCode::job_damaged,
                {{"file", path.string()}, {"detail", fmt::format("artefact {} ({}): checksum", id, artefact.kind)}});
  }
  ZD_TRY(artefact.inputs, inputs_of(*database, id));
  ZD_TRY(Statement names, database->prepare("SELECT name FROM blob WHERE artefact = ? ORDER BY name"));
  names.bind(1, id);
  for (;;) {
    ZD_TRY(const bool found, names.step());
    if (!found) return artefact;
    artefact.blob_names.push_back(names.text(0));
  }
}

Result<Artefact> Job::artefact(ArtefactId id) const {
  const std::scoped_lock lock(m_store->mutex);
  return m_store->read_artefact(id);
}

Result<std::optional<Artefact>> Job::latest(const std::string& kind) const {
  const std::scoped_lock lock(m_store->mutex);
  const auto kept = m_store->newest.find(kind);
  // Where this is a reader, another process may add to the job.
  if (kept != m_store->newest.end() && !m_store->read_only) return kept->second;
  ZD_TRY(Statement rows, m_store->database->prepare("SELECT max(id) FROM artefact WHERE kind = ?"));
  ZD_TRY(const bool row, rows.bind(1, kind).step());
  const ArtefactId id = row ? rows.integer(0) : 0;
  std::optional<Artefact> latest;
  if (kept != m_store->newest.end() && kept->second && kept->second->id == id) return kept->second;
  if (id != 0) {
    ZD_TRY(latest, m_store->read_artefact(id));
  }
  m_store->newest[kind] = latest;
  return latest;
}

Result<std::vector<Artefact>> Job::history(const std::string& kind) const {
  const std::scoped_lock lock(m_store->mutex);
  ZD_TRY(Statement rows, m_store->database->prepare("SELECT id FROM artefact WHERE kind = ? ORDER BY id"));
  rows.bind(1, kind);
  std::vector<Artefact> artefacts;
  for (;;) {
    ZD_TRY(const bool row, rows.step());
    if (!row) return artefacts;
    ZD_TRY(Artefact artefact, m_store->read_artefact(rows.integer(0)));
    artefacts.push_back(std::move(artefact));
  }
}

Result<std::vector<std::string>> Job::kinds() const {
  const std::scoped_lock lock(m_store->mutex);
  ZD_TRY(Statement rows, m_store->database->prepare("SELECT DISTINCT kind FROM artefact ORDER BY kind"));
  std::vector<std::string> kinds;
  for (;;) {
    ZD_TRY(const bool row, rows.step());
    if (!row) return kinds;
    kinds.push_back(rows.text(0));
  }
}

Result<std::string> Job::blob(ArtefactId id, const std::string& name) const {
  const std::scoped_lock lock(m_store->mutex);
  ZD_TRY(Statement rows, m_store->database->prepare("SELECT bytes, sha256 FROM blob WHERE artefact = ? AND name = ?"));
  ZD_TRY(const bool row, rows.bind(1, id).bind(2, name).step());
  if (!row) {
    return fail(ErrorCode::bad_argument, {{"what", "file of an artefact"},
                                          {"found", name},
                                          {"expected", "one that belongs to artefact " + std::to_string(id)}});
  }
  std::string bytes = rows.bytes(0);
  if (sha256_hex(bytes) != rows.text(1)) {
    return fail(ErrorCode::job_damaged,
                {{"file", m_store->path.string()}, {"detail", name + " of artefact " + std::to_string(id)}});
  }
  return bytes;
}

}  // namespace zerodrift::commissioning
