#pragma once
// The job of a command that makes one where there is none. A command that is refused before it has put anything into
// the job takes the file away again: it leaves nothing that was not there.

#include <filesystem>
#include <optional>
#include <utility>

#include "core/commissioning/job.h"

namespace zerodrift::cli {

class JobFile {
 public:
  static Result<JobFile> open_or_create(const std::filesystem::path& path);
  JobFile(JobFile&& other) noexcept : m_job(std::exchange(other.m_job, std::nullopt)), m_made(other.m_made) {}
  ~JobFile();

  commissioning::Job& job() { return *m_job; }
  bool made() const { return m_made; }

 private:
  JobFile(commissioning::Job job, bool made) : m_job(std::move(job)), m_made(made) {}
  std::optional<commissioning::Job> m_job;
  bool m_made;
};

}  // namespace zerodrift::cli
