#include "ui/pages/upload_page.h"

#include <algorithm>
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

constexpr int side_width = 396;

}  // namespace

UploadPage::UploadPage(QWidget* parent) : Page("upload", parent) {
  auto* row = new QHBoxLayout;
  row->setSpacing(16);
  row->addWidget(makeTable(), 1);
  auto* right = new QVBoxLayout;
  right->setSpacing(16);
  right->addWidget(makeWriting(), 1);
  right->addWidget(makeSign());
  row->addLayout(right);
  content()->addLayout(row, 1);
  connect(m_axis, &ToggleSegment::currentChanged, this, [this] { renderAxis(); });
  connect(m_side, &ToggleSegment::currentChanged, m_sides, &QStackedWidget::setCurrentIndex);
  connect(m_history, &DataTable::rowSelected, this, [this](int index) {
    m_chosen = m_state.history.value(index).id;
    renderRollback();
  });
  connect(m_rollback, &QPushButton::clicked, this, [this] { Q_EMIT rollbackRequested(m_chosen); });
  refresh();
}

Card* UploadPage::makeTable() {
  m_tableCard = new Card(this);
  m_tableCard->setBodyMargins(6, 0, 6, 8);
  m_axis = new ToggleSegment(m_tableCard);
  m_tableCard->tools()->addWidget(m_axis);
  m_curves = new XyPlot(m_tableCard);
  m_curves->setIncludeZero(true);
  m_terms = new DataTable(m_tableCard);
  m_terms->setMinimumHeight(96);
  m_loss = new WrapLabel(m_tableCard);
  m_loss->setProperty("role", "caption");
  m_loss->setContentsMargins(10, 0, 10, 0);
  m_legend = new LegendRow(m_tableCard);
  m_tableCard->body()->addWidget(m_legend);
  m_tableCard->body()->addWidget(m_curves, 3);
  m_tableCard->body()->addWidget(m_terms, 2);
  m_tableCard->body()->addWidget(m_loss);
  return m_tableCard;
}

Card* UploadPage::makeWriting() {
  m_writeCard = new Card(this);
  m_writeCard->setFixedWidth(side_width);
  m_side = new ToggleSegment(m_writeCard);
  m_writeCard->tools()->addWidget(m_side);
  auto* stagePanel = new QWidget(m_writeCard);
  auto* stageLayout = new QVBoxLayout(stagePanel);
  stageLayout->setContentsMargins(0, 0, 0, 0);
  m_stages = new StepList(stagePanel);
  stageLayout->addWidget(m_stages);
  stageLayout->addStretch();
  auto* historyPanel = new QWidget(m_writeCard);
  auto* historyLayout = new QVBoxLayout(historyPanel);
  historyLayout->setContentsMargins(0, 0, 0, 0);
  m_history = new DataTable(historyPanel);
  m_rollback = new QPushButton(lineIcon(Icon::undo), {}, historyPanel);
  m_rollback->setObjectName("rollback");
  historyLayout->addWidget(m_history, 1);
  m_rollbackHint = new WrapLabel(historyPanel);
  m_rollbackHint->setObjectName("rollbackHint");
  m_rollbackHint->setProperty("role", "caption");
  historyLayout->addWidget(m_rollback, 0, Qt::AlignLeft);
  historyLayout->addWidget(m_rollbackHint);
  m_sides = new QStackedWidget(m_writeCard);
  m_sides->addWidget(stagePanel);
  m_sides->addWidget(historyPanel);
  m_writeCard->body()->addWidget(m_sides, 1);
  return m_writeCard;
}

Card* UploadPage::makeSign() {
  m_signCard = new Card(this);
  m_signCard->setFixedWidth(side_width);
  m_signCard->setBodyMargins(12, 0, 12, 8);
  m_sign = new SignCheck(m_signCard);
  m_signCard->body()->addWidget(m_sign);
  return m_signCard;
}

void UploadPage::setState(const UploadState& state) {
  if (state.writing && !m_state.writing) m_side->setCurrentIndex(0);
  m_state = state;
  refresh();
}

void UploadPage::showHistory(int version) {
  m_side->setCurrentIndex(1);
  m_sides->setCurrentIndex(1);
  for (const TableVersion& one : m_state.history) {
    if (one.version != version) continue;
    m_chosen = one.id;
    break;
  }
  renderHistory();
}

QString UploadPage::title() const {
  return tr("Upload");
}

QString UploadPage::sentence() const {
  if (!m_state.blocked.isEmpty()) return notYet();
  if (m_state.writing) return tr("The table is being written. It becomes active as a whole or not at all.");
  if (m_state.writtenEmpty) {
    return tr("%1 holds no compensation any more. Write puts the last table back.").arg(m_state.machineName);
  }
  if (m_state.written) {
    const QString version = QString::number(m_state.newVersion.value_or(0));
    if (!m_state.asOf.isEmpty())
      return tr("Version %1 was active in %2 as this job left it, %3.").arg(version, m_state.machineName, m_state.asOf);
    return m_state.proved
               ? tr("Version %1 is active in %2, and its verification run is done.").arg(version, m_state.machineName)
               : tr("Version %1 is active in %2. Now prove it.").arg(version, m_state.machineName);
  }
  return tr("Compare the old table with the new one, let the camera check the sign, then write.");
}

PageAction UploadPage::primary() const {
  const QString text = m_state.written ? tr("Go on") : tr("Write to the machine");
  if (!m_state.blocked.isEmpty()) return {"primary", text, false, m_state.blocked};
  if (m_state.written) return {"primary", text, true, {}};
  if (m_state.writing) return {"primary", text, false, tr("The table is being written.")};
  if (!m_state.offline.isEmpty()) return {"primary", text, false, m_state.offline};
  if (m_state.compensationOn) {
    return {"primary", text, false, tr("The compensation is ON. Tables may only be written while it is off.")};
  }
  if (m_state.largestChange_um > m_state.changeLimit_um) {
    return {"primary", text, false, tr("The largest change is above the machine's limit.")};
  }
  if (m_state.sign.judgement == Judgement::bad) {
    return {"primary", text, false, tr("The camera saw the test move in the wrong direction.")};
  }
  return {"primary", text, true, {}, tr("Shows what is written and asks; the table before stays in the history")};
}

QVector<PageAction> UploadPage::secondary() const {
  if (!m_state.blocked.isEmpty()) return {};
  const QString wait = m_state.writing ? tr("The table is being written.") : m_state.offline;
  const bool free = wait.isEmpty();
  return {
      {"export", tr("Export"), true, {}, tr("The table as a file for a controller")},
      {"dryRun", tr("Dry run"), free, wait, tr("Everything but the write: reads, compares and says what would change")},
      {"sign", tr("Check sign"), free, wait,
       tr("A small offset for a moment; the camera sees whether the machine moves the right way")}};
}

QVector<Figure> UploadPage::figures() const {
  const QString before = !m_state.oldVersion        ? QString()
                         : *m_state.oldVersion == 0 ? tr("none")
                                                    : QString::number(*m_state.oldVersion);
  Figure version = figureOf(tr("Version"), m_state.newVersion ? *m_state.newVersion : std::nan(""), 0,
                            m_state.written ? tr("active") : tr("to write"));
  if (!before.isEmpty())
    version.limit = m_state.written ? tr("before: %1").arg(before) : tr("in the machine: %1").arg(before);
  if (!m_state.newVersion) version.limit = tr("the machine is not read yet");
  Figure size = figureAtMost(tr("Registers"), m_state.registers, 0, {}, m_state.capacity);
  if (size.judgement == Judgement::ok) size.word = tr("fits");
  if (std::isnan(m_state.registers)) size.limit = tr("of %1").arg(m_state.capacity, 0, 'f', 0);
  Figure sign = figureOf(tr("Sign"), NAN, 0, {});
  sign.value =
      m_state.sign.measured ? (m_state.sign.judgement == Judgement::bad ? tr("wrong") : tr("right")) : QString();
  sign.judgement = m_state.sign.judgement;
  sign.word = m_state.sign.measured ? tr("seen by the camera") : tr("not checked yet");
  Figure largest = figureAtMost(tr("Largest change now"), m_state.largestChange_um, 1, "µm", m_state.changeLimit_um);
  largest.tip =
      tr("Between the old and the new table at the temperatures of this moment: so far the axes would move. "
         "While the machine warms it grows; the curve shows it over the whole warm-up run.");
  return {version, largest,
          figureAtMost(tr("Steepest term"), m_state.steepest_um_per_K, 2, tr("µm/K"), m_state.steepestLimit_um_per_K),
          size, sign};
}

void UploadPage::render() {
  if (!m_state.blocked.isEmpty()) {
    showEmpty(Icon::plug, tr("No table to write yet"), m_state.blocked);
    return;
  }
  showContent();
  setFigures(figures());
  QStringList names;
  for (const AxisTable& axis : m_state.axes) names.append(axis.axis);
  {
    const QSignalBlocker quiet(m_axis);
    m_axis->setItems(names);
  }
  m_tableCard->setTitle(tr("Old and new compensation"));
  m_tableCard->setSubtitle(QStringLiteral("µm"));
  QStringList loss;
  if (!m_state.expressed.isEmpty()) loss.append(tr("The controller takes %1.").arg(m_state.expressed));
  loss.append(m_state.lost.isEmpty() ? tr("Nothing is lost on the way.")
                                     : tr("Lost: %1.").arg(m_state.lost.join("; ")));
  for (const QString& warning : m_state.warnings) loss.append(tr("%1.", "a whole sentence").arg(warning));
  m_loss->setText(sentencesText(loss));
  m_writeCard->setTitle(tr("Transaction"));
  m_side->setItems({tr("Write"), tr("History, roll back")});
  m_signCard->setTitle(tr("Sign check"));
  m_sign->setResult(m_state.sign);
  renderAxis();
  renderTransaction();
  renderHistory();
}

void UploadPage::renderAxis() {
  m_terms->setColumns({{tr("Term of the error"), 0, false,
                        tr("What each term predicts of the error, actual less commanded, as in the report and in the "
                           "file. The controller moves against it: the curve above is that compensation.")},
                       {tr("Old"), 84, true, {}},
                       {tr("New"), 84, true, {}},
                       {tr("Change"), 84, true, {}},
                       {tr("Unit"), 66, false, {}}});
  const int index = m_axis->currentIndex();
  if (index < 0 || index >= m_state.axes.size()) {
    m_legend->setItems({});
    m_curves->clear();
    m_curves->setTimeAxis(false);
    m_curves->setAxisLabels({}, {});
    return m_terms->setRows({});
  }
  const AxisTable& axis = m_state.axes[index];
  m_tableCard->setSubtitle(QStringLiteral("%1, µm").arg(axis.axis));
  const Colors& c = colors();
  // Without a table before, the change is the new table itself: one curve then, not two that hide each other.
  const bool replaces = std::any_of(axis.before_um.begin(), axis.before_um.end(), [](double um) { return um != 0.0; });
  if (replaces) {
    m_legend->setItems({{tr("old"), c.muted, true}, {tr("new"), c.accent}, {tr("change"), axisColor(0)}});
  } else {
    m_legend->setItems({{tr("new"), c.accent}});
  }
  m_curves->setTimeAxis(axis.overTime);
  m_curves->setAxisLabels(axis.abscissa, {});
  PartStyle style;
  style.unit = "µm";
  style.tag = tr("Old");
  style.color = c.muted;
  style.dashed = true;
  if (replaces) {
    m_curves->setPart("1old", axis.x, axis.before_um, style);
  } else {
    m_curves->removePart("1old");
    m_curves->removePart("3change");
  }
  style.tag = tr("New");
  style.color = c.accent;
  style.dashed = false;
  style.width = 2.0;
  m_curves->setPart("2new", axis.x, axis.after_um, style);
  QVector<double> change;
  double largest = 0.0;
  for (int i = 0; i < axis.after_um.size() && i < axis.before_um.size(); ++i) {
    change.append(axis.after_um[i] - axis.before_um[i]);
    largest = std::max({largest, std::abs(axis.after_um[i]), std::abs(axis.before_um[i]), std::abs(change.last())});
  }
  style.tag = tr("Change");
  style.color = axisColor(0);
  style.width = 1.2;
  if (replaces) m_curves->setPart("3change", axis.x, change, style);
  // Limits far outside the curves would press them flat: they are drawn when they are near.
  QVector<Limit> limits;
  if (largest > 0.4 * axis.limit_um) {
    limits = {{axis.limit_um, tr("limit"), Judgement::bad}, {-axis.limit_um, {}, Judgement::bad}};
    m_curves->setBand("0allowed", {axis.x.value(0), axis.x.isEmpty() ? 0.0 : axis.x.last()},
                      {-axis.limit_um, -axis.limit_um}, {axis.limit_um, axis.limit_um}, c.ok);
  } else {
    m_curves->removePart("0allowed");
  }
  m_curves->setLimits(limits);

  QVector<QVector<DataCell>> rows;
  const auto number = [](double value) {
    return DataCell{std::isnan(value) ? QStringLiteral("–") : fixedText(value, 3)};
  };
  for (const TableTerm& term : axis.terms) {
    const double from = std::isnan(term.before) ? 0.0 : term.before;
    const double to = std::isnan(term.after) ? 0.0 : term.after;
    DataCell changed = number(to - from);
    if (to > from) changed.text.prepend('+');
    changed.strong = std::abs(to - from) > 1e-9;
    rows.append({DataCell{term.name}, number(term.before), number(term.after), changed, DataCell{term.unit}});
  }
  m_terms->setRows(rows);
}

void UploadPage::renderTransaction() {
  m_stages->setStages(m_state.stages);
  m_writeCard->setSubtitle(std::isnan(m_state.ramp_percent) ? m_state.stagesNote
                                                            : tr("ramp %1 %").arg(m_state.ramp_percent, 0, 'f', 0));
}

int UploadPage::proposedRow() const {
  for (int row = 0; row < m_state.history.size(); ++row) {
    if (m_state.history[row].proposed) return row;
  }
  return -1;
}

void UploadPage::renderHistory() {
  m_history->setColumns({{tr("Version"), 56, true, {}},
                         {tr("Written"), 108, false, {}},
                         {tr("By"), 58, false, {}},
                         {tr("How"), 0, false, {}}});
  QVector<QVector<DataCell>> rows;
  int chosen = -1;
  const QString unknown = QStringLiteral("–");
  for (const TableVersion& version : m_state.history) {
    if (version.id == m_chosen && !version.active) chosen = static_cast<int>(rows.size());
    DataCell number{QString::number(version.version)};
    number.strong = version.active;
    DataCell how{version.active ? tr("active: %1").arg(version.how) : version.how};
    how.judged = version.active;
    how.judgement = version.active ? Judgement::ok : Judgement::none;
    how.tip = QStringList{version.how, version.what, version.note}.join(QLatin1Char('\n')).trimmed();
    DataCell who{version.who.isEmpty() ? unknown : version.who};
    who.tip = version.who;
    rows.append({number, DataCell{version.when.isEmpty() ? unknown : version.when}, who, how});
  }
  const QSignalBlocker quiet(m_history);
  m_history->setRows(rows);
  if (chosen < 0) chosen = proposedRow();
  m_chosen = m_state.history.value(chosen).id;
  m_history->selectRow(chosen);
  renderRollback();
}

void UploadPage::renderRollback() {
  const int row = m_history->currentRow();
  const TableVersion chosen = m_state.history.value(row);
  QString why = m_state.writing ? tr("The table is being written.") : m_state.rollbackBlocked;
  if (why.isEmpty() && m_state.history.isEmpty()) why = tr("Nothing was written into this machine yet.");
  if (why.isEmpty() && chosen.id.isEmpty()) why = tr("Select the version to go back to.");
  if (why.isEmpty()) why = chosen.blocked;
  m_rollback->setText(chosen.id.isEmpty() ? tr("Roll back") : tr("Roll back to version %1").arg(chosen.version));
  m_rollback->setEnabled(why.isEmpty());
  const QString deed = tr("Writes version %1 (%2) again, as a new version. The difference is shown and you are asked.")
                           .arg(chosen.version)
                           .arg(chosen.what);
  m_rollback->setToolTip(why.isEmpty() ? deed : why);
  m_rollbackHint->setText(why.isEmpty() ? deed : why);
}

}  // namespace zerodrift::ui
