#include "core/controller/upload.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/compensation/interlock.h"
#include "core/controller/table_route.h"
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

std::string with_remedy(const std::string& expected) {
  return fmt::format("{}; {}", expected, "make the table anew with this machine's profile");
}

Status same_serial(const char* what, std::uint32_t made_for, std::uint32_t connected) {
  if (made_for == 0 || connected == 0 || made_for == connected) return {};
  return fail(ErrorCode::data_does_not_fit, {{"what", what},
                                             {"found", fmt::format("serial {}", made_for)},
                                             {"expected", fmt::format("serial {}, which is connected", connected)}});
}

/// The machine has each axis of the table and takes what the table may give it.
Status fits_axes(const Table& table, const Profile& profile, const acquisition::MachineSample& sample) {
  for (const auto& [name, axis] : table.axes) {
    if (!sample.axes.empty() && !sample.axes.contains(name)) {
      std::vector<std::string> there;
      for (const auto& [own, position_mm] : sample.axes) there.push_back(own);
      return fail(ErrorCode::data_does_not_fit,
                  {{"what", "an axis of the table"},
                   {"found", name},
                   {"expected", with_remedy(fmt::format("one of the machine's ({})", fmt::join(there, ", ")))}});
    }
    const auto beyond = [&](const char* what, double found, double limit, const char* unit) -> Status {
      if (found <= limit * (1.0 + 1e-6)) return {};  // a table out of a controller has single precision
      return fail(ErrorCode::limit_exceeded, {{"what", fmt::format("the table's {} of axis {}", what, name)},
                                              {"found", fmt::format("{:g} {}", found, unit)},
                                              {"limit", with_remedy(fmt::format("{:g} {}", limit, unit))}});
    };
    ZD_CHECK(beyond("limit", axis.max_um, profile.max_um, "um"));
    ZD_CHECK(beyond("rate", axis.max_um_per_s, profile.max_um_per_s, "um/s"));
  }
  return {};
}

/// What is the same for every control: the checks, the difference, the switch, the record.
class Upload {
 public:
  Upload(TableRoute& route, const UploadOptions& options, const TaskContext& context)
      : m_route(route), m_attempt{m_record, options, context, [this](UploadState state, std::string detail) {
                                    enter(state, std::move(detail));
                                  }} {
    m_record.started = m_clock.utc();
    m_record.dry_run = options.dry_run;
  }

  UploadRecord run(const MakeWords& make_words, const Table* table) {
    m_record.result = whole(make_words, table);
    if (m_record.result) enter(UploadState::done, m_record.dry_run ? "dry run: nothing was written" : "");
    return std::move(m_record);
  }

 private:
  void enter(UploadState state, std::string detail) {
    m_record.reached = state;
    m_record.steps.push_back({state, m_clock.utc(), std::move(detail)});
    if (m_attempt.options.observer) m_attempt.options.observer(m_record.steps.back());
    m_attempt.context.progress(std::min(1.0, static_cast<double>(state) / static_cast<double>(UploadState::done)),
                               std::string(name_of(state)));
  }

  Status whole(const MakeWords& make_words, const Table* table) {
    enter(UploadState::checking, "");
    ZD_TRY(const auto identity, m_route.machine().identify());
    m_record.machine = identity.name;
    m_record.serial = identity.serial;
    ZD_CHECK(require_table(identity));
    ZD_TRY(const auto sample, m_route.machine().read());
    if (table != nullptr) ZD_CHECK(made_for(*table, identity, sample));
    ZD_CHECK(m_route.ready(sample));
    m_attempt.was_on = sample.compensation_on;
    enter(UploadState::saving_old, "");
    ZD_CHECK(m_route.save_old(m_record));
    ZD_TRY(m_record.new_words, make_words(m_route.capacity(identity)));
    m_record.crc = m_route.check_value(m_record);
    ZD_CHECK(compare_tables(m_record, m_route.profile(), sample));
    if (table != nullptr) ZD_CHECK(check_for_machine(m_record, *table, m_route.profile(), sample));
    if (m_record.dry_run) return {};
    if (m_attempt.context.cancelled()) return fail(ErrorCode::cancelled);
    if (m_attempt.options.keep_old) ZD_CHECK(m_attempt.options.keep_old(m_record));
    return write();
  }

  /// A table of another machine is refused by what the two know of themselves: name, serial number, axes, limits.
  Status made_for(const Table& table, const acquisition::MachineIdentity& identity,
                  const acquisition::MachineSample& sample) {
    const Profile& profile = m_route.profile();
    if (m_attempt.options.check_machine_name && !table.machine.empty() && !profile.name.empty() &&
        table.machine != profile.name) {
      return fail(ErrorCode::data_does_not_fit,
                  {{"what", "the table's machine"}, {"found", table.machine}, {"expected", with_remedy(profile.name)}});
    }
    ZD_CHECK(same_serial("the profile's machine", profile.serial, identity.serial));
    ZD_CHECK(same_serial("the table's machine", table.serial, identity.serial));
    if (table.machine.empty()) m_record.warnings.emplace_back("the table does not say for which machine it was made");
    return fits_axes(table, profile, sample);
  }

  Status write() {
    ZD_CHECK(m_route.prepare(m_attempt));
    enter(UploadState::switching_off, "");
    if (auto off = switch_off(); !off) return m_route.undo(m_attempt, off.error());
    if (auto moved = m_route.transfer(m_attempt); !moved) return m_route.undo(m_attempt, moved.error());
    const Activation activation = m_attempt.options.activation;
    if (activation == Activation::off || (activation == Activation::as_before && !m_attempt.was_on)) return {};
    enter(UploadState::switching_on, "");
    if (auto on = m_route.machine().switch_compensation(true); !on) return m_route.undo(m_attempt, on.error());
    wait_for_ramp();
    return {};
  }

  Status switch_off() {
    ZD_CHECK(m_route.machine().switch_compensation(false));
    ZD_TRY(const bool on, m_route.machine().compensation_on());
    return compensation::allow_staging(on);
  }

  void wait_for_ramp() {
    enter(UploadState::ramping, "");
    const auto percent = m_route.machine().wait_for_ramp(true, m_attempt.context.stop);
    // The table is active and compared by now: what happens while it ramps is worth a word, not a restore.
    if (!percent) m_record.warnings.push_back("the ramp could not be watched: " + describe(percent.error()));
    if (percent && *percent < 100.0) m_record.warnings.push_back(fmt::format("the ramp stands at {:.0f} %", *percent));
  }

  TableRoute& m_route;
  SystemClock m_clock;
  UploadRecord m_record;
  UploadAttempt m_attempt;
};

int next_sequence(int sequence) {
  return sequence >= 65535 ? 1 : sequence + 1;
}

/// Over the registers of a controller.
class LinkedTable : public TableRoute {
 public:
  explicit LinkedTable(ModbusMachine& machine) : m_machine(machine) {}

  acquisition::MachineIo& machine() override { return m_machine; }
  const Profile& profile() const override { return m_machine.profile(); }
  int capacity(const acquisition::MachineIdentity& identity) const override {
    return identity.table_capacity_registers;
  }

  Status ready(const acquisition::MachineSample& sample) override {
    if (sample.alarm) return fail(not_ready("an alarm is on"));
    if (!sample.referenced) return fail(not_ready("the axes are not referenced"));
    if (sample.moving) return fail(not_ready("the axes move"));
    ZD_TRY(const double state,
           m_machine.map().find("state") == nullptr ? Result<double>(0.0) : m_machine.read_value("state"));
    if ((static_cast<int>(state) & 1) != 0) return fail(not_ready("the warm-up cycle runs"));
    return {};
  }

  Status save_old(UploadRecord& record) override {
    ZD_TRY(ActiveTable old, read_active(m_machine));
    record.old_words = std::move(old.words);
    record.old_sequence = old.sequence;
    ZD_TRY(const TableStatus status, read_table_status(m_machine));
    record.sequence = next_sequence(std::max(old.sequence, status.sequence));
    return {};
  }

  std::uint32_t check_value(const UploadRecord& record) const override { return crc_of_words(record.new_words); }
  Status prepare(UploadAttempt&) override { return {}; }

  Status transfer(UploadAttempt& attempt) override {
    TableTransfer transfer(m_machine, attempt.record.new_words, attempt.record.sequence, attempt.enter);
    const Status done = transfer.run(attempt.context);
    m_committed = transfer.committed();
    return done;
  }

  /// Brings the old table back, or proves that it never left.
  Status undo(UploadAttempt& attempt, const Error& reason) override {
    const std::string why = describe(reason);
    attempt.enter(UploadState::restoring, why);
    const auto restored = restore(attempt);
    if (!restored) {
      // Without a commit only the staging area was touched: the active table is known to be the old one.
      if (!m_committed) {
        if (!attempt.was_on || attempt.options.activation == Activation::off) return fail(reason);
        return fail(ErrorCode::upload_left_off, {{"reason", why}, {"detail", describe(restored.error())}});
      }
      attempt.enter(UploadState::restore_failed, describe(restored.error()));
      return fail(ErrorCode::upload_restore_failed, {{"reason", why}, {"detail", describe(restored.error())}});
    }
    attempt.enter(UploadState::restored,
                  *restored ? "the old table was written again" : "the old table is still active");
    const bool own_words = reason.code == ErrorCode::upload_rejected || reason.code == ErrorCode::upload_read_back ||
                           reason.code == ErrorCode::cancelled || reason.code == ErrorCode::limit_exceeded;
    if (own_words && !*restored) return fail(reason);
    return fail(ErrorCode::upload_restored, {{"reason", why}});
  }

 private:
  /// True when the old table had to be written again.
  Result<bool> restore(UploadAttempt& attempt) {
    UploadRecord& record = attempt.record;
    ZD_CHECK(m_machine.switch_compensation(false));
    bool rewritten = false;
    for (int tries = 0;; ++tries) {
      auto active = m_committed ? settled_active(m_machine) : read_active(m_machine);
      if (active && same_table(active->words, record.old_words)) {
        if (active->sequence != record.old_sequence) record.restored_sequence = active->sequence;
        break;
      }
      if (!active && !m_committed) return fail(active.error());
      if (tries == 3) {
        return active ? fail(ErrorCode::upload_read_back,
                             {{"register", "active table"}, {"written", "the old table"}, {"read", "another one"}})
                      : fail(active.error());
      }
      const auto silent = [](UploadState, const std::string&) {};
      ZD_TRY(const TableStatus status, read_table_status(m_machine));
      const Words old_words = record.old_words.empty() ? Words{1, 0} : record.old_words;
      const int sequence = next_sequence(std::max(status.sequence, record.sequence));
      TableTransfer back(m_machine, old_words, sequence, silent);
      if (back.run({})) {
        record.restored_sequence = sequence;
        rewritten = true;
        break;
      }
    }
    if (attempt.was_on && attempt.options.activation != Activation::off) ZD_CHECK(m_machine.switch_compensation(true));
    return rewritten;
  }

  ModbusMachine& m_machine;
  bool m_committed = false;
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

UploadRecord run_upload(TableRoute& route, const MakeWords& make_words, const Table* table,
                        const UploadOptions& options, const TaskContext& context) {
  return Upload(route, options, context).run(make_words, table);
}

UploadRecord upload_table(ModbusMachine& machine, const Table& table, const UploadOptions& options,
                          const TaskContext& context) {
  LinkedTable route(machine);
  const MakeWords words = [&](int capacity) { return encode_table(table, machine.profile(), capacity); };
  return run_upload(route, words, &table, options, context);
}

UploadRecord upload_words(ModbusMachine& machine, std::vector<std::uint16_t> words, const UploadOptions& options,
                          const TaskContext& context) {
  if (words.empty()) words = {1, 0};  // the empty table
  LinkedTable route(machine);
  return run_upload(
      route, [&](int) -> Result<Words> { return words; }, nullptr, options, context);
}

}  // namespace zerodrift::controller
