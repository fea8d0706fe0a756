#include "core/flow/machine_table.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/commissioning/job.h"
#include "core/controller/manual_upload.h"
#include "core/controller/rollback.h"

namespace zerodrift::flow {

using nlohmann::json;

namespace {

controller::UploadRecord failed(const Error& error) {
  controller::UploadRecord record;
  record.result = fail(error);
  return record;
}

/// Nobody can read what stands in such a control: what this job put there last is taken for it.
Status know_old(const commissioning::Job& job, controller::ManualUploadOptions& options) {
  ZD_TRY(const auto before, job.latest("upload"));
  if (!before) return {};
  ZD_TRY(const json body, before->document());
  options.old_words = body.at("record").value("new_words", std::vector<std::uint16_t>{});
  options.old_sequence = body.value("version", 0);
  return {};
}

}  // namespace

Status table_is_active(Devices& devices, const json& upload) {
  const auto not_active = [&](const std::string& found) {
    return fail(ErrorCode::table_not_active,
                {{"version", fmt::to_string(upload.value("version", 0))}, {"found", found}});
  };
  if (devices.by_hand != nullptr) {
    ZD_TRY(const std::string check, devices.by_hand->table_check());
    if (check == upload.value("crc32", "")) return {};
    return not_active(fmt::format("a table with the check value {}", check));
  }
  ZD_TRY(auto* const machine, devices.linked("reading the active table"));
  ZD_TRY(const auto mark, controller::read_active_mark(*machine));
  const auto words = upload.at("record").value("new_words", std::vector<std::uint16_t>{});
  const bool none = controller::is_empty_table(static_cast<std::size_t>(mark.registers));
  if (!none && controller::is_marked(mark, words)) return {};
  return not_active(none ? std::string("no table") : fmt::format("version {}", mark.sequence));
}

controller::UploadRecord write_table(const commissioning::Job& job, Devices& devices, compensation::Table& table,
                                     controller::TableOrigin origin, const controller::UploadOptions& options,
                                     const TaskContext& context) {
  if (devices.by_hand == nullptr) {
    if (options.dry_run) return controller::upload_table(*devices.link, table, options, context);
    return controller::push_table(*devices.link, table, origin, options, context);
  }
  controller::ManualUploadOptions by_hand;
  by_hand.dry_run = options.dry_run;
  by_hand.observer = options.observer;
  if (const Status known = know_old(job, by_hand); !known) return failed(known.error());
  by_hand.file = fmt::format("{}.table-{}.json", job.path().string(), by_hand.old_sequence + 1);
  return controller::upload_by_hand(*devices.by_hand, table, by_hand, context);
}

}  // namespace zerodrift::flow
