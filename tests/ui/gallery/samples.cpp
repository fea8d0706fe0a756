#include "tests/ui/gallery/samples.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/ui/gallery/page_samples.h"
#include "ui/shell/main_window.h"

namespace zerodrift::ui::samples {

QVector<double> timeAxis(double duration_s, double step_s) {
  QVector<double> time;
  for (double t = 0.0; t <= duration_s; t += step_s) time.append(t);
  return time;
}

QVector<double> warming(const QVector<double>& time_s, double start, double rise, double tau_s, double noise,
                        int seed) {
  QRandomGenerator random(static_cast<quint32>(seed) + 1U);
  QVector<double> values;
  values.reserve(time_s.size());
  for (const double t : time_s) {
    const double scatter = random.generateDouble() + random.generateDouble() + random.generateDouble() - 1.5;
    values.append(start + rise * (1.0 - std::exp(-t / tau_s)) + 2.0 * noise * scatter);
  }
  return values;
}

QImage cameraImage(int width, int height) {
  QImage image(width, height, QImage::Format_Grayscale8);
  QRandomGenerator random(7);
  const QPointF target(width * 0.5, height * 0.48);
  const QPointF reference(width * 0.16, height * 0.76);
  const auto rings = [](double r, double outer, int count) {
    if (r > outer) return -1.0;
    return std::cos(2.0 * std::numbers::pi * count * r / outer) > 0.0 ? 0.08 : 0.92;
  };
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double shade = 0.42 + 0.18 * x / width - 0.12 * y / height;
      double value = shade;
      const double a = rings(std::hypot(x - target.x(), y - target.y()), 78, 4);
      const double b = rings(std::hypot(x - reference.x(), y - reference.y()), 52, 3);
      if (a >= 0.0) value = 0.1 + 0.75 * a;
      if (b >= 0.0) value = 0.1 + 0.65 * b;
      value += 0.03 * (random.generateDouble() - 0.5);
      image.scanLine(y)[x] = static_cast<uchar>(std::clamp(255.0 * value, 0.0, 255.0));
    }
  }
  return image;
}

void fillWindow(MainWindow& window) {
  addPages(window);
  window.setJob("VMC-850 #3", "A. Keller");
  window.setLanguageName("English");
  window.setLamp(LampId::controller, "Controller 127.0.0.1:1502", Judgement::ok);
  window.setLamp(LampId::recording, "Not recording", Judgement::none);
  window.setLamp(LampId::camera, "Cameras 2 of 2", Judgement::ok);
  window.setLamp(LampId::compensation, "Compensation OFF", Judgement::none, true);
  const auto now = QDateTime(QDate(2026, 11, 21), QTime(9, 12));
  window.appendLog(now, Judgement::ok, "Connected to Virtual five-axis, serial 20261.");
  window.appendLog(now.addSecs(4), Judgement::none, "20 sensors found, 20 alive.");
  window.appendLog(now.addSecs(9), Judgement::warn, "Sensor T14: noise 0.21 K, twice the others.");
}

}  // namespace zerodrift::ui::samples
