#include "core/flow/rollback_and_switch.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/controller/table_words.h"
#include "core/flow/steps/inputs.h"

namespace zerodrift::flow {

using commissioning::NewArtefact;
using controller::UploadRecord;
using nlohmann::json;

Result<RollbackPreview> preview_roll_back(const commissioning::Job& job, const controller::Profile& profile,
                                          const std::string& id, const TaskContext& context) {
  ZD_TRY(auto devices, Devices::open(profile, false));
  ZD_TRY(const auto identity, devices.machine->identify());
  ZD_TRY(auto* const machine, devices.linked("going back to a former table"));
  ZD_CHECK(controller::TableHistory().adopt(identity.serial, tables_of(job, identity.serial)));
  RollbackPreview preview;
  ZD_TRY(preview.target, controller::rollback_target(*machine, {std::nullopt, id}));
  controller::UploadOptions options;
  options.dry_run = true;
  preview.difference.record = controller::roll_back(*machine, preview.target, options, context);
  ZD_CHECK(preview.difference.record.result);
  ZD_TRY(preview.difference.table, controller::decode_table(preview.difference.record.new_words, profile));
  preview.difference.note_largest();
  return preview;
}

namespace {

/// A controller's registers hold no range of validity: it is in the job that has written them.
auto valid_range_of(const commissioning::Job& job, const std::vector<std::uint16_t>& words)
    -> decltype(compensation::Table::valid) {
  const auto uploads = job.history("upload");
  if (!uploads) return {};
  for (const auto& one : *uploads) {
    const auto body = one.document();
    if (!body || !body->contains("record") || !body->contains("table")) continue;
    if (body->at("record").value("new_words", std::vector<std::uint16_t>{}) != words) continue;
    const auto table = compensation::table_from_json(body->at("table"), "upload");
    if (table && !table->valid.empty()) return table->valid;
  }
  return {};
}

}  // namespace

Result<NewArtefact> roll_back(commissioning::Job& job, const controller::Profile& profile, access::Permit permit,
                              const Consent& consent, const controller::RollbackTarget& target,
                              const std::function<void(const controller::UploadStep&)>& observer,
                              const TaskContext& context) {
  ZD_TRY(const auto machine_artefact, need(job, "upload", "machine"));
  ZD_TRY(auto devices, Devices::open(profile, false, permit));
  ZD_TRY(auto* const machine, devices.linked("going back to a former table"));
  ZD_TRY(const auto identity, machine->identify());
  ZD_CHECK(same_machine(job, "upload", identity.serial));
  ZD_TRY(auto table, controller::decode_table(target.table.words.value_or(std::vector<std::uint16_t>{}), profile));
  ZD_TRY(const auto write, MachineWrite::begin(&job, permit, consent,
                                               {fmt::format("Going back to version {}", target.table.version),
                                                machine_text(identity.name, identity.serial)}));
  table.version = target.table.version;  // which one was brought back
  table.valid = valid_range_of(job, target.table.words.value_or(std::vector<std::uint16_t>{}));
  commissioning::AuditEntry entry;
  entry.action = "roll back table";
  entry.subject = "compensation table";
  entry.old_value = fmt::format("version {}, {} registers", target.active.sequence, target.active.words.size());
  entry.new_value = json_text(compensation::to_json(table));
  controller::UploadOptions options;
  options.observer = observer;
  UploadRecord record;
  ZD_CHECK(write.write(entry, [&]() -> Status {
    record = controller::roll_back(*machine, target, options, context);
    return record.result;
  }));
  table.version = record.sequence;
  json body = upload_body(record, table, controller::TableOrigin::rollback);
  body["rolled_back_to"] = target.table.version;
  return NewArtefact::of("upload", body, {machine_artefact.id});
}

Result<controller::SignCheckRecord> try_signs(commissioning::Job& job, const controller::Profile& profile,
                                              access::Permit permit, const Consent& consent,
                                              const TaskContext& context) {
  ZD_TRY(auto devices, Devices::open(profile, true, permit));
  ZD_TRY(const auto identity, devices.machine->identify());
  ZD_CHECK(same_machine(job, "upload", identity.serial));
  if (!identity.accepts_host_offset) {
    return fail(ErrorCode::machine_unsupported,
                {{"what", "the host offset"}, {"found", "none"}, {"expected", "one, for the test move"}});
  }
  ZD_TRY(const auto write,
         MachineWrite::begin(&job, permit, consent, {"A test move", machine_text(identity.name, identity.serial)}));
  return watch_signs(job, devices, write, context);
}

Result<bool> switch_compensation(commissioning::Job* job, Devices& devices, const Consent& consent, bool on) {
  ZD_TRY(const auto identity, devices.machine->identify());
  ZD_TRY(const bool is_on, devices.machine->compensation_on());
  if (is_on == on) return on;
  ZD_TRY(const auto write, MachineWrite::begin(job, devices.permit, consent,
                                               {on ? "Switching the compensation on" : "Switching the compensation off",
                                                machine_text(identity.name, identity.serial)}));
  commissioning::AuditEntry entry;
  entry.action = "switch compensation";
  entry.subject = "compensation switch";
  entry.old_value = is_on ? "on" : "off";
  entry.new_value = on ? "on" : "off";
  // Outside of any job the machine's own history is the trail.
  if (job == nullptr) ZD_CHECK(controller::TableHistory().note_switch(identity.serial, on));
  ZD_CHECK(write.write(entry, [&] { return devices.machine->switch_compensation(on); }));
  return devices.machine->compensation_on();
}

}  // namespace zerodrift::flow
