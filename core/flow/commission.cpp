#include "core/flow/commission.h"

#include <nlohmann/json.hpp>
#include <utility>

#include "core/acquisition/job_sink.h"
#include "core/controller/active_table.h"
#include "core/flow/devices.h"
#include "core/flow/flow.h"
#include "core/flow/machine_table.h"
#include "core/flow/rollback_and_switch.h"
#include "core/flow/steps/calibrate_step.h"
#include "core/flow/steps/diagnose_step.h"
#include "core/flow/steps/fit_step.h"
#include "core/flow/steps/inputs.h"
#include "core/flow/steps/machine_step.h"
#include "core/flow/steps/sensors_step.h"
#include "core/flow/steps/upload_step.h"
#include "core/flow/steps/verify_step.h"
#include "core/flow/steps/warmup_step.h"

namespace zerodrift::flow {

using commissioning::Job;
using nlohmann::json;

namespace {

constexpr int most_corrections = 2;  // each costs a verification run; what two do not take out is no matter of scale

/// Names the job after the machine it was made on, unless a person did.
Status name_job(Job& job) {
  ZD_TRY(const Input machine, need(job, "machine", "machine"));
  ZD_TRY(auto header, job.header());
  const json& identity = machine.body.at("identity");
  if (header.machine.empty()) header.machine = identity.at("name").get<std::string>();
  if (header.serial.empty()) header.serial = std::to_string(identity.at("serial").get<long long>());
  return job.set_header(header);
}

class Commissioning {
 public:
  Commissioning(Job& job, Devices& devices, const CommissionOptions& options, const TaskContext& context)
      : m_job(job), m_devices(devices), m_options(options), m_context(context) {}

  Status measure(const json& profile_document) {
    // A run that was broken off is gone on with: machine and calibration are those it was begun with.
    ZD_TRY(const auto interrupted, acquisition::interrupted_run(m_job, "warm-up"));
    if (!interrupted) {
      if (current("warmup")) return {};
      ZD_CHECK(unless_current("machine", 0.02,
                              [&](Job&, const auto& c) { return check_machine(m_devices, profile_document, c); }));
      ZD_CHECK(name_job(m_job));
    }
    // A table that is active already would falsify what is measured.
    ZD_TRY(m_switched_off, m_devices.machine->compensation_on());
    ZD_CHECK(switched(false));
    if (!interrupted) {
      CalibrateOptions calibrate_options;
      calibrate_options.keep_views = m_options.keep_views;
      ZD_CHECK(unless_current(
          "calibrate", 0.08, [&](Job& job, const auto& c) { return calibrate(job, m_devices, calibrate_options, c); }));
    }
    return step("warmup", 0.4, [&](Job& job, const auto& c) {
      RunOptions run;
      run.plan = m_options.plan;
      run.refuse_too_few = true;
      return record_warmup(job, m_devices, run, c);
    });
  }

  Status analyse() {
    ZD_CHECK(unless_current("sensors", 0.02, [](Job& job, const auto& c) -> Result<commissioning::NewArtefact> {
      ZD_TRY(const auto as_before, sensors_asked_for(job));
      return choose_sensors(job, as_before, c);
    }));
    ZD_CHECK(unless_current("fit", 0.03, [](Job& job, const auto& c) -> Result<commissioning::NewArtefact> {
      ZD_TRY(const auto as_before, fit_asked_for(job));
      return fit_model(job, as_before, c);
    }));
    return unless_current("physics", 0.03, [](Job& job, const auto& c) { return find_missing(job, c); });
  }

  Status compensate() {
    if (current("verify")) return {};
    ZD_TRY(const bool held, upload_is_held());
    if (held) {
      ZD_CHECK(switched(true));
    } else {
      ZD_CHECK(write(std::nullopt));
    }
    return prove(0.4);
  }

  /// Corrects by the measured residual and verifies again (C2).
  Status correct() {
    for (int round = 0; round < most_corrections; ++round) {
      ZD_TRY(const auto artefact, m_job.latest("verification"));
      ZD_TRY(const Input uploaded, need(m_job, "verify", "upload"));
      ZD_TRY(const json verification, artefact->document());
      ZD_TRY(const auto table, corrected_table(*artefact));
      if (!table || !correction_due(verification, uploaded.body)) return {};
      ZD_CHECK(write(table));
      ZD_CHECK(prove(0.0));
    }
    return {};
  }

  /// Ended before anything was written: the switch as it was found.
  Status leave(const Error& error) {
    // Whoever let it be switched off wants it back.
    if (m_switched_off && !switch_compensation(&m_job, m_devices, Consent::given(), true)) {
      return fail(ErrorCode::compensation_ended, {{"reason", describe(error)}, {"switch", "off"}});
    }
    return fail(error);
  }

 private:
  bool current(const std::string& id) const { return status_of(m_job, id).state == StepState::current; }

  Status unless_current(const std::string& id, double share, const StepRun& run) {
    return current(id) ? Status() : step(id, share, run);
  }

  Status step(const std::string& id, double share, const StepRun& run) {
    if (m_context.cancelled()) return fail(ErrorCode::cancelled);
    TaskContext inner = m_context;
    const double from = m_done;
    inner.report = [this, id, from, share](const Progress& progress) {
      m_context.progress(from + share * progress.fraction, id + (progress.phase.empty() ? "" : ": " + progress.phase),
                         progress.seconds_left);
    };
    ZD_CHECK(m_flow.perform(m_job, id, run, inner).map([](const auto&) {}));
    m_done += share;
    return {};
  }

  Status switched(bool on) {
    return switch_compensation(&m_job, m_devices, m_options.consent, on).map([](bool) {});
  }

  /// The machine still has the table that this job wrote last, and it is one of today's model.
  Result<bool> upload_is_held() {
    if (!current("upload")) return false;
    ZD_TRY(const Input upload, need(m_job, "upload", "upload"));
    if (upload.body.value("kind", "") == controller::name_of(controller::TableOrigin::rollback)) return false;
    const auto words = upload.body.at("record").value("new_words", std::vector<std::uint16_t>{});
    if (controller::is_empty_table(words.size())) return false;
    const Status active = table_is_active(m_devices, upload.body);
    if (!active && active.error().code != ErrorCode::table_not_active) return fail(active.error());
    return active.has_value();
  }

  Status write(const std::optional<compensation::Table>& table) {
    const bool switched_off = std::exchange(m_switched_off, false);
    const Status done = step("upload", table ? 0.0 : 0.02, [&](Job& job, const auto& c) {
      UploadStepOptions upload_options;
      upload_options.consent = m_options.consent;
      upload_options.table = table;
      upload_options.sign_check = !table;  // checked with the first table
      return upload(job, m_devices, upload_options, c);
    });
    m_switched_off = switched_off && !done && done.error().code == ErrorCode::not_confirmed;
    return done;
  }

  Status prove(double share) {
    return step("verify", share, [&](Job& job, const auto& c) {
      VerifyOptions verify_options;
      verify_options.limit_um = m_options.limit_um;
      return verify(job, m_devices, verify_options, c);
    });
  }

  Job& m_job;
  Devices& m_devices;
  const CommissionOptions& m_options;
  const TaskContext& m_context;
  const Flow m_flow;
  double m_done = 0.0;
  bool m_switched_off = false;  // by us, and no table was written since
};

}  // namespace

bool correction_due(const json& verification, const json& upload) {
  const bool corrected = upload.value("kind", "") == controller::name_of(controller::TableOrigin::correction);
  return !corrected || verification.value("verdict", "") != "passed";
}

Result<CommissionResult> commission(Job& job, const controller::Profile& profile, const json& profile_document,
                                    const CommissionOptions& options, const TaskContext& context) {
  // Not after hours of measuring.
  ZD_CHECK(options.permit.check("A commissioning"));
  ZD_CHECK(options.consent.possible("A commissioning"));
  ZD_CHECK(acquisition::with_measuring_position(options.plan, profile.measure_position_mm).map([](const auto&) {}));
  ZD_TRY(Devices devices, Devices::open(profile, true, options.permit, options.person));
  Commissioning work(job, devices, options, context);
  const auto all = [&]() -> Status {
    ZD_CHECK(work.measure(profile_document));
    ZD_CHECK(work.analyse());
    ZD_CHECK(work.compensate());
    return work.correct();
  };
  if (const Status done = all(); !done) return fail(work.leave(done.error()).error());
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
