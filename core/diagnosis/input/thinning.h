#pragma once
// Long recordings have far more samples than a thermal answer needs: neighbouring samples are averaged until about
// `most_rows` are left. Inputs are not averaged across a change, so that what heats keeps its edges.

#include "core/recording/recording.h"

namespace zerodrift::diagnosis {

/// The recording itself if it is short enough.
recording::Recording thinned(const recording::Recording& recording, std::size_t most_rows);

}  // namespace zerodrift::diagnosis
