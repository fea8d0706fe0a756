#include "core/flow/steps/upload_step.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/base/json.h"
#include "core/compensation/model_table.h"
#include "core/controller/rollback.h"
#include "core/controller/table_words.h"
#include "core/flow/flow.h"
#include "core/flow/machine_table.h"
#include "core/flow/steps/fit_step.h"
#include "core/flow/steps/inputs.h"

namespace zerodrift::flow {

using nlohmann::json;

namespace {

std::map<std::string, std::pair<std::string, std::string>> entries_of(const compensation::Table& old_table,
                                                                      const compensation::Table& new_table) {
  std::map<std::string, std::pair<std::string, std::string>> entries;
  const auto add = [&](const compensation::Table& table, bool is_new) {
    const auto set = [&](const std::string& what, const std::string& value) {
      auto& entry = entries[what];
      (is_new ? entry.second : entry.first) = value;
    };
    for (const auto& [axis, record] : table.axes) {
      set(axis + " offset", fmt::format("{:.2f} um", record.offset_um));
      for (const auto& term : record.terms) {
        set(axis + " " + term.sensor, fmt::format("{:.3f} um/K from {:.2f} C", term.um_per_K, term.reference_C));
      }
      if (!record.points.empty()) set(axis + " points", std::to_string(record.points.size()));
    }
  };
  add(old_table, false);
  add(new_table, true);
  return entries;
}

json body_of(const UploadPreview& preview, const controller::UploadRecord& record, controller::TableOrigin origin,
             const json& signs) {
  compensation::Table table = preview.table;
  table.version = record.sequence;
  json body = upload_body(record, table, origin);
  body["sign_check"] = signs;
  return body;
}

Status sign_check(commissioning::Job& job, Devices& devices, const MachineWrite& write,
                  const UploadStepOptions& options, const TaskContext& context, json& out) {
  ZD_TRY(const auto identity, devices.machine->identify());
  if (!options.sign_check || !identity.accepts_host_offset) {
    // A correction goes out on the sign that was seen before the first table.
    ZD_TRY(const auto before, job.latest("upload"));
    out = nullptr;
    if (before) {
      ZD_TRY(const json body, before->document());
      out = body.value("sign_check", json());
    }
    return {};
  }
  if (options.checked_signs && options.checked_signs->result) {
    out = controller::to_json(*options.checked_signs);
    return {};
  }
  context.progress(0.1, "checking the sign");
  ZD_TRY(const auto record, watch_signs(job, devices, write, context));
  out = controller::to_json(record);
  if (options.sign_observer) options.sign_observer(record);
  return record.result;
}

/// What was made anew since the model was fitted from it; empty when the model is of today.
Result<std::string> outdated_by(const commissioning::Job& job) {
  const Flow flow;
  ZD_TRY(const auto steps, flow.status(job));
  for (const auto& status : steps) {
    if (status.step->id == "fit" && status.state == StepState::stale) return status.reason;
  }
  return std::string();
}

}  // namespace

void UploadPreview::note_largest() {
  for (const auto& axis : record.difference) {
    if (axis.largest_um < largest_change_um) continue;
    largest_change_um = axis.largest_um;
    largest_change_axis = axis.axis;
  }
}

json table_difference(const compensation::Table& old_table, const compensation::Table& new_table) {
  json difference = json::array();
  for (const auto& [what, values] : entries_of(old_table, new_table)) {
    difference.push_back({{"what", what},
                          {"old", values.first.empty() ? "-" : values.first},
                          {"new", values.second.empty() ? "-" : values.second}});
  }
  return difference;
}

json upload_body(const controller::UploadRecord& record, const compensation::Table& table,
                 controller::TableOrigin origin) {
  json states = json::array();
  for (const auto& step : record.steps) {
    const auto since = std::chrono::duration<double>(step.time - record.started).count();
    states.push_back({{"state", controller::name_of(step.state)}, {"at_s", since}, {"detail", step.detail}});
  }
  double largest_um = 0.0;
  for (const auto& axis : record.difference) largest_um = std::max(largest_um, axis.largest_um);
  return {{"table", compensation::to_json(table)},
          {"kind", controller::name_of(origin)},
          {"version", record.sequence},
          {"crc32", fmt::format("{:08x}", record.crc)},
          {"registers", record.new_words.size()},
          {"largest_change_um", largest_um},
          {"difference", table_difference(record.old_table, table)},
          {"states", states},
          {"sign_check", nullptr},
          {"record", controller::to_json(record)},
          {"problems", record.warnings}};
}

std::vector<controller::TableEntry> tables_of(const commissioning::Job& job, std::uint32_t serial) {
  std::vector<controller::TableEntry> entries;
  const auto made = job.history("upload");
  if (!made) return entries;
  for (const auto& artefact : *made) {
    const auto body = artefact.document();
    if (!body || !body->contains("record")) continue;
    const json& record = body->at("record");
    if (record.value("serial", 0U) != serial || record.contains("error")) continue;
    controller::TableEntry entry;
    entry.id = fmt::format("job-{}-{}", record.value("started", ""), record.value("sequence", 0));
    entry.time = artefact.created_utc;
    entry.who = artefact.engineer;
    // Jobs made before the kind was kept say only when a table was brought back.
    const std::string kind = body->value("kind", body->value("rolled_back", false) ? "rollback" : "upload");
    entry.origin = kind == "rollback"     ? controller::TableOrigin::rollback
                   : kind == "correction" ? controller::TableOrigin::correction
                                          : controller::TableOrigin::upload;
    entry.version = record.value("sequence", 0);
    entry.words = record.value("new_words", std::vector<std::uint16_t>{});
    entry.crc = controller::crc_of_words(*entry.words);
    entries.push_back(std::move(entry));
  }
  return entries;
}

Result<UploadPreview> preview_upload(const commissioning::Job& job, Devices& devices,
                                     const std::optional<compensation::Table>& table, const TaskContext& context) {
  ZD_TRY(const auto identity, devices.machine->identify());
  ZD_CHECK(same_machine(job, "upload", identity.serial));
  auto made_for = controller::table_options(devices.profile);
  made_for.serial = identity.serial;
  UploadPreview preview;
  ZD_TRY(preview.model_outdated_by, outdated_by(job));
  if (table) {
    preview.table = *table;
  } else {
    ZD_TRY(const auto artefact, job.latest("model"));
    if (!artefact) return fail(ErrorCode::step_blocked, {{"step", "upload"}, {"needs", "model"}});
    ZD_TRY(auto model, model_of(*artefact));
    ZD_TRY(const Input warmup, need(job, "upload", "warmup"));
    ZD_TRY(preview.table, compensation::table_from_model(by_axes(std::move(model), warmup.body), made_for));
    ZD_TRY(const auto axes, job.latest("axis_table"));
    if (axes) {
      ZD_TRY(const json body, axes->document());
      ZD_TRY(const auto axis_table, compensation::table_from_json(body.at("table"), "the axis table"));
      ZD_CHECK(compensation::add_axis_table(preview.table, axis_table, made_for));
    }
  }
  controller::UploadOptions options;
  options.dry_run = true;
  preview.record = write_table(job, devices, preview.table, controller::TableOrigin::upload, options, context);
  if (!preview.record.result) return fail(preview.record.result.error());
  preview.note_largest();
  return preview;
}

Result<controller::SignCheckRecord> watch_signs(const commissioning::Job& job, Devices& devices,
                                                const MachineWrite& write, const TaskContext& context) {
  ZD_TRY(const auto source, open_error_source(job, devices));
  ZD_TRY(const auto stand, come_to_measuring_position(devices));
  commissioning::AuditEntry entry;
  entry.action = "test offset";
  entry.subject = "host offset of X, Y, Z, one after the other";
  entry.old_value = "0 um";
  entry.new_value = "10 um, then 0 um";
  controller::SignCheckRecord record;
  const Status done = write.write(entry, [&]() -> Status {
    ZD_CHECK(source->take_zero(stand, context));
    record = devices.by_hand != nullptr ? controller::check_signs(*devices.by_hand, *source, {}, context)
                                        : controller::check_signs(*devices.link, *source, {}, context);
    return record.result;
  });
  // What was seen is worth showing just when it is wrong; without it there is only the error.
  if (!done && record.axes.empty()) return fail(done.error());
  if (!done) record.result = done;
  return record;
}

Result<commissioning::NewArtefact> upload(commissioning::Job& job, Devices& devices, const UploadStepOptions& options,
                                          const TaskContext& context) {
  ZD_TRY(const Input machine, need(job, "upload", "machine"));
  ZD_TRY(const Input model, need(job, "upload", "model"));
  ZD_TRY(auto preview, preview_upload(job, devices, options.table, context));
  const std::string name = machine_text(preview.record.machine, preview.record.serial);
  ZD_TRY(const auto write,
         MachineWrite::begin(&job, devices.permit, options.consent, {"Writing the table", name, &preview}));
  const auto origin = options.table ? controller::TableOrigin::correction : controller::TableOrigin::upload;
  json signs;
  ZD_CHECK(sign_check(job, devices, write, options, context, signs));
  controller::UploadRecord record;
  controller::UploadOptions upload_options;
  upload_options.observer = options.observer;
  commissioning::AuditEntry entry;
  entry.action = options.table ? "correct table" : "upload table";
  entry.subject = "compensation table";
  entry.old_value =
      fmt::format("version {}, {} registers", preview.record.old_sequence, preview.record.old_words.size());
  compensation::Table written = preview.table;
  written.version = preview.record.sequence;
  entry.new_value = json_text(compensation::to_json(written));
  context.progress(0.4, "uploading");
  ZD_CHECK(write.write(entry, [&]() -> Status {
    record = write_table(job, devices, preview.table, origin, upload_options, context);
    return record.result;
  }));
  std::vector<commissioning::ArtefactId> inputs = {machine.id, model.id};
  ZD_TRY(const auto axes, job.latest("axis_table"));
  if (axes) inputs.push_back(axes->id);
  return commissioning::NewArtefact::of("upload", body_of(preview, record, origin, signs), inputs);
}

}  // namespace zerodrift::flow
