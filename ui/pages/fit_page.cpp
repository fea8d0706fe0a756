#include "ui/pages/fit_page.h"

#include <cmath>

#include "ui/plots/xy_plot.h"
#include "ui/widgets/card.h"
#include "ui/widgets/data_table.h"
#include "ui/widgets/figure_card.h"
#include "ui/widgets/legend_row.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/toggle_segment.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

PartStyle curve(const QString& tag, const QColor& color, double width) {
  PartStyle style;
  style.tag = tag;
  style.unit = "µm";
  style.color = color;
  style.width = width;
  return style;
}

}  // namespace

FitPage::FitPage(QWidget* parent) : Page("fit", parent) {
  m_plotCard = new Card(this);
  m_plotCard->setBodyMargins(6, 0, 6, 6);
  m_direction = new ToggleSegment(m_plotCard);
  m_view = new ToggleSegment(m_plotCard);
  m_plotCard->tools()->addWidget(m_view);
  m_plotCard->tools()->addWidget(m_direction);
  m_prediction = new XyPlot(m_plotCard);
  m_overTime = new XyPlot(m_plotCard);
  m_overTemperature = new XyPlot(m_plotCard);
  m_histogram = new XyPlot(m_plotCard);
  for (XyPlot* plot : {m_prediction, m_overTime}) plot->setTimeAxis(true);
  auto* residuals = new QWidget(m_plotCard);
  auto* grid = new QGridLayout(residuals);
  grid->setContentsMargins(0, 0, 0, 0);
  grid->addWidget(m_overTime, 0, 0, 1, 2);
  grid->addWidget(m_overTemperature, 1, 0);
  grid->addWidget(m_histogram, 1, 1);
  m_views = new QStackedWidget(m_plotCard);
  m_views->addWidget(m_prediction);
  m_views->addWidget(residuals);
  m_legend = new LegendRow(m_plotCard);
  m_plotCard->body()->addWidget(m_legend);
  m_plotCard->body()->addWidget(m_views, 1);

  m_methodCard = new Card(this);
  m_methodCard->setBodyMargins(1, 0, 1, 6);
  m_methods = new DataTable(m_methodCard);
  m_methodCard->body()->addWidget(m_methods, 1);
  m_why = new WrapLabel(m_methodCard);
  m_why->setProperty("role", "caption");
  m_why->setContentsMargins(12, 0, 12, 0);
  m_methodCard->body()->addWidget(m_why);
  m_wordCard = new Card(this);
  m_headline = new WrapLabel(m_wordCard);
  m_headline->setProperty("role", "strong");
  m_advice = new WrapLabel(m_wordCard);
  m_advice->setProperty("role", "muted");
  m_wordCard->body()->addWidget(m_headline);
  m_wordCard->body()->addWidget(m_advice);

  auto* right = new QVBoxLayout;
  right->setSpacing(16);
  right->addWidget(m_methodCard, 1);
  right->addWidget(m_wordCard);
  m_methodCard->setFixedWidth(420);
  m_wordCard->setFixedWidth(420);
  auto* row = new QHBoxLayout;
  row->setSpacing(16);
  row->addWidget(m_plotCard, 1);
  row->addLayout(right);
  content()->addLayout(row, 1);
  connect(m_direction, &ToggleSegment::currentChanged, this, [this] { refresh(); });
  connect(m_view, &ToggleSegment::currentChanged, this, [this](int index) {
    m_views->setCurrentIndex(index);
    refresh();
  });
  const auto choose = [this](int chosen) {
    if (chosen >= 0 && chosen < m_state.methods.size()) Q_EMIT methodChosen(m_state.methods[chosen].id);
  };
  connect(m_methods, &DataTable::rowSelected, this, choose);
  refresh();
}

void FitPage::setState(const FitState& state) {
  m_state = state;
  refresh();
}

QString FitPage::title() const {
  return tr("Fit");
}

QString FitPage::sentence() const {
  if (!m_state.blocked.isEmpty()) return notYet();
  return tr("Judge the model on stretches it has not seen. Only then is it worth writing to the machine.");
}

PageAction FitPage::primary() const {
  const bool ready = m_state.blocked.isEmpty();
  switch (m_state.standing) {
    case FitStanding::none:
      return {"primary", tr("Fit the model"), ready, m_state.blocked,
              tr("Finds how the errors follow the chosen sensors, and tests it on stretches it has not seen")};
    case FitStanding::stale:
      return {"primary", tr("Fit again"), ready, m_state.blocked,
              tr("The sensors or the recordings have changed since the last fit")};
    case FitStanding::current:
      break;
  }
  return {"primary", tr("Use this model"), ready, m_state.blocked, tr("Goes on: the table is made of this model")};
}

QVector<PageAction> FitPage::secondary() const {
  if (!m_state.blocked.isEmpty()) return {};
  return {
      {"update", tr("Update by a new run…"), m_state.standing != FitStanding::none, tr("Fit a model first."),
       tr("Machines age. A recording of half an hour corrects this model instead of starting over: what it does not "
          "excite stays as it was.")}};
}

QVector<Figure> FitPage::figures() const {
  Figure peak =
      figureAtMost(tr("Attainable peak error"), m_state.attainablePeak_um, 1, "µm", m_state.attainableLimit_um);
  peak.tip = tr("Largest single error of the worst axis that stays on unseen stretches.");
  Figure validity = figureOf(tr("Valid"), NAN, 0, {}, m_state.validityLimits);
  validity.value = m_state.validity;
  return {peak, figureAtLeast(tr("Removed"), m_state.removed_percent, 0, "%", m_state.removedTarget_percent),
          figureAtLeast(tr("Band coverage"), m_state.coverage_percent, 0, "%", m_state.coverageTarget_percent),
          validity};
}

QVector<Span> FitPage::spans() const {
  QVector<Span> spans;
  for (const FitStretch& stretch : m_state.stretches) {
    QColor color = stretch.training ? QColor(0, 0, 0, 0) : colors().soft(colors().accent);
    spans.append({stretch.from_s, stretch.to_s, color, stretch.training ? tr("fitted") : tr("unseen")});
  }
  return spans;
}

void FitPage::render() {
  if (!m_state.blocked.isEmpty()) {
    showEmpty(Icon::chart, tr("No model yet"), m_state.blocked);
    return;
  }
  showContent();
  setFigures(figures());
  m_view->setItems({tr("Prediction"), tr("Residuals")});
  QStringList names;
  for (const FitSeries& series : m_state.series) names.append(series.name);
  {
    const QSignalBlocker quiet(m_direction);
    m_direction->setItems(names);
  }
  const bool residuals = m_views->currentIndex() == 1;
  // More directions than the axes need the room of the heading.
  const bool crowded = m_state.series.size() > 3;
  m_plotCard->setTitle(crowded ? QString() : residuals ? tr("Residuals") : tr("Measured and predicted"));
  const int index =
      std::clamp(m_direction->currentIndex(), 0, std::max(0, static_cast<int>(m_state.series.size()) - 1));
  m_plotCard->setSubtitle(names.isEmpty() ? QStringLiteral("µm") : QStringLiteral("%1, µm").arg(names[index]));
  renderMethods();
  renderWords();
  if (m_state.series.isEmpty()) {
    m_legend->setItems({});
    for (XyPlot* plot : {m_prediction, m_overTime, m_overTemperature, m_histogram}) {
      plot->clear();
      plot->setSpans({});
    }
    return;
  }
  if (residuals) {
    renderResiduals(m_state.series[index]);
  } else {
    renderPrediction(m_state.series[index]);
  }
}

void FitPage::renderPrediction(const FitSeries& series) {
  const Colors& c = colors();
  m_legend->setItems(
      {{tr("measured"), c.text}, {tr("predicted"), c.accent}, {tr("prediction band"), c.accent, false, true}});
  m_prediction->setSpans(spans());
  m_prediction->setBand("0band", series.time_s, series.low_um, series.high_um, c.accent);
  PartStyle measured = curve(tr("Measured"), c.text, 1.2);
  measured.points = series.time_s.size() < 150;
  measured.pointSize = 4;
  m_prediction->setPart("1measured", series.time_s, series.measured_um, measured);
  m_prediction->setPart("2predicted", series.time_s, series.predicted_um, curve(tr("Predicted"), c.accent, 2.0));
}

void FitPage::renderResiduals(const FitSeries& series) {
  const Colors& c = colors();
  QVector<double> residuals;
  for (int i = 0; i < series.measured_um.size() && i < series.predicted_um.size(); ++i) {
    residuals.append(series.measured_um[i] - series.predicted_um[i]);
  }
  m_legend->setItems({{tr("measured - predicted"), c.accent}});
  m_overTime->setSpans(spans());
  m_overTime->setAxisLabels(tr("time"), {});
  m_overTime->setPart("residual", series.time_s, residuals, curve(tr("Residual"), c.accent, 1.2));
  m_overTemperature->setAxisLabels(tr("leading sensor / °C"), {});
  PartStyle cloud = curve(tr("Residual"), c.accent, 1.0);
  cloud.line = false;
  cloud.points = true;
  cloud.pointSize = 3.5;
  m_overTemperature->setPart("residual", series.temperature_C, residuals, cloud);
  renderHistogram(residuals);
}

void FitPage::renderHistogram(const QVector<double>& residuals) {
  QVector<double> known;
  std::copy_if(residuals.begin(), residuals.end(), std::back_inserter(known), [](double r) { return !std::isnan(r); });
  m_histogram->setAxisLabels(tr("residual / µm"), {});
  m_histogram->setIncludeZero(true);
  m_histogram->clear();
  if (known.size() < 3) return;
  const auto [low, high] = std::minmax_element(known.begin(), known.end());
  const int bins = std::clamp(static_cast<int>(std::sqrt(static_cast<double>(known.size()))), 5, 31);
  const double width = std::max((*high - *low) / bins, 1e-9);
  QVector<double> centre(bins);
  QVector<double> count(bins, 0.0);
  for (int i = 0; i < bins; ++i) centre[i] = *low + (i + 0.5) * width;
  for (const double r : known) count[std::clamp(static_cast<int>((r - *low) / width), 0, bins - 1)] += 1.0;
  m_histogram->setBars("histogram", centre, count, 0.9 * width, mix(colors().panel, colors().accent, 0.7));
}

void FitPage::renderMethods() {
  m_methodCard->setTitle(tr("Methods"));
  m_methodCard->setSubtitle(tr("on unseen stretches, mean of the axes"));
  m_methods->setColumns(
      {{tr("Method"), 0, false, {}},
       {tr("rms"), 62, true, tr("Root mean square of what is left")},
       {tr("Peak"), 70, true, {}},
       {tr("Band"), 52, true, tr("Share of the measurements inside the stated band")},
       {tr("Runs on"), 80, false,
        tr("Controller: it can compute the model itself. Host: this computer must stay connected.")}});
  QVector<QVector<DataCell>> rows;
  int chosen = -1;
  for (const MethodRow& method : m_state.methods) {
    if (method.id == m_state.method) chosen = static_cast<int>(rows.size());
    DataCell name;
    name.text = method.name;
    name.strong = method.id == m_state.method;
    name.judged = method.id == m_state.proposed;
    name.judgement = name.judged ? Judgement::ok : Judgement::none;
    name.tip = name.judged ? tr("Proposed: %1").arg(method.why) : method.why;
    const auto um = [](double value) {
      return DataCell{std::isnan(value) ? QStringLiteral("–") : fixedText(value, 2) + " µm"};
    };
    DataCell coverage;
    coverage.text =
        std::isnan(method.coverage_percent) ? QStringLiteral("–") : fixedText(method.coverage_percent, 0) + " %";
    rows.append({name, um(method.unseen_um), um(method.peak_um), coverage,
                 DataCell{method.onController ? tr("controller") : tr("host")}});
  }
  m_methods->setRows(rows);
  if (chosen >= 0) m_methods->selectRow(chosen);
  const QString why = chosen < 0 ? QString() : m_state.methods[chosen].why;
  m_why->setText(why.isEmpty() ? QString() : tr("Why: %1.").arg(why));
}

void FitPage::renderWords() {
  m_wordCard->setTitle(tr("What to expect"));
  if (m_state.standing == FitStanding::stale) {
    m_headline->setText(tr("Out of date: %1 changed after this model was fitted. Fit again.").arg(m_state.changed));
  } else if (std::isnan(m_state.attainableRms_um)) {
    m_headline->setText(tr("Choose a method to see what it will leave."));
  } else if (m_state.oneCycle) {
    m_headline->setText(
        tr("Left %1 µm rms in the worst axis on the end of the run; one cycle says nothing about other speeds.")
            .arg(m_state.attainableRms_um, 0, 'f', 1));
  } else if (std::isnan(m_state.attainable90_um)) {
    m_headline->setText(
        tr("Will leave %1 µm rms in the worst axis at speeds like these.").arg(m_state.attainableRms_um, 0, 'f', 1));
  } else {
    m_headline->setText(tr("Will leave %1 µm rms in the worst axis (90 %: %2 µm) at speeds like these.")
                            .arg(m_state.attainableRms_um, 0, 'f', 1)
                            .arg(m_state.attainable90_um, 0, 'f', 1));
  }
  QStringList lines;
  if (!m_state.updatedBy.isEmpty()) lines.append(tr("Corrected by the newer run %1.").arg(m_state.updatedBy));
  if (!m_state.sensors.isEmpty()) lines.append(tr("From %1.").arg(listText(m_state.sensors)));
  lines += m_state.advice;
  m_advice->setText(lines.join('\n'));
}

}  // namespace zerodrift::ui
