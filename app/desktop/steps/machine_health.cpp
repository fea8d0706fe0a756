// How the connected machine is: its sensors, whether it is at rest, its parts and the devices beside it.

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/desktop/steps/machine_presenter.h"
#include "app/text/core_text.h"
#include "app/text/error_text.h"
#include "core/acquisition/health.h"
#include "ui/pages/machine_page.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {
namespace {

constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
constexpr double spread_s = 60.0;        // of the machine: the readings whose means tell the spread of now
constexpr std::size_t spread_least = 3;  // on a quick machine they are minutes apart
constexpr double course_least_s = 180.0;

double noise_of(const std::deque<std::vector<double>>& readings, std::size_t sensor) {
  // From differences of neighbours, so that a slow drift is no noise.
  double squares = 0.0;
  int count = 0;
  for (std::size_t i = 1; i < readings.size(); ++i) {
    const double step = readings[i][sensor] - readings[i - 1][sensor];
    if (std::isnan(step)) continue;
    squares += step * step;
    ++count;
  }
  return count < 3 ? unknown : std::sqrt(squares / (2.0 * count));
}

/// Kelvin an hour by least squares over the course; NaN while it is too short, or while the sensor was silent.
double slope_K_h(const std::deque<std::pair<double, std::vector<double>>>& course, std::size_t sensor) {
  if (course.size() < MachinePresenter::course_least || course.back().first - course.front().first < course_least_s)
    return unknown;
  double mean_t = 0.0;
  double mean_T = 0.0;
  const auto n = static_cast<double>(course.size());
  for (const auto& [time_s, values] : course) {
    mean_t += time_s / n;
    mean_T += values[sensor] / n;
  }
  double tt = 0.0;
  double tT = 0.0;
  for (const auto& [time_s, values] : course) {
    tt += (time_s - mean_t) * (time_s - mean_t);
    tT += (time_s - mean_t) * (values[sensor] - mean_T);
  }
  return 3600.0 * tT / tt;
}

double median_of(std::vector<double> values) {
  values.erase(std::remove_if(values.begin(), values.end(), [](double v) { return std::isnan(v); }), values.end());
  if (values.empty()) return unknown;
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

QString tag_of(const MachineLook& look, std::size_t sensor) {
  const auto& sensors = look.identity.sensors;
  const QString id = sensor < sensors.size() ? QString::fromStdString(sensors[sensor].channel)
                                             : QStringLiteral("T%1_C").arg(sensor + 1);
  return QString(id).remove(QStringLiteral("_C"));
}

}  // namespace

void MachinePresenter::fillSensors(ui::MachineState& state) {
  const auto& look = *bench().look();
  const auto& sensors = look.identity.sensors;
  const QDateTime now = QDateTime::currentDateTime();
  for (std::size_t i = 0; i < look.sample.temperature_C.size(); ++i) {
    ui::SensorHealth health;
    const bool known = i < sensors.size();
    health.tag = tag_of(look, i);
    health.id = health.tag + QStringLiteral("_C");
    health.label = known ? coreText(sensors[i].label) : QString();
    health.place = known ? QString::fromStdString(sensors[i].place) : QString();
    health.value_C = look.sample.temperature_C[i];
    health.noise_K = noise_of(m_readings, i);
    const bool dead = std::isnan(health.value_C);
    if (!dead) m_alive[health.id] = m_lookedAt.isValid() ? m_lookedAt : now;
    if (m_alive.contains(health.id)) health.age_s = 1e-3 * static_cast<double>(m_alive[health.id].msecsTo(now));
    const bool stuck = !dead && m_readings.size() >= 20 && health.noise_K == 0.0;
    health.judgement = dead ? ui::Judgement::bad : stuck ? ui::Judgement::warn : ui::Judgement::ok;
    health.state = dead ? tr("No signal") : stuck ? tr("Stuck") : tr("OK");
    state.sensors.append(health);
  }
  state.roundTrip_ms = look.round_trip_ms;
  state.clockDifference_s = std::round(10.0 * look.clock_difference_s) / 10.0 + 0.0;  // no "-0.0"
}

void MachinePresenter::fillRest(ui::MachineState& state) const {
  const auto& look = *bench().look();
  const auto& now_C = look.sample.temperature_C;
  const double middle_C = median_of(now_C);
  ui::RestState& rest = state.rest;
  for (std::size_t i = 0; i < now_C.size(); ++i) {
    if (std::isnan(now_C[i])) continue;
    const double apart_K = now_C[i] - middle_C;
    if (std::isnan(rest.apart_K) || std::abs(apart_K) > std::abs(rest.apart_K)) {
      rest.apart_K = apart_K;
      rest.warmest = tag_of(look, i);
    }
    const double slope = slope_K_h(m_course, i);
    if (std::isnan(slope)) continue;
    if (std::isnan(rest.change_K_h) || std::abs(slope) > std::abs(rest.change_K_h)) {
      rest.change_K_h = slope;
      rest.quickest = tag_of(look, i);
    }
  }
  std::vector<std::vector<double>> by_sensor(now_C.size());
  for (std::size_t k = 0; k < m_course.size(); ++k) {
    if (m_course.back().first - m_course[k].first > spread_s && m_course.size() - k > spread_least) continue;
    for (std::size_t i = 0; i < now_C.size(); ++i) by_sensor[i].push_back(m_course[k].second[i]);
  }
  if (!m_course.empty()) rest.now_K = acquisition::spread_of(acquisition::judged(look.identity.sensors, by_sensor));
  rest.spread_K = rest.now_K;
  const auto& begun = bench().body("machine");  // what the job and its report say of the start
  if (begun.is_object() && begun.value("spread_K", nlohmann::json()).is_number()) {
    rest.spread_K = begun["spread_K"].get<double>();
    rest.atStart = true;
  }
}

void MachinePresenter::fillParts(ui::MachineState& state) const {
  const auto& look = *bench().look();
  const auto& sample = look.sample;
  for (const auto& [axis, position] : sample.axes) {
    const bool turns = axis == "A" || axis == "B" || axis == "C";
    state.parts.append({QString::fromStdString(axis), tr("%1 axis").arg(QString::fromStdString(axis)),
                        QStringLiteral("%1 %2")
                            .arg(ui::fixedText(position, 3))
                            .arg(turns ? QStringLiteral("°") : QStringLiteral("mm")),
                        sample.referenced ? ui::Judgement::ok : ui::Judgement::warn});
  }
  if (!std::isnan(sample.spindle_rpm)) {
    state.parts.append(
        {QStringLiteral("spindle"), tr("Spindle"), tr("%1 rpm").arg(sample.spindle_rpm, 0, 'f', 0), ui::Judgement::ok});
  }
  state.parts.append({QStringLiteral("switch"), tr("Compensation"), sample.compensation_on ? tr("ON") : tr("OFF"),
                      sample.compensation_on ? ui::Judgement::warn : ui::Judgement::ok});
}

void MachinePresenter::fillDevices(ui::MachineState& state) const {
  for (const controller::DeviceState& device : bench().look()->devices) {
    ui::DeviceHealth health;
    health.id = QString::fromStdString(device.id);
    health.missed = device.faults;
    health.rounds = device.rounds + device.faults;
    health.judgement = device.fault ? ui::Judgement::bad : device.rounds > 0 ? ui::Judgement::ok : ui::Judgement::none;
    if (device.age_s) health.age_s = *device.age_s;
    if (device.rounds > 0 && !device.fault) health.roundTrip_ms = 1000.0 * device.round_trip_s;
    if (device.fault) {
      const ErrorText text = textOf(*device.fault, Reader::window);
      health.state = text.sentence;
      health.remedy = text.remedy;
    } else {
      QStringList remarks;
      for (const auto& remark : device.remarks) remarks << coreText(remark);
      health.state = remarks.join(QStringLiteral("; "));
    }
    state.devices.append(health);
  }
}

}  // namespace zerodrift::desktop
