#pragma once
// Two loggers have two clocks: what drives the machine is then recorded some minutes before or after it acts, and every
// temperature looks as if something were missing.

#include "core/diagnosis/diagnosis.h"

namespace zerodrift::diagnosis {

/// The columns that drive the machine at the times when they acted; after the last row they are as in it.
recording::Recording with_inputs_moved(const recording::Recording& recording, const ClockOffset& offset);

/// `answer`, with no clock, where it asks for none or the recordings with their inputs moved are `unexplained`; else
/// the answer to those, and `recordings` are those.
Result<Diagnosis> with_one_clock(Diagnosis answer, const physics::Machine& machine,
                                 std::vector<recording::Recording>& recordings, const DiagnoseOptions& options,
                                 const TaskContext& context);

/// That they were moved, and what it leaves in doubt.
void tell_clock(Diagnosis& answer, const ClockOffset& found);

}  // namespace zerodrift::diagnosis
