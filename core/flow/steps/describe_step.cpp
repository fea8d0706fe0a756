#include "core/flow/steps/describe_step.h"

#include <algorithm>

#include "core/flow/steps/inputs.h"
#include "core/physics/machine.h"

namespace zerodrift::flow {

using nlohmann::json;
using recording::ChannelKind;

namespace {

/// What may heat: the spindle with each term of its law, a logged input with one size of its own.
json sources_of(const recording::Recording& run, const std::string& lump) {
  json sources = json::array();
  for (const auto& channel : run.channels) {
    if (channel.kind() == ChannelKind::speed) {
      sources.push_back({{"id", "speed_" + lump},
                         {"kind", "speed"},
                         {"channel", channel.name},
                         {"law", {"on", "n", "n2"}},
                         {"power_unknown", true}});
    } else if (channel.kind() == ChannelKind::input || channel.kind() == ChannelKind::load) {
      sources.push_back({{"id", channel.name + "_" + lump},
                         {"kind", "input"},
                         {"channel", channel.name},
                         {"watts_per_unit", 1.0},
                         {"power_unknown", true}});
    }
  }
  return sources;
}

}  // namespace

Result<std::optional<Description>> description_of(const commissioning::Job& job) {
  ZD_TRY(const auto own, job.latest("description"));
  if (own) {
    ZD_TRY(const json body, own->document());
    return Description{body.at("machine"), body.value("file", "machine.json"), {own->id}};
  }
  ZD_TRY(const auto machine, job.latest("machine"));
  if (!machine) return std::nullopt;
  ZD_TRY(const auto profile, profile_of(job, "physics"));
  if (profile.machine == nullptr) return std::nullopt;
  return Description{*profile.machine, profile.machine_file, {machine->id}};
}

Result<commissioning::NewArtefact> take_description(const commissioning::Job& job, const json& machine,
                                                    const std::string& file) {
  ZD_TRY(const auto read, physics::machine_from_json(machine, file));
  ZD_TRY(const Input warmup, need(job, "physics", "warmup"));
  ZD_TRY(const auto run, run_of(job, warmup));
  std::string wanted;
  bool some = false;
  for (const auto& sensor : read.sensors) {
    some = some || run.find(sensor.channel) != nullptr;
    wanted += (wanted.empty() ? "" : ", ") + sensor.channel;
  }
  if (!some) {
    std::string there;
    for (const auto& channel : run.channels) {
      if (channel.kind() == ChannelKind::temperature) there += (there.empty() ? "" : ", ") + channel.name;
    }
    return fail(ErrorCode::data_does_not_fit,
                {{"what", file}, {"found", "sensors " + wanted}, {"expected", "sensors of the recording: " + there}});
  }
  return commissioning::NewArtefact::of("description", {{"file", file}, {"machine", machine}});
}

json lump_for_each_sensor(const recording::Recording& run, const std::string& name) {
  json machine = {{"format", "zerodrift-machine/1"}, {"name", name},
                  {"components", json::array()},     {"effects", json::array()},
                  {"tolerances", json::object()},    {"sensors", json::array()},
                  {"displacements", json::array()}};
  for (const auto& channel : run.channels) {
    if (channel.kind() == ChannelKind::ambient) {
      machine["sensors"].push_back({{"channel", channel.name}, {"component", "ambient"}});
    } else if (channel.kind() == ChannelKind::temperature) {
      const std::string lump = channel.name.substr(0, channel.name.rfind('_'));
      machine["components"].push_back({{"id", lump}, {"kind", "lump"}, {"heat_sources", sources_of(run, lump)}});
      machine["sensors"].push_back({{"channel", channel.name}, {"component", lump}});
    } else if (channel.kind() == ChannelKind::error) {
      machine["displacements"].push_back({{"channel", channel.name}, {"direction", "unknown"}, {"component", nullptr}});
    }
  }
  return machine;
}

}  // namespace zerodrift::flow
