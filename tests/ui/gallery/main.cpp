// zerodrift-ui-gallery DIR: a picture of every page in every state, in light and dark, at 1440x900 and 1280x720.

#include <QApplication>
#include <QDir>
#include <QElapsedTimer>
#include <QPixmap>
#include <cstdio>

#include "tests/ui/gallery/samples.h"
#include "ui/plots/heat_map.h"
#include "ui/plots/live_plot.h"
#include "ui/plots/xy_plot.h"
#include "ui/shell/main_window.h"
#include "ui/shell/theme.h"

using namespace zerodrift::ui;

namespace {

void settle(MainWindow& window) {
  // Plots gather their redraws for 33 ms and cards take several rounds of layout: pass that, then draw what is still
  // due.
  QElapsedTimer clock;
  clock.start();
  while (clock.elapsed() < 250) QCoreApplication::processEvents(QEventLoop::AllEvents, 20);
  for (auto* plot : window.findChildren<LivePlot*>()) {
    if (plot->isVisible()) plot->flush();
  }
  for (auto* plot : window.findChildren<XyPlot*>()) {
    if (plot->isVisible()) plot->flush();
  }
  for (auto* plot : window.findChildren<HeatMap*>()) {
    if (plot->isVisible()) plot->flush();
  }
}

}  // namespace

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  Theme theme(application);
  if (argc > 1 && argv[1][0] == '-') {  // an option is no folder
    std::fprintf(stderr, "usage: zerodrift-ui-gallery [DIR [PAGE-SCENE]]\n");
    return 2;
  }
  const QString only = argc > 2 ? QString::fromLocal8Bit(argv[2]) : QString();
  const QDir folder(argc > 1 ? QString::fromLocal8Bit(argv[1]) : "gallery");
  folder.mkpath(".");
  MainWindow window;
  samples::fillWindow(window);
  const QVector<QSize> sizes = {{1440, 900}, {1280, 720}};
  for (const bool dark : {false, true}) {
    theme.setMode(dark ? ThemeMode::dark : ThemeMode::light);
    for (const QSize& size : sizes) {
      window.resize(size);
      window.show();
      for (const auto& scene : samples::scenes()) {
        if (!only.isEmpty() && !(scene.page + '-' + scene.name).contains(only)) continue;
        samples::play(window, scene);
        settle(window);
        const QString name =
            QStringLiteral("%1-%2-%3-%4.png").arg(scene.page, scene.name, dark ? "dark" : "light").arg(size.width());
        if (!window.grab().save(folder.filePath(name))) return 1;
        std::printf("%s\n", qPrintable(name));
      }
    }
  }
  return 0;
}
