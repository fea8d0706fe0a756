#pragma once
// A diagnosis from files alone, as `zerodrift-cli diagnose` makes it.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/task_context.h"

namespace zerodrift::proof {

/// machine.json and the recordings of a folder (explained together); the answer is written
/// beside them.
Result<nlohmann::json> diagnose_files(const std::filesystem::path& folder, const std::vector<std::string>& recordings,
                                      const std::string& out, const TaskContext& context);

}  // namespace zerodrift::proof
