#pragma once
// Leave one recording out: each further recording is predicted from all others, which neither explanation has seen.

#include "core/diagnosis/answer/posterior_summary.h"

namespace zerodrift::diagnosis::answer {

std::vector<HeldOut> held_out(const PosteriorSummary& summary);

}  // namespace zerodrift::diagnosis::answer
