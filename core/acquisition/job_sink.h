#pragma once
// A run recorded into the job: one series with its events.

#include <optional>

#include "core/acquisition/run_sink.h"
#include "core/commissioning/job.h"

namespace zerodrift::acquisition {

class JobSink : public RunSink {
 public:
  /// Begins a new series.
  explicit JobSink(commissioning::Job& job) : m_job(job) {}
  /// Goes on with an open one.
  JobSink(commissioning::Job& job, commissioning::SeriesId series) : m_job(job), m_series(series) {}

  Status begin(const RunStart& start) override;
  Status append(double time_s, std::span<const double> values) override;
  Status event(const RunEvent& event) override;
  Status flush() override;
  Status end(RunEnd end) override;
  commissioning::SeriesId series() const { return m_series; }

 private:
  commissioning::Job& m_job;
  commissioning::SeriesId m_series = 0;
};

struct InterruptedSeries {
  commissioning::SeriesId series = 0;
  InterruptedRun run;
};

/// The last run of this name that was broken off, from what is on the disk; nothing when the last one was ended.
Result<std::optional<InterruptedSeries>> interrupted_run(const commissioning::Job& job, const std::string& name);
/// Any name.
Result<std::optional<InterruptedSeries>> interrupted_run(const commissioning::Job& job);

/// The plan a series was recorded by.
Result<Plan> plan_of(const commissioning::SeriesInfo& series);

}  // namespace zerodrift::acquisition
