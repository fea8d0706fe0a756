#include "core/controller/rollback.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <set>

#include "core/controller/table_words.h"

namespace zerodrift::controller {
namespace {

ActiveTable old_of(const UploadRecord& record) {
  return {record.old_words, record.old_sequence, crc_of_words(record.old_words)};
}

/// Keeps the log of one transaction.
class Keeper {
 public:
  Keeper(const TableHistory& history, TableOrigin origin, std::string of) : m_history(history) {
    m_entry.origin = origin;
    m_entry.of = std::move(of);
    m_entry.who = TableHistory::user();
  }

  /// Before anything is written.
  Status begin(const UploadRecord& record) {
    ZD_TRY(const TableLog log, m_history.note_active(record.serial, old_of(record)));
    m_before = log.entries.back();
    m_entry.version = record.sequence;
    m_entry.crc = record.crc;
    m_entry.words = record.new_words;
    ZD_CHECK(m_history.begin(record.serial, m_entry));
    m_begun = true;
    return {};
  }

  /// An end that cannot be written is settled at the next look at the machine.
  void end(UploadRecord& record) const {
    if (!m_begun || record.reached == UploadState::restore_failed) return;
    const Status kept = write_end(record);
    if (!kept) record.warnings.push_back("the history could not be written: " + describe(kept.error()));
  }

 private:
  Status write_end(const UploadRecord& record) const {
    ZD_CHECK(m_history.end(record.serial, m_entry.id, record.result.has_value()));
    if (record.result || !record.restored_sequence) return {};
    TableEntry restored = m_before;
    restored.origin = TableOrigin::restored;
    restored.who = m_entry.who;
    restored.version = *record.restored_sequence;
    restored.of = m_before.id;
    restored.note = fmt::format("version {}: {}", record.sequence, describe(record.result.error()));
    return m_history.add(record.serial, restored);
  }

  const TableHistory& m_history;
  TableEntry m_entry;
  TableEntry m_before;
  bool m_begun = false;
};

Error no_such_version(const TableLog& log, const std::string& found) {
  std::set<int> versions;
  for (std::size_t i = 0; i + 1 < log.entries.size(); ++i) {
    if (log.entries[i].words) versions.insert(log.entries[i].version);
  }
  return Error{ErrorCode::bad_argument,
               {{"what", "the version to go back to"},
                {"found", found},
                {"expected", fmt::format("a former one ({})", fmt::join(versions, ", "))}}};
}

Result<TableEntry> chosen_in(const TableLog& log, const RollbackChoice& choice) {
  for (auto one = log.entries.rbegin() + 1; one != log.entries.rend(); ++one) {
    const bool meant = choice.id.empty() ? one->version == *choice.version : one->id == choice.id;
    if (meant && one->words) return *one;
  }
  return fail(no_such_version(log, choice.version ? std::to_string(*choice.version) : choice.id));
}

}  // namespace

UploadRecord push_table(ModbusMachine& machine, const compensation::Table& table, TableOrigin origin,
                        UploadOptions options, const TaskContext& context, const TableHistory& history) {
  Keeper keeper(history, origin, {});
  options.keep_old = [&](const UploadRecord& record) { return keeper.begin(record); };
  UploadRecord done = upload_table(machine, table, options, context);
  keeper.end(done);
  return done;
}

Result<RollbackTarget> rollback_target(ModbusMachine& machine, const RollbackChoice& choice,
                                       const TableHistory& history) {
  ZD_TRY(const auto identity, machine.identify());
  ZD_CHECK(require_table(identity));
  ZD_TRY(const TableLog before, history.read(identity.serial));
  RollbackTarget target;
  ZD_TRY(target.active, read_active(machine));
  const TableLog log = with_active(before, target.active, "");
  if (log.entries.size() < 2) {
    return fail(
        ErrorCode::not_enough_data,
        {{"what", fmt::format("former tables of machine {}", identity.serial)}, {"found", "0"}, {"needed", "1"}});
  }
  if (choice.version || !choice.id.empty()) {
    ZD_TRY(target.table, chosen_in(log, choice));
    return target;
  }
  if (log.entries.back().origin == TableOrigin::found && log.entries.back().of.empty()) {
    return fail(ErrorCode::data_does_not_fit,
                {{"what", "the active table"},
                 {"found", fmt::format("version {}, not written from here", target.active.sequence)},
                 {"expected", "the table that was written last, or a version chosen to go back to"}});
  }
  const TableEntry* former = before_last(log);
  if (former == nullptr) {
    return fail(ErrorCode::not_enough_data,
                {{"what", fmt::format("tables before the active one on machine {}", identity.serial)},
                 {"found", "0"},
                 {"needed", "1"}});
  }
  target.table = *former;
  return target;
}

UploadRecord roll_back(ModbusMachine& machine, const RollbackTarget& target, UploadOptions options,
                       const TaskContext& context, const TableHistory& history) {
  Keeper keeper(history, TableOrigin::rollback, target.table.id);
  options.activation = Activation::as_before;
  options.keep_old = [&](const UploadRecord& record) -> Status {
    if (!same_table(record.old_words, target.active.words)) {
      return fail(ErrorCode::data_does_not_fit,
                  {{"what", "the active table"},
                   {"found", fmt::format("version {}, written meanwhile", record.old_sequence)},
                   {"expected", fmt::format("version {}", target.active.sequence)}});
    }
    return keeper.begin(record);
  };
  UploadRecord record =
      upload_words(machine, target.table.words.value_or(std::vector<std::uint16_t>{}), options, context);
  keeper.end(record);
  return record;
}

}  // namespace zerodrift::controller
