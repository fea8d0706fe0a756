#include "ui/widgets/data_table.h"

#include "ui/widgets/copy_rows.h"
#include "ui/widgets/fitted_text.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/whole_rows.h"

namespace zerodrift::ui {
namespace {

enum CellRole {
  judgementItem = Qt::UserRole + 1,
  judgedItem,
  swatchItem,
  backgroundItem,
  strongItem,
};

class CellPainter : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const Colors& c = colors();
    QStyleOptionViewItem filled = option;
    initStyleOption(&filled, index);
    painter->save();
    painter->setRenderHints(QPainter::Antialiasing | QPainter::TextAntialiasing);
    const bool chosen = option.state & QStyle::State_Selected;
    const QColor background = index.data(backgroundItem).value<QColor>();
    if (chosen) painter->fillRect(option.rect, c.soft(c.accent));
    if (background.isValid()) painter->fillRect(option.rect.adjusted(1, 1, -1, -1), background);
    painter->setPen(c.grid);
    painter->drawLine(option.rect.bottomLeft(), option.rect.bottomRight());

    const bool number = filled.displayAlignment & Qt::AlignRight;
    QRect inside = option.rect.adjusted(number ? 3 : 7, 0, -6, 0);
    const QVariant check = index.data(Qt::CheckStateRole);
    if (check.isValid()) {
      const bool on = check.toInt() == Qt::Checked;
      const QRectF box(inside.x() + 0.5, inside.center().y() - 6.5, 14, 14);
      painter->setPen(on ? c.accent : mix(c.line, c.muted, 0.45));
      painter->setBrush(on ? c.accent : c.panel);
      painter->drawRoundedRect(box, 3, 3);
      if (on) drawIcon(*painter, box.adjusted(1, 1, -1, -1), Icon::tick, c.onAccent, 2.0);
      inside.setLeft(inside.left() + 22);
    }
    const QColor swatch = index.data(swatchItem).value<QColor>();
    if (swatch.isValid()) {
      painter->setPen(Qt::NoPen);
      painter->setBrush(swatch);
      painter->drawEllipse(QPointF(inside.x() + 5, inside.center().y() + 1), 4.5, 4.5);
      inside.setLeft(inside.left() + 16);
    }
    const auto judgement = static_cast<Judgement>(index.data(judgementItem).toInt());
    const bool judged = index.data(judgedItem).toBool();
    if (judged) {
      drawJudgement(*painter, QRectF(inside.x(), inside.center().y() - 5.5, 12, 12), judgement);
      inside.setLeft(inside.left() + 18);
    }
    QColor ink = judged && judgement != Judgement::none ? c.ink(judgement) : c.text;
    if (background.isValid()) ink = background.lightness() > 140 ? lightColors().text : QColor(Qt::white);
    painter->setPen(ink);
    painter->setFont(uiFont(12, index.data(strongItem).toBool() ? QFont::DemiBold : QFont::Normal));
    painter->drawText(inside, static_cast<int>(filled.displayAlignment),
                      fittedText(painter->fontMetrics(), index.data().toString(), inside.width(),
                                 index.data(Qt::ToolTipRole).toString()));
    painter->restore();
  }
};

}  // namespace

DataTable::DataTable(QWidget* parent) : QWidget(parent) {
  m_table = new QTableWidget(this);
  m_table->setItemDelegate(new CellPainter(m_table));
  m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
  m_table->setSelectionMode(QAbstractItemView::SingleSelection);
  m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  m_table->setShowGrid(false);
  m_table->setFrameShape(QFrame::NoFrame);
  m_table->setMouseTracking(true);
  m_table->setTabKeyNavigation(false);
  m_table->verticalHeader()->hide();
  m_table->verticalHeader()->setMinimumSectionSize(18);
  m_table->horizontalHeader()->setFixedHeight(26);
  m_table->horizontalHeader()->setMinimumSectionSize(20);
  m_table->horizontalHeader()->setHighlightSections(false);
  m_table->viewport()->installEventFilter(this);
  new WholeRows(this, m_table);
  copyRows(m_table);
  connect(m_table, &QTableWidget::currentCellChanged, this, [this](int row, int, int before, int) {
    if (!m_filling && row != before) Q_EMIT rowSelected(row);
  });
  connect(m_table, &QTableWidget::cellDoubleClicked, this, [this](int row, int) { Q_EMIT rowActivated(row); });
  connect(m_table, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    if (!m_filling && item->flags().testFlag(Qt::ItemIsUserCheckable)) {
      Q_EMIT checkChanged(item->row(), item->checkState() == Qt::Checked);
    }
  });
}

void DataTable::setColumns(const QVector<DataColumn>& columns) {
  m_filling = true;
  m_table->setColumnCount(static_cast<int>(columns.size()));
  for (int i = 0; i < columns.size(); ++i) {
    auto* item = new QTableWidgetItem(columns[i].title);
    item->setTextAlignment(Qt::AlignVCenter | (columns[i].number ? Qt::AlignRight : Qt::AlignLeft));
    item->setToolTip(columns[i].tip);
    item->setData(Qt::UserRole, columns[i].number);
    m_table->setHorizontalHeaderItem(i, item);
    const bool rest = columns[i].width == 0;
    m_table->horizontalHeader()->setSectionResizeMode(i, rest ? QHeaderView::Stretch : QHeaderView::Fixed);
    if (!rest) m_table->setColumnWidth(i, columns[i].width);
  }
  m_filling = false;
}

void DataTable::setRows(const QVector<QVector<DataCell>>& rows) {
  m_filling = true;
  if (m_table->rowCount() != rows.size()) layout()->update();
  m_table->setRowCount(static_cast<int>(rows.size()));
  for (int row = 0; row < rows.size(); ++row) {
    m_table->setRowHeight(row, m_rowHeight);
    for (int column = 0; column < rows[row].size() && column < m_table->columnCount(); ++column) {
      const DataCell& cell = rows[row][column];
      auto* item = m_table->item(row, column);
      if (item == nullptr) {
        item = new QTableWidgetItem;
        m_table->setItem(row, column, item);
      }
      const bool number = m_table->horizontalHeaderItem(column)->data(Qt::UserRole).toBool();
      item->setText(cell.text);
      item->setToolTip(cell.tip.isEmpty() || cell.tip.contains(cell.text) ? (cell.tip.isEmpty() ? cell.text : cell.tip)
                                                                          : cell.text + QLatin1Char('\n') + cell.tip);
      item->setTextAlignment(Qt::AlignVCenter | (number ? Qt::AlignRight : Qt::AlignLeft));
      item->setData(judgementItem, static_cast<int>(cell.judgement));
      item->setData(judgedItem, cell.judged);
      item->setData(swatchItem, cell.swatch);
      item->setData(backgroundItem, cell.background);
      item->setData(strongItem, cell.strong);
      item->setFlags(Qt::ItemIsEnabled | Qt::ItemIsSelectable |
                     (cell.checkable ? Qt::ItemIsUserCheckable : Qt::NoItemFlags));
      item->setData(Qt::CheckStateRole,
                    cell.checkable ? QVariant(cell.checked ? Qt::Checked : Qt::Unchecked) : QVariant());
    }
  }
  m_filling = false;
  fitHeight();
}

int DataTable::rowCount() const {
  return m_table->rowCount();
}

int DataTable::currentRow() const {
  return m_table->currentRow();
}

void DataTable::selectRow(int row) {
  m_filling = true;
  m_table->setCurrentCell(row, 0);
  m_filling = false;
}

void DataTable::setRowHeight(int pixels) {
  m_rowHeight = pixels;
}

void DataTable::setFitted(bool fitted) {
  m_fitted = fitted;
  m_table->setVerticalScrollBarPolicy(fitted ? Qt::ScrollBarAlwaysOff : Qt::ScrollBarAsNeeded);
  fitHeight();
}

int DataTable::heightOfRows() const {
  return 30 + m_rowHeight * m_table->rowCount();
}

void DataTable::fitHeight() {
  if (m_fitted) setFixedHeight(heightOfRows());
}

bool DataTable::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::MouseMove || event->type() == QEvent::Leave) {
    int over = -1;
    if (event->type() == QEvent::MouseMove) over = m_table->rowAt(static_cast<QMouseEvent*>(event)->pos().y());
    if (over != m_hovered) {
      m_hovered = over;
      Q_EMIT rowHovered(over);
    }
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace zerodrift::ui
