#include "core/flow/live_compensation.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "core/analysis/model.h"
#include "core/compensation/model_table.h"
#include "core/controller/table_words.h"
#include "core/flow/devices.h"
#include "core/flow/live_measuring.h"
#include "core/flow/machine_write.h"
#include "core/flow/steps/fit_step.h"
#include "core/flow/steps/inputs.h"

namespace zerodrift::flow {

using nlohmann::json;

namespace {

/// With the zero of the warm-up run in force; the devices must outlive it.
Result<std::unique_ptr<acquisition::ErrorSource>> source_of(const commissioning::Job& job,
                                                            const controller::Profile& profile, Devices& devices) {
  ZD_TRY(const Input warmup, need(job, "compensator", "warmup"));
  ZD_TRY(devices, Devices::open(profile));
  ZD_TRY(auto source, open_error_source(job, devices));
  const auto zero = warmup.body.find("zero_um");
  if (zero == warmup.body.end() || !zero->is_array() || !source->restore_zero_um(zero->get<std::array<double, 3>>())) {
    return fail(ErrorCode::machine_not_ready,
                {{"what", source->name()}, {"reason", "the zero of the warm-up run cannot be restored"}});
  }
  return source;
}

Result<analysis::Model> running_model(const commissioning::Job& job) {
  ZD_TRY(const auto artefact, job.latest("model"));
  if (!artefact) return fail(ErrorCode::step_blocked, {{"step", "compensator"}, {"needs", "model"}});
  ZD_TRY(auto model, flow::model_of(*artefact));
  ZD_TRY(const Input warmup, need(job, "compensator", "warmup"));
  model = by_axes(std::move(model), warmup.body);
  if (model.method != analysis::Method::physics) return model;
  return fail(ErrorCode::bad_argument, {{"what", "the job's model"},
                                        {"found", "a physics model, which predicts recordings"},
                                        {"expected", "one that runs sample by sample"}});
}

}  // namespace

Result<controller::CompensatorSummary> compensate_live(commissioning::Job& job, const controller::Profile& profile,
                                                       const LiveOptions& options, const TaskContext& context,
                                                       const std::function<void(const LiveTurn&)>& observer) {
  ZD_TRY(const auto model, running_model(job));
  ZD_TRY(const auto table, compensation::table_from_model(model, controller::table_options(profile)));
  ZD_TRY(const auto machine, controller::ModbusMachine::open(profile, options.permit));
  ZD_TRY(const auto identity, machine->identify());
  ZD_CHECK(same_machine(job, "compensator", identity.serial));
  Devices cameras;  // of their own: a camera needs longer than a turn of the compensator
  LiveMeasuringOptions measuring_options;
  measuring_options.position_mm = profile.measure_position_mm;
  measuring_options.there_mm = options.there_mm;
  measuring_options.every_s = options.measure_every_s;
  measuring_options.drift.um_per_min = profile.max_drift_um_per_min;
  LiveMeasuring measuring(source_of(job, profile, cameras), measuring_options);
  controller::HostCompensatorOptions how;
  how.period_s = options.period_s;
  how.switch_on = true;
  if (!model.is_static()) how.predictor = compensation::live_predictor(model);

  // It ends with the operation: whoever starts it has given the word for it.
  ZD_TRY(const auto write, MachineWrite::begin(&job, options.permit, Consent::given(),
                                               {"Compensating", machine_text(identity.name, identity.serial)}));
  commissioning::AuditEntry entry;
  entry.action = "compensate from this computer";
  entry.subject = "host offset of X, Y, Z";
  ZD_TRY(const bool was_on, machine->compensation_on());
  entry.old_value = was_on ? "0 um, switch on" : "0 um, switch off";
  entry.new_value = fmt::format("what the model says, at most {:.0f} um, every {} s", profile.max_um, options.period_s);
  controller::CompensatorSummary summary;
  const auto work = [&]() -> Status {
    auto ran = controller::run_host_compensator(*machine, table, how, context, [&](const auto& turn) {
      LiveMeasuring::Now now = measuring.exchange(turn);
      observer({turn, std::move(now.left), std::move(now.not_measured)});
    });
    if (!ran) return fail(ran.error());
    summary = *ran;
    return {};
  };
  ZD_CHECK(write.write(entry, work));
  return summary;
}

}  // namespace zerodrift::flow
