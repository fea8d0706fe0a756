#include "app/cli/job_file.h"

namespace zerodrift::cli {
namespace {

/// The look at the machine is what every run begins with; nothing was measured or written then.
bool is_empty(const commissioning::Job& job) {
  const auto kinds = job.kinds();
  const auto series = job.series();
  const auto trail = job.audit_trail();
  if (!kinds || !series || !trail || !series->empty() || !trail->empty()) return false;
  return kinds->empty() || (kinds->size() == 1 && kinds->front() == "machine");
}

}  // namespace

Result<JobFile> JobFile::open_or_create(const std::filesystem::path& path) {
  std::error_code ignored;
  const bool made = !std::filesystem::exists(path, ignored);
  ZD_TRY(auto job, commissioning::Job::open_or_create(path));
  return JobFile(std::move(job), made);
}

JobFile::~JobFile() {
  if (!m_made || !m_job || !is_empty(*m_job)) return;
  const std::filesystem::path path = m_job->path();
  m_job.reset();
  std::error_code ignored;
  for (const char* ending : {"", "-wal", "-shm"}) std::filesystem::remove(path.string() + ending, ignored);
}

}  // namespace zerodrift::cli
