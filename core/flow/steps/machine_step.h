#pragma once
// Step "machine": connects, looks at the sensors and the state, and keeps profile, identity and health. Makes the
// artefact "machine":
//   {"profile": {...}, "identity": {name, serial, map_version, accepts_table, accepts_host_offset, has_probes},
//    "health": [{channel, label, place, value_C, noise_K, state}], "sensors_alive", "spread_K", "round_trip_ms",
//    "clock_difference_s", "compensation_on", "problems": [...]}

#include <nlohmann/json_fwd.hpp>

#include "core/acquisition/health.h"
#include "core/base/task_context.h"
#include "core/commissioning/job.h"
#include "core/flow/devices.h"

namespace zerodrift::flow {

/// `profile` is the document the devices were opened from; it is kept whole, so that the job can be gone on with alone.
Result<commissioning::NewArtefact> check_machine(Devices& devices, const nlohmann::json& profile,
                                                 const TaskContext& context,
                                                 acquisition::MachineHealth* health = nullptr);

}  // namespace zerodrift::flow
