#pragma once
// Everything of a job that was refused, went wrong or is outside its limit, one sentence each with the page it comes
// from. The same limits as on the pages.

#include <vector>

#include "core/report/report.h"
#include "core/report/source.h"

namespace zerodrift::report {

struct Doubt {
  Verdict verdict = Verdict::doubtful;  // doubtful or bad
  std::string text;
  Trace trace;
};

/// In the order of the job; the bad ones first.
std::vector<Doubt> doubts_of(const Source& source);

}  // namespace zerodrift::report
