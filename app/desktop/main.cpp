// zerodrift: the desktop application.

#include <CLI/CLI.hpp>
#include <QApplication>
#include <QIcon>
#include <QSettings>
#include <QTimer>
#include <csignal>
#include <cstdio>
#include <memory>

#include "app/desktop/application.h"
#include "app/desktop/quit_signals.h"
#include "app/desktop/scratch_folder.h"
#include "app/desktop/stall_watch.h"
#include "app/desktop/tour.h"
#include "app/text/error_text.h"
#include "core/base/resources.h"
#include "ui/shell/theme.h"

namespace {

struct Arguments {
  std::vector<std::string> files;
  bool sample = false;
  bool demo = false;
  std::string tour;
  double speedup = 240.0;
  int seed = 1;
  std::string conceal = "coolant";
  std::vector<std::string> faults;
  std::string language;
  std::string theme;
  std::string size = "1440x900";
};

/// Without a display the tour draws on the offscreen platform.
void choosePlatform(int argc, char** argv) {
  bool tour = false;
  for (int i = 1; i < argc; ++i) tour = tour || std::string(argv[i]) == "--tour";
  const bool display = qEnvironmentVariableIsSet("DISPLAY") || qEnvironmentVariableIsSet("WAYLAND_DISPLAY");
  if (tour && !display && !qEnvironmentVariableIsSet("QT_QPA_PLATFORM")) qputenv("QT_QPA_PLATFORM", "offscreen");
}

void declare(CLI::App& app, Arguments& arguments) {
  app.add_option("files", arguments.files, "Job to open; or a profile, plan, laser report or recording");
  app.add_flag("--sample", arguments.sample, "Open a copy of the sample job");
  app.add_flag("--demo", arguments.demo,
               "Start the virtual machine tool beside the application, with a new job, past the start page");
  app.add_option("--tour", arguments.tour,
                 "Drive the whole wizard against the virtual machine; pictures into this folder");
  app.add_option("--speedup", arguments.speedup, "Speed of the virtual machine's time")->check(CLI::Range(1.0, 2000.0));
  app.add_option("--seed", arguments.seed, "Which virtual machine");
  app.add_option(
      "--conceal", arguments.conceal,
      "Effect that the virtual machine's description leaves out, for the Physics page to find; none: nothing");
  app.add_option("--fault", arguments.faults,
                 "A fault of the virtual machine, now and then (NAME) or all the time "
                 "(NAME:always)");
  app.add_option("--language", arguments.language, "en or zh")->check(CLI::IsMember({"en", "zh", "zh_CN"}));
  app.add_option("--theme", arguments.theme, "light or dark")->check(CLI::IsMember({"light", "dark"}));
  app.add_option("--size", arguments.size, "Size of the window for the tour, for example 1280x720");
  app.set_version_flag("--version", ZERODRIFT_VERSION);
}

bool is_size(const std::string& text) {
  unsigned width = 0;
  unsigned height = 0;
  int end = 0;
  return std::sscanf(text.c_str(), "%4ux%4u%n", &width, &height, &end) == 2 &&
         static_cast<std::size_t>(end) == text.size() && width >= 640 && height >= 480;
}

/// What was given and would be ignored; empty: nothing.
std::string unused(const CLI::App& app, const Arguments& arguments) {
  const bool tour = !arguments.tour.empty();
  if (app.count("--size") > 0 && !tour) return "--size is the size of the tour's window: it needs --tour";
  if (!is_size(arguments.size)) return "--size is not WIDTHxHEIGHT, at least 640x480: " + arguments.size;
  if (tour && (arguments.sample || !arguments.files.empty())) return "--tour makes a job of its own and opens no other";
  for (const char* option : {"--speedup", "--seed", "--conceal", "--fault"}) {
    if (app.count(option) > 0 && !tour && !arguments.demo) {
      return std::string(option) + " is for the virtual machine: it needs --demo or --tour";
    }
  }
  return {};
}

}  // namespace

int main(int argc, char** argv) {
  zerodrift::set_program_name(argc > 0 ? argv[0] : nullptr);
  CLI::App app("Zerodrift takes the thermal drift out of a CNC machine", "zerodrift");
  Arguments arguments;
  declare(app, arguments);
  choosePlatform(argc, argv);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : 2;
  }
  if (const std::string problem = unused(app, arguments); !problem.empty()) {
    std::fprintf(stderr, "zerodrift: %s\n", problem.c_str());
    return 2;
  }
  std::signal(SIGPIPE, SIG_IGN);
  zerodrift::desktop::sweep_scratch_folders();
  zerodrift::desktop::WatchedApplication application(argc, argv);
  zerodrift::desktop::quit_on_signals(application);
  QApplication::setOrganizationName(QStringLiteral("Zerodrift"));
  QApplication::setApplicationName(QStringLiteral("Zerodrift"));
  QApplication::setApplicationVersion(QStringLiteral(ZERODRIFT_VERSION));
  QApplication::setDesktopFileName(QStringLiteral("org.zerodrift.Zerodrift"));
  QApplication::setWindowIcon(QIcon(QStringLiteral(":/icons/zerodrift.svg")));

  using zerodrift::desktop::DemoOptions;
  zerodrift::ui::Theme theme(application);
  if (!arguments.theme.empty()) {
    theme.setMode(arguments.theme == "dark" ? zerodrift::ui::ThemeMode::dark : zerodrift::ui::ThemeMode::light);
  } else if (const QVariant dark = QSettings().value(QStringLiteral("dark"));
             dark.isValid() && arguments.tour.empty()) {
    theme.setMode(dark.toBool() ? zerodrift::ui::ThemeMode::dark : zerodrift::ui::ThemeMode::light);
  }
  zerodrift::desktop::Application desktop(theme);
  desktop.setLanguage(arguments.language.empty()   ? zerodrift::desktop::Application::rememberedLanguage()
                      : arguments.language == "en" ? QStringLiteral("en")
                                                   : QStringLiteral("zh_CN"));
  application.onException = [&desktop](const QString& what) {
    const zerodrift::Error error{zerodrift::ErrorCode::internal, {{"detail", what.toStdString()}}};
    desktop.bench().log(zerodrift::desktop::LogKind::bad, zerodrift::lineOf(error));
  };
  DemoOptions demo{arguments.speedup, arguments.seed, QString::fromStdString(arguments.conceal), {}, {}};
  for (const std::string& fault : arguments.faults) demo.faults << QString::fromStdString(fault);

  std::unique_ptr<zerodrift::desktop::Tour> tour;
  if (!arguments.tour.empty()) {
    tour = std::make_unique<zerodrift::desktop::Tour>(desktop, QString::fromStdString(arguments.tour),
                                                      QString::fromStdString(arguments.size), demo);
    QTimer::singleShot(0, tour.get(), &zerodrift::desktop::Tour::start);
  } else {
    desktop.show();
    QTimer::singleShot(0, &desktop, [&] {
      if (arguments.sample) desktop.openSample();
      QStringList files;
      for (const auto& file : arguments.files) files << QString::fromStdString(file);
      desktop.openFiles(files);
    });
    if (arguments.demo) desktop.startDemo(demo);
  }
  return QApplication::exec();
}
