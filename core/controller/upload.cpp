#include "core/controller/upload.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/compensation/interlock.h"
#include "core/controller/table_transfer.h"
#include "core/controller/table_words.h"

namespace zerodrift::controller {
namespace {

using compensation::Table;
using Words = std::vector<std::uint16_t>;

Error not_ready(const std::string& reason) {
  return Error{ErrorCode::machine_not_ready, {{"what", "an upload"}, {"reason", reason}}};
}

compensation::Temperatures temperatures_of(const Profile& profile, const acquisition::MachineSample& sample) {
  compensation::Temperatures temperatures{{"ambient_C", sample.ambient_C}};
  for (std::size_t i = 0; i < profile.sensors.size(); ++i) {
    temperatures[profile.sensors[i].channel] = sample.temperature_C[i];
  }
  return temperatures;
}

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
    ZD_CHECK(require_table(identity));
    if (table != nullptr) ZD_CHECK(check_machine(*table));
    ZD_TRY(m_record.new_words, make_words(identity.table_capacity_registers));
    m_record.crc = crc_of_words(m_record.new_words);
    ZD_TRY(const auto sample, m_machine.read());
    ZD_CHECK(check_ready(sample));
    m_was_on = sample.compensation_on;
    enter(UploadState::saving_old, "");
    ZD_CHECK(save_old());
    ZD_CHECK(compare_tables(m_record, m_machine.profile(), sample));
    if (table != nullptr) ZD_CHECK(check_for_machine(m_record, *table, m_machine.profile(), sample));
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
    ZD_TRY(const TableStatus status, read_table_status(m_machine));
    m_record.sequence = next_sequence(std::max(old.sequence, status.sequence));
    return {};
  }

  static int next_sequence(int sequence) { return sequence >= 65535 ? 1 : sequence + 1; }

  Status write() {
    enter(UploadState::switching_off, "");
    if (auto off = switch_off(); !off) return undo(off.error(), false);
    const auto notify = [this](UploadState state, std::string detail) { enter(state, std::move(detail)); };
    TableTransfer transfer(m_machine, m_record.new_words, m_record.sequence, notify);
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
      if (!committed) {
        if (!m_was_on || m_options.activation == Activation::off) return fail(reason);
        return fail(ErrorCode::upload_left_off, {{"reason", why}, {"detail", describe(restored.error())}});
      }
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
      auto active = committed ? settled_active(m_machine) : read_active(m_machine);
      if (active && same_table(active->words, m_record.old_words)) {
        if (active->sequence != m_record.old_sequence) m_record.restored_sequence = active->sequence;
        break;
      }
      if (!active && !committed) return fail(active.error());
      if (attempt == 3) {
        return active ? fail(ErrorCode::upload_read_back,
                             {{"register", "active table"}, {"written", "the old table"}, {"read", "another one"}})
                      : fail(active.error());
      }
      const auto silent = [](UploadState, const std::string&) {};
      ZD_TRY(const TableStatus status, read_table_status(m_machine));
      const Words old_words = m_record.old_words.empty() ? Words{1, 0} : m_record.old_words;
      const int sequence = next_sequence(std::max(status.sequence, m_record.sequence));
      TableTransfer back(m_machine, old_words, sequence, silent);
      if (back.run({})) {
        m_record.restored_sequence = sequence;
        rewritten = true;
        break;
      }
    }
    if (m_was_on && m_options.activation != Activation::off) ZD_CHECK(m_machine.switch_compensation(true));
    return rewritten;
  }

  ModbusMachine& m_machine;
  const UploadOptions& m_options;
  const TaskContext& m_context;
  SystemClock m_clock;
  UploadRecord m_record;
  bool m_was_on = false;
};

}  // namespace

Status compare_tables(UploadRecord& record, const Profile& profile, const acquisition::MachineSample& sample) {
  ZD_TRY(const Table new_table, decode_table(record.new_words, profile));
  ZD_TRY(record.old_table, decode_table(record.old_words, profile));
  record.old_table.version = record.old_sequence;
  ZD_TRY(record.difference,
         compensation::difference(record.old_table, new_table, temperatures_of(profile, sample), sample.axes));
  for (const auto& axis : record.difference) {
    if (axis.largest_um <= profile.max_um) continue;
    return fail(ErrorCode::limit_exceeded, {{"what", "the change of the compensation of axis " + axis.axis},
                                            {"found", fmt::format("{:.1f} um", axis.largest_um)},
                                            {"limit", fmt::format("{:.0f} um", profile.max_um)}});
  }
  return compensation::check_steepness(new_table, profile.max_um_per_K);
}

Status check_for_machine(UploadRecord& record, const Table& table, const Profile& profile,
                         const acquisition::MachineSample& sample) {
  ZD_CHECK(compensation::check_steepness(table, profile.max_um_per_K));
  for (const auto& outside : compensation::outside_valid_range(table, temperatures_of(profile, sample))) {
    record.warnings.push_back(outside +
                              ": when the table was written, the machine was outside the range the model was made in");
  }
  return {};
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

}  // namespace zerodrift::controller
