#include "core/flow/steps/audited.h"

#include <fmt/format.h>

namespace zerodrift::flow {

Status audited(commissioning::Job& job, commissioning::AuditEntry entry, const std::function<Status()>& work) {
  entry.result = "started";
  ZD_CHECK(job.audit(entry).map([](const auto&) {}));
  Status done = work();
  entry.result = done ? "done" : std::string(name_of(done.error().code));
  ZD_CHECK(job.audit(entry).map([](const auto&) {}));
  return done;
}

std::string machine_text(const std::string& name, std::uint32_t serial) {
  return fmt::format("{} (serial {})", name, serial);
}

}  // namespace zerodrift::flow
