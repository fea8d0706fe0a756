#include "core/controller/manual_upload.h"

#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/controller/table_route.h"
#include "core/controller/table_words.h"

namespace zerodrift::controller {
namespace {

constexpr int most_registers = 2000;  // of no register map: what the difference can be computed from

/// By the hands of a person: the table leaves as a file, and the control's check value proves that it arrived.
class TableByHand : public TableRoute {
 public:
  TableByHand(ManualControl& control, compensation::Table& table, const ManualUploadOptions& options)
      : m_control(control), m_table(table), m_options(options) {}

  acquisition::MachineIo& machine() override { return m_control; }
  const Profile& profile() const override { return m_control.profile(); }
  int capacity(const acquisition::MachineIdentity&) const override { return most_registers; }
  Status ready(const acquisition::MachineSample&) override { return {}; }

  Status save_old(UploadRecord& record) override {
    record.old_words = m_options.old_words;
    record.old_sequence = m_options.old_sequence;
    record.sequence = m_options.old_sequence + 1;
    m_table.version = record.sequence;
    return {};
  }

  std::uint32_t check_value(const UploadRecord&) const override {
    return static_cast<std::uint32_t>(std::stoul(controller::check_value(m_table), nullptr, 16));
  }

  Status prepare(UploadAttempt& attempt) override {
    attempt.enter(UploadState::staging, m_options.file);
    return write_json_file(m_options.file, compensation::to_json(m_table));
  }

  Status transfer(UploadAttempt& attempt) override {
    attempt.enter(UploadState::waiting, "");
    return m_control.load_table(m_options.file, controller::check_value(m_table));
  }

  /// What the control holds now nobody knows: it stays off.
  Status undo(UploadAttempt&, const Error& reason) override { return fail(reason); }

 private:
  ManualControl& m_control;
  compensation::Table& m_table;
  const ManualUploadOptions& m_options;
};

}  // namespace

UploadRecord upload_by_hand(ManualControl& control, compensation::Table& table, const ManualUploadOptions& options,
                            const TaskContext& context) {
  TableByHand route(control, table, options);
  const MakeWords words = [&](int capacity) { return encode_table(table, control.profile(), capacity); };
  UploadOptions upload;
  upload.dry_run = options.dry_run;
  upload.observer = options.observer;
  return run_upload(route, words, &table, upload, context);
}

std::string check_value(const compensation::Table& table) {
  return compensation::crc32_text(table);
}

}  // namespace zerodrift::controller
