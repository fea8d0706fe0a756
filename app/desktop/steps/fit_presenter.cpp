#include "app/desktop/steps/fit_presenter.h"

#include <QDir>
#include <QFileDialog>
#include <algorithm>
#include <cmath>
#include <limits>

#include "app/text/core_text.h"
#include "app/text/error_text.h"
#include "core/analysis/figures.h"
#include "core/analysis/predict.h"
#include "core/flow/flow.h"
#include "core/flow/steps/fit_step.h"
#include "core/flow/steps/inputs.h"
#include "core/recording/csv.h"
#include "core/report/limits.h"
#include "ui/pages/fit_page.h"
#include "ui/widgets/number_text.h"

namespace zerodrift::desktop {

using nlohmann::json;

namespace {

QString method_name(analysis::Method method) {
  return QString::fromUtf8(analysis::name_of(method).data());
}

/// Measured and predicted with the band, where it was measured.
ui::FitSeries series_of(const recording::Recording& run, const recording::Recording& prediction,
                        const std::string& error, const std::string& sensor) {
  ui::FitSeries series;
  const auto* measured = run.find(error);
  const auto* predicted = prediction.find(error);
  const auto* low = prediction.find(error + "_low");
  const auto* high = prediction.find(error + "_high");
  const auto* temperature = run.find(sensor);
  if (measured == nullptr || predicted == nullptr) return series;
  for (std::size_t r = 0; r < run.rows(); ++r) {
    if (std::isnan(measured->values[r])) continue;
    const double value = predicted->values[r];
    series.time_s.append(run.time_s[r]);
    series.measured_um.append(measured->values[r]);
    series.predicted_um.append(value);
    series.low_um.append(low == nullptr ? value : low->values[r]);
    series.high_um.append(high == nullptr ? value : high->values[r]);
    series.temperature_C.append(temperature == nullptr ? std::nan("") : temperature->values[r]);
  }
  return series;
}

/// Share of the errors left out that were inside the band, of the worst axis; not a number where no band is stated.
double coverage_percent(const analysis::Model& model) {
  double coverage = 1.0;
  for (const auto& error : model.errors) {
    if (error.band.guaranteed_coverage <= 0.0) return std::numeric_limits<double>::quiet_NaN();
    coverage = std::min(coverage, error.band.measured_coverage);
  }
  return 100.0 * coverage;
}

/// Every method that was tried on the same run and sensors: choosing one takes none of the others away. The figures are
/// those of its latest trial; `proposed` becomes what the fit takes when nobody asks for a method.
QVector<ui::MethodRow> methods_of(Workbench& bench, const commissioning::Artefact& latest, QString& proposed) {
  QVector<ui::MethodRow> rows;
  const auto history = bench.job()->history(latest.kind);
  if (!history) return rows;
  for (const auto& artefact : *history) {
    if (artefact.input_hash != latest.input_hash) continue;
    const auto model = flow::model_of(artefact);
    if (!model) continue;
    if (model->asked == analysis::Method::automatic || proposed.isEmpty()) proposed = method_name(model->method);
    for (const auto& candidate : model->candidates) {
      ui::MethodRow row;
      row.id = method_name(candidate.method);
      row.name = bench.inWords(candidate.label);
      row.unseen_um = candidate.held_out_rms_um;
      row.peak_um = candidate.held_out_peak_um;
      row.onController = candidate.runs_on_controller;
      if (candidate.chosen) {
        row.why = bench.inWords(model->reason);
        row.coverage_percent = coverage_percent(*model);
      }
      const auto same = std::find_if(rows.begin(), rows.end(), [&](const ui::MethodRow& r) { return r.id == row.id; });
      if (same == rows.end()) {
        rows.append(row);
      } else {
        if (row.why.isEmpty()) row.why = same->why;
        if (std::isnan(row.coverage_percent)) row.coverage_percent = same->coverage_percent;
        *same = row;
      }
    }
  }
  return rows;
}

/// What can be asked for before anything was tried, or after a fit that failed.
void offerUntried(ui::FitState& state) {
  for (const auto method : {analysis::Method::ridge, analysis::Method::mlr, analysis::Method::dynamic}) {
    const QString id = method_name(method);
    if (std::any_of(state.methods.begin(), state.methods.end(), [&](const auto& row) { return row.id == id; }))
      continue;
    ui::MethodRow row;
    row.id = id;
    row.name = coreText(id);
    row.onController = analysis::is_static(method);
    state.methods.append(row);
  }
}

/// One cycle: where the end of the run was left out, the curve is that of the fit that did not see it.
void show_left_out(const analysis::Model& model, const recording::Recording& run, ui::FitState& state) {
  const auto figures = analysis::fit_figures(model, {run});
  if (!figures) return;
  double split_s = run.time_s.back();
  for (std::size_t e = 0; e < figures->size() && static_cast<qsizetype>(e) < state.series.size(); ++e) {
    const analysis::FitFigure& figure = (*figures)[e];
    ui::FitSeries& series = state.series[static_cast<qsizetype>(e)];
    std::size_t block = 0;
    for (qsizetype i = 0; i < series.time_s.size(); ++i) {
      const double time_s = series.time_s[i];
      while (block + 1 < figure.time_s.size() &&
             std::abs(figure.time_s[block + 1] - time_s) <= std::abs(figure.time_s[block] - time_s)) {
        ++block;
      }
      if (figure.time_s.empty() || !std::isfinite(figure.left_out_um[block])) continue;
      const double shift_um = figure.left_out_um[block] - figure.predicted_um[block];
      series.predicted_um[i] += shift_um;
      series.low_um[i] += shift_um;
      series.high_um[i] += shift_um;
      split_s = std::min(split_s, time_s);
    }
  }
  state.stretches = {{run.time_s.front(), split_s, true}, {split_s, run.time_s.back(), false}};
}

}  // namespace

FitPresenter::FitPresenter(Workbench& bench, ui::FitPage* page) : Presenter(bench, page), m_page(page) {
  connect(page, &ui::FitPage::methodChosen, this, [this](const QString& method) {
    if (this->bench().tasks().running()) return;
    if (this->bench().has("model")) m_undo.push_back(asked());
    run(method.toStdString(), {});
  });
  connect(page, &ui::Page::secondaryTriggered, this, [this](const QString&) {
    const QString path = QFileDialog::getOpenFileName(m_page, tr("Recording of a newer run"), this->bench().folder(),
                                                      tr("Recordings (*.csv)"));
    if (path.isEmpty() || this->bench().tasks().running()) return;
    m_undo.push_back(asked());  // undone by fitting as before
    update(path.toStdString(), {});
  });
  connect(page, &ui::Page::primaryTriggered, this, [this] {
    if (m_page->state().standing == ui::FitStanding::current) {
      Q_EMIT nextRequested();
    } else {
      run(asked(), {});
    }
  });
}

std::string FitPresenter::asked() {
  const auto job = bench().job();
  const auto options =
      job == nullptr ? flow::FitStepOptions{} : flow::fit_asked_for(*job).value_or(flow::FitStepOptions{});
  return options.method;
}

void FitPresenter::enter() {
  refresh();
  if (bench().has("sensors") && !bench().has("model") && !bench().tasks().running()) run(asked(), {});
}

void FitPresenter::undo() {
  if (m_undo.empty() || bench().tasks().running()) return;
  const std::string before = m_undo.back();
  m_undo.pop_back();
  run(before, {});
}

void FitPresenter::run(const std::string& method, std::function<void(bool good)> done) {
  if (bench().job() == nullptr) return;
  runStep(
      tr("Fitting the model"),
      [method](commissioning::Job& job, const TaskContext& context) { return flow::fit_model(job, {method}, context); },
      std::move(done));
}

void FitPresenter::update(const std::string& recording, std::function<void(bool good)> done) {
  if (bench().job() == nullptr) return;
  runStep(
      tr("Updating the model"),
      [recording](commissioning::Job& job, const TaskContext&) -> Result<commissioning::NewArtefact> {
        ZD_TRY(const auto run, recording::read_recording(recording));
        return flow::update_model(job, run);
      },
      std::move(done));
}

void FitPresenter::fill(ui::FitState& state) {
  const auto artefact = bench().job()->latest("model");
  if (!artefact || !*artefact) return;
  const auto model = flow::model_of(**artefact);
  const auto warmup = flow::need(*bench().job(), "fit", "warmup");
  if (!model || !warmup) return;
  state.method = method_name(model->method);
  double peak = 0.0;
  double rms = 0.0;
  for (const auto& error : model->errors) {
    peak = std::max(peak, error.held_out.peak_um);
    rms = std::max(rms, error.held_out.rms_um);
    // Of the same residuals as peak and rms. The band promises more and is wider.
    state.attainable90_um = std::fmax(state.attainable90_um, error.held_out.p90_um);
  }
  const double range = model->quality.error_range_um;
  state.attainablePeak_um = peak;
  state.attainableLimit_um = report::limits::attainable_peak_um;
  state.removedTarget_percent = report::limits::removed_percent;
  state.coverageTarget_percent = report::limits::coverage_percent;
  state.attainableRms_um = rms;
  state.coverage_percent = coverage_percent(*model);
  state.oneCycle = model->quality.cycles < 2;
  if (range > 0) state.removed_percent = 100.0 * std::max(0.0, 1.0 - peak / range);
  for (const auto& sensor : model->sensors) state.sensors << bench().channelInWords(sensor);
  const auto body = bench().body("model");
  const std::size_t fitted = 1 + body.value("fitted_too", nlohmann::json::array()).size();
  if (model->recordings.size() > fitted) state.updatedBy = QString::fromStdString(model->recordings.back());
  state.proposed.clear();
  state.methods = methods_of(bench(), **artefact, state.proposed);
  double low = 1e9;
  double high = -1e9;
  for (std::size_t i = 0; i < model->domain.channels.size(); ++i) {
    const auto kind = recording::kind_of(model->domain.channels[i]);
    if (kind == recording::ChannelKind::temperature || kind == recording::ChannelKind::ambient) {
      low = std::min(low, model->domain.low[i]);
      high = std::max(high, model->domain.high[i]);
    } else if (kind == recording::ChannelKind::speed) {
      state.validityLimits =
          tr("%1 to %2 rpm").arg(model->domain.low[i], 0, 'f', 0).arg(model->domain.high[i], 0, 'f', 0);
    }
  }
  if (high > low) state.validity = tr("%1 to %2 °C").arg(low, 0, 'f', 0).arg(high, 0, 'f', 0);
  for (const auto& test : body.value("tests", nlohmann::json::array())) {
    QStringList left;
    for (const auto& error : test.value("errors", nlohmann::json::array())) {
      const double rms_um = error["rms_um"].is_number() ? error["rms_um"].get<double>() : std::nan("");
      left << QStringLiteral("%1 %2 µm").arg(bench().tagOf(error.value("channel", ""))).arg(rms_um, 0, 'f', 1);
    }
    if (left.isEmpty()) continue;
    state.advice << tr("On %1, another day that it has not seen, it leaves (rms): %2.")
                        .arg(QString::fromStdString(test.value("recording", "")), ui::listText(left));
  }
  for (const auto& advice : model->quality.advice) state.advice << bench().inWords(advice);
  for (const auto& finding : model->findings) state.advice << bench().inWords(analysis::describe(finding));
  const recording::Recording& run = bench().warmupRun();
  const auto prediction = analysis::predict(*model, run);
  if (!prediction) return;
  const std::string sensor = model->sensors.empty() ? "" : model->sensors.front();
  const auto predicted = prediction->to_recording();
  for (const auto& error : model->errors) {
    state.series.append(series_of(run, predicted, error.error, sensor));
    state.series.last().name = bench().tagOf(error.error);
  }
  if (model->quality.cycles < 2) show_left_out(*model, run, state);
}

void FitPresenter::refresh() {
  ui::FitState state;
  const auto job = bench().job();
  if (job == nullptr || !bench().has("sensors")) {
    state.blocked = tr("Choose the sensors first: the model is fitted to them.");
  } else {
    const auto status = flow::status_of(*job, "fit");
    if (status.state == flow::StepState::current) state.standing = ui::FitStanding::current;
    if (status.state == flow::StepState::stale) {
      state.standing = ui::FitStanding::stale;
      state.changed = stepName(status.reason);
    }
    fill(state);
    offerUntried(state);
  }
  m_page->setState(state);
}

void FitPresenter::tour(std::function<void(bool good)> done) {
  whenIdle([this, done = std::move(done)] {
    if (m_page->state().standing == ui::FitStanding::current) {
      done(true);
    } else {
      run("auto", done);
    }
  });
}

}  // namespace zerodrift::desktop
