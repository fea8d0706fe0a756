#pragma once
// The person at a manual control, on the command line: a dialogue on a terminal, or, with --operator -, a line of JSON
// for each request on stdout and an answer on stdin (docs/reference/operator.md).

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "core/controller/operator.h"
#include "core/controller/profile.h"

namespace zerodrift::cli {

/// Adds --operator to a command.
void add_operator_option(CLI::App& command, std::string& option);

/// Null for a control with a link. With "-" lines of JSON, else a dialogue where there is a terminal; operator_missing
/// without either, bad_argument for another word.
Result<std::shared_ptr<controller::Operator>> operator_of(const controller::Profile& profile,
                                                          const std::string& option);

}  // namespace zerodrift::cli
