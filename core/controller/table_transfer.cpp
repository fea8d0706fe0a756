#include "core/controller/table_transfer.h"

#include <fmt/format.h>

#include <chrono>
#include <thread>

#include "core/acquisition/machine_fault.h"
#include "core/controller/table_words.h"

namespace zerodrift::controller {
namespace {

constexpr double table_scale_nm = 1000.0;  // values are in um
constexpr double check_timeout_machine_s = 30.0;
constexpr int status_checking = 2;
constexpr int status_active = 3;
constexpr int status_rejected = 4;

std::string reason_text(int reason) {
  switch (reason) {
    case 1:
      return "the check sum does not fit";
    case 2:
      return "the number of registers is wrong";
    case 3:
      return "the words are not a table";
    case 4:
      return "a limit of the machine is exceeded";
    case 5:
      return "the compensation switch is on";
    case 6:
      return "the axes move";
    case 7:
      return "the scale is wrong";
    case 8:
      return "the sequence number is wrong";
    default:
      return fmt::format("reason {}", reason);
  }
}

/// Waits with a deadline in machine seconds.
class Deadline {
 public:
  Deadline(const ModbusMachine& machine, double machine_s)
      : m_end(std::chrono::steady_clock::now() + std::chrono::duration_cast<std::chrono::steady_clock::duration>(
                                                     std::chrono::duration<double>(machine.host_seconds(machine_s)))) {}
  /// False when the time is over; pauses a little otherwise.
  bool wait() const {
    if (std::chrono::steady_clock::now() > m_end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return true;
  }

 private:
  std::chrono::steady_clock::time_point m_end;
};

}  // namespace

Result<TableStatus> read_table_status(ModbusMachine& machine) {
  std::vector<std::string> names = {"table_commit", "table_status", "table_status_sequence"};
  const bool tells_reason = machine.map().find("table_reject_reason") != nullptr;
  if (tells_reason) names.emplace_back("table_reject_reason");
  ZD_TRY(const RegisterValues values, machine.read_values(names));
  const auto number = [&](const char* name) { return static_cast<int>(values.at(name).front()); };
  return TableStatus{number("table_commit"), number("table_status"), number("table_status_sequence"),
                     tells_reason ? number("table_reject_reason") : 0};
}

Result<ActiveTable> settled_active(ModbusMachine& machine) {
  const Deadline deadline(machine, check_timeout_machine_s);
  for (;;) {
    ZD_TRY(const TableStatus now, read_table_status(machine));
    if (now.commit == 0 && now.status != status_checking) break;
    if (!deadline.wait()) break;
  }
  return read_active(machine);
}

Status TableTransfer::run(const TaskContext& context) {
  m_enter(UploadState::staging, fmt::format("{} registers", m_words.size()));
  ZD_CHECK(m_machine.write_words("table_staging", 0, m_words));
  m_enter(UploadState::reading_back, "");
  ZD_CHECK(compare_staging());
  m_enter(UploadState::announcing, fmt::format("version {}", m_sequence));
  ZD_CHECK(announce());
  if (context.cancelled()) return fail(ErrorCode::cancelled);
  m_enter(UploadState::committing, "");
  ZD_CHECK(commit());
  m_enter(UploadState::waiting, "");
  ZD_CHECK(wait_for_check());
  m_enter(UploadState::comparing, "");
  ZD_TRY(const ActiveTable active, read_active(m_machine));
  if (active.sequence != m_sequence || active.words != m_words) {
    return fail(ErrorCode::upload_read_back, {{"register", "active table"},
                                              {"written", fmt::format("sequence {}", m_sequence)},
                                              {"read", fmt::format("sequence {}", active.sequence)}});
  }
  return {};
}

Status TableTransfer::compare_staging() {
  ZD_TRY(const std::vector<std::uint16_t> read,
         m_machine.read_words("table_staging", static_cast<int>(m_words.size())));
  ZD_TRY(const Register entry, m_machine.map().require("table_staging"));
  for (std::size_t i = 0; i < read.size(); ++i) {
    if (read[i] == m_words[i]) continue;
    return fail(ErrorCode::upload_read_back, {{"register", std::to_string(entry.address + static_cast<int>(i))},
                                              {"written", std::to_string(m_words[i])},
                                              {"read", std::to_string(read[i])}});
  }
  return {};
}

Status TableTransfer::announce() {
  const std::vector<std::pair<const char*, double>> facts = {{"table_count", static_cast<double>(m_words.size())},
                                                             {"table_scale", table_scale_nm},
                                                             {"table_crc", static_cast<double>(crc_of_words(m_words))},
                                                             {"table_sequence", static_cast<double>(m_sequence)}};
  for (const auto& [name, value] : facts) {
    ZD_CHECK(m_machine.write_values(name, {value}));
    ZD_TRY(const double read, m_machine.read_value(name));
    if (read == value) continue;
    return fail(ErrorCode::upload_read_back,
                {{"register", name}, {"written", fmt::format("{:.0f}", value)}, {"read", fmt::format("{:.0f}", read)}});
  }
  return {};
}

Status TableTransfer::commit() {
  constexpr int attempts = 3;
  for (int attempt = 1;; ++attempt) {
    m_committed = true;  // from here on the controller may have taken it, whatever the link says
    const Status sent = m_machine.write_values("table_commit", {static_cast<double>(m_sequence)}, Retry::no);
    if (sent || !acquisition::may_pass(sent.error())) return sent;
    // Unclear: the controller's own word decides, after time to take the commit up.
    std::this_thread::sleep_for(std::chrono::milliseconds(50 * attempt));
    ZD_TRY(const TableStatus now, read_table_status(m_machine));
    if (now.sequence == m_sequence || now.commit == m_sequence) return {};  // it did arrive
    if (attempt == attempts) return sent;
  }
}

Status TableTransfer::wait_for_check() {
  const Deadline deadline(m_machine, check_timeout_machine_s);
  for (;;) {
    ZD_TRY(const TableStatus now, read_table_status(m_machine));
    if (now.sequence == m_sequence && now.status == status_active) return {};
    if (now.sequence == m_sequence && now.status == status_rejected) {
      return fail(ErrorCode::upload_rejected, {{"reason", reason_text(now.reason)}});
    }
    if (!deadline.wait()) {
      return fail(ErrorCode::machine_not_ready,
                  {{"what", "the check of the table"}, {"reason", fmt::format("status stays {}", now.status)}});
    }
  }
}

}  // namespace zerodrift::controller
