#include "ui/pages/run_view.h"

#include <QRegularExpression>
#include <algorithm>
#include <cmath>

#include "ui/widgets/card.h"
#include "ui/widgets/figure_card.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/problem_banner.h"
#include "ui/widgets/toggle_segment.h"

namespace zerodrift::ui {
namespace {

/// Without the counts, which change all the time.
QStringList kindsOf(const QStringList& lines) {
  QStringList kinds;
  static const QRegularExpression figures(QStringLiteral("\\d+"));
  static const QRegularExpression comma(QStringLiteral("[,，]"));  // what follows is how often
  for (const QString& line : lines) kinds << line.section(comma, 0, 0).remove(figures);
  return kinds;
}

}  // namespace

RunView::RunView(QWidget* parent) : QWidget(parent) {
  makePlots();
  makeTables();
  m_right = new QVBoxLayout;
  m_right->setSpacing(16);
  m_right->addWidget(m_cameraCard);
  m_right->addWidget(m_errorCard, 1);
  m_right->addWidget(m_temperatureCard, 1);
  for (Card* card : {m_cameraCard, m_errorCard, m_temperatureCard}) card->setFixedWidth(304);
  auto* row = new QHBoxLayout;
  row->setSpacing(16);
  row->addWidget(m_plotCard, 1);
  row->addLayout(m_right);
  m_banner = new ProblemBanner(this);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->setSpacing(12);
  all->addWidget(m_banner);
  all->addLayout(row, 1);
  connect(m_banner, &ProblemBanner::dismissed, this, [this] { m_dismissed = kindsOf(m_trouble.so_far); });
  connect(m_span, &ToggleSegment::currentChanged, this, [this](int index) {
    static constexpr double spans_s[] = {600.0, 3600.0, 0.0};
    for (LivePlot* each : {m_temperatures, m_errors, m_inputs}) each->setTimeWindow(spans_s[std::clamp(index, 0, 2)]);
  });
  retranslate();
  m_span->setCurrentIndex(2);
}

void RunView::makePlots() {
  m_plotCard = new Card(this);
  m_plotCard->setBodyMargins(6, 0, 4, 4);
  m_plotCard->body()->setSpacing(0);
  m_span = new ToggleSegment(m_plotCard);
  m_plotCard->tools()->addWidget(m_span);
  const auto plot = [this](int stretch, bool addHeading) {
    if (addHeading) {
      auto* heading = new QLabel(m_plotCard);
      heading->setProperty("role", "cardTitle");
      heading->setContentsMargins(10, 2, 0, 0);
      m_plotCard->body()->addWidget(heading);
      m_headings.append(heading);
    }
    auto* made = new LivePlot(m_plotCard);
    made->setNotesWanted(true);
    m_plotCard->body()->addWidget(made, stretch);
    connect(made, &PlotWidget::noteRequested, this, &RunView::noteRequested);
    return made;
  };
  m_temperatures = plot(5, false);
  m_errors = plot(4, true);
  m_inputs = plot(2, true);
  m_temperatures->setSmallestSpan(1.0);
  m_errors->setSmallestSpan(4.0);
  m_errors->setIncludeZero(true);
  m_inputs->setIncludeZero(true);
  m_temperatures->linkTime(m_errors);
  m_temperatures->linkTime(m_inputs);
  m_errors->linkTime(m_inputs);
}

void RunView::makeTables() {
  m_cameraCard = new Card(this);
  m_cameraCard->setBodyMargins(8, 8, 8, 8);
  m_camera = new CameraView(m_cameraCard);
  m_camera->setMinimumHeight(60);
  m_cameraCard->body()->addWidget(m_camera);
  // Gives way first when the window is low.
  m_cameraCard->setMinimumHeight(78);
  m_cameraCard->setMaximumHeight(150);
  const auto table = [this](Card** card) {
    *card = new Card(this);
    (*card)->setBodyMargins(1, 0, 1, 6);
    auto* made = new ChannelTable(*card);
    made->setColumnWidths(86, 70);
    (*card)->body()->addWidget(made);
    return made;
  };
  m_errorTable = table(&m_errorCard);
  m_temperatureTable = table(&m_temperatureCard);
  wire(m_temperatures, m_temperatureTable);
  wire(m_errors, m_errorTable);
}

void RunView::wire(LivePlot* plot, ChannelTable* table) {
  connect(table, &ChannelTable::hovered, plot,
          [plot, table](const QString& id) { plot->highlight(id.isEmpty() ? table->selectedId() : id); });
  connect(table, &ChannelTable::selected, plot, &LivePlot::highlight);
  connect(table, &ChannelTable::visibilityChanged, plot, &LivePlot::setCurveVisible);
  connect(plot, &PlotWidget::clicked, table, [table](const QString& id) { table->select(id); });
}

QVector<Curve> RunView::curvesOf(const QVector<RunChannel>& channels, bool steps) {
  QVector<Curve> curves;
  for (const RunChannel& channel : channels) {
    Curve curve;
    curve.id = channel.id;
    curve.tag = channel.tag;
    curve.unit = channel.unit;
    curve.color = channel.color;
    curve.decimals = channel.decimals;
    curve.dashed = channel.dashed;
    curve.steps = steps;
    curves.append(curve);
  }
  return curves;
}

QVector<ChannelRow> RunView::rowsOf(const QVector<RunChannel>& channels) {
  QVector<ChannelRow> rows;
  for (int i = 0; i < channels.size(); ++i) {
    ChannelRow row;
    row.id = channels[i].id;
    row.tag = channels[i].tag;
    row.tip = channels[i].label;
    row.value = QStringLiteral("–");
    row.color = channels[i].color.isValid() ? channels[i].color : curveColor(i);
    rows.append(row);
  }
  return rows;
}

void RunView::setChannels(const QVector<RunChannel>& temperatures, const QVector<RunChannel>& errors,
                          const QVector<RunChannel>& inputs) {
  m_plotOf.clear();
  m_channels.clear();
  const auto enter = [this](const QVector<RunChannel>& channels, LivePlot* plot) {
    for (const RunChannel& channel : channels) {
      m_plotOf.insert(channel.id, plot);
      m_channels.insert(channel.id, channel);
    }
  };
  enter(temperatures, m_temperatures);
  enter(errors, m_errors);
  enter(inputs, m_inputs);
  m_temperatures->setCurves(curvesOf(temperatures, false));
  m_errors->setCurves(curvesOf(errors, false));
  m_inputs->setCurves(curvesOf(inputs, true));
  m_temperatureTable->setRows(rowsOf(temperatures));
  m_errorTable->setRows(rowsOf(errors));
  // As high as its rows. In a low window many rows scroll, but the three directions are always seen.
  const auto high = [](qsizetype rows) { return 72 + 22 * static_cast<int>(std::max<qsizetype>(1, rows)); };
  m_errorCard->setMinimumHeight(high(std::min<qsizetype>(errors.size(), 3)));
  m_errorCard->setMaximumHeight(high(errors.size()));
  // A recording of heat alone has no errors, one of a machine at rest no inputs.
  for (QWidget* part :
       {static_cast<QWidget*>(m_errors), static_cast<QWidget*>(m_errorCard), static_cast<QWidget*>(m_headings[0])}) {
    part->setVisible(!errors.isEmpty());
  }
  for (QWidget* part : {static_cast<QWidget*>(m_inputs), static_cast<QWidget*>(m_headings[1])}) {
    part->setVisible(!inputs.isEmpty());
  }
  m_inputTags.clear();
  for (const RunChannel& channel : inputs) {
    if (channel.id != QStringLiteral("spindle_rpm")) m_inputTags << channel.tag;
  }
  retranslate();
  const QVector<RunValue> values(m_values.cbegin(), m_values.cend());
  setValues(values);
}

void RunView::append(const QString& id, const QVector<double>& time_s, const QVector<double>& values) {
  if (LivePlot* plot = m_plotOf.value(id)) plot->append(id, time_s, values);
}

void RunView::setBand(const QString& id, const QVector<double>& time_s, const QVector<double>& low,
                      const QVector<double>& high) {
  if (LivePlot* plot = m_plotOf.value(id)) plot->setBand(id, time_s, low, high);
}

void RunView::clear() {
  for (const RunValue& value : std::as_const(m_values)) {
    for (ChannelTable* table : {m_temperatureTable, m_errorTable}) {
      table->setValue(value.id, QStringLiteral("–"), {}, Judgement::none);
    }
    if (LivePlot* plot = m_plotOf.value(value.id)) plot->setEmphasis(value.id, false);
  }
  m_values.clear();
  for (LivePlot* plot : {m_temperatures, m_errors, m_inputs}) plot->clearData();
  setMarks({});
  setRegimes({}, 0.0);
  setFrame({}, {});
}

void RunView::setValues(const QVector<RunValue>& values) {
  for (const RunValue& value : values) {
    const auto channel = m_channels.constFind(value.id);
    m_values.insert(value.id, value);
    if (channel == m_channels.constEnd()) continue;
    const QString text =
        std::isnan(value.value) ? QStringLiteral("–") : fixedText(value.value, channel->decimals) + ' ' + channel->unit;
    m_temperatureTable->setValue(value.id, text, value.state, value.judgement);
    m_errorTable->setValue(value.id, text, value.state, value.judgement);
    if (LivePlot* plot = m_plotOf.value(value.id)) plot->setEmphasis(value.id, value.judgement == Judgement::bad);
  }
}

void RunView::setRegimes(const QVector<Regime>& regimes, double fastest_rpm) {
  m_temperatures->setRegimes(regimes, fastest_rpm);
  // The words stand once, above; the lower plots carry the shades only.
  m_errors->setRegimes(regimes, fastest_rpm, false);
  m_inputs->setRegimes(regimes, fastest_rpm, false);
}

void RunView::setMarks(const QVector<Mark>& marks) {
  m_temperatures->setMarks(marks);
  QVector<Mark> bare = marks;
  for (Mark& mark : bare) mark.text.clear();
  m_errors->setMarks(bare);
  m_inputs->setMarks(bare);
}

void RunView::setErrorLimits(const QVector<Limit>& limits) {
  m_errors->setLimits(limits);
}

void RunView::setFrame(const QImage& image, const CameraMarks& marks) {
  m_camera->setImage(image);
  m_camera->setMarks(marks);
}

void RunView::setCameraShown(bool shown) {
  m_cameraCard->setVisible(shown);
}

void RunView::setSide(QWidget* side) {
  side->setFixedWidth(m_errorCard->width());
  m_right->insertWidget(0, side);
}

void RunView::setTrouble(const RunTrouble& trouble) {
  if (trouble.so_far.isEmpty()) m_dismissed.clear();  // another run
  m_trouble = trouble;
  showTrouble();
}

void RunView::showTrouble() {
  const QStringList kinds = kindsOf(m_trouble.so_far);
  const bool news =
      std::any_of(kinds.begin(), kinds.end(), [this](const QString& kind) { return !m_dismissed.contains(kind); });
  if (m_trouble.now.isEmpty() && !news) return m_banner->clear();
  Problem problem;
  problem.kind = m_trouble.now.isEmpty() ? ProblemKind::note : ProblemKind::warning;
  problem.sentence = !m_trouble.now.isEmpty() ? m_trouble.now
                     : m_trouble.ended        ? tr("Happened in this run")
                                              : tr("Everything is in order again.");
  problem.remedy = m_trouble.so_far.join(QStringLiteral(" · "));
  if (!m_trouble.ended && !problem.remedy.isEmpty()) problem.remedy = tr("In this run: %1").arg(problem.remedy);
  m_banner->setProblem(problem);
}

qsizetype RunView::sampleCount(const QString& id) const {
  const LivePlot* plot = m_plotOf.value(id);
  return plot == nullptr ? 0 : plot->sampleCount(id);
}

QString RunView::waitingSentence(const QString& since) {
  return tr("The controller has been silent since %1: the run waits, nothing is recorded. Finish keeps what there is.")
      .arg(since);
}

QString RunView::silentReason() {
  return tr("The controller does not answer: it cannot be told to stop.");
}

void RunView::markStopped(Figure& figure) {
  figure.judgement = Judgement::warn;
  figure.word = tr("stopped");
}

void RunView::retranslate() {
  m_plotCard->setTitle(tr("Temperatures"));
  m_plotCard->setSubtitle(QStringLiteral("°C"));
  const QString grey = colors().muted.name();
  m_headings[0]->setText(tr("Errors") + QStringLiteral("  <span style='font-weight:400;color:%1'>µm</span>").arg(grey));
  m_headings[1]->setText(tr("Inputs") +
                         QStringLiteral("  <span style='font-weight:400;color:%1'>%2</span>")
                             .arg(grey, m_inputTags.isEmpty() ? tr("speed in rpm") : listText(m_inputTags)));
  m_errorCard->setTitle(tr("Errors"));
  m_temperatureCard->setTitle(tr("Temperatures"));
  m_temperatureCard->setSubtitle(tr("%n channels", nullptr, static_cast<int>(m_temperatureTable->rows().size())));
  m_span->setItems({tr("10 min"), tr("1 h"), tr("All")});
  m_errorTable->setHeaders(tr("Channel"), tr("Value"), QStringLiteral("±"));
  m_temperatureTable->setHeaders(tr("Channel"), tr("Value"), tr("State"));
  m_camera->setPlaceholder(tr("No picture yet"));
  for (LivePlot* plot : {m_temperatures, m_errors, m_inputs}) plot->setPlaceholder(tr("Waiting for the first sample"));
  showTrouble();
}

}  // namespace zerodrift::ui
