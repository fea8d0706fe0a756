// zerodrift-cli: every step of the job without a display.
// Exit 0 done, 1 refused or failed on the data (one sentence on stderr), 2 wrong usage.

#include <fmt/format.h>
#include <unistd.h>

#include <QApplication>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <mutex>
#include <stop_token>
#include <thread>

#include "app/cli/command.h"
#include "app/cli/typed.h"
#include "app/text/error_text.h"
#include "core/base/file.h"
#include "core/base/json.h"
#include "core/base/resources.h"

namespace {

using zerodrift::Error;
using zerodrift::ErrorCode;

std::atomic<int> signal_seen{0};

void on_signal(int signal) {
  signal_seen = signal;
}

/// Turns Ctrl+C and the other requests to end into a stop request, so that a write to a machine is finished or restored
/// and files are whole. A second one ends the program whatever it does; what arrives with the first (timeout signals a
/// group twice) is no second one.
std::jthread watch_signals(std::stop_source& stop) {
  using Clock = std::chrono::steady_clock;
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT}) {
    // One that was ignored at the start (nohup) stays so.
    if (std::signal(signal, on_signal) == SIG_IGN) std::signal(signal, SIG_IGN);
  }
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);  // the write that meets it fails instead
  return std::jthread([&stop](const std::stop_token& done) {
    constexpr auto together = std::chrono::milliseconds(500);
    Clock::time_point first;
    std::mutex mutex;
    std::condition_variable_any end;
    std::unique_lock lock(mutex);
    while (!done.stop_requested()) {
      if (const int signal = signal_seen.exchange(0); signal != 0) {
        if (!stop.stop_requested()) {
          first = Clock::now();
          stop.request_stop();
          zerodrift::end_waiting_reads();
          zerodrift::cli::end_typing();
        } else if (Clock::now() - first > together) {
          std::signal(signal, SIG_DFL);
          std::raise(signal);
        }
      }
      end.wait_for(lock, done, std::chrono::milliseconds(50), [] { return false; });
    }
  });
}

void show_progress(const zerodrift::Progress& progress) {
  std::string line = fmt::format("\r{:3.0f} % {}", 100.0 * progress.fraction, progress.phase);
  if (progress.seconds_left) line += fmt::format(", {:.0f} s left", *progress.seconds_left);
  std::fprintf(stderr, "%-70s", line.c_str());
  std::fflush(stderr);
}

int print_error(const Error& error) {
  std::fprintf(stderr, "zerodrift-cli: %s\n", zerodrift::lineOf(error).toUtf8().constData());
  return 1;
}

int run_command(zerodrift::cli::Cli& cli) {
  std::stop_source stop;
  const auto watcher = watch_signals(stop);
  const bool terminal = ::isatty(STDERR_FILENO) != 0;
  zerodrift::TaskContext context;
  context.stop = stop.get_token();
  if (terminal) context.report = show_progress;
  const auto output = cli.chosen(context);
  if (terminal) std::fprintf(stderr, "\r%70s\r", "");
  for (const auto& warning : output ? output->warnings : cli.warnings_of_failed) {
    std::fprintf(stderr, "warning: %s\n", warning.c_str());
  }
  if (!output) return print_error(output.error());
  const std::string text = cli.json_output ? zerodrift::json_text(output->json, 2) : output->text;
  if (!text.empty()) std::printf("%s\n", text.c_str());
  return 0;
}

/// Commands that draw a report need fonts and a painter; without a display the offscreen platform gives them.
std::unique_ptr<QCoreApplication> make_application(int& argc, char** argv) {
  const std::string command = argc > 1 ? argv[1] : "";
  if (command != "commission" && command != "report" && command != "prove" && command != "bundle")
    return std::make_unique<QCoreApplication>(argc, argv);
  qputenv("QT_QPA_PLATFORM", "offscreen");
  // What the toolkit remarks about its surroundings is not for the reader of stderr.
  qInstallMessageHandler([](QtMsgType, const QMessageLogContext&, const QString&) {});
  return std::make_unique<QApplication>(argc, argv);
}

}  // namespace

int main(int argc, char** argv) {
  zerodrift::set_program_name(argc > 0 ? argv[0] : nullptr);
  const auto application = make_application(argc, argv);
  CLI::App app("Zerodrift takes the thermal drift out of a CNC machine", "zerodrift-cli");
  app.set_version_flag("--version", ZERODRIFT_VERSION);
  app.require_subcommand(1);
  zerodrift::cli::Cli cli(app);
  zerodrift::cli::add_all_commands(cli);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  try {
    return run_command(cli);
  } catch (const std::exception& error) {
    return print_error(Error{ErrorCode::internal, {{"detail", error.what()}}});
  }
}
