#pragma once
// Plausible values for the pictures of the gallery and for the tests: a five-axis machine with 20 sensors after a
// run of four hours at 3000 rpm. Deterministic.

#include <QImage>
#include <QVector>
#include <functional>

namespace zerodrift::ui {

class MainWindow;
class Page;

namespace samples {

/// All pages in wizard order, filled, in a window that the caller owns.
void fillWindow(MainWindow& window);
/// Brings one page into a named state ("filled", "empty", ...) before its picture is taken.
struct Scene {
  QString page;
  QString name;
};
QVector<Scene> scenes();
void play(MainWindow& window, const Scene& scene);

QVector<double> timeAxis(double duration_s, double step_s);
/// Exponential warm-up with noise: start + rise (1 - exp(-t / tau)).
QVector<double> warming(const QVector<double>& time_s, double start, double rise, double tau_s, double noise, int seed);
QImage cameraImage(int width, int height);

}  // namespace samples
}  // namespace zerodrift::ui
