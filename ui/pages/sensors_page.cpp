#include "ui/pages/sensors_page.h"

#include <cmath>

#include "ui/plots/matrix_view.h"
#include "ui/plots/xy_plot.h"
#include "ui/widgets/card.h"
#include "ui/widgets/data_table.h"
#include "ui/widgets/figure_card.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/toggle_segment.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

DataCell numberCell(double value, int decimals) {
  DataCell cell;
  cell.text = std::isnan(value) ? QStringLiteral("–") : fixedText(value, decimals);
  return cell;
}

DataCell correlationCell(double value) {
  DataCell cell = numberCell(value, 2);
  cell.background = divergingColor(0.9 * value);
  return cell;
}

}  // namespace

SensorsPage::SensorsPage(QWidget* parent) : Page("sensors", parent) {
  auto* row = new QHBoxLayout;
  row->setSpacing(16);
  row->addWidget(makePlots(), 1);
  row->addWidget(makeChoice(), 2);
  content()->addLayout(row, 1);
  connectParts();
  refresh();
}

Card* SensorsPage::makePlots() {
  m_plotCard = new Card(this);
  m_plotCard->setBodyMargins(6, 0, 6, 8);
  m_view = new ToggleSegment(m_plotCard);
  m_plotCard->tools()->addWidget(m_view);
  m_clusterPlot = new XyPlot(m_plotCard);
  m_clusterPlot->setVerticalZoom(true);
  m_seriesPanel = new QWidget(m_plotCard);
  m_seriesGrid = new QGridLayout(m_seriesPanel);
  m_seriesGrid->setContentsMargins(0, 0, 0, 0);
  m_seriesGrid->setSpacing(4);
  auto* matrixPanel = new QWidget(m_plotCard);
  auto* matrixLayout = new QVBoxLayout(matrixPanel);
  matrixLayout->setContentsMargins(10, 0, 10, 0);
  m_matrix = new MatrixView(matrixPanel);
  matrixLayout->addWidget(m_matrix);
  m_budget = new XyPlot(m_plotCard);
  m_budget->setIncludeZero(true);
  m_budget->setIntegerX(true);
  m_views = new QStackedWidget(m_plotCard);
  for (QWidget* view :
       {static_cast<QWidget*>(m_clusterPlot), m_seriesPanel, matrixPanel, static_cast<QWidget*>(m_budget)}) {
    m_views->addWidget(view);
  }
  m_plotNote = new WrapLabel(m_plotCard);
  m_plotNote->setProperty("role", "caption");
  m_plotNote->setContentsMargins(10, 0, 10, 0);
  m_plotCard->body()->addWidget(m_views, 1);
  m_plotCard->body()->addWidget(m_plotNote);
  return m_plotCard;
}

Card* SensorsPage::makeChoice() {
  m_tableCard = new Card(this);
  m_tableCard->setBodyMargins(1, 0, 1, 6);
  m_clusterName = new QLabel(m_tableCard);
  m_clusterName->setProperty("role", "caption");
  m_clusters = new QSpinBox(m_tableCard);
  m_clusters->setObjectName("clusters");
  m_clusters->setRange(0, 12);
  m_clusterName->setBuddy(m_clusters);
  m_sum = new ToggleSegment(m_tableCard);
  m_tableCard->tools()->addWidget(m_clusterName);
  m_tableCard->tools()->addWidget(m_clusters);
  m_tableCard->tools()->addWidget(m_sum);
  m_table = new DataTable(m_tableCard);
  m_table->setRowHeight(22);
  m_tableCard->body()->addWidget(m_table, 1);
  m_priceNote = new WrapLabel(m_tableCard);
  m_priceNote->setProperty("role", "caption");
  m_priceNote->setContentsMargins(15, 2, 15, 4);
  m_tableCard->body()->addWidget(m_priceNote);
  m_plotCard->setMinimumWidth(372);
  m_tableCard->setMinimumWidth(606);
  m_tableCard->setMaximumWidth(680);  // the longest names of sensors
  return m_tableCard;
}

void SensorsPage::connectParts() {
  connect(m_view, &ToggleSegment::currentChanged, this, [this](int index) {
    m_views->setCurrentIndex(index);
    refresh();
  });
  connect(m_table, &DataTable::checkChanged, this, &SensorsPage::toggle);
  connect(m_clusterPlot, &XyPlot::pointClicked, this, [this](const QString& id, int index) {
    // The parts are named by cluster and kept or left; count up to the sensor meant.
    for (int i = 0, seen = 0; i < m_state.sensors.size(); ++i) {
      const SensorRow& s = m_state.sensors[i];
      if (id != QStringLiteral("%1%2").arg(s.kept ? "kept" : "left").arg(s.cluster)) continue;
      if (seen++ == index) return toggle(i, !s.kept);
    }
  });
  connect(m_matrix, &MatrixView::cellClicked, this, [this](int sensor, int) { m_table->selectRow(sensor); });
  connect(m_clusters, &QSpinBox::valueChanged, this, [this](int value) {
    if (!m_filling) Q_EMIT clustersChosen(value);
  });
  connect(m_sum, &ToggleSegment::currentChanged, this, [this](int index) {
    if (!m_filling) Q_EMIT absoluteChosen(index == 1);
  });
}

void SensorsPage::setState(const SensorsState& state) {
  m_state = state;
  refresh();
}

void SensorsPage::toggle(int row, bool kept) {
  if (row < 0 || row >= m_state.sensors.size()) return;
  m_state.sensors[row].kept = kept;
  refresh();
  Q_EMIT keptChanged(m_state.sensors[row].id, kept);
}

int SensorsPage::keptCount() const {
  return static_cast<int>(
      std::count_if(m_state.sensors.begin(), m_state.sensors.end(), [](const SensorRow& s) { return s.kept; }));
}

QString SensorsPage::title() const {
  return tr("Sensors");
}

QString SensorsPage::sentence() const {
  if (!m_state.blocked.isEmpty()) return notYet();
  return tr("Keep the few sensors that carry the error. Tick one in or out; its price shows at once.");
}

PageAction SensorsPage::primary() const {
  return {"primary", tr("Use these sensors"), m_state.blocked.isEmpty() && keptCount() > 0 && !m_state.pricing,
          !m_state.blocked.isEmpty() ? m_state.blocked
          : m_state.pricing          ? tr("The figures of the last change are being computed.")
                                     : tr("Keep at least one sensor."),
          tr("Goes on: the model is fitted on the sensors that are ticked")};
}

QVector<PageAction> SensorsPage::secondary() const {
  if (!m_state.blocked.isEmpty()) return {};
  return {{"suggest", tr("Proposed choice"), true, {}, tr("Ticks the sensors with the least error to expect again")}};
}

QVector<Figure> SensorsPage::figures() const {
  Figure kept = figureOf(tr("Sensors kept"), keptCount(), 0, tr("of %1").arg(m_state.sensors.size()));
  Figure error = figureAtMost(tr("Error on unseen"), m_state.error_um, 2, "µm", m_state.errorLimit_um);
  error.tip = tr("Root mean square over stretches of the run that the model was not fitted to.");
  Figure lost = figureAtMost(tr("Lost against all"), m_state.lost_percent, 1, "%", m_state.lostLimit_percent);
  // Fewer sensors are often better than all: a gain is not a fault.
  if (m_state.lost_percent <= 0.0) {
    lost.judgement = Judgement::ok;
    lost.word = tr("nothing lost");
  } else if (lost.judgement != Judgement::ok) {
    const double lost_um = m_state.error_um * m_state.lost_percent / (100.0 + m_state.lost_percent);
    // So little is within the limit, whatever its share: then that is the limit that is shown.
    if (lost_um <= m_state.lostLimit_um) {
      lost = figureAtMost(lost.label, lost_um, 2, QStringLiteral("µm"), m_state.lostLimit_um);
    }
  }
  Figure condition = figureAtMost(tr("Condition number"), m_state.condition, 0, {}, m_state.conditionLimit);
  condition.tip =
      tr("Of the fit on the kept sensors, its penalty included. Large: their coefficients disturb one another.");
  if (condition.judgement == Judgement::bad) {
    condition.judgement = Judgement::warn;
    condition.word = tr("much alike");
  }
  if (m_state.pricing) {
    for (Figure* figure : {&error, &lost, &condition}) {
      figure->judgement = Judgement::none;
      figure->word = tr("computing");
    }
  }
  return {kept, error, lost, condition};
}

void SensorsPage::render() {
  if (!m_state.blocked.isEmpty()) {
    showEmpty(Icon::chart, tr("No sensors to choose from yet"), m_state.blocked);
    return;
  }
  showContent();
  m_filling = true;
  setFigures(figures());
  const QStringList names = {tr("Clusters"), tr("Series"), tr("Correlation"), tr("Budget")};
  m_view->setItems(names);
  m_plotCard->setTitle(names.value(m_views->currentIndex()));
  m_clusterName->setText(tr("Clusters"));
  m_clusters->setSpecialValueText(tr("auto (%1)").arg(m_state.suggestedClusters));
  m_clusters->setValue(m_state.automatic ? 0 : m_state.clusters);
  m_sum->setItems({tr("with sign"), tr("absolute")});
  m_sum->setCurrentIndex(m_state.absolute ? 1 : 0);
  m_sum->setToolTip(
      tr("As published the correlations with X, Y and Z are added with their signs.\n"
         "Opposite signs cancel: a sensor that drives X up and Z down may look useless.\n"
         "The sum of absolute values does not have this fault."));
  m_filling = false;
  renderClusters();
  renderSeries();
  renderMatrix();
  renderBudget();
  renderTable();
}

void SensorsPage::renderClusters() {
  m_clusterPlot->clear();
  const auto axis = [](int number, double percent) {
    return std::isnan(percent) ? tr("Component %1").arg(number)
                               : tr("Component %1 (%2 %)").arg(number).arg(percent, 0, 'f', 0);
  };
  m_clusterPlot->setAxisLabels(axis(1, m_state.explained1_percent), axis(2, m_state.explained2_percent));
  for (int cluster = 0; cluster < m_state.clusters; ++cluster) {
    for (const bool kept : {false, true}) {
      QVector<double> x;
      QVector<double> y;
      QStringList tags;
      for (const SensorRow& s : m_state.sensors) {
        if (s.cluster != cluster || s.kept != kept) continue;
        x.append(s.pc1);
        y.append(s.pc2);
        tags.append(s.tag);
      }
      if (x.isEmpty()) continue;
      PartStyle style;
      style.tag = tr("Cluster %1").arg(cluster + 1);
      style.color = groupColor(cluster);
      style.line = false;
      style.points = true;
      style.hollow = !kept;
      style.pointSize = kept ? 13 : 9;
      m_clusterPlot->setPart(QStringLiteral("%1%2").arg(kept ? "kept" : "left").arg(cluster), x, y, style, tags);
    }
  }
  const QStringList notes = {
      tr("Sensors near each other warm alike. Filled: kept. Click a sensor to keep or leave it."),
      tr("Temperatures by cluster, each scaled to its own spread. Thick: kept."),
      tr("Correlation of each sensor with the errors, and their sum."),
      tr("Error on unseen stretches against the number of sensors: where the curve turns flat, more do not help."),
  };
  m_plotNote->setText(notes.value(m_views->currentIndex()));
}

void SensorsPage::renderSeries() {
  while (m_seriesPlots.size() < m_state.clusters) {
    auto* plot = new XyPlot(m_seriesPanel);
    plot->setTimeAxis(true);
    const int i = static_cast<int>(m_seriesPlots.size());
    m_seriesGrid->addWidget(plot, i / 2, i % 2);
    m_seriesPlots.append(plot);
  }
  for (int cluster = 0; cluster < m_seriesPlots.size(); ++cluster) {
    XyPlot* plot = m_seriesPlots[cluster];
    plot->setVisible(cluster < m_state.clusters);
    if (m_views->currentIndex() != 1 || cluster >= m_state.clusters) continue;
    plot->clear();
    for (int i = 0; i < m_state.sensors.size() && i < m_state.temperatures.size(); ++i) {
      const SensorRow& s = m_state.sensors[i];
      if (s.cluster != cluster) continue;
      PartStyle style;
      style.tag = s.tag;
      style.color = groupColor(cluster);
      style.width = s.kept ? 2.2 : 1.0;
      if (!s.kept) style.color = mix(colors().panel, style.color, 0.55);
      plot->setPart(s.id, m_state.time_s, m_state.temperatures[i], style);
    }
  }
}

void SensorsPage::renderMatrix() {
  QStringList rows;
  QVector<double> values;
  for (const SensorRow& s : m_state.sensors) {
    if (s.cluster < 0) continue;
    rows.append(s.tag);
    values << s.r << s.sum / static_cast<double>(std::max<qsizetype>(1, s.r.size()));
  }
  m_matrix->setMatrix(rows, m_state.errors + QStringList{tr("mean")}, values);
}

void SensorsPage::renderBudget() {
  m_budget->clear();
  m_budget->setAxisLabels(tr("number of sensors"), tr("error on unseen / µm"));
  m_budget->setPlaceholder(tr("The budget curve is being computed"));
  if (m_state.budgetCount.isEmpty()) return;
  PartStyle style;
  style.tag = tr("Error on unseen");
  style.unit = "µm";
  style.color = colors().accent;
  style.points = true;
  m_budget->setPart("budget", m_state.budgetCount, m_state.budgetError_um, style);
  if (!std::isnan(m_state.error_um) && keptCount() > 0) {
    style.tag = tr("Your choice");
    style.line = false;
    style.pointSize = 13;
    style.color = colors().ok;
    m_budget->setPart("choice", {static_cast<double>(keptCount())}, {m_state.error_um}, style);
  }
  m_budget->setLimits({{m_state.errorLimit_um, tr("limit"), Judgement::bad}});
}

void SensorsPage::renderTable() {
  m_tableCard->setTitle(tr("Choice"));
  QVector<DataColumn> columns{{tr("Sensor"), 0, false, {}}};
  for (const QString& error : m_state.errors) {
    columns.append({error, 44, true, tr("Correlation with the error in %1").arg(error)});
  }
  columns.append(
      {{tr("Sum"), 44, true, tr("Largest in its cluster: thermally sensitive point")},
       {tr("Lag"), 62, true, tr("The error follows this sensor after so many minutes")},
       {"VIF", 44, true, tr("Variance inflation: above 10 the sensor repeats others")},
       {tr("Price"), 76, true,
        tr("Change of the error on unseen stretches when this tick is changed; plus: worse, minus: better")}});
  m_table->setColumns(columns);
  QVector<QVector<DataCell>> rows;
  for (const SensorRow& s : m_state.sensors) {
    DataCell name;
    name.text = s.tag + QStringLiteral("  ") + s.label;
    name.tip = s.note.isEmpty() ? name.text : name.text + ": " + s.note;
    name.checkable = true;
    name.judged = !s.note.isEmpty();
    if (name.judged) {
      name.text = s.tag + QStringLiteral("  ") + s.note;
      name.judgement = Judgement::warn;
    }
    if (s.cluster < 0) {
      const DataCell none{QStringLiteral("–")};
      rows.append(QVector<DataCell>{name} + QVector<DataCell>(columns.size() - 1, none));
      continue;
    }
    name.swatch = groupColor(s.cluster);
    name.checked = s.kept;
    name.strong = s.kept;
    DataCell lag = numberCell(s.lag_s / 60.0, 0);
    if (!std::isnan(s.lag_s)) lag.text = tr("%1 min").arg(lag.text);
    DataCell price;
    price.text = QStringLiteral("–");
    if (!std::isnan(s.price_um)) {
      const QString size = fixedText(std::abs(s.price_um), 2);
      const bool nothing = std::abs(s.price_um) < 0.005;
      price.text = nothing ? tr("0.00 µm") : QStringLiteral("%1%2 µm").arg(s.price_um < 0.0 ? "−" : "+", size);
      price.tip = nothing  ? tr("Keeping it or not makes no difference")
                  : s.kept ? (s.price_um > 0.0 ? tr("Without it the error grows by %1 µm: keep it")
                                               : tr("Without it the error shrinks by %1 µm: leave it out"))
                                 .arg(size)
                  : s.price_um < 0.0 ? tr("With it the error shrinks by %1 µm: worth keeping").arg(size)
                                     : tr("With it the error grows by %1 µm: leave it out").arg(size);
      price.strong = !nothing && s.price_um < 0.0;
    }
    DataCell vif = numberCell(s.vif, 1);
    if (s.vif >= 100.0) vif.text = QStringLiteral("> 99");
    QVector<DataCell> row{name};
    for (const double r : s.r) row.append(correlationCell(r));
    row.append({numberCell(s.sum, 2), lag, vif, price});
    rows.append(row);
  }
  m_table->setRows(rows);
  QStringList named;
  for (const SensorRow& s : m_state.sensors) {
    if (!s.note.isEmpty()) named << tr("%1: %2.").arg(s.tag, s.note);
  }
  QString before = named.isEmpty() ? QString() : named.join(QLatin1Char(' ')) + QLatin1Char('\n');
  if (!m_state.proposal.isEmpty()) before += m_state.proposal + QLatin1Char('\n');
  m_priceNote->setText(
      before +
      tr("Price: what a click on the tick does to the error on unseen stretches. Plus: it grows, leave the tick as "
         "it is. Minus (bold): it shrinks."));
}

}  // namespace zerodrift::ui
