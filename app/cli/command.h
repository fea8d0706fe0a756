#pragma once
// How a command of zerodrift-cli is written: one file commands/<command>.cpp with one function add_<command>(Cli&) that
// declares its options and says what runs. Commands return a value or an Error; printing and exit codes are main's.

#include <CLI/CLI.hpp>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "core/base/result.h"
#include "core/base/task_context.h"
#include "core/recording/recording.h"

namespace zerodrift::cli {

struct CommandOutput {
  nlohmann::json json = nlohmann::json::object();  // printed with --json
  std::string text;                                // printed otherwise; ends without newline
  std::vector<std::string> warnings;               // one line each on stderr
};

using Command = std::function<Result<CommandOutput>(const TaskContext&)>;
/// The same for a command whose warnings are told when it fails, too.
using FillingCommand = std::function<Status(const TaskContext&, CommandOutput&)>;

class Cli {
 public:
  explicit Cli(CLI::App& app) : m_app(app) {}

  /// Declares a subcommand with --json; `run` is called when it was chosen. Options are added to the returned App and
  /// may be bound to a struct kept alive by the command (std::make_shared<Options>() captured by `run`).
  CLI::App* add(const std::string& name, const std::string& description, Command run);
  CLI::App* add(const std::string& name, const std::string& description, FillingCommand run);
  CLI::App& app() { return m_app; }

  bool json_output = false;
  Command chosen;
  std::string chosen_name;
  std::vector<std::string> warnings_of_failed;  // what was gathered before the error

 private:
  CLI::App& m_app;
};

/// "1,2,3" -> numbers; exactly `count` unless 0. An empty text is an empty list.
Result<std::vector<double>> numbers_from(const std::string& text, const std::string& option, std::size_t count = 0);
/// "a,b,c" -> names without blanks.
std::vector<std::string> names_from(const std::string& text);
/// For options that names_from reads: a list in which a name is missing is wrong usage.
CLI::Validator names_with_commas();

/// The recording as checked() leaves it; what was wrong goes into the warnings.
recording::Recording sound(const recording::Recording& recording, const std::set<std::string>& may_stand_still,
                           std::vector<std::string>& warnings);

// One line a command; each is defined in commands/<command>.cpp.
void add_all_commands(Cli& cli);

}  // namespace zerodrift::cli
