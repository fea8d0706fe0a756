#include "core/controller/manual_upload.h"

#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/compensation/interlock.h"
#include "core/controller/table_words.h"

namespace zerodrift::controller {
namespace {

class ManualUpload {
 public:
  ManualUpload(ManualControl& control, const ManualUploadOptions& options, const TaskContext& context)
      : m_control(control), m_options(options), m_context(context) {
    m_record.started = m_clock.utc();
    m_record.dry_run = options.dry_run;
  }

  UploadRecord run(compensation::Table& table) {
    m_record.result = whole(table);
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

  Status whole(compensation::Table& table) {
    enter(UploadState::checking, "");
    const Profile& profile = m_control.profile();
    m_record.machine = profile.name;
    m_record.serial = profile.serial;
    if (!table.machine.empty() && table.machine != profile.name) {
      return fail(ErrorCode::data_does_not_fit,
                  {{"what", "the table's machine"}, {"found", table.machine}, {"expected", profile.name}});
    }
    m_record.old_words = m_options.old_words;
    m_record.old_sequence = m_options.old_sequence;
    m_record.sequence = m_options.old_sequence + 1;
    table.version = m_record.sequence;
    ZD_TRY(m_record.new_words, encode_table(table, profile));
    m_record.crc = static_cast<std::uint32_t>(std::stoul(check_value(table), nullptr, 16));
    ZD_TRY(const auto sample, m_control.read());
    ZD_CHECK(compare_tables(m_record, profile, sample));
    ZD_CHECK(check_for_machine(m_record, table, profile, sample));
    if (m_options.dry_run) return {};
    if (m_context.cancelled()) return fail(ErrorCode::cancelled);
    return load(table);
  }

  Status load(const compensation::Table& table) {
    enter(UploadState::staging, m_options.file);
    ZD_CHECK(write_json_file(m_options.file, compensation::to_json(table)));
    enter(UploadState::switching_off, "");
    ZD_CHECK(m_control.switch_compensation(false));
    ZD_TRY(const bool on, m_control.compensation_on());
    ZD_CHECK(compensation::allow_staging(on));
    enter(UploadState::waiting, "");
    ZD_CHECK(m_control.load_table(m_options.file, check_value(table)));
    enter(UploadState::switching_on, "");
    ZD_CHECK(m_control.switch_compensation(true));
    enter(UploadState::ramping, "");
    return m_control.wait_for_ramp(true, m_context.stop).map([](double) {});
  }

  ManualControl& m_control;
  const ManualUploadOptions& m_options;
  const TaskContext& m_context;
  SystemClock m_clock;
  UploadRecord m_record;
};

}  // namespace

UploadRecord upload_by_hand(ManualControl& control, compensation::Table& table, const ManualUploadOptions& options,
                            const TaskContext& context) {
  return ManualUpload(control, options, context).run(table);
}

std::string check_value(const compensation::Table& table) {
  return compensation::crc32_text(table);
}

}  // namespace zerodrift::controller
