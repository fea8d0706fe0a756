#include "app/cli/command.h"

#include <charconv>

namespace zerodrift::cli {
namespace {

std::vector<std::string> split(const std::string& text) {
  std::vector<std::string> parts;
  std::string part;
  for (const char c : text + ",") {
    if (c == ',') {
      if (!part.empty()) parts.push_back(part);
      part.clear();
    } else if (c != ' ') {
      part += c;
    }
  }
  return parts;
}

}  // namespace

CLI::App* Cli::add(const std::string& name, const std::string& description, Command run) {
  CLI::App* command = m_app.add_subcommand(name, description);
  command->add_flag("--json", json_output, "Print the result as JSON on stdout");
  command->callback([this, name, run = std::move(run)] {
    chosen = run;
    chosen_name = name;
  });
  return command;
}

Result<std::vector<double>> numbers_from(const std::string& text, const std::string& option, std::size_t count) {
  std::vector<double> numbers;
  for (const auto& part : split(text)) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    if (error != std::errc{} || end != part.data() + part.size()) {
      return fail(ErrorCode::bad_argument, {{"what", option}, {"found", part}, {"expected", "numbers with commas"}});
    }
    numbers.push_back(value);
  }
  if (count != 0 && numbers.size() != count) {
    return fail(ErrorCode::bad_argument,
                {{"what", option}, {"found", text}, {"expected", std::to_string(count) + " numbers with commas"}});
  }
  return numbers;
}

std::vector<std::string> names_from(const std::string& text) {
  return split(text);
}

}  // namespace zerodrift::cli
