#pragma once
// A run that does not excite an effect cannot show it: at one speed the heat of cutting is a stronger bearing. Where
// the fitted description misses another recording of the same machine, that one is fitted instead and the first is held
// out. Its answer counts if it is borne out there; a recording of another machine is not.

#include "core/diagnosis/diagnosis.h"

namespace zerodrift::diagnosis {

/// How far the held-out recordings are missed: largest rms over the channels, in units of the noise or of what the fit
/// itself leaves there, whichever is larger; 0 without any.
double missed_by(const Diagnosis& diagnosis);

/// The answer to keep: `first`, which fitted recordings.front(), or that of the recording it misses most.
Result<Diagnosis> settled(Diagnosis first, const physics::Machine& machine,
                          const std::vector<recording::Recording>& recordings, const DiagnoseOptions& options,
                          const TaskContext& context);

}  // namespace zerodrift::diagnosis
