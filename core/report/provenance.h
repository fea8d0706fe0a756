#pragma once
// What a report was made from, as one number.

#include <string>

#include "core/base/hash.h"
#include "core/report/source.h"

namespace zerodrift::report {

/// SHA-256 over every artefact's content and the last write to the machine; earlier reports do not count, so that a
/// report says the same number each time it is written.
std::string job_hash(const Source& source);

}  // namespace zerodrift::report
