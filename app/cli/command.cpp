#include "app/cli/command.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <set>

#include "core/analysis/checked.h"

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

/// No command writes pictures, and views and frames are read without being named one by one.
bool is_picture(const std::filesystem::path& path) {
  static const std::set<std::string> endings = {".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff"};
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return endings.contains(ending);
}

/// A file that is read is not written over: a recording would be gone for good. A model may be updated in place.
void refuse_writing_over(const CLI::App& command) {
  const auto writes = [](const CLI::Option& option) {
    static const std::set<std::string> names = {"--out",    "--refined", "--statistics",
                                                "--report", "--log",     "--save-map"};
    return names.contains(option.get_name());
  };
  std::set<std::string> all_written;
  for (const CLI::Option* written : command.get_options([&](const CLI::Option* o) { return writes(*o); })) {
    for (const std::string& path : written->results()) {
      std::error_code none;
      if (is_picture(path) && std::filesystem::is_regular_file(path, none)) {
        throw CLI::ValidationError(written->get_name(), "a picture would be written over: " + path);
      }
      if (!all_written.insert(std::filesystem::weakly_canonical(path, none).string()).second) {
        throw CLI::ValidationError(written->get_name(), "two outputs would go to the same file: " + path);
      }
      for (const CLI::Option* read : command.get_options()) {
        if (writes(*read) || read->get_name() == "--update") continue;
        if (written->get_name() == "--save-map" && read->get_name() == "--map") continue;
        for (const std::string& other : read->results()) {
          std::error_code unknown;
          if (std::filesystem::equivalent(path, other, unknown) && !std::filesystem::is_directory(path, unknown)) {
            throw CLI::ValidationError(written->get_name(),
                                       "the file of " + read->get_name() + " would be written over: " + path);
          }
        }
      }
    }
  }
}

}  // namespace

CLI::App* Cli::add(const std::string& name, const std::string& description, Command run) {
  CLI::App* command = m_app.add_subcommand(name, description);
  command->add_flag("--json", json_output, "Print the result as JSON on stdout");
  command->callback([this, command, name, run = std::move(run)] {
    refuse_writing_over(*command);
    chosen = run;
    chosen_name = name;
  });
  return command;
}

CLI::App* Cli::add(const std::string& name, const std::string& description, FillingCommand run) {
  return add(name, description, [this, run = std::move(run)](const TaskContext& context) -> Result<CommandOutput> {
    CommandOutput output;
    if (const Status done = run(context, output); !done) {
      warnings_of_failed = std::move(output.warnings);
      return fail(done.error());
    }
    return output;
  });
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

CLI::Validator names_with_commas() {
  const auto look = [](std::string& text) {
    const auto commas = static_cast<std::size_t>(std::count(text.begin(), text.end(), ','));
    return split(text).size() == commas + 1 ? std::string() : "a name is missing in \"" + text + "\"";
  };
  return {look, "", "names"};
}

recording::Recording sound(const recording::Recording& recording, const std::set<std::string>& may_stand_still,
                           std::vector<std::string>& warnings) {
  analysis::Checked checked = analysis::checked(recording, may_stand_still);
  for (const auto& finding : checked.findings) warnings.push_back(recording.name + ": " + analysis::describe(finding));
  return std::move(checked.recording);
}

}  // namespace zerodrift::cli
