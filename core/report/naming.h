#pragma once
// What core/report/wording.h says in English, for a text in another language.

#include <functional>
#include <string>

#include "core/report/wording.h"

namespace zerodrift::report {

/// Units and channels as people read them; `name` says a channel in the reader's language, in English when it is null.
std::string readable(const std::string& original, const Labels& labels,
                     const std::function<std::string(const std::string&)>& name);

}  // namespace zerodrift::report
