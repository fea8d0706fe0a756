// Any bytes as a job file, or done to one: an error, or a job of which everything can be asked and that can be written
// to. Bytes that are no database end at its first page, so most inputs change a true job, which is made at the start:
//   input[0] % 4 == 0  the rest is the whole file
//                   1  the rest is patches of the file: offset (3 bytes), length (1), bytes
//                   2  the rest is one cell: table, column, row, type, value
//                   3  the rest is the samples of a chunk or row whose checksum fits, as a hostile hand would make them

#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>
#include <zlib.h>

#include <array>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <span>
#include <string>

#include "core/commissioning/job.h"
#include "core/recording/recording.h"

namespace {

using zerodrift::commissioning::Job;
using Bytes = std::span<const std::uint8_t>;

const std::filesystem::path& place() {
  static const std::filesystem::path path = "/dev/shm/zerodrift-fuzz-" + std::to_string(::getpid()) + ".zdj";
  return path;
}

void remove_all() {
  for (const char* ending : {"", "-wal", "-shm", "-lock", "-journal", ".v1.bak"}) {
    ::unlink((place().string() + ending).c_str());
  }
}

void must(bool done) {
  if (!done) std::abort();
}

/// A job with something in every table: the bytes of its file.
std::string true_job() {
  remove_all();
  {
    auto job = Job::create(place(), {"VMC", "4711", "", "Ann", ""});
    must(job.has_value());
    must(job->set_header({"VMC", "4711", "hall 2", "Bob", ""}).has_value());
    for (const bool ended : {true, false}) {
      const auto series = job->start_series("warm-up", {"T1_C", "dZ_um"}, R"({"plan":{"name":"p"}})");
      must(series.has_value());
      for (int i = 0; i < 970; ++i) must(job->append(*series, i, std::array{20.0 + i % 7, 1.5 * i}).has_value());
      must(job->add_event(*series, {5.0, "note", "door", R"({"a":1})", ""}).has_value());
      if (ended) must(job->finish_series(*series).has_value());
    }
    const auto machine = job->put({"machine", R"({"name":"VMC","sensors":[1,2]})", {}, {}, {}});
    must(machine.has_value());
    must(job->put({"model", R"({"a":{"b":[1.5,null]},"seen":3})", {machine->id}, {{"t.png", "png"}}, {"seen"}})
             .has_value());
    must(job->audit({}).has_value());
  }
  std::ifstream stream(place(), std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

void write_file(const std::uint8_t* bytes, std::size_t size) {
  const int file = ::open(place().c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  must(file >= 0 && ::write(file, bytes, size) == static_cast<ssize_t>(size));
  ::close(file);
}

std::uint8_t take(Bytes& bytes) {
  if (bytes.empty()) return 0;
  const std::uint8_t first = bytes.front();
  bytes = bytes.subspan(1);
  return first;
}

std::string patched(std::string file, Bytes bytes) {
  while (bytes.size() > 4) {
    std::size_t offset = take(bytes);
    offset = offset << 8 | take(bytes);
    offset = (offset << 8 | take(bytes)) % file.size();
    const std::size_t length =
        std::min<std::size_t>({std::size_t{take(bytes)} + 1, bytes.size(), file.size() - offset});
    std::copy_n(bytes.begin(), length, file.begin() + static_cast<std::ptrdiff_t>(offset));
    bytes = bytes.subspan(length);
  }
  return file;
}

/// Changes the job past the program: without its guards, with whatever value.
void change(const std::string& sql, Bytes value, int type, sqlite3_int64 crc) {
  sqlite3* handle = nullptr;
  must(sqlite3_open(place().c_str(), &handle) == SQLITE_OK);
  sqlite3_db_config(handle, SQLITE_DBCONFIG_ENABLE_TRIGGER, 0, nullptr);
  sqlite3_exec(handle, "PRAGMA synchronous=OFF; PRAGMA ignore_check_constraints=ON", nullptr, nullptr, nullptr);
  sqlite3_stmt* statement = nullptr;
  must(sqlite3_prepare_v2(handle, sql.c_str(), -1, &statement, nullptr) == SQLITE_OK);
  const auto* text = reinterpret_cast<const char*>(value.data());
  const int size = static_cast<int>(value.size());
  if (type == 0) sqlite3_bind_text(statement, 1, text, size, SQLITE_STATIC);
  if (type == 1) sqlite3_bind_blob(statement, 1, text, size, SQLITE_STATIC);
  if (type == 2) sqlite3_bind_int64(statement, 1, std::atoll(std::string(text, value.size()).c_str()));
  if (type == 3) sqlite3_bind_double(statement, 1, std::atof(std::string(text, value.size()).c_str()));
  sqlite3_bind_int64(statement, 2, crc);
  sqlite3_step(statement);  // what the table itself refuses stays as it was
  sqlite3_finalize(statement);
  sqlite3_close(handle);
}

struct Cell {
  const char* table;
  const char* column;
};
constexpr Cell cells[] = {{"header", "value"},
                          {"header", "key"},
                          {"header_change", "key"},
                          {"header_change", "utc"},
                          {"artefact", "kind"},
                          {"artefact", "body"},
                          {"artefact", "observed"},
                          {"artefact", "content_hash"},
                          {"artefact", "id"},
                          {"artefact", "body_hash"},
                          {"artefact", "input_hash"},
                          {"artefact", "created_utc"},
                          {"blob", "name"},
                          {"blob", "sha256"},
                          {"blob", "bytes"},
                          {"blob", "artefact"},
                          {"series", "id"},
                          {"series", "name"},
                          {"series", "channels"},
                          {"series", "details"},
                          {"series", "state"},
                          {"series", "last_utc"},
                          {"series", "content_hash"},
                          {"chunk", "series"},
                          {"chunk", "first_row"},
                          {"chunk", "rows"},
                          {"chunk", "crc32"},
                          {"chunk", "data"},
                          {"open_row", "series"},
                          {"open_row", "row"},
                          {"open_row", "data"},
                          {"event", "series"},
                          {"event", "time_s"},
                          {"event", "utc"},
                          {"event", "kind"},
                          {"event", "text"},
                          {"event", "details"},
                          {"audit", "id"},
                          {"audit", "utc"},
                          {"audit", "engineer"},
                          {"audit", "action"},
                          {"audit", "previous_hash"},
                          {"audit", "hash"},
                          {"audit", "new_value"},
                          {"artefact_input", "input"},
                          {"artefact_input", "content_hash"}};

void change_cell(Bytes bytes) {
  const Cell& cell = cells[take(bytes) % std::size(cells)];
  const int row = take(bytes) % 4;
  const int type = take(bytes) % 4;
  const std::string table = cell.table;
  // Tables without a rowid hold few rows that matter: all are changed at once.
  const bool has_rowid = table != "header" && table != "artefact_input" && table != "open_row";
  std::string sql = "UPDATE OR IGNORE " + table + " SET " + cell.column + " = ?1";
  if (has_rowid) sql += " WHERE rowid = " + std::to_string(row + 1);
  change(sql, bytes, type, 0);
}

void change_samples(Bytes bytes) {
  const std::uint8_t choice = take(bytes);
  const auto crc = static_cast<sqlite3_int64>(::crc32(0, bytes.data(), static_cast<uInt>(bytes.size())));
  if (choice % 2 == 0) {
    const int rows = 1 + choice / 2 * 8;  // 1, 9, ... 1017
    change("UPDATE chunk SET data = ?1, crc32 = ?2, rows = " + std::to_string(rows) + " WHERE series = 1", bytes, 1,
           crc);
  } else {
    change("UPDATE open_row SET data = ?1, crc32 = ?2", bytes, 1, crc);
  }
}

void ask_everything(const Job& job) {
  static_cast<void>(job.header());
  static_cast<void>(job.header_changes());
  static_cast<void>(job.check());
  static_cast<void>(job.audit_trail());
  static_cast<void>(job.verify_audit());
  if (const auto kinds = job.kinds()) {
    for (const auto& kind : *kinds) {
      static_cast<void>(job.latest(kind));
      const auto all = job.history(kind);
      if (!all) continue;
      for (const auto& artefact : *all) {
        static_cast<void>(artefact.document());
        for (const auto& name : artefact.blob_names) static_cast<void>(job.blob(artefact.id, name));
      }
    }
  }
  const auto series = job.series();
  if (!series) return;
  for (const auto& one : *series) {
    static_cast<void>(job.events(one.id));
    std::vector<zerodrift::Error> damaged;
    for (auto* gaps : {static_cast<decltype(&damaged)>(nullptr), &damaged}) {
      const auto run = job.read_series(one.id, gaps);
      if (!run) continue;
      for (const auto& channel : run->channels) must(channel.values.size() == run->rows());
    }
  }
}

/// What a program does with a job it has opened; refused or done.
void work_on(Job& job) {
  if (const auto series = job.series()) {
    for (const auto& one : *series) {
      static_cast<void>(job.append(one.id, 1e7, std::vector<double>(one.channels.size(), 1.0)));
      static_cast<void>(job.flush());
      static_cast<void>(job.finish_series(one.id));
    }
  }
  static_cast<void>(job.put({"table", "{}", {1}, {}, {}}));
  static_cast<void>(job.audit({}));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const std::string whole = true_job();
  static const auto* whole_bytes = reinterpret_cast<const std::uint8_t*>(whole.data());
  if (size == 0) return 0;
  const Bytes rest(bytes + 1, size - 1);
  remove_all();
  if (bytes[0] % 4 == 0) {
    write_file(rest.data(), rest.size());
  } else if (bytes[0] % 4 == 1) {
    const std::string file = patched(whole, rest);
    write_file(reinterpret_cast<const std::uint8_t*>(file.data()), file.size());
  } else {
    write_file(whole_bytes, whole.size());
    bytes[0] % 4 == 2 ? change_cell(rest) : change_samples(rest);
  }
  if (const auto job = Job::open_read_only(place())) ask_everything(*job);
  if (auto job = Job::open(place())) {
    ask_everything(*job);
    work_on(*job);
    ask_everything(*job);
  }
  remove_all();
  return 0;
}
