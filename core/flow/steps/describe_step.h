#pragma once
// The description of the machine that the job is simulated with (contract: machine.json): taken from a file or begun
// with a lump for each sensor. Makes the artefact "description": {"file", "machine": {...}}. Without one the profile's
// serves.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "core/commissioning/job.h"
#include "core/recording/recording.h"

namespace zerodrift::flow {

struct Description {
  nlohmann::json machine;
  std::string file;                                // for messages
  std::vector<commissioning::ArtefactId> sources;  // what it stands in
};

/// Nothing when neither the job nor its profile describes the machine.
Result<std::optional<Description>> description_of(const commissioning::Job& job);

/// The errors of machine_from_json; data_does_not_fit when the run has none of the description's channels.
Result<commissioning::NewArtefact> take_description(const commissioning::Job& job, const nlohmann::json& machine,
                                                    const std::string& file);

/// A start when there is no drawing: a lump for each temperature, heated by what is logged, sizes unknown.
nlohmann::json lump_for_each_sensor(const recording::Recording& run, const std::string& name);

}  // namespace zerodrift::flow
