#pragma once
// The only way in which something is written to a machine, from the window and from the command line alike: the right
// to write is checked, a person's consent is asked for, and every write stands in the job's audit trail before it
// begins and after it ended. The rule of consent is in docs/access.md.

#include <functional>
#include <string>

#include "core/access/permit.h"
#include "core/base/result.h"
#include "core/commissioning/artefact.h"

namespace zerodrift::commissioning {
class Job;
}

namespace zerodrift::flow {

struct UploadPreview;

/// What a person is asked.
struct WriteQuestion {
  std::string operation;                 // "Writing the table"
  std::string machine;                   // machine_text
  const UploadPreview* table = nullptr;  // the difference, when a table is written
};

/// A person's word. By default nobody gives it: what nobody can be asked about is not written.
class Consent {
 public:
  Consent() = default;
  /// The question was answered before: in the window, by --yes, or by starting what ends with its operation.
  static Consent given();
  static Consent by_asking(std::function<bool(const WriteQuestion&)> ask);

  /// not_confirmed when nobody can be asked: for work that should not be begun then.
  Status possible(const std::string& operation) const;
  /// not_confirmed naming the operation.
  Status ask(const WriteQuestion& question) const;

 private:
  bool m_given = false;
  std::function<bool(const WriteQuestion&)> m_ask;
};

/// The right and the consent for one operation, which may write several times.
class MachineWrite {
 public:
  /// access_locked without a permit to write, not_confirmed without consent. `job` null: written outside of any job,
  /// so there is no trail.
  static Result<MachineWrite> begin(commissioning::Job* job, access::Permit permit, const Consent& consent,
                                    const WriteQuestion& question);

  /// `entry` names action, subject, old and new value. Nothing is written when the trail cannot be.
  Status write(commissioning::AuditEntry entry, const std::function<Status()>& work) const;

 private:
  MachineWrite(commissioning::Job* job, std::string machine) : m_job(job), m_machine(std::move(machine)) {}
  commissioning::Job* m_job;
  std::string m_machine;
};

/// "VMC-850 #3 (serial 17)"
std::string machine_text(const std::string& name, std::uint32_t serial);

}  // namespace zerodrift::flow
