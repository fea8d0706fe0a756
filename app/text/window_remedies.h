#pragma once
// What to do about an error where a window is open: the tables of its import dialogs take the place of a header map.

#include "core/base/error.h"

namespace zerodrift {

/// A source text of the context "errors"; null where the remedy of the command line holds in the window as well.
const char* window_remedy(ErrorCode code);

}  // namespace zerodrift
