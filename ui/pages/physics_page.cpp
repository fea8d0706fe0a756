#include "ui/pages/physics_page.h"

#include <cmath>

#include "ui/pages/explanation_card.h"
#include "ui/plots/live_plot.h"
#include "ui/widgets/card.h"
#include "ui/widgets/channel_table.h"
#include "ui/widgets/data_table.h"
#include "ui/widgets/figure_card.h"
#include "ui/widgets/legend_row.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/toggle_segment.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {

PhysicsPage::PhysicsPage(QWidget* parent) : Page("physics", parent) {
  m_mapCard = new Card(this);
  m_mapCard->setBodyMargins(6, 0, 6, 6);
  m_component = new ToggleSegment(m_mapCard);
  m_view = new ToggleSegment(m_mapCard);
  m_mapCard->tools()->addWidget(m_component);
  m_mapCard->tools()->addWidget(m_view);

  m_views = new QStackedWidget(m_mapCard);
  for (QWidget* view : {makeWhere(), makeCompare(), makeTrial()}) m_views->addWidget(view);
  m_mapCard->body()->addWidget(m_views, 1);
  auto* right = new QVBoxLayout;
  right->setSpacing(16);
  right->addWidget(makeExplanations(), 1);
  right->addWidget(makeExperiment());
  auto* row = new QHBoxLayout;
  row->setSpacing(16);
  row->addWidget(m_mapCard, 1);
  row->addLayout(right);
  content()->addLayout(row, 1);
  connect(m_view, &ToggleSegment::currentChanged, this, [this](int index) {
    m_views->setCurrentIndex(index);
    refresh();
  });
  connect(m_component, &ToggleSegment::currentChanged, this, &PhysicsPage::componentChosen);
  refresh();
}

QWidget* PhysicsPage::makeWhere() {
  auto* where = new QWidget(m_mapCard);
  auto* whereLayout = new QVBoxLayout(where);
  whereLayout->setContentsMargins(0, 0, 0, 0);
  whereLayout->setSpacing(0);
  m_drawing = new ComponentDrawing(where);
  m_map = new HeatMap(where);
  m_map->setPositionAcross(true);
  m_drawing->setScale([this](double position_mm) { return m_map->positionToPixel(position_mm); });
  m_region = new WrapLabel(where);
  m_region->setProperty("role", "ok");
  m_region->setContentsMargins(10, 0, 10, 4);
  whereLayout->addWidget(m_region);
  whereLayout->addWidget(m_drawing);
  whereLayout->addWidget(m_map, 1);
  connect(m_map, &HeatMap::layoutChanged, m_drawing, qOverload<>(&QWidget::update));
  return where;
}

QWidget* PhysicsPage::makeCompare() {
  auto* compare = new QWidget(m_mapCard);
  auto* compareLayout = new QHBoxLayout(compare);
  compareLayout->setContentsMargins(0, 0, 0, 0);
  auto* plots = new QVBoxLayout;
  m_channelPlot = new LivePlot(compare);
  m_residualPlot = new LivePlot(compare);
  m_channelPlot->linkTime(m_residualPlot);
  m_channelLegend = new LegendRow(compare);
  plots->addWidget(m_channelLegend);
  plots->addWidget(m_channelPlot, 3);
  plots->addWidget(m_residualPlot, 2);
  m_channelTable = new ChannelTable(compare);
  m_channelTable->setFixedWidth(246);
  m_channelTable->setColumnWidths(70, 66);
  compareLayout->addLayout(plots, 1);
  compareLayout->addWidget(m_channelTable);
  connect(m_channelTable, &ChannelTable::selected, this, [this] { renderChannel(); });
  return compare;
}

QWidget* PhysicsPage::makeTrial() {
  auto* trial = new QWidget(m_mapCard);
  auto* trialLayout = new QVBoxLayout(trial);
  m_trialWords = new WrapLabel(trial);
  m_trials = new DataTable(trial);
  m_trialPlot = new LivePlot(trial);
  m_trialLegend = new LegendRow(trial);
  trialLayout->setSpacing(6);
  trialLayout->addWidget(m_trialWords);
  constexpr int steps = 4;
  for (int i = 0; i < steps; ++i) {
    m_trialSteps.append(new WrapLabel(trial));
    trialLayout->addWidget(m_trialSteps.last());
  }
  trialLayout->addWidget(m_trialLegend);
  trialLayout->addWidget(m_trialPlot, 3);
  trialLayout->addWidget(m_trials, 2);
  return trial;
}

QWidget* PhysicsPage::makeExplanations() {
  m_sideCard = new Card(this);
  m_sideCard->setFixedWidth(372);
  m_sideCard->setBodyMargins(16, 0, 8, 8);
  m_verdict = new WrapLabel(m_sideCard);
  m_scroll = new QScrollArea(m_sideCard);
  m_scroll->setWidgetResizable(true);
  m_scroll->setProperty("role", "plain");
  m_scroll->setFrameShape(QFrame::NoFrame);
  m_scroll->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  auto* list = new QWidget;
  list->setObjectName("explanations");
  m_explanationLayout = new QVBoxLayout(list);
  m_explanationLayout->setContentsMargins(0, 0, 8, 0);
  m_explanationLayout->setSpacing(10);
  m_explanationLayout->addStretch();
  m_scroll->setWidget(list);
  m_sideCard->body()->addWidget(m_verdict);
  m_sideCard->body()->addWidget(m_scroll, 1);
  return m_sideCard;
}

QWidget* PhysicsPage::makeExperiment() {
  m_experiment = new Card(this);
  m_experiment->setFixedWidth(372);
  m_experimentText = new WrapLabel(m_experiment);
  m_experimentButton = new QPushButton(m_experiment);
  m_experimentButton->setObjectName("experiment");
  m_experiment->body()->addWidget(m_experimentText);
  m_experiment->body()->addWidget(m_experimentButton, 0, Qt::AlignLeft);
  connect(m_experimentButton, &QPushButton::clicked, this, &PhysicsPage::experimentRequested);
  return m_experiment;
}

void PhysicsPage::setState(const PhysicsState& state) {
  m_state = state;
  refresh();
}

void PhysicsPage::showView(int index) {
  m_view->setCurrentIndex(index);
}

QString PhysicsPage::title() const {
  return tr("Physics");
}

QString PhysicsPage::sentence() const {
  if (!m_state.blocked.isEmpty()) return notYet();
  if (m_state.undescribed) return tr("Say what the machine is: then its heat is simulated and compared.");
  switch (m_state.verdict) {
    case PhysicsVerdict::none:
      return tr("The run is simulated from the machine's description. Let the program find what the simulation lacks.");
    case PhysicsVerdict::consistent:
      return tr(
          "Within the tolerances of its description the simulation agrees with the recording. Nothing needs to be "
          "added.");
    case PhysicsVerdict::missingEffect:
      return m_state.adopted
                 ? tr("Map, curves and figures hold what was adopted. Go on, or take it out again.")
                 : tr("Something is missing in the simulation. Judge the explanations; adopt what convinces.");
    case PhysicsVerdict::unexplained:
      if (m_state.adopted)
        return tr("Map, curves and figures hold what was adopted; the rest no known effect explains.");
      return m_state.explanations.isEmpty()
                 ? tr("Something is missing that no known effect explains. It is shown, not guessed.")
                 : tr("A part is explained, at the right. The rest no known effect explains: it is shown, not "
                      "guessed.");
  }
  return {};
}

PageAction PhysicsPage::primary() const {
  if (m_state.undescribed)
    return {"primary",
            tr("Describe the machine"),
            true,
            {},
            tr("A form for parts, sizes, heat sources and sensors, drawn as they are entered")};
  if (m_state.verdict == PhysicsVerdict::none || !m_state.blocked.isEmpty()) {
    return {"primary", tr("Find what is missing"), m_state.blocked.isEmpty(), m_state.blocked,
            tr("Compares the recording with the described machine and seeks effects that explain the difference")};
  }
  return {"primary", tr("Go on"), true, {}};
}

QVector<PageAction> PhysicsPage::secondary() const {
  if (!m_state.blocked.isEmpty()) return {};
  const PageAction lumps = {"lumps",
                            tr("Use a lump for each sensor"),
                            true,
                            {},
                            tr("A start without a drawing: each sensor is a body of its own, its sizes are found")};
  if (m_state.undescribed)
    return {{"load", tr("Open machine.json"), true, {}, tr("A description that was made before")}, lumps};
  const TrialStage stage = m_state.trial.stage;
  const bool running = stage == TrialStage::sealed || stage == TrialStage::searching;
  QVector<PageAction> actions;
  // Leftmost, so that no button takes its place when it comes or goes.
  if (stage != TrialStage::none) {
    actions.append({"open", tr("Open the seal"), stage == TrialStage::answered,
                    running ? tr("The seal is opened when the answer is given.") : tr("The seal is open.")});
  }
  actions.append({"trial", tr("Blind trial"), !running && stage != TrialStage::answered,
                  running ? tr("A blind trial is running.") : tr("Open the seal of this trial first."),
                  tr("The virtual machine hides an effect; the program has to find it")});
  actions.append({"region",
                  tr("Find sensor region"),
                  true,
                  {},
                  tr("Where on the component a sensor follows the "
                     "deformation best")});
  actions.append(
      {"describe",
       tr("Edit description"),
       true,
       {},
       tr("Simulated is %1. It is changed here, or a machine.json takes its place").arg(m_state.description)});
  if (m_state.verdict != PhysicsVerdict::none) {
    actions.append({"find",
                    tr("Search again"),
                    true,
                    {},
                    tr("Seeks the effects anew, with the recordings and the description as they are now")});
  }
  return actions;
}

QVector<Figure> PhysicsPage::figures() const {
  // The limit follows from the sensors' noise: before that is known there is none.
  const QString label = tr("Simulation error, all sensors");
  Figure agreement = std::isnan(m_state.noise_K)
                         ? figureOf(label, m_state.rmse_K, 2, "K")
                         : figureAtMost(label, m_state.rmse_K, 2, "K", std::ceil(20.0 * m_state.noise_K) / 10.0);
  if (agreement.judgement == Judgement::ok) agreement.word = tr("down to noise");
  if (agreement.judgement == Judgement::bad) agreement.word = tr("something missing");
  if (agreement.judgement == Judgement::bad && m_state.verdict == PhysicsVerdict::consistent) {
    agreement = figureOf(label, m_state.rmse_K, 2, "K", tr("within its tolerances"));
  }
  agreement.tip =
      sentencesText({tr("Recorded less simulated, rms over all temperatures; a card tells of one channel."),
                     m_state.adopted ? tr("With what was adopted.")
                                     : tr("As the machine is described: with every number at its middle.")});
  Figure noise = figureOf(tr("Noise of the sensors"), m_state.noise_K, 2, "K");
  Figure heat = figureOf(tr("Missing heat"), m_state.missing_W, 0, "W");
  if (m_state.adopted && !heat.value.isEmpty()) heat.word = tr("explained by what was adopted");
  const auto adopted = std::count_if(m_state.explanations.begin(), m_state.explanations.end(),
                                     [](const Explanation& e) { return e.adopted; });
  Figure held = figureOf(tr("On unseen data"), m_state.held_K, 2, "K",
                         adopted > 0 ? tr("with %n adopted", nullptr, static_cast<int>(adopted)) : tr("none adopted"));
  held.tip = tr("The same difference on data that was not used for the search.");
  return {agreement, noise, heat, held};
}

void PhysicsPage::render() {
  if (!m_state.blocked.isEmpty()) {
    showEmpty(Icon::chart, tr("Nothing to compare yet"), m_state.blocked);
    return;
  }
  if (m_state.undescribed) {
    showEmpty(Icon::machine, tr("The machine is not described yet"),
              tr("Enter its parts, heat sources and where each sensor sits; typical values are offered. Or open a "
                 "machine.json. Without a drawing begin with a lump for each sensor."),
              tr("Describe the machine"));
    return;
  }
  showContent();
  setFigures(figures());
  m_view->setItems({tr("Where"), tr("Channels"), tr("Blind trial")});
  // Lumps have no length over which anything could be drawn.
  if (m_state.components.isEmpty() && m_views->currentIndex() == 0 && !m_state.channels.isEmpty()) showView(1);
  QStringList names;
  for (const DrawnComponent& component : m_state.components) names.append(component.name);
  {
    const QSignalBlocker quiet(m_component);
    m_component->setItems(names);
    m_component->setCurrentIndex(m_state.component);
    m_component->setVisible(names.size() > 1 && m_views->currentIndex() == 0);
  }
  const bool residual = m_state.missingHeat.unit == QStringLiteral("K");  // before the search: what the sensors saw
  const QStringList titles = {m_state.adopted ? tr("What is left")
                              : residual      ? tr("Recorded minus simulated")
                                              : tr("Missing heat"),
                              tr("Simulation and recording"), tr("Blind trial")};
  m_mapCard->setTitle(titles.value(m_views->currentIndex()));
  const bool sealed = m_views->currentIndex() == 2 && m_state.trial.stage != TrialStage::none;
  m_mapCard->setSubtitle(m_views->currentIndex() == 0 ? m_state.missingHeat.unit
                         : sealed                     ? QStringLiteral("°C")
                                                      : QString());
  renderMap();
  renderChannels();
  renderExplanations();
  renderTrials();
}

void PhysicsPage::renderMap() {
  m_region->setText(m_state.region);
  m_region->setVisible(!m_state.region.isEmpty());
  m_map->setPlaceholder(m_state.components.isEmpty() ? tr("The description has no rod: see the channels.")
                                                     : tr("Drawn when the search is done"));
  if (m_state.components.isEmpty()) {
    m_drawing->setComponent({});
    m_map->setSensors({});
    m_map->setData({});
  }
  if (m_state.component < m_state.components.size()) {
    const DrawnComponent& component = m_state.components[m_state.component];
    m_drawing->setComponent(component);
    QVector<SensorTick> ticks;
    for (const DrawnSensor& sensor : component.sensors) ticks.append({sensor.tag, sensor.position_mm});
    m_map->setSensors(ticks);
    m_map->setData(m_state.missingHeat);
    m_map->setPositionRange(0.0, component.length_mm);
  }
}

void PhysicsPage::renderChannels() {
  QVector<ChannelRow> rows;
  for (const SimulatedChannel& channel : m_state.channels) {
    ChannelRow row;
    row.id = channel.id;
    row.tag = channel.tag;
    const bool known = !std::isnan(channel.rmse);
    row.value = known ? fixedText(channel.rmse, 2) + ' ' + channel.unit : QStringLiteral("–");
    const double times = channel.rmse / std::max(channel.noise, 1e-9);
    row.judgement = !known || std::isnan(times) ? Judgement::none
                    : times < 2.0               ? Judgement::ok
                    : times < 5.0               ? Judgement::warn
                                                : Judgement::bad;
    row.state = row.judgement == Judgement::ok     ? tr("agrees")
                : row.judgement == Judgement::none ? QString()
                                                   : tr("differs");
    rows.append(row);
  }
  m_channelTable->setHeaders(tr("Channel"), tr("rms"), tr("State"));
  m_channelTable->setRows(rows);
  if (m_channelTable->selectedId().isEmpty() && !rows.isEmpty()) {
    // The channel that disagrees most is the one to look at first.
    const auto worst = std::max_element(m_state.channels.begin(), m_state.channels.end(),
                                        [](const SimulatedChannel& a, const SimulatedChannel& b) {
                                          return a.rmse / std::max(a.noise, 1e-9) < b.rmse / std::max(b.noise, 1e-9);
                                        });
    m_channelTable->select(worst->id);
  }
  renderChannel();
}

void PhysicsPage::renderChannel() {
  const QString id = m_channelTable->selectedId();
  const auto found = std::find_if(m_state.channels.begin(), m_state.channels.end(),
                                  [&](const SimulatedChannel& c) { return c.id == id; });
  if (found == m_state.channels.end()) {
    m_channelLegend->setItems({});
    for (LivePlot* plot : {m_channelPlot, m_residualPlot}) plot->setCurves({});
    return;
  }
  const Colors& c = colors();
  const auto curve = [&](const char* name, const QString& tag, const QColor& color, bool dashed) {
    Curve made;
    made.id = name;
    made.tag = tag;
    made.unit = found->unit;
    made.color = color;
    made.dashed = dashed;
    made.width = 1.6;
    return made;
  };
  m_channelPlot->setCurves({curve("recorded", tr("Recorded"), c.text, false),
                            curve("simulated", tr("Simulated"), c.bad, true),
                            curve("refined", tr("With effects"), c.ok, false)});
  m_channelPlot->setData("recorded", found->time_s, found->recorded);
  m_channelPlot->setData("simulated", found->time_s, found->simulated);
  m_channelPlot->setData("refined", found->time_s, found->refined);
  QVector<LegendItem> legend = {{tr("recorded"), c.text}, {tr("simulated"), c.bad, true}};
  if (!found->refined.isEmpty()) legend.append({tr("adopted"), c.ok});
  m_channelLegend->setItems(legend);
  m_channelPlot->setAxisLabels({}, found->valueUnit);
  m_residualPlot->setAxisLabels({}, tr("difference / %1").arg(found->unit));
  const auto difference = [&](const QVector<double>& model) {
    QVector<double> d;
    for (int i = 0; i < model.size() && i < found->recorded.size(); ++i) d.append(found->recorded[i] - model[i]);
    return d;
  };
  m_residualPlot->setCurves({curve("simulated", tr("Recorded - simulated"), c.bad, false),
                             curve("refined", tr("Recorded - refined"), c.ok, false)});
  m_residualPlot->setData("simulated", found->time_s, difference(found->simulated));
  m_residualPlot->setData("refined", found->time_s, difference(found->refined));
  m_residualPlot->setIncludeZero(true);
}

void PhysicsPage::renderExplanations() {
  m_sideCard->setTitle(tr("Explanations"));
  m_sideCard->setSubtitle(tr("ranked by evidence"));
  QString words = m_state.verdictSentence;
  if (m_state.verdict == PhysicsVerdict::none && words.isEmpty()) words = tr("Not searched yet.");
  m_verdict->setText(words);
  m_verdict->setProperty("role", m_state.verdict == PhysicsVerdict::consistent ? "ok" : "muted");
  m_verdict->style()->unpolish(m_verdict);
  m_verdict->style()->polish(m_verdict);
  while (m_cards.size() > m_state.explanations.size()) delete m_cards.takeLast();
  while (m_cards.size() < m_state.explanations.size()) {
    auto* card = new ExplanationCard(m_scroll->widget());
    m_explanationLayout->insertWidget(static_cast<int>(m_cards.size()), card);
    m_cards.append(card);
    connect(card, &ExplanationCard::adoptClicked, this,
            [this, card](bool adopt) { Q_EMIT adopted(card->effectId(), adopt); });
    connect(card, &ExplanationCard::rejectClicked, this, [this, card] { Q_EMIT rejected(card->effectId()); });
  }
  for (int i = 0; i < m_cards.size(); ++i) m_cards[i]->setExplanation(i + 1, m_state.explanations[i]);
  m_experiment->setTitle(tr("Shortest run that decides"));
  m_experimentText->setText(m_state.nextExperiment);
  m_experimentButton->setText(tr("Put it into the plan"));
  m_experimentButton->setVisible(m_state.nextIsWarmupRun);
  m_experiment->setVisible(!m_state.nextExperiment.isEmpty());
}

void PhysicsPage::renderTrials() {
  const auto right =
      std::count_if(m_state.trials.begin(), m_state.trials.end(), [](const TrialScore& t) { return t.right; });
  m_trialWords->setText(m_state.trials.isEmpty()
                            ? tr("The virtual machine hides one effect and seals its name. Watch the run, see what the "
                                 "search answers, then "
                                 "open the seal. Start with Blind trial above.")
                            : tr("%1 of %2 hidden effects named correctly.").arg(right).arg(m_state.trials.size()));
  const bool begun = m_state.trial.stage != TrialStage::none;
  m_trialWords->setVisible(!begun || !m_state.trials.isEmpty());  // the steps say the same once they go on
  m_trials->setVisible(!m_state.trials.isEmpty());
  m_trials->setColumns({{tr("Hidden"), 0, false, {}},
                        {tr("Answer"), 0, false, {}},
                        {tr("Result"), 110, false, {}},
                        {tr("Improved"), 90, true, {}}});
  QVector<QVector<DataCell>> rows;
  for (const TrialScore& trial : m_state.trials) {
    DataCell result;
    result.text = trial.right ? tr("right") : tr("wrong");
    result.judged = true;
    result.judgement = trial.right ? Judgement::ok : Judgement::bad;
    rows.append({DataCell{trial.effect}, DataCell{trial.answer}, result,
                 DataCell{fixedText(trial.improvement_percent, 0) + " %"}});
  }
  m_trials->setRows(rows);
  m_trials->setMaximumHeight(m_trials->heightOfRows());  // what an almost empty table leaves is the plot's
  renderTrial();
}

void PhysicsPage::renderTrial() {
  const BlindTrial& trial = m_state.trial;
  const bool begun = trial.stage != TrialStage::none;
  const bool answered = trial.stage == TrialStage::answered || trial.stage == TrialStage::opened;
  const bool opened = trial.stage == TrialStage::opened;
  const QString pending = tr("to come");
  const QStringList words = {tr("1. Sealed: %1").arg(trial.seal),
                             tr("2. Run watched: %1 %").arg(100.0 * trial.shown, 0, 'f', 0),
                             tr("3. Answer: %1")
                                 .arg(answered                               ? trial.answer
                                      : trial.stage == TrialStage::searching ? tr("searching")
                                                                             : pending),
                             opened ? tr("4. Seal opened: %1 was hidden. The answer is %2; %3.")
                                          .arg(trial.hidden, trial.right ? tr("right") : tr("wrong"),
                                               trial.kept ? tr("the promise was kept") : tr("the promise was broken"))
                                    : tr("4. Seal: %1").arg(answered ? tr("press Open the seal") : pending)};
  for (int i = 0; i < m_trialSteps.size(); ++i) {
    QLabel* step = m_trialSteps[i];
    step->setVisible(begun);
    step->setText(words[i]);
    const bool last = i == m_trialSteps.size() - 1;
    step->setProperty("role", last && opened       ? (trial.right && trial.kept ? "ok" : "bad")
                              : i == 2 && answered ? "strong"
                                                   : "muted");
    step->style()->unpolish(step);
    step->style()->polish(step);
  }
  m_trialPlot->setVisible(begun);
  m_trialLegend->setVisible(begun);
  if (begun) renderTrialCurves();
}

void PhysicsPage::renderTrialCurves() {
  const Colors& c = colors();
  const bool refined = m_state.trial.stage == TrialStage::answered || m_state.trial.stage == TrialStage::opened;
  QVector<Curve> curves;
  const auto add = [&](const QString& id, const QString& tag, const QColor& color, bool dashed) {
    Curve curve;
    curve.id = id;
    curve.tag = tag;
    curve.unit = QStringLiteral("°C");
    curve.color = color;
    curve.dashed = dashed;
    curves.append(curve);
  };
  for (const TrialCurve& one : m_state.trial.curves) {
    add(one.tag + "/r", one.tag, c.text, false);
    add(one.tag + "/s", tr("%1 simulated").arg(one.tag), c.bad, true);
    if (refined) add(one.tag + "/a", tr("%1 with the answer").arg(one.tag), c.ok, false);
  }
  m_trialPlot->setCurves(curves);
  for (const TrialCurve& one : m_state.trial.curves) {
    const auto count =
        static_cast<qsizetype>(std::lround(m_state.trial.shown * static_cast<double>(one.time_s.size())));
    const QVector<double> time_s = one.time_s.first(count);
    m_trialPlot->setData(one.tag + "/r", time_s, one.recorded.first(std::min(count, one.recorded.size())));
    m_trialPlot->setData(one.tag + "/s", time_s, one.simulated.first(std::min(count, one.simulated.size())));
    if (refined) m_trialPlot->setData(one.tag + "/a", time_s, one.refined.first(std::min(count, one.refined.size())));
  }
  QVector<LegendItem> legend = {{tr("recorded"), c.text}, {tr("simulated"), c.bad, true}};
  if (refined) legend.append({tr("with the answer"), c.ok});
  m_trialLegend->setItems(legend);
}

}  // namespace zerodrift::ui
