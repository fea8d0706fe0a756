#pragma once
// A case for a blind trial of the diagnosis, without any server: run.csv, second.csv (the same machine, another plan),
// machine.json (what its maker would state, without the hidden effect), commitment.json and answer.json.
// The displacements are those of a nest of probes on the headstock: the spindle against its seat.

#include <filesystem>

#include "app/machine/hidden_effect.h"
#include "core/base/result.h"
#include "core/recording/recording.h"

namespace zerodrift::machine {

/// One recording; second takes another plan and another day.
recording::Recording record_case(const HiddenEffect& hidden, std::uint64_t seed, bool second);
Status write_case(const std::filesystem::path& folder, const HiddenEffect& hidden, std::uint64_t seed);

}  // namespace zerodrift::machine
