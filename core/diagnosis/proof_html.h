#pragma once
// The diagnosis as one self-contained page: sentences, figures before and after, each channel drawn, missing heat as a
// map.

#include <string>

#include "core/diagnosis/diagnosis.h"

namespace zerodrift::diagnosis {

std::string proof_html(const physics::Machine& machine, const Diagnosis& diagnosis);

}  // namespace zerodrift::diagnosis
