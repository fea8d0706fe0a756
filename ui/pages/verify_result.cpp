#include "ui/pages/verify_result.h"

#include <cmath>

#include "ui/plots/xy_plot.h"
#include "ui/widgets/card.h"
#include "ui/widgets/data_table.h"
#include "ui/widgets/legend_row.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

DataCell micrometres(double value) {
  return DataCell{std::isnan(value) ? QStringLiteral("–") : fixedText(value, 1) + QStringLiteral(" µm")};
}

DataCell judgedCell(DataCell cell, Judgement judgement) {
  cell.judged = judgement != Judgement::none;
  cell.judgement = judgement;
  return cell;
}

}  // namespace

VerifyResult::VerifyResult(QWidget* parent) : QWidget(parent) {
  m_plotCard = new Card(this);
  m_plotCard->setBodyMargins(6, 0, 6, 6);
  m_legend = new LegendRow(m_plotCard);
  m_plot = new XyPlot(m_plotCard);
  m_plot->setTimeAxis(true);
  m_plot->setIncludeZero(true);
  m_plotCard->body()->addWidget(m_legend);
  m_plotCard->body()->addWidget(m_plot, 1);
  m_tableCard = new Card(this);
  m_tableCard->setFixedWidth(480);
  m_tableCard->setBodyMargins(1, 0, 1, 12);
  m_table = new DataTable(m_tableCard);
  m_table->setRowHeight(30);
  m_table->setFitted(true);
  m_words = new WrapLabel(m_tableCard);
  m_words->setContentsMargins(15, 8, 15, 0);
  m_tableCard->body()->addWidget(m_table);
  m_tableCard->body()->addWidget(m_words);
  m_tableCard->body()->addStretch(1);
  auto* row = new QHBoxLayout(this);
  row->setContentsMargins(0, 0, 0, 0);
  row->setSpacing(16);
  row->addWidget(m_plotCard, 1);
  row->addWidget(m_tableCard);
  connect(m_table, &DataTable::rowSelected, this, [this] { renderPlot(); });
}

void VerifyResult::setResults(const QVector<AxisResult>& results, double compared_s, double limit_um, bool same_run,
                              const QStringList& words) {
  m_results = results;
  m_compared_s = compared_s;
  m_limit_um = limit_um;
  m_sameRun = same_run;
  m_words->setText(words.join(QStringLiteral("\n\n")));
  renderTable();
  renderPlot();
}

void VerifyResult::renderTable() {
  m_tableCard->setTitle(tr("Axis by axis"));
  m_tableCard->setSubtitle(
      m_results.isEmpty() ? QString()
      : m_sameRun         ? tr("largest error of the same %1 min").arg(m_compared_s / 60.0, 0, 'f', 0)
                          : tr("largest error in the first %1 min of each run").arg(m_compared_s / 60.0, 0, 'f', 0));
  m_table->setColumns({{tr("Axis"), 46, false, {}},
                       {tr("Without"), 78, true,
                        m_sameRun ? tr("This run less what was applied") : tr("Warm-up run, compensation off")},
                       {tr("With"), 98, true, tr("Verification run, compensation on")},
                       {tr("Gain"), 0, false, tr("Share of the largest error that is gone")},
                       {tr("At the end"), 122, true, tr("Mean of the last tenth: without, with")}});
  QVector<QVector<DataCell>> rows;
  for (const AxisResult& axis : m_results) {
    DataCell name{axis.axis};
    name.strong = true;
    DataCell gain{axis.worse() ? tr("%1 % worse").arg(-axis.removed_percent, 0, 'f', 0)
                               : tr("%1 % removed").arg(std::floor(axis.removed_percent), 0, 'f', 0)};
    if (std::isnan(axis.removed_percent)) gain.text = QStringLiteral("–");
    DataCell end{QStringLiteral("%1 → %2 µm").arg(fixedText(axis.endBefore_um, 1)).arg(fixedText(axis.endAfter_um, 1))};
    if (std::isnan(axis.endBefore_um) || std::isnan(axis.endAfter_um)) end.text = QStringLiteral("–");
    if (axis.worseAtTheEnd()) end.tip = tr("Worse at the end than without compensation");
    const bool kept = axis.after_um <= m_limit_um;
    rows.append({name, micrometres(axis.before_um),
                 judgedCell(micrometres(axis.after_um), kept ? Judgement::ok : Judgement::bad),
                 judgedCell(gain, axis.worse() ? Judgement::bad : Judgement::none),
                 judgedCell(end, axis.worseAtTheEnd() ? Judgement::bad : Judgement::none)});
  }
  m_table->setRows(rows);
  if (m_table->currentRow() >= 0 || m_results.isEmpty()) return;
  int largest = 0;
  for (int i = 1; i < m_results.size(); ++i) {
    if (m_results[i].after_um > m_results[largest].after_um) largest = i;
  }
  m_table->selectRow(largest);
}

void VerifyResult::renderPlot() {
  m_plot->setPlaceholder(tr("Shown when the verification is finished"));
  m_plotCard->setSubtitle(QStringLiteral("µm"));
  m_legend->setItems({{tr("without"), colors().muted, true}, {tr("with compensation"), colors().accent}});
  const int row = m_table->currentRow();
  if (row < 0 || row >= m_results.size()) {
    m_plotCard->setTitle(tr("Without and with compensation"));
    return m_plot->clear();
  }
  const AxisResult& axis = m_results[row];
  m_plotCard->setTitle(tr("%1 without and with compensation").arg(axis.axis));
  m_plot->setAxisLabels(m_sameRun ? tr("time of the run") : tr("time since the start of each run"), {});
  m_plot->setLimits({{m_limit_um, tr("limit"), Judgement::bad}, {-m_limit_um, {}, Judgement::bad}});
  PartStyle style;
  style.unit = QStringLiteral("µm");
  style.tag = tr("%1 without").arg(axis.axis);
  style.color = colors().muted;
  style.dashed = true;
  m_plot->setPart("1before", axis.beforeTime_s, axis.before, style);
  style.tag = tr("%1 with compensation").arg(axis.axis);
  style.color = colors().accent;
  style.dashed = false;
  style.width = 1.8;
  m_plot->setPart("2after", axis.afterTime_s, axis.after, style);
}

}  // namespace zerodrift::ui
