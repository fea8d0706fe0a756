#include "ui/widgets/register_table.h"

#include <functional>

namespace zerodrift::ui {
namespace {

/// A list to choose from in the cells of some columns, a line in the others.
class RegisterEditor : public QStyledItemDelegate {
 public:
  RegisterEditor(QObject* parent, std::function<QStringList()> names)
      : QStyledItemDelegate(parent), m_names(std::move(names)) {}

  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const QStringList offered = choices(index.column());
    if (offered.isEmpty()) return QStyledItemDelegate::createEditor(parent, option, index);
    auto* box = new QComboBox(parent);
    box->setEditable(index.column() == RegisterTable::name);
    box->addItems(offered);
    return box;
  }
  void setEditorData(QWidget* editor, const QModelIndex& index) const override {
    if (auto* box = qobject_cast<QComboBox*>(editor)) {
      box->setCurrentText(index.data().toString());
      return;
    }
    QStyledItemDelegate::setEditorData(editor, index);
  }
  void setModelData(QWidget* editor, QAbstractItemModel* model, const QModelIndex& index) const override {
    if (auto* box = qobject_cast<QComboBox*>(editor)) {
      model->setData(index, box->currentText());
      return;
    }
    QStyledItemDelegate::setModelData(editor, model, index);
  }

 private:
  QStringList choices(int column) const {
    if (column == RegisterTable::name) return m_names();
    if (column == RegisterTable::function) return {"holding", "input"};
    if (column == RegisterTable::type) return {"int16", "uint16", "int32", "uint32", "float32"};
    if (column == RegisterTable::order) return {"ABCD", "CDAB", "BADC", "DCBA"};
    return {};
  }

  std::function<QStringList()> m_names;
};

QStringList texts_of(const RegisterRow& row) {
  return {row.name,
          QString::number(row.address),
          row.function,
          row.type,
          QString::number(row.count),
          row.scale,
          row.order,
          row.value,
          row.meaning};
}

}  // namespace

RegisterTable::RegisterTable(QWidget* parent) : QWidget(parent) {
  m_table = new QTableWidget(0, columns, this);
  m_table->setObjectName("registers");
  m_table->setItemDelegate(new RegisterEditor(m_table, [this] { return m_names; }));
  m_table->verticalHeader()->hide();
  m_table->verticalHeader()->setDefaultSectionSize(26);
  m_table->verticalHeader()->setMinimumSectionSize(20);
  m_table->setShowGrid(false);
  m_table->setFrameShape(QFrame::NoFrame);
  m_table->setSelectionBehavior(QAbstractItemView::SelectRows);
  m_table->setSelectionMode(QAbstractItemView::SingleSelection);
  m_table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  auto* header = m_table->horizontalHeader();
  header->setHighlightSections(false);
  header->setFixedHeight(28);
  const QVector<int> widths = {180, 64, 72, 72, 54, 70, 60, 210, 0};
  for (int i = 0; i < widths.size(); ++i) {
    if (widths[i] > 0) m_table->setColumnWidth(i, widths[i]);
  }
  header->setStretchLastSection(true);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(m_table);
  connect(m_table, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    if (!m_filling) Q_EMIT edited(item->row(), item->column(), item->text());
  });
  connect(m_table, &QTableWidget::currentCellChanged, this, [this](int row, int, int before, int) {
    if (!m_filling && row != before) Q_EMIT rowSelected(row);
  });
  setHeaders();
}

void RegisterTable::setHeaders() {
  m_table->setHorizontalHeaderLabels({tr("Name"), tr("Address"), tr("Function"), tr("Type"), tr("Count"), tr("Scale"),
                                      tr("Order"), tr("Value now"), tr("Meaning")});
  m_table->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  m_table->horizontalHeaderItem(order)->setToolTip(tr("ABCD: high word and high byte first"));
  m_table->setAccessibleName(tr("Registers"));
}

void RegisterTable::setNames(const QStringList& names) {
  m_names = names;
}

void RegisterTable::setRows(const QVector<RegisterRow>& rows) {
  m_filling = true;
  m_table->setRowCount(static_cast<int>(rows.size()));
  for (int row = 0; row < rows.size(); ++row) {
    const QStringList texts = texts_of(rows[row]);
    for (int column = 0; column < columns; ++column) {
      auto* item = m_table->item(row, column);
      if (item == nullptr) {
        item = new QTableWidgetItem;
        if (column == value || column == meaning) item->setFlags(item->flags() & ~Qt::ItemIsEditable);
        m_table->setItem(row, column, item);
      }
      if (item->text() != texts[column]) item->setText(texts[column]);
      if (column == value) {
        item->setForeground(rows[row].failed ? colors().badText : colors().text);
        item->setToolTip(rows[row].raw);
      }
      if (column == name) item->setToolTip(rows[row].name);
      if (column == meaning) item->setForeground(colors().muted);
    }
  }
  m_filling = false;
}

int RegisterTable::currentRow() const {
  return m_table->currentRow();
}

void RegisterTable::selectRow(int row) {
  m_table->selectRow(row);
}

}  // namespace zerodrift::ui
