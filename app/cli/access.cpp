#include "app/cli/access.h"

#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <thread>

#include "app/cli/typed.h"
#include "core/base/file.h"

namespace zerodrift::cli {
namespace {

constexpr std::size_t pin_file_limit_bytes = 4096;
constexpr std::chrono::seconds wrong_pin_pause{2};  // a program that guesses gets no further

/// Empty where nothing is typed.
Result<std::string> typed_unseen(const std::string& question) {
  termios before{};
  const bool terminal = ::tcgetattr(STDIN_FILENO, &before) == 0;
  termios silent = before;
  silent.c_lflag &= ~static_cast<tcflag_t>(ECHO);
  if (terminal) ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &silent);
  auto pin = typed_line(question);
  if (terminal) ::tcsetattr(STDIN_FILENO, TCSAFLUSH, &before);
  std::fprintf(stderr, "\n");
  if (!pin) return fail(std::move(pin).error());
  return pin->value_or("");
}

}  // namespace

std::shared_ptr<PinOption> add_pin_option(CLI::App& command) {
  auto option = std::make_shared<PinOption>();
  command.add_option("--pin-file", option->file, "File with the engineer's PIN, where this computer has one")
      ->envname("ZERODRIFT_PIN_FILE");
  return option;
}

Result<std::string> pin_from(const std::string& file, const std::string& question, const std::string& operation) {
  if (!file.empty()) {
    ZD_TRY(const std::string text, read_file(file, pin_file_limit_bytes));
    return text.substr(0, text.find_first_of("\r\n"));
  }
  if (::isatty(STDIN_FILENO) != 0 && ::isatty(STDERR_FILENO) != 0) return typed_unseen(question);
  return fail(ErrorCode::access_locked, {{"operation", operation}});
}

Result<access::Permit> engineer(const PinOption& option, const std::string& operation) {
  access::Access access(access::access_file());
  if (access.has_pin()) {
    ZD_TRY(const std::string pin, pin_from(option.file, "PIN of the engineer: ", operation));
    if (const Status unlocked = access.unlock(pin); !unlocked) {
      if (unlocked.error().code == ErrorCode::access_wrong_pin) std::this_thread::sleep_for(wrong_pin_pause);
      return fail(unlocked.error());
    }
  }
  return access.permit(operation);
}

}  // namespace zerodrift::cli
