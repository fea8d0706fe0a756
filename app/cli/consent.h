#pragma once
// A person's consent to a write, on the command line: --yes, or a question on a terminal. Elsewhere nobody gives it.

#include <string>

#include "core/controller/upload.h"
#include "core/flow/machine_write.h"

namespace zerodrift::cli {

flow::Consent consent_of(bool yes);

/// The difference that a table makes, and the state that was reached.
std::string text_of(const controller::UploadRecord& record);

}  // namespace zerodrift::cli
