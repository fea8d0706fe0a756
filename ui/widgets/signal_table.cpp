#include "ui/widgets/signal_table.h"

#include <QComboBox>
#include <QHeaderView>
#include <QStyledItemDelegate>
#include <QTableWidget>
#include <QVBoxLayout>
#include <algorithm>
#include <functional>
#include <utility>

#include "ui/widgets/copy_rows.h"

namespace zerodrift::ui {
namespace {

/// A list to choose from where there is one, a line in the others.
class SignalEditor : public QStyledItemDelegate {
 public:
  using Choices = std::function<QStringList(int row, int column)>;
  SignalEditor(QObject* parent, Choices choices) : QStyledItemDelegate(parent), m_choices(std::move(choices)) {}

  QWidget* createEditor(QWidget* parent, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const QStringList offered = m_choices(index.row(), index.column());
    if (offered.isEmpty()) return QStyledItemDelegate::createEditor(parent, option, index);
    auto* box = new QComboBox(parent);
    box->setEditable(index.column() == SignalTable::signal);
    box->setInsertPolicy(QComboBox::NoInsert);
    box->addItems(offered);
    return box;
  }
  void setEditorData(QWidget* editor, const QModelIndex& index) const override {
    auto* box = qobject_cast<QComboBox*>(editor);
    if (box == nullptr) return QStyledItemDelegate::setEditorData(editor, index);
    box->setCurrentText(index.data().toString());
  }
  void setModelData(QWidget* editor, QAbstractItemModel* model, const QModelIndex& index) const override {
    auto* box = qobject_cast<QComboBox*>(editor);
    if (box == nullptr) return QStyledItemDelegate::setModelData(editor, model, index);
    model->setData(index, box->currentText());
  }

 private:
  Choices m_choices;
};

QString markOf(Judgement judgement) {
  switch (judgement) {
    case Judgement::ok:
      return QStringLiteral("✓ ");
    case Judgement::warn:
      return QStringLiteral("! ");
    case Judgement::bad:
      return QStringLiteral("✕ ");
    case Judgement::none:
      break;
  }
  return {};
}

bool editable(const SignalLine& line, int column) {
  switch (column) {
    case SignalTable::name:
    case SignalTable::label:
      return line.sensor;
    case SignalTable::device:
    case SignalTable::signal:
      return true;
    case SignalTable::scale:
      return !line.scale.isEmpty();
    default:
      return false;
  }
}

}  // namespace

SignalTable::SignalTable(QWidget* parent) : QWidget(parent) {
  m_table = new QTableWidget(0, columns, this);
  m_table->setObjectName("signals");
  m_table->setItemDelegate(new SignalEditor(m_table, [this](int row, int column) { return choices(row, column); }));
  m_table->setEditTriggers(QAbstractItemView::DoubleClicked | QAbstractItemView::EditKeyPressed |
                           QAbstractItemView::AnyKeyPressed | QAbstractItemView::SelectedClicked);
  m_table->verticalHeader()->hide();
  m_table->verticalHeader()->setDefaultSectionSize(28);
  m_table->verticalHeader()->setMinimumSectionSize(20);
  m_table->setShowGrid(false);
  m_table->setFrameShape(QFrame::NoFrame);
  m_table->setSelectionMode(QAbstractItemView::ExtendedSelection);
  m_table->setHorizontalScrollMode(QAbstractItemView::ScrollPerPixel);
  auto* header = m_table->horizontalHeader();
  header->setHighlightSections(false);
  header->setFixedHeight(28);
  const QVector<int> widths = {150, 0, 104, 204, 58, 56, 80, 128};
  for (int i = 0; i < widths.size(); ++i) {
    header->setSectionResizeMode(i, widths[i] == 0 ? QHeaderView::Stretch : QHeaderView::Interactive);
    if (widths[i] > 0) m_table->setColumnWidth(i, widths[i]);
  }
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(0, 0, 0, 0);
  all->addWidget(m_table);
  copyRows(m_table);
  connect(m_table, &QTableWidget::itemChanged, this, [this](QTableWidgetItem* item) {
    if (!m_filling) Q_EMIT edited(item->row(), item->column(), item->text());
  });
  connect(m_table, &QTableWidget::currentCellChanged, this, [this](int row, int, int before, int) {
    if (!m_filling && row != before) Q_EMIT rowSelected(row);
  });
  retranslate();
}

void SignalTable::retranslate() {
  m_table->setHorizontalHeaderLabels({tr("Quantity"), tr("Label"), tr("Device"), tr("Register, topic or item"),
                                      tr("Unit"), tr("Scale"), tr("Value now"), tr("Plausible?")});
  m_table->horizontalHeader()->setDefaultAlignment(Qt::AlignLeft | Qt::AlignVCenter);
  for (const int column : {scale, value}) {
    m_table->horizontalHeaderItem(column)->setTextAlignment(Qt::AlignRight | Qt::AlignVCenter);
  }
  m_table->horizontalHeaderItem(scale)->setToolTip(
      tr("Factor from the register to the value. It holds for all values of this register in this device."));
  m_table->setAccessibleName(tr("Signals"));
}

void SignalTable::setDevices(const QStringList& devices) {
  m_devices = devices;
}

QStringList SignalTable::choices(int row, int column) const {
  if (column == device) return m_devices;
  if (column == signal && row >= 0 && row < m_rows.size()) return m_rows[row].offered;
  return {};
}

void SignalTable::setRows(const QVector<SignalLine>& rows) {
  m_filling = true;
  const auto wrong = std::find_if(rows.begin(), rows.end(), [](const auto& line) { return !line.problem.isEmpty(); });
  const int mend = wrong == rows.end() ? -1 : static_cast<int>(wrong - rows.begin());
  m_rows = rows;
  m_table->setRowCount(static_cast<int>(rows.size()));
  for (int row = 0; row < rows.size(); ++row) fill(row, rows[row]);
  m_filling = false;
  if (std::exchange(m_mend, mend) != mend && mend >= 0) m_table->scrollToItem(m_table->item(mend, name));
}

void SignalTable::fill(int row, const SignalLine& line) {
  const QString word =
      line.problem.isEmpty() ? markOf(line.judgement) + line.state : markOf(Judgement::bad) + tr("to be mended");
  const QStringList texts = {line.name, line.label, line.device, line.signal, line.unit, line.scale, line.value, word};
  for (int column = 0; column < columns; ++column) {
    auto* item = m_table->item(row, column);
    if (item == nullptr) {
      item = new QTableWidgetItem;
      m_table->setItem(row, column, item);
    }
    const Qt::ItemFlags flags =
        Qt::ItemIsEnabled | Qt::ItemIsSelectable | (editable(line, column) ? Qt::ItemIsEditable : Qt::NoItemFlags);
    if (item->flags() != flags) item->setFlags(flags);
    if (item->text() != texts[column]) item->setText(texts[column]);
    const bool number = column == value || column == scale;
    item->setTextAlignment(Qt::AlignVCenter | (number ? Qt::AlignRight : Qt::AlignLeft));
    const bool wrong = column == line.problemColumn && !line.problem.isEmpty();
    const bool judged = column == state && (line.judgement != Judgement::none || !line.problem.isEmpty());
    const QColor ink = line.problem.isEmpty() ? colors().ink(line.judgement) : colors().badText;
    // Ordinary text takes its colour from the theme.
    item->setData(Qt::ForegroundRole, judged || wrong ? QVariant(QBrush(ink)) : QVariant());
    item->setToolTip(wrong ? line.problem : column == value && !line.change.isEmpty() ? line.change : texts[column]);
  }
}

int SignalTable::currentRow() const {
  return m_table->currentRow();
}

void SignalTable::selectRow(int row) {
  m_table->setCurrentCell(row, name);
}

}  // namespace zerodrift::ui
