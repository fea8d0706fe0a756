#pragma once
// The diagnosis as one self-contained page: sentences, figures before and after, each channel drawn, missing heat as a
// map.

#include <string>

#include "core/diagnosis/diagnosis.h"

namespace zerodrift::reporting {

std::string proof_html(const physics::Machine& machine, const diagnosis::Diagnosis& diagnosis);

}  // namespace zerodrift::reporting
