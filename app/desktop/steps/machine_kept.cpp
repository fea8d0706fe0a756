// The machine page of a job that is looked at away from the machine.

#include <cmath>
#include <limits>

#include "app/desktop/moment.h"
#include "app/desktop/steps/machine_presenter.h"
#include "app/text/core_text.h"
#include "ui/pages/machine_page.h"

namespace zerodrift::desktop {

void MachinePresenter::fillKept(ui::MachineState& state) const {
  const auto job = bench().job();
  if (job == nullptr) return;
  const auto artefact = job->latest("machine");
  if (!artefact || !*artefact) return;
  const nlohmann::json body = (*artefact)->document().value_or(nlohmann::json::object());
  const auto number = [](const nlohmann::json& from, const char* key) {
    const auto at = from.find(key);
    return at != from.end() && at->is_number() ? at->get<double>() : std::numeric_limits<double>::quiet_NaN();
  };
  const auto text = [](const nlohmann::json& from, const char* key) {
    return QString::fromStdString(from.value(key, std::string()));
  };
  for (const auto& sensor : body.value("health", nlohmann::json::array())) {
    ui::SensorHealth health;
    health.id = text(sensor, "channel");
    health.tag = QString(health.id).remove(QStringLiteral("_C"));
    health.label = coreText(text(sensor, "label"));
    health.place = text(sensor, "place");
    health.value_C = number(sensor, "value_C");
    health.noise_K = number(sensor, "noise_K");
    const bool good = sensor.value("state", "") == "ok";
    health.judgement = good ? ui::Judgement::ok : ui::Judgement::warn;
    health.state = good ? tr("OK") : std::isnan(health.value_C) ? tr("No signal") : tr("Stuck");
    state.sensors.append(health);
  }
  if (state.sensors.isEmpty()) return;
  state.rest.spread_K = number(body, "spread_K");
  state.rest.atStart = true;
  state.roundTrip_ms = number(body, "round_trip_ms");
  state.clockDifference_s = std::round(10.0 * number(body, "clock_difference_s")) / 10.0 + 0.0;
  state.keptFrom = momentText((*artefact)->created_utc);
}

}  // namespace zerodrift::desktop
