#include "core/controller/upload.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/base/hash.h"
#include "core/base/time_text.h"
#include "core/compensation/interlock.h"
#include "core/controller/table_words.h"

namespace zerodrift::controller {
namespace {

using compensation::Table;
using Words = std::vector<std::uint16_t>;

constexpr double table_scale_nm = 1000.0;  // values are in um
constexpr double check_timeout_machine_s = 30.0;
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

Error not_ready(const std::string& reason) {
  return Error{ErrorCode::machine_not_ready, {{"what", "an upload"}, {"reason", reason}}};
}

struct TableStatus {
  int commit = 0;
  int status = 0;
  int sequence = 0;
  int reason = 0;
};

Result<TableStatus> read_status(ModbusMachine& machine) {
  std::vector<std::string> names = {"table_commit", "table_status", "table_status_sequence"};
  const bool tells_reason = machine.map().find("table_reject_reason") != nullptr;
  if (tells_reason) names.emplace_back("table_reject_reason");
  ZD_TRY(const RegisterValues values, machine.read_values(names));
  const auto number = [&](const char* name) { return static_cast<int>(values.at(name).front()); };
  return TableStatus{number("table_commit"), number("table_status"), number("table_status_sequence"),
                     tells_reason ? number("table_reject_reason") : 0};
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

/// One table into the controller, from staging to the comparison of the active copy; used for the new table and,
/// when something fails, for the old one.
class Transfer {
 public:
  Transfer(ModbusMachine& machine, const Words& words, int sequence,
           std::function<void(UploadState, std::string)> enter)
      : m_machine(machine), m_words(words), m_sequence(sequence), m_enter(std::move(enter)) {}

  bool committed() const { return m_committed; }

  Status run(const TaskContext& context) {
    m_enter(UploadState::staging, fmt::format("{} registers", m_words.size()));
    ZD_CHECK(m_machine.write_words("table_staging", 0, m_words));
    m_enter(UploadState::reading_back, "");
    ZD_CHECK(compare("table_staging"));
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

 private:
  Status compare(const std::string& area) {
    ZD_TRY(const Words read, m_machine.read_words(area, static_cast<int>(m_words.size())));
    ZD_TRY(const Register entry, m_machine.map().require(area));
    for (std::size_t i = 0; i < read.size(); ++i) {
      if (read[i] == m_words[i]) continue;
      return fail(ErrorCode::upload_read_back, {{"register", std::to_string(entry.address + static_cast<int>(i))},
                                                {"written", std::to_string(m_words[i])},
                                                {"read", std::to_string(read[i])}});
    }
    return {};
  }

  Status announce() {
    const std::vector<std::pair<const char*, double>> facts = {
        {"table_count", static_cast<double>(m_words.size())},
        {"table_scale", table_scale_nm},
        {"table_crc", static_cast<double>(crc_of_words(m_words))},
        {"table_sequence", static_cast<double>(m_sequence)}};
    for (const auto& [name, value] : facts) {
      ZD_CHECK(m_machine.write_values(name, {value}));
      ZD_TRY(const double read, m_machine.read_value(name));
      if (read == value) continue;
      return fail(
          ErrorCode::upload_read_back,
          {{"register", name}, {"written", fmt::format("{:.0f}", value)}, {"read", fmt::format("{:.0f}", read)}});
    }
    return {};
  }

  Status commit() {
    for (int attempt = 0;; ++attempt) {
      m_committed = true;  // from here on the controller may have taken it, whatever the link says
      const Status sent = m_machine.write_values("table_commit", {static_cast<double>(m_sequence)}, Retry::no);
      if (sent) return {};
      ZD_TRY(const TableStatus now, read_status(m_machine));
      if (now.sequence == m_sequence || now.commit == m_sequence) return {};  // it did arrive
      if (attempt == 2) return fail(sent.error());
    }
  }

  Status wait_for_check() {
    const Deadline deadline(m_machine, check_timeout_machine_s);
    for (;;) {
      ZD_TRY(const TableStatus now, read_status(m_machine));
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

  ModbusMachine& m_machine;
  const Words& m_words;
  int m_sequence;
  std::function<void(UploadState, std::string)> m_enter;
  bool m_committed = false;
};

class Upload {
 public:
  Upload(ModbusMachine& machine, const UploadOptions& options, const TaskContext& context)
      : m_machine(machine), m_options(options), m_context(context) {
    m_record.started = m_clock.utc();
    m_record.dry_run = options.dry_run;
  }

  /// `make_words` is given the capacity; `table` is null for a rollback.
  UploadRecord run(const std::function<Result<Words>(int)>& make_words, const Table* table) {
    m_record.result = whole(make_words, table);
    if (m_record.result) enter(UploadState::done, m_options.dry_run ? "dry run: nothing was written" : "");
    return std::move(m_record);
  }

 private:
  void enter(UploadState state, std::string detail) {
    m_record.reached = state;
    m_record.steps.push_back({state, m_clock.utc(), std::move(detail)});
    if (m_options.observer) m_options.observer(m_record.steps.back());
    m_context.progress(std::min(1.0, static_cast<double>(state) / static_cast<double>(UploadState::done)),
                       std::string(name_of(state)));
  }

  Status whole(const std::function<Result<Words>(int)>& make_words, const Table* table) {
    enter(UploadState::checking, "");
    ZD_TRY(const auto identity, m_machine.identify());
    m_record.machine = identity.name;
    m_record.serial = identity.serial;
    if (!identity.accepts_table) {
      return fail(ErrorCode::machine_unsupported,
                  {{"what", "the controller's table"}, {"found", "none"}, {"expected", "a table it computes itself"}});
    }
    if (table != nullptr) ZD_CHECK(check_machine(*table));
    ZD_TRY(m_record.new_words, make_words(identity.table_capacity_registers));
    m_record.crc = crc_of_words(m_record.new_words);
    ZD_TRY(const auto sample, m_machine.read());
    ZD_CHECK(check_ready(sample));
    m_was_on = sample.compensation_on;
    enter(UploadState::saving_old, "");
    ZD_CHECK(save_old());
    ZD_CHECK(compare_tables(sample));
    if (table != nullptr) {
      ZD_CHECK(compensation::check_steepness(*table, m_machine.profile().max_um_per_K));
      for (const auto& outside : compensation::outside_valid_range(*table, temperatures_of(sample))) {
        m_record.warnings.push_back(outside + ": the machine is outside the range the model was made in");
      }
    }
    if (m_options.dry_run) return {};
    if (m_context.cancelled()) return fail(ErrorCode::cancelled);
    if (m_options.keep_old) ZD_CHECK(m_options.keep_old(m_record));
    return write();
  }

  Status check_machine(const Table& table) {
    const std::string& own = m_machine.profile().name;
    if (!m_options.check_machine_name || table.machine.empty() || own.empty() || table.machine == own) return {};
    return fail(ErrorCode::data_does_not_fit,
                {{"what", "the table's machine"}, {"found", table.machine}, {"expected", own}});
  }

  Status check_ready(const acquisition::MachineSample& sample) {
    if (sample.alarm) return fail(not_ready("an alarm is on"));
    if (!sample.referenced) return fail(not_ready("the axes are not referenced"));
    if (sample.moving) return fail(not_ready("the axes move"));
    ZD_TRY(const double state,
           m_machine.map().find("state") == nullptr ? Result<double>(0.0) : m_machine.read_value("state"));
    if ((static_cast<int>(state) & 1) != 0) return fail(not_ready("the warm-up cycle runs"));
    return {};
  }

  Status save_old() {
    ZD_TRY(ActiveTable old, read_active(m_machine));
    m_record.old_words = std::move(old.words);
    m_record.old_sequence = old.sequence;
    ZD_TRY(const TableStatus status, read_status(m_machine));
    m_record.sequence = next_sequence(std::max(old.sequence, status.sequence));
    return {};
  }

  static int next_sequence(int sequence) { return sequence >= 65535 ? 1 : sequence + 1; }

  compensation::Temperatures temperatures_of(const acquisition::MachineSample& sample) const {
    const auto& sensors = m_machine.profile().sensors;
    compensation::Temperatures temperatures{{"ambient_C", sample.ambient_C}};
    for (std::size_t i = 0; i < sensors.size(); ++i) temperatures[sensors[i].channel] = sample.temperature_C[i];
    return temperatures;
  }

  /// The difference, and the limits: at the present temperatures no axis may jump by more than the machine takes.
  Status compare_tables(const acquisition::MachineSample& sample) {
    const Profile& profile = m_machine.profile();
    ZD_TRY(const Table new_table, decode_table(m_record.new_words, profile));
    ZD_TRY(m_record.old_table, decode_table(m_record.old_words, profile));
    m_record.old_table.version = m_record.old_sequence;
    ZD_TRY(m_record.difference,
           compensation::difference(m_record.old_table, new_table, temperatures_of(sample), sample.axes));
    for (const auto& axis : m_record.difference) {
      if (axis.largest_um <= profile.max_um) continue;
      return fail(ErrorCode::limit_exceeded, {{"what", "the change of the compensation of axis " + axis.axis},
                                              {"found", fmt::format("{:.1f} um", axis.largest_um)},
                                              {"limit", fmt::format("{:.0f} um", profile.max_um)}});
    }
    ZD_CHECK(compensation::check_steepness(new_table, profile.max_um_per_K));
    return {};
  }

  Status write() {
    enter(UploadState::switching_off, "");
    if (auto off = switch_off(); !off) return undo(off.error(), false);
    const auto notify = [this](UploadState state, std::string detail) { enter(state, std::move(detail)); };
    Transfer transfer(m_machine, m_record.new_words, m_record.sequence, notify);
    if (auto moved = transfer.run(m_context); !moved) return undo(moved.error(), transfer.committed());
    const bool on =
        m_options.activation == Activation::on || (m_options.activation == Activation::as_before && m_was_on);
    if (!on) return {};
    enter(UploadState::switching_on, "");
    if (auto switched = m_machine.switch_compensation(true); !switched) return undo(switched.error(), true);
    return wait_for_ramp();
  }

  Status switch_off() {
    ZD_CHECK(m_machine.switch_compensation(false));
    ZD_TRY(const bool on, m_machine.compensation_on());
    return compensation::allow_staging(on);
  }

  Status wait_for_ramp() {
    enter(UploadState::ramping, "");
    const auto percent = m_machine.wait_for_ramp(true);
    // The table is active and compared by now: what happens to the link while it ramps is worth a word, not a restore.
    if (!percent) m_record.warnings.push_back("the ramp could not be watched: " + describe(percent.error()));
    if (percent && *percent < 100.0) m_record.warnings.push_back(fmt::format("the ramp stands at {:.0f} %", *percent));
    return {};
  }

  /// Brings the old table back, or proves that it never left.
  Status undo(const Error& reason, bool committed) {
    const std::string why = describe(reason);
    enter(UploadState::restoring, why);
    const auto restored = restore(committed);
    if (!restored) {
      // Without a commit only the staging area was touched: the active table is known to be the old one.
      if (!committed) return fail(reason);
      enter(UploadState::restore_failed, describe(restored.error()));
      return fail(ErrorCode::upload_restore_failed, {{"reason", why}, {"detail", describe(restored.error())}});
    }
    enter(UploadState::restored, *restored ? "the old table was written again" : "the old table is still active");
    const bool own_words = reason.code == ErrorCode::upload_rejected || reason.code == ErrorCode::upload_read_back ||
                           reason.code == ErrorCode::cancelled || reason.code == ErrorCode::limit_exceeded;
    if (own_words && !*restored) return fail(reason);
    return fail(ErrorCode::upload_restored, {{"reason", why}});
  }

  /// True when the old table had to be written again.
  Result<bool> restore(bool committed) {
    ZD_CHECK(m_machine.switch_compensation(false));
    bool rewritten = false;
    for (int attempt = 0;; ++attempt) {
      auto active = committed ? settled_active() : read_active(m_machine);
      if (active && active->words == m_record.old_words) break;
      if (!active && !committed) return fail(active.error());
      if (attempt == 3) {
        return active ? fail(ErrorCode::upload_read_back,
                             {{"register", "active table"}, {"written", "the old table"}, {"read", "another one"}})
                      : fail(active.error());
      }
      const auto silent = [](UploadState, const std::string&) {};
      ZD_TRY(const TableStatus status, read_status(m_machine));
      const Words old_words = m_record.old_words.empty() ? Words{1, 0} : m_record.old_words;
      Transfer back(m_machine, old_words, next_sequence(std::max(status.sequence, m_record.sequence)), silent);
      if (back.run({})) {
        rewritten = true;
        break;
      }
    }
    if (m_was_on && m_options.activation != Activation::off) ZD_CHECK(m_machine.switch_compensation(true));
    return rewritten;
  }

  /// After a commit that ended in doubt: waits until the controller has finished its check before judging.
  Result<ActiveTable> settled_active() {
    const Deadline deadline(m_machine, check_timeout_machine_s);
    for (;;) {
      ZD_TRY(const TableStatus now, read_status(m_machine));
      if (now.commit == 0 && now.status != 2) break;
      if (!deadline.wait()) break;
    }
    return read_active(m_machine);
  }

  ModbusMachine& m_machine;
  const UploadOptions& m_options;
  const TaskContext& m_context;
  SystemClock m_clock;
  UploadRecord m_record;
  bool m_was_on = false;
};

}  // namespace

std::string_view name_of(UploadState state) {
  constexpr std::array<std::string_view, 15> names = {
      "checking",  "saving_old",   "switching_off", "staging", "reading_back", "announcing", "committing",    "waiting",
      "comparing", "switching_on", "ramping",       "done",    "restoring",    "restored",   "restore_failed"};
  return names.at(static_cast<std::size_t>(state));
}

Result<ActiveTable> read_active(ModbusMachine& machine) {
  ZD_TRY(const RegisterValues values,
         machine.read_values({"table_active_crc", "table_active_count", "table_active_sequence"}));
  ActiveTable active;
  active.crc = static_cast<std::uint32_t>(values.at("table_active_crc").front());
  active.sequence = static_cast<int>(values.at("table_active_sequence").front());
  const int count = static_cast<int>(values.at("table_active_count").front());
  if (count == 0) return active;
  ZD_TRY(active.words, machine.read_words("table_active", count));
  if (crc_of_words(active.words) != active.crc) {
    return fail(ErrorCode::machine_bad_reply, {{"what", "active table"}, {"detail", "its check sum does not fit"}});
  }
  return active;
}

UploadRecord upload_table(ModbusMachine& machine, const Table& table, const UploadOptions& options,
                          const TaskContext& context) {
  Upload upload(machine, options, context);
  return upload.run([&](int capacity) { return encode_table(table, machine.profile(), capacity); }, &table);
}

UploadRecord upload_words(ModbusMachine& machine, std::vector<std::uint16_t> words, const UploadOptions& options,
                          const TaskContext& context) {
  Upload upload(machine, options, context);
  if (words.empty()) words = {1, 0};  // the empty table
  return upload.run([&](int) -> Result<Words> { return words; }, nullptr);
}

nlohmann::json to_json(const UploadRecord& record) {
  nlohmann::json steps = nlohmann::json::array();
  for (const auto& step : record.steps) {
    steps.push_back({{"state", name_of(step.state)}, {"time", to_text(step.time)}, {"detail", step.detail}});
  }
  nlohmann::json axes = nlohmann::json::array();
  for (const auto& axis : record.difference) {
    nlohmann::json curve = nlohmann::json::array();
    for (const auto& row : axis.curve) {
      curve.push_back({{"position_mm", row.position_mm},
                       {"old_up_um", row.old_up_um},
                       {"old_down_um", row.old_down_um},
                       {"new_up_um", row.new_up_um},
                       {"new_down_um", row.new_down_um}});
    }
    axes.push_back({{"axis", axis.axis},
                    {"largest_um", axis.largest_um},
                    {"largest_at_mm", axis.largest_at_mm},
                    {"compensation", curve}});
  }
  nlohmann::json out = {{"started", to_text(record.started)},
                        {"machine", record.machine},
                        {"serial", record.serial},
                        {"dry_run", record.dry_run},
                        {"state", name_of(record.reached)},
                        {"old_sequence", record.old_sequence},
                        {"sequence", record.sequence},
                        {"crc32", fmt::format("{:08x}", record.crc)},
                        {"old_words", record.old_words},
                        {"new_words", record.new_words},
                        {"difference", axes},
                        {"warnings", record.warnings},
                        {"steps", steps}};
  if (!record.result) out["error"] = describe(record.result.error());
  return out;
}

}  // namespace zerodrift::controller
