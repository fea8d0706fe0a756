#include "core/flow/machine_write.h"

#include <fmt/format.h>

#include "core/commissioning/job.h"

namespace zerodrift::flow {

Consent Consent::given() {
  Consent consent;
  consent.m_given = true;
  return consent;
}

Consent Consent::by_asking(std::function<bool(const WriteQuestion&)> ask) {
  Consent consent;
  consent.m_ask = std::move(ask);
  return consent;
}

Status Consent::possible(const std::string& operation) const {
  if (m_given || m_ask) return {};
  return fail(ErrorCode::not_confirmed, {{"operation", operation}});
}

Status Consent::ask(const WriteQuestion& question) const {
  if (m_given || (m_ask && m_ask(question))) return {};
  return fail(ErrorCode::not_confirmed, {{"operation", question.operation}});
}

Result<MachineWrite> MachineWrite::begin(commissioning::Job* job, access::Permit permit, const Consent& consent,
                                         const WriteQuestion& question) {
  ZD_CHECK(permit.check(question.operation));
  ZD_CHECK(consent.ask(question));
  return MachineWrite(job, question.machine);
}

Status MachineWrite::write(commissioning::AuditEntry entry, const std::function<Status()>& work) const {
  if (m_job == nullptr) return work();
  entry.machine = m_machine;
  entry.result = "started";
  ZD_CHECK(m_job->audit(entry).map([](const auto&) {}));
  Status done = work();
  entry.result = done ? "done" : std::string(name_of(done.error().code));
  ZD_CHECK(m_job->audit(entry).map([](const auto&) {}));
  return done;
}

std::string machine_text(const std::string& name, std::uint32_t serial) {
  return fmt::format("{} (serial {})", name, serial);
}

}  // namespace zerodrift::flow
