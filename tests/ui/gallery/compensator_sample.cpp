#include <cmath>

#include "tests/ui/gallery/page_samples.h"
#include "ui/pages/compensator_page.h"

namespace zerodrift::ui::samples {

void fillCompensator(Page* page, const QString& scene) {
  auto* compensator = qobject_cast<CompensatorPage*>(page);
  CompensatorState s;
  if (scene == "empty") {
    s.blocked = "Fit a model first: it says from the temperatures what to compensate.";
    return compensator->setState(s);
  }
  s.phase = CompensatorPhase::running;
  s.doing = "compensating";
  s.turns = 3600;
  s.latest_ms = 8.0;
  compensator->clear();
  for (int i = 0; i < 900; ++i) {
    const double t = 2.0 * i;
    s.running_s = t;
    for (std::size_t a = 0; a < 3; ++a) {
      const double size = a == 0 ? 12.0 : a == 1 ? -7.0 : 54.0;
      s.axes[a].predicted_um = size * (1.0 - std::exp(-t / 900.0)) + 0.1 * std::sin(i * 0.7);
      s.axes[a].applied_um = -size * (1.0 - std::exp(-(t - 4.0) / 900.0));
      s.axes[a].left_um = 0.02 * size + 0.8 * std::sin(t / 260.0 + static_cast<double>(a));
      s.axes[a].largestLeft_um = std::max(s.axes[a].largestLeft_um, std::abs(s.axes[a].left_um));
    }
    compensator->append(t, s.axes, i % 30 == 0);
  }
  compensator->setState(s);
}

}  // namespace zerodrift::ui::samples
