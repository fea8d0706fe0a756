#include "core/flow/commission.h"

#include <nlohmann/json.hpp>

#include "core/flow/devices.h"
#include "core/flow/steps/calibrate_step.h"
#include "core/flow/steps/diagnose_step.h"
#include "core/flow/steps/fit_step.h"
#include "core/flow/steps/inputs.h"
#include "core/flow/steps/machine_step.h"
#include "core/flow/steps/sensors_step.h"
#include "core/flow/steps/verify_step.h"
#include "core/flow/steps/warmup_step.h"

namespace zerodrift::flow {

using commissioning::Job;
using commissioning::NewArtefact;
using nlohmann::json;

namespace {

constexpr int most_corrections = 2;  // each costs a verification run; what two do not take out is no matter of scale

/// Names the job after the machine it was made on, unless a person did.
Status name_job(Job& job, const json& machine) {
  ZD_TRY(auto header, job.header());
  if (header.machine.empty()) header.machine = machine.at("identity").at("name").get<std::string>();
  if (header.serial.empty()) header.serial = std::to_string(machine.at("identity").at("serial").get<long long>());
  return job.set_header(header);
}

class Commissioning {
 public:
  Commissioning(Job& job, Devices& devices, const CommissionOptions& options, const TaskContext& context)
      : m_job(job), m_devices(devices), m_options(options), m_context(context) {}

  /// Runs a step and keeps what it made.
  Status step(const std::string& id, double share, const std::function<Result<NewArtefact>(const TaskContext&)>& run) {
    if (m_context.cancelled()) return fail(ErrorCode::cancelled);
    if (m_options.step_started) m_options.step_started(id);
    TaskContext inner = m_context;
    const double from = m_done;
    inner.report = [this, id, from, share](const Progress& progress) {
      m_context.progress(from + share * progress.fraction, id + (progress.phase.empty() ? "" : ": " + progress.phase),
                         progress.seconds_left);
    };
    ZD_TRY(const auto made, run(inner));
    ZD_CHECK(m_job.put(made).map([](auto) {}));
    m_done += share;
    return {};
  }

  Status measure(const json& profile_document) {
    ZD_CHECK(step("machine", 0.02, [&](const auto& c) { return check_machine(m_devices, profile_document, c); }));
    ZD_TRY(const Input machine, need(m_job, "machine", "machine"));
    ZD_CHECK(name_job(m_job, machine.body));
    // A table that is active already would falsify what is measured.
    ZD_CHECK(m_devices.machine->switch_compensation(false));
    CalibrateOptions calibrate_options;
    calibrate_options.keep_views = m_options.keep_views;
    ZD_CHECK(step("calibrate", 0.08, [&](const auto& c) { return calibrate(m_job, m_devices, calibrate_options, c); }));
    return record();
  }

  Status record() {
    return step("warm-up", 0.4, [&](const auto& c) {
      RunOptions run;
      run.plan = m_options.plan;
      run.refuse_too_few = true;
      return record_warmup(m_job, m_devices, run, c);
    });
  }

  Status analyse() {
    ZD_CHECK(step("sensors", 0.02, [&](const auto& c) { return choose_sensors(m_job, {}, c); }));
    ZD_CHECK(step("fit", 0.03, [&](const auto& c) { return fit_model(m_job, {}, c); }));
    return step("physics", 0.03, [&](const auto& c) { return find_missing(m_job, c); });
  }

  Status compensate(const std::optional<compensation::Table>& table) {
    ZD_CHECK(step("upload", 0.02, [&](const auto& c) {
      UploadStepOptions upload_options;
      upload_options.confirm = m_options.confirm;
      upload_options.table = table;
      upload_options.sign_check = !table;  // checked with the first table
      return upload(m_job, m_devices, upload_options, c);
    }));
    return step("verify", table ? 0.0 : 0.4, [&](const auto& c) {
      VerifyOptions verify_options;
      verify_options.limit_um = m_options.limit_um;
      return verify(m_job, m_devices, verify_options, c);
    });
  }

  /// Corrects by the measured residual and verifies again while a part error exceeds its threshold (C2).
  Status correct() {
    for (int round = 0; round < most_corrections; ++round) {
      ZD_TRY(const auto artefact, m_job.latest("verification"));
      ZD_TRY(const auto table, corrected_table(*artefact));
      if (!table) return {};
      ZD_CHECK(compensate(table));
    }
    return {};
  }

 private:
  Job& m_job;
  Devices& m_devices;
  const CommissionOptions& m_options;
  const TaskContext& m_context;
  double m_done = 0.0;
};

/// A run that was broken off is gone on with: machine and calibration are those it was begun with.
Result<bool> has_open_run(const Job& job) {
  ZD_TRY(const auto series, job.series());
  ZD_TRY(const auto calibration, job.latest("calibration"));
  if (!calibration || series.empty()) return false;
  return series.back().state == commissioning::SeriesState::open && series.back().name == "warm-up";
}

}  // namespace

Result<CommissionResult> commission(Job& job, const controller::Profile& profile, const json& profile_document,
                                    const CommissionOptions& options, const TaskContext& context) {
  ZD_CHECK(acquisition::with_measuring_position(options.plan, profile.measure_position_mm).map([](const auto&) {}));
  ZD_TRY(Devices devices, Devices::open(profile, true, options.permit));
  Commissioning work(job, devices, options, context);
  ZD_TRY(const bool resuming, has_open_run(job));
  ZD_TRY(const auto recorded, job.latest("warmup"));
  if (resuming) {
    ZD_CHECK(work.record());
  } else if (!recorded) {
    ZD_CHECK(work.measure(profile_document));
  }
  ZD_CHECK(work.analyse());
  ZD_CHECK(work.compensate(std::nullopt));
  ZD_CHECK(work.correct());
  CommissionResult result;
  ZD_TRY(const Input verification, need(job, "report", "verification"));
  ZD_TRY(const Input uploaded, need(job, "report", "upload"));
  ZD_TRY(const Input sensors, need(job, "report", "sensors"));
  result.verification = verification.body;
  result.upload = uploaded.body;
  result.sensors = sensors.body;
  return result;
}

}  // namespace zerodrift::flow
