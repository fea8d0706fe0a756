// Any bytes as a job file: an error, or a job of which everything can be asked. The seeds are true jobs.

#include <fcntl.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>

#include "core/commissioning/job.h"
#include "core/recording/recording.h"

namespace {

using zerodrift::commissioning::Job;

const std::filesystem::path& place() {
  static const std::filesystem::path path = "/dev/shm/zerodrift-fuzz-" + std::to_string(::getpid()) + ".zdj";
  return path;
}

void remove_all() {
  for (const char* ending : {"", "-wal", "-shm", "-lock", "-journal", ".v1.bak"}) {
    ::unlink((place().string() + ending).c_str());
  }
}

void ask_everything(const Job& job) {
  static_cast<void>(job.header());
  static_cast<void>(job.header_changes());
  static_cast<void>(job.check());
  static_cast<void>(job.audit_trail());
  if (const auto kinds = job.kinds()) {
    for (const auto& kind : *kinds) {
      if (const auto all = job.history(kind)) {
        for (const auto& artefact : *all) static_cast<void>(artefact.document());
      }
    }
  }
  if (const auto series = job.series()) {
    for (const auto& one : *series) {
      static_cast<void>(job.events(one.id));
      if (const auto run = job.read_series(one.id)) {
        for (const auto& channel : run->channels) {
          if (channel.values.size() != run->rows()) std::abort();
        }
      }
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  remove_all();
  const int file = ::open(place().c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600);
  if (file < 0 || ::write(file, bytes, size) != static_cast<ssize_t>(size)) std::abort();
  ::close(file);
  if (const auto job = Job::open_read_only(place())) ask_everything(*job);
  if (const auto job = Job::open(place())) ask_everything(*job);
  remove_all();
  return 0;
}
