#include "core/flow/steps/inputs.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/json.h"
#include "core/recording/import/importer.h"

namespace zerodrift::flow {

Result<Input> need(const commissioning::Job& job, const std::string& step, const std::string& kind) {
  ZD_TRY(const auto artefact, job.latest(kind));
  if (!artefact) return fail(ErrorCode::step_blocked, {{"step", step}, {"needs", kind}});
  ZD_TRY(auto body, artefact->document());
  return Input{artefact->id, std::move(body)};
}

Result<recording::Recording> run_of(const commissioning::Job& job, const Input& input) {
  return job.read_series(input.body.at("series").get<commissioning::SeriesId>());
}

Result<controller::Profile> profile_of(const commissioning::Job& job, const std::string& step) {
  ZD_TRY(const Input machine, need(job, step, "machine"));
  return controller::profile_from_job(machine.body.at("profile"));
}

Status same_machine(const commissioning::Job& job, const std::string& step, std::uint32_t connected_serial) {
  ZD_TRY(const Input machine, need(job, step, "machine"));
  std::vector<std::uint32_t> known;
  const auto identity = machine.body.value("identity", nlohmann::json::object());
  known.push_back(identity.value("serial", 0U));
  ZD_TRY(const auto warmup, job.latest("warmup"));
  if (warmup) {
    ZD_TRY(const auto body, warmup->document());
    ZD_TRY(const auto all, job.series());
    for (const auto& series : all) {
      if (series.id != body.value("series", commissioning::SeriesId{0})) continue;
      ZD_TRY(const auto details, parse_json(series.details.empty() ? "{}" : series.details, "the warm-up run"));
      known.push_back(details.value("machine_serial", 0U));  // 0: imported from a file
    }
  }
  for (const std::uint32_t serial : known) {
    if (serial == 0 || serial == connected_serial) continue;
    return fail(ErrorCode::data_does_not_fit, {{"what", "the machine of this job"},
                                               {"found", fmt::format("serial {} connected", connected_serial)},
                                               {"expected", fmt::format("serial {}", serial)}});
  }
  return {};
}

std::map<std::string, std::string> assigned_axes(const nlohmann::json& warmup) {
  return recording::assigned_in(warmup.value("import", nlohmann::json())).axes;
}

std::string error_by_axis(const std::string& channel, const std::map<std::string, std::string>& axes) {
  const auto at = axes.find(channel);
  return at == axes.end() ? channel : "d" + at->second + "_um";
}

std::map<std::string, ErrorSize> error_sizes(const recording::Recording& run,
                                             const std::map<std::string, std::string>& axes) {
  std::map<std::string, ErrorSize> sizes;
  for (const auto& channel : run.channels) {
    if (channel.kind() != recording::ChannelKind::error) continue;
    const std::string name = error_by_axis(channel.name, axes);
    if (name.size() < 2 || name[0] != 'd') continue;
    ErrorSize size;
    double squares = 0.0;
    double count = 0.0;
    for (std::size_t r = 0; r < run.rows(); ++r) {
      const double value = channel.values[r];
      if (std::isnan(value)) continue;
      squares += value * value;
      count += 1.0;
      if (std::abs(value) <= size.peak_um && size.row >= 0) continue;
      size.peak_um = std::abs(value);
      size.row = static_cast<long long>(r);
    }
    if (count == 0.0) continue;
    size.rms_um = std::sqrt(squares / count);
    sizes[name.substr(1, name.find('_') - 1)] = size;
  }
  return sizes;
}

}  // namespace zerodrift::flow
