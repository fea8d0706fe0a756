#include "app/desktop/steps/sensors_presenter.h"

#include <algorithm>
#include <cmath>

#include "app/text/core_text.h"
#include "core/flow/flow.h"
#include "core/flow/steps/inputs.h"
#include "core/report/limits.h"
#include "ui/pages/sensors_page.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using nlohmann::json;

namespace {

constexpr std::size_t most_points = 200;  // of a small multiple

double number(const json& object, const char* key) {
  const auto at = object.find(key);
  return at != object.end() && at->is_number() ? at->get<double>() : std::nan("");
}

QVector<double> standardised(const std::vector<double>& values, std::size_t stride) {
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (const double v : values) {
    if (std::isnan(v)) continue;
    sum += v;
    squares += v * v;
    count += 1.0;
  }
  const double mean = count > 0 ? sum / count : 0.0;
  const double deviation = count > 0 ? std::sqrt(std::max(0.0, squares / count - mean * mean)) : 1.0;
  QVector<double> out;
  for (std::size_t i = 0; i < values.size(); i += stride) out.append((values[i] - mean) / std::max(deviation, 1e-9));
  return out;
}

}  // namespace

SensorsPresenter::SensorsPresenter(Workbench& bench, ui::SensorsPage* page) : Presenter(bench, page), m_page(page) {
  connect(page, &ui::SensorsPage::clustersChosen, this, [this](int clusters) {
    rememberChoice();
    run({clusters, {}}, {});
  });
  connect(page, &ui::SensorsPage::absoluteChosen, this, [this](bool absolute) {
    m_absolute = absolute;
    refresh();
  });
  connect(page, &ui::SensorsPage::keptChanged, this, [this](const QString& sensor, bool kept) {
    auto chosen = this->bench().body("sensors").value("chosen", std::vector<std::string>{});
    const std::string name = sensor.toStdString();
    std::erase(chosen, name);
    if (kept) chosen.push_back(name);
    if (chosen.empty()) {
      refresh();
      return;
    }
    rememberChoice();
    run({asked().clusters, chosen}, {});
  });
  connect(page, &ui::Page::primaryTriggered, this, [this] {
    if (this->bench().has("sensors")) {
      Q_EMIT nextRequested();
    } else {
      run(asked(), {});
    }
  });
  connect(page, &ui::Page::secondaryTriggered, this, [this](const QString&) { run({asked().clusters, {}}, {}); });
}

void SensorsPresenter::forget() {
  m_undo.clear();
  m_absolute.reset();
}

flow::SensorsOptions SensorsPresenter::asked() {
  const auto job = bench().job();
  return job == nullptr ? flow::SensorsOptions{} : flow::sensors_asked_for(*job).value_or(flow::SensorsOptions{});
}

void SensorsPresenter::enter() {
  refresh();
  // The clustering asks nothing of the user: it is there when the page opens.
  const auto job = bench().job();
  const bool due = job != nullptr && flow::status_of(*job, "sensors").state == flow::StepState::ready;
  if (due && !bench().tasks().running()) run(asked(), {});
}

void SensorsPresenter::undo() {
  if (m_undo.empty() || bench().tasks().running()) return;
  const flow::SensorsOptions before = m_undo.back();
  m_undo.pop_back();
  run(before, {});
}

void SensorsPresenter::rememberChoice() {
  // What was proposed is proposed again; only a choice by hand is put back sensor by sensor.
  if (bench().has("sensors")) m_undo.push_back(asked());
}

void SensorsPresenter::run(const flow::SensorsOptions& options, std::function<void(bool good)> done) {
  if (bench().job() == nullptr) return;
  runStep(
      tr("Clustering the sensors"),
      [options](commissioning::Job& job, const TaskContext& context) {
        return flow::choose_sensors(job, options, context);
      },
      std::move(done));
}

/// The axes in their order, then what is of none.
std::vector<std::string> SensorsPresenter::errorsOf(const json& body) const {
  auto errors = body.value("errors", std::vector<std::string>{"dX_um", "dY_um", "dZ_um"});
  std::stable_sort(errors.begin(), errors.end(), [this](const std::string& a, const std::string& b) {
    const auto place = [this](const std::string& channel) {
      const auto at = QStringList{"X", "Y", "Z"}.indexOf(bench().tagOf(channel));
      return at < 0 ? 3 : at;
    };
    return place(a) < place(b);
  });
  return errors;
}

void SensorsPresenter::fill(ui::SensorsState& state, const json& body) const {
  const auto chosen = body.value("chosen", std::vector<std::string>{});
  const json labels = body.value("table", json::array());
  const json price = body.value("price", json::object());
  const json changes = price.value("change_um", json::object());
  const json criterion = body.value("criterion", json::object());
  state.absolute = m_absolute.value_or(criterion.value("used", "signed") == "absolute");
  const auto errors = errorsOf(body);
  state.errors.clear();
  for (const auto& error : errors) state.errors << bench().tagOf(error);
  for (const auto& sensor : body.value("sensors", json::array())) {
    ui::SensorRow row;
    const std::string channel = sensor.value("sensor", "");
    row.id = QString::fromStdString(channel);
    row.tag = bench().tagOf(channel);
    row.label = bench().labelOf(channel);
    for (const auto& known : labels) {
      if (known.value("channel", "") != channel) continue;
      if (row.label.isEmpty()) row.label = coreText(known.value("label", ""));
      row.note = coreText(known.value("note", ""));
    }
    row.cluster = sensor.value("cluster", 1) - 1;
    row.kept = std::find(chosen.begin(), chosen.end(), channel) != chosen.end();
    const json correlation = sensor.value("correlation", json::object());
    row.r.clear();
    for (const auto& error : errors) row.r.append(number(correlation, error.c_str()));
    row.sum = number(sensor, state.absolute ? "sum_absolute" : "sum");
    const json lags = sensor.value("lag_s", json::object());
    row.lag_s = errors.empty() ? std::nan("") : number(lags, errors.back().c_str());
    row.vif = number(sensor, "vif");
    row.price_um = number(changes, channel.c_str());
    const json pc = sensor.value("pc", json::array());
    if (pc.size() >= 2 && pc[0].is_number() && pc[1].is_number()) {
      row.pc1 = pc[0].get<double>();
      row.pc2 = pc[1].get<double>();
    }
    state.sensors.append(row);
  }
  for (const auto& sensor : body.value("left_out", json::array())) {
    ui::SensorRow row;
    const std::string channel = sensor.value("channel", "");
    row.id = QString::fromStdString(channel);
    row.tag = bench().tagOf(channel);
    row.label = coreText(sensor.value("label", ""));
    row.cluster = -1;
    row.note = coreText(sensor.value("reason", ""));
    state.sensors.prepend(row);  // where it is seen
  }
  state.clusters = static_cast<int>(body.value("clusters", json::array()).size());
  const json suggested = body.value("suggested_clusters", json::object());
  state.suggestedClusters = suggested.value("silhouette", state.clusters);
  state.proposal = proposalInWords(body);
  state.automatic = body.value("clusters_asked", 1) == 0;
  const json explained = body.value("explained_variance", json::array());
  if (explained.size() >= 2) {
    state.explained1_percent = 100.0 * explained[0].get<double>();
    state.explained2_percent = 100.0 * explained[1].get<double>();
  }
  const json condition = body.value("condition_number", json::object());
  state.condition = number(condition, "chosen");
  state.error_um = number(price, "held_out_rms_um");
  state.errorLimit_um = report::limits::unseen_error_um;
  state.lostLimit_percent = report::limits::lost_against_all_percent;
  state.lostLimit_um = report::limits::lost_against_all_um;
  state.conditionLimit = report::limits::condition_number;
  const double all_um = number(price, "all_rms_um");
  if (all_um > 0.0) state.lost_percent = 100.0 * (state.error_um / all_um - 1.0);
  for (const auto& point : body.value("budget", json::array())) {
    state.budgetCount.append(number(point, "sensors"));
    state.budgetError_um.append(number(point, "held_out_rms_um"));
  }
}

/// Why so many are proposed and not more or fewer; "" when they were chosen by hand.
QString SensorsPresenter::proposalInWords(const json& body) const {
  if (body.value("chosen_by", "") == "hand") return {};
  const json choice = body.value("choice", json::object());
  const auto count = static_cast<int>(body.value("chosen", json::array()).size());
  const QString about = conditionInWords(choice.value("condition", json()), count, choice.value("one_cycle", false));
  if (choice.value("one_cycle", false)) {
    return ui::sentencesText(
        {tr("%n proposed: one speed does not tell which of them matter at another. A run at a second speed does.",
            nullptr, count),
         about});
  }
  const json flat = choice.value("flat", json::object());
  QStringList left;
  for (const auto& sensor : flat.value("left", json::array())) left << bench().tagOf(sensor.get<std::string>());
  if (left.isEmpty()) return about;
  return ui::sentencesText({tr("%n proposed: with %1 the error to expect would be only %2 µm less.", nullptr, count)
                                .arg(ui::listText(left))
                                .arg(std::max(0.0, flat.value("cost_um", 0.0)), 0, 'f', 2),
                            about});
}

/// How the proposal holds the limit of the condition number, or why it does not; "" where nothing is to be said.
QString SensorsPresenter::conditionInWords(const json& condition, int proposed, bool oneCycle) const {
  if (!condition.is_object()) return {};
  QStringList left;
  for (const auto& sensor : condition.value("left", json::array())) left << bench().tagOf(sensor.get<std::string>());
  const double without = condition.value("without", 0.0);
  const double cost_um = std::max(0.0, condition.value("cost_um", 0.0));
  if (condition.value("held", false)) {
    return tr("Without %1 the condition number falls from %2 to the limit, for an error of only %3 µm more.")
        .arg(ui::listText(left))
        .arg(without, 0, 'f', 0)
        .arg(cost_um, 0, 'f', 2);
  }
  const int remaining = proposed - static_cast<int>(left.size());
  const QString alike = tr("They are much alike: condition number %1, limit %2.")
                            .arg(without, 0, 'f', 0)
                            .arg(report::limits::condition_number, 0, 'f', 0);
  if (oneCycle) return ui::sentencesText({alike, tr("Within the limit only %n would remain.", nullptr, remaining)});
  if (condition.value("fewer_than_clusters", false)) {
    return ui::sentencesText(
        {alike, tr("Within the limit only %n would remain, fewer than there are clusters.", nullptr, remaining)});
  }
  return ui::sentencesText(
      {alike, tr("Within the limit only %n would remain, for an error of %1 µm more.", nullptr, remaining)
                  .arg(cost_um, 0, 'f', 2)});
}

void SensorsPresenter::fillSeries(ui::SensorsState& state) const {
  const recording::Recording& run = bench().warmupRun();
  if (run.rows() == 0) return;
  const std::size_t stride = run.rows() / most_points + 1;
  for (std::size_t r = 0; r < run.rows(); r += stride) state.time_s.append(run.time_s[r]);
  for (const auto& row : state.sensors) {
    const auto* channel = run.find(row.id.toStdString());
    state.temperatures.append(channel == nullptr ? QVector<double>() : standardised(channel->values, stride));
  }
}

void SensorsPresenter::refresh() {
  ui::SensorsState state;
  if (!bench().has("warmup")) {
    state.blocked = tr("Record a warm-up run first: the sensors are chosen from it.");
  } else if (const json& body = bench().body("sensors"); body.is_object()) {
    fill(state, body);
    fillSeries(state);
  }
  m_page->setState(state);
}

void SensorsPresenter::tour(std::function<void(bool good)> done) {
  whenIdle([this, done = std::move(done)] {
    if (bench().has("sensors")) {
      done(true);
    } else {
      run(asked(), done);
    }
  });
}

}  // namespace zerodrift::desktop
