#include "ui/pages/axis_page.h"

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

constexpr int side_width = 372;
constexpr int fewest_row = 1;

double largest_residual(const QVector<AxisSegment>& segments) {
  double largest = std::nan("");
  for (const AxisSegment& one : segments) largest = std::fmax(largest, one.largestResidual_um);
  return largest;
}

/// Segments that were fitted; joints between them do not count.
qsizetype fitted(const QVector<AxisSegment>& segments) {
  return std::count_if(segments.begin(), segments.end(), [](const AxisSegment& one) { return one.points > 0; });
}

}  // namespace

AxisPage::AxisPage(QWidget* parent) : Page("axis_errors", parent) {
  auto* row = new QHBoxLayout;
  row->setSpacing(16);
  row->addWidget(makePlotCard(), 1);
  auto* right = new QVBoxLayout;
  right->setSpacing(16);
  m_figureCard = new Card(this);
  m_figureCard->setFixedWidth(side_width);
  m_figureCard->setBodyMargins(1, 0, 1, 6);
  m_standard = new ToggleSegment(m_figureCard);
  m_figureCard->tools()->addWidget(m_standard);
  m_standardTable = new DataTable(m_figureCard);
  m_segmentTable = new DataTable(m_figureCard);
  m_tables = new QStackedWidget(m_figureCard);
  m_tables->addWidget(m_standardTable);
  m_tables->addWidget(m_segmentTable);
  m_figureCard->body()->addWidget(m_tables, 1);
  right->addWidget(m_figureCard, 1);
  right->addWidget(makeExportCard());
  right->addWidget(makeRuleCard());
  row->addLayout(right);
  content()->addLayout(row, 1);
  connect(m_standard, &ToggleSegment::currentChanged, this, [this] { renderTables(); });
  refresh();
}

Card* AxisPage::makePlotCard() {
  m_plotCard = new Card(this);
  m_plotCard->setBodyMargins(6, 0, 6, 6);
  m_axis = new ToggleSegment(m_plotCard);
  m_view = new ToggleSegment(m_plotCard);
  m_plotCard->tools()->addWidget(m_axis);
  m_plotCard->tools()->addWidget(m_view);
  m_measurement = new XyPlot(m_plotCard);
  m_segmentPlot = new XyPlot(m_plotCard);
  m_views = new QStackedWidget(m_plotCard);
  m_views->addWidget(m_measurement);
  m_views->addWidget(m_segmentPlot);
  m_legend = new LegendRow(m_plotCard);
  m_plotCard->body()->addWidget(m_legend);
  m_plotCard->body()->addWidget(m_views, 1);
  connect(m_axis, &ToggleSegment::currentChanged, this, &AxisPage::axisChosen);
  connect(m_view, &ToggleSegment::currentChanged, this, [this](int index) {
    m_views->setCurrentIndex(index);
    refresh();
  });
  return m_plotCard;
}

Card* AxisPage::makeExportCard() {
  m_exportCard = new Card(this);
  m_exportCard->setFixedWidth(side_width);
  m_format = new QComboBox(m_exportCard);
  m_format->setObjectName("format");
  m_format->setMinimumWidth(190);
  m_exportCard->tools()->addWidget(m_format);
  m_check = new WrapLabel(m_exportCard);
  m_check->setProperty("role", "caption");
  m_exportCard->body()->addWidget(m_check);
  connect(m_format, &QComboBox::activated, this, &AxisPage::formatChosen);
  return m_exportCard;
}

Card* AxisPage::makeRuleCard() {
  m_ruleCard = new Card(this);
  m_ruleCard->setFixedWidth(side_width);
  m_rivals = new DataTable(m_ruleCard);
  m_rivals->setFitted(true);
  m_criterion = new QComboBox(m_ruleCard);
  m_criterion->setObjectName("criterion");
  m_limit = new QDoubleSpinBox(m_ruleCard);
  m_limit->setObjectName("criterionLimit");
  m_start = new QSpinBox(m_ruleCard);
  m_start->setRange(2, 20000);
  auto* grid = new QGridLayout;
  grid->setHorizontalSpacing(10);
  grid->setVerticalSpacing(4);
  const QVector<QWidget*> fields = {m_criterion, m_limit, m_start};
  for (int i = 0; i < fields.size(); ++i) {
    auto* name = new QLabel(m_ruleCard);
    name->setProperty("role", "muted");
    name->setBuddy(fields[i]);
    grid->addWidget(name, i, 0);
    grid->addWidget(fields[i], i, 1);
    m_names.append(name);
  }
  grid->setColumnStretch(1, 1);
  m_blind = new WrapLabel(m_ruleCard);
  m_blind->setProperty("role", "caption");
  m_ruleCard->body()->addWidget(m_rivals);
  m_ruleCard->body()->addLayout(grid);
  m_ruleCard->body()->addWidget(m_blind);
  const auto changed = [this] {
    if (m_filling) return;
    m_state.criterion = static_cast<SegmentCriterion>(m_criterion->currentIndex());
    (m_state.criterion == SegmentCriterion::tolerance ? m_state.tolerance_um : m_state.threshold) = m_limit->value();
    m_state.startPoints = m_start->value();
    Q_EMIT segmentationChanged(m_criterion->currentIndex(), m_state.threshold, m_state.startPoints,
                               m_state.tolerance_um);
  };
  connect(m_criterion, &QComboBox::activated, this, [this](int index) {
    m_state.criterion = static_cast<SegmentCriterion>(index);
    refresh();
    Q_EMIT segmentationChanged(index, m_state.threshold, m_state.startPoints, m_state.tolerance_um);
  });
  connect(m_limit, &QDoubleSpinBox::editingFinished, this, changed);
  connect(m_start, &QSpinBox::editingFinished, this, changed);
  connect(m_rivals, &DataTable::rowSelected, this, [this](int row) {
    if (row < 0 || m_filling || m_state.useOptimal == (row == fewest_row)) return;
    m_state.useOptimal = row == fewest_row;
    refresh();
    Q_EMIT ruleChosen(m_state.useOptimal);
  });
  return m_ruleCard;
}

void AxisPage::setState(const AxisState& state) {
  m_state = state;
  refresh();
}

void AxisPage::showView(int index) {
  m_view->setCurrentIndex(index);
}

const QVector<AxisSegment>& AxisPage::segments() const {
  return m_state.useOptimal ? m_state.optimal : m_state.published;
}

QString AxisPage::title() const {
  return tr("Axis errors");
}

QString AxisPage::sentence() const {
  if (m_state.axis.isEmpty())
    return tr("Beside the main line: the geometric error of each axis, from a laser interferometer.");
  return tr("Judge the measurement, choose how it is cut into segments, then write the table.");
}

PageAction AxisPage::primary() const {
  if (m_state.axis.isEmpty())
    return {"primary", tr("Open laser file"), true, {}, tr("Reads what an interferometer measured along one axis")};
  return {"primary", tr("Use for upload"), m_state.monotonic && !segments().isEmpty(),
          tr("The table is not monotonic: the axis would move backwards somewhere."),
          tr("Keeps the table in the job; the next upload writes it with the model")};
}

QVector<PageAction> AxisPage::secondary() const {
  if (m_state.axis.isEmpty()) return {};
  QVector<PageAction> actions = {
      {"open", tr("Open laser file"), true, {}, tr("Another measurement, of this axis or of another")}};
  if (m_state.columnsAsked)
    actions.append({"columns", tr("Columns"), true, {}, tr("Which column of the file is what")});
  if (!m_state.formatConfirm.isEmpty())
    actions.append(
        {"onePoint", tr("Export one point"), true, {}, tr("A table of one point, to try the sign on the machine")});
  actions.append({"export", tr("Export"), true, {}, tr("The table as a file for a controller")});
  return actions;
}

QVector<Figure> AxisPage::figures() const {
  Figure now = figureOf(tr("Accuracy now"), m_state.before_um, 1, "µm", tr("A, ISO 230-2"));
  Figure then = figureOf(tr("With the table"), m_state.after_um, 1, "µm", tr("expected"));
  if (!std::isnan(m_state.after_um) && !std::isnan(m_state.before_um)) {
    then.judgement = m_state.after_um < m_state.before_um ? Judgement::ok : Judgement::bad;
    then.word = then.judgement == Judgement::ok ? tr("better") : tr("worse");
  }
  Figure count = figureOf(tr("Segments"), static_cast<double>(fitted(segments())), 0, {},
                          m_state.useOptimal ? tr("fewest") : tr("as published"));
  Figure residual = figureAtMost(tr("Largest residual"), largest_residual(segments()), 2, "µm", m_state.tolerance_um);
  Figure thereAndBack = figureAtMost(tr("There and back"), m_state.roundTrip_nm, 2, "nm", 1.0);
  thereAndBack.tip = tr("Forward of inverse against the position itself, largest over the travel.");
  return {now, then, count, residual, thereAndBack};
}

void AxisPage::render() {
  if (m_state.axis.isEmpty()) {
    showEmpty(Icon::file, tr("Drop a laser file here"),
              tr("CSV, Renishaw .rtl or .pos with targets and runs. It is checked, drawn with its ISO 230-2 figures, "
                 "and cut into segments that the controller can use."),
              tr("Open laser file"));
    return;
  }
  showContent();
  m_filling = true;
  setFigures(figures());
  {
    const QSignalBlocker quiet(m_axis);
    m_axis->setItems(m_state.axes);
    m_axis->setCurrentIndex(m_state.chosenAxis);
    m_axis->setVisible(m_state.axes.size() > 1);
  }
  m_view->setItems({tr("Measurement"), tr("Segments")});
  m_plotCard->setTitle(tr("Axis %1").arg(m_state.axis));
  m_plotCard->setSubtitle(m_state.fileNotes);
  m_plotCard->setToolTip(m_state.fileNotes);
  // The measurement is judged and exported; what is cut is chosen beside its picture.
  m_ruleCard->setVisible(m_views->currentIndex() == 1);
  m_exportCard->setVisible(m_views->currentIndex() == 0);
  renderRule();
  renderExport();
  m_filling = false;
  renderLegend();
  renderMeasurement();
  renderSegments();
  renderTables();
}

void AxisPage::renderRule() {
  m_ruleCard->setTitle(tr("Cut into segments"));
  renderRivals();
  const QStringList names = {tr("Criterion"),
                             m_state.criterion == SegmentCriterion::tolerance ? tr("Tolerance") : tr("Threshold"),
                             tr("First points")};
  for (int i = 0; i < names.size(); ++i) m_names[i]->setText(names[i]);
  m_criterion->clear();
  m_criterion->addItems({tr("r on coordinates"), tr("r on errors"), tr("tolerance in µm")});
  m_criterion->setCurrentIndex(static_cast<int>(m_state.criterion));
  const bool tolerance = m_state.criterion == SegmentCriterion::tolerance;
  m_limit->setDecimals(tolerance ? 2 : 4);
  m_limit->setRange(tolerance ? 0.01 : 0.0, tolerance ? 1000.0 : 1.0);
  m_limit->setSingleStep(tolerance ? 0.1 : 0.005);
  m_limit->setSuffix(tolerance ? QStringLiteral(" µm") : QString());
  m_limit->setValue(tolerance ? m_state.tolerance_um : m_state.threshold);
  m_start->setValue(m_state.startPoints);
  m_start->setEnabled(!m_state.useOptimal);
  const bool blind = m_state.criterion == SegmentCriterion::coordinates;
  m_blind->setText(blind ? tr("On coordinates r is about 1 whatever the error: it hardly cuts.") : QString());
  m_blind->setVisible(blind);
}

void AxisPage::renderExport() {
  m_exportCard->setTitle(tr("Export as"));
  m_format->setAccessibleName(tr("Format of the export"));
  m_format->clear();
  m_format->addItems(m_state.formats);
  m_format->setCurrentIndex(m_state.format);
  QStringList check;
  check.append(m_state.formatLoss.isEmpty() ? tr("The format loses nothing.")
                                            : tr("Lost in this format: %1.").arg(m_state.formatLoss));
  if (!std::isnan(m_state.formatLoss_um)) {
    check.append(tr("Largest difference %1 µm.").arg(m_state.formatLoss_um, 0, 'f', 3));
  }
  if (!m_state.formatConfirm.isEmpty()) check.append(tr("Confirm on one point first: %1.").arg(m_state.formatConfirm));
  m_check->setText(sentencesText(check));
}

void AxisPage::renderRivals() {
  m_rivals->setColumns({{tr("Rule"), 0, false, {}},
                        {tr("Segments"), 72, true, {}},
                        {tr("Residual"), 78, true, tr("Largest of a measured point, µm")}});
  QVector<QVector<DataCell>> rows;
  for (const bool optimal : {false, true}) {
    const QVector<AxisSegment>& segments = optimal ? m_state.optimal : m_state.published;
    const bool used = optimal == m_state.useOptimal;
    DataCell name{optimal ? tr("Fewest within %1 µm").arg(m_state.tolerance_um) : tr("As published")};
    name.judged = used;
    name.judgement = used ? Judgement::ok : Judgement::none;
    name.strong = used;
    DataCell count{QString::number(fitted(segments))};
    const double residual = largest_residual(segments);
    DataCell largest{std::isnan(residual) ? QStringLiteral("–") : fixedText(residual, 2) + " µm"};
    rows.append({name, count, largest});
  }
  m_rivals->setRows(rows);
  m_rivals->selectRow(m_state.useOptimal ? fewest_row : 0);
}

void AxisPage::renderTables() {
  const bool cut = m_views->currentIndex() == 1;
  m_figureCard->setTitle(cut ? tr("Segments") : tr("Figures"));
  m_standard->setItems({"ISO 230-2", "VDI 3441"});
  m_standard->setVisible(!cut);
  m_tables->setCurrentIndex(cut ? 1 : 0);
  m_standardTable->setColumns({{tr("Figure"), 72, false, {}}, {tr("Meaning"), 0, false, {}}, {"µm", 64, true, {}}});
  QVector<QVector<DataCell>> rows;
  for (const StandardFigure& figure : m_standard->currentIndex() == 1 ? m_state.vdi : m_state.iso) {
    DataCell symbol{figure.symbol};
    symbol.strong = true;
    rows.append({symbol, DataCell{figure.name},
                 DataCell{std::isnan(figure.value_um) ? QStringLiteral("–") : fixedText(figure.value_um, 2)}});
  }
  m_standardTable->setRows(rows);
  m_segmentTable->setColumns({{tr("From"), 66, true, {}},
                              {tr("To"), 66, true, {}},
                              {tr("Points"), 54, true, {}},
                              {"r", 66, true, {}},
                              {tr("Residual"), 0, true, tr("Largest residual of a point")}});
  rows.clear();
  for (const AxisSegment& s : segments()) {
    rows.append({DataCell{fixedText(s.from_mm, 1)}, DataCell{fixedText(s.to_mm, 1)},
                 DataCell{s.points == 0 ? tr("joint") : QString::number(s.points)},
                 DataCell{std::isnan(s.r) ? QStringLiteral("–") : fixedText(s.r, 4)},
                 DataCell{fixedText(s.largestResidual_um, 2) + " µm"}});
  }
  m_segmentTable->setRows(rows);
}

}  // namespace zerodrift::ui
