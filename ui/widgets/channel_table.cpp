#include "ui/widgets/channel_table.h"

#include "ui/widgets/copy_rows.h"
#include "ui/widgets/fitted_text.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/whole_rows.h"

namespace zerodrift::ui {

enum Column {
  swatchColumn,
  tagColumn,
  valueColumn,
  stateColumn,
  columnCount,
};

class ChannelModel : public QAbstractTableModel {
 public:
  using QAbstractTableModel::QAbstractTableModel;

  QVector<ChannelRow> rows;
  QStringList headers = {QString(), QString(), QString(), QString()};

  int rowCount(const QModelIndex& parent = {}) const override {
    return parent.isValid() ? 0 : static_cast<int>(rows.size());
  }
  int columnCount(const QModelIndex& = {}) const override { return ui::columnCount; }

  QVariant headerData(int section, Qt::Orientation orientation, int role) const override {
    if (orientation != Qt::Horizontal) return {};
    if (role == Qt::DisplayRole) return headers.value(section);
    if (role == Qt::TextAlignmentRole)
      return int(Qt::AlignVCenter | (section == valueColumn ? Qt::AlignRight : Qt::AlignLeft));
    return {};
  }

  static QString words(QStringList parts) {
    parts.removeAll(QString());
    return listText(parts);
  }

  QVariant data(const QModelIndex& index, int role) const override {
    const ChannelRow& row = rows[index.row()];
    switch (role) {
      case Qt::DisplayRole:
        if (index.column() == tagColumn) return row.tag;
        if (index.column() == valueColumn) return row.value;
        if (index.column() == stateColumn) return row.state;
        return {};
      case Qt::TextAlignmentRole:
        return int(Qt::AlignVCenter | (index.column() == valueColumn ? Qt::AlignRight : Qt::AlignLeft));
      case Qt::ForegroundRole:
        if (index.column() == stateColumn) return colors().ink(row.judgement);
        if (!row.visible) return colors().muted;
        return {};
      case Qt::ToolTipRole:
        return words({row.tag, row.value, row.state, row.tip});
      case Qt::AccessibleTextRole:
        return words({row.tag, row.value, row.state});
      default:
        return {};
    }
  }

  void replace(const QVector<ChannelRow>& with) {
    beginResetModel();
    rows = with;
    endResetModel();
  }
  void touched(int row) { Q_EMIT dataChanged(index(row, 0), index(row, ui::columnCount - 1)); }
};

namespace {

class RowPainter : public QStyledItemDelegate {
 public:
  using QStyledItemDelegate::QStyledItemDelegate;

  QSize sizeHint(const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    return {QStyledItemDelegate::sizeHint(option, index).width(), 22};
  }

  void paint(QPainter* painter, const QStyleOptionViewItem& option, const QModelIndex& index) const override {
    const auto& row = static_cast<const ChannelModel*>(index.model())->rows[index.row()];
    const Colors& c = colors();
    painter->save();
    if (option.state & QStyle::State_Selected) painter->fillRect(option.rect, c.soft(c.accent));
    if ((option.state & QStyle::State_MouseOver) && !(option.state & QStyle::State_Selected)) {
      painter->fillRect(option.rect, c.grid);
    }
    painter->setPen(c.grid);
    painter->drawLine(option.rect.bottomLeft(), option.rect.bottomRight());
    if (index.column() == swatchColumn) {
      paintSwatch(painter, option.rect, row);
    } else {
      const bool strong = row.judgement == Judgement::bad || row.judgement == Judgement::warn;
      QColor ink = index.column() == stateColumn ? c.ink(row.judgement) : row.visible ? c.text : c.muted;
      if (index.column() == valueColumn && row.judgement == Judgement::bad) ink = c.badText;
      painter->setPen(ink);
      painter->setFont(uiFont(12, strong && index.column() == stateColumn ? QFont::DemiBold : QFont::Normal));
      const QRect inside = option.rect.adjusted(4, 0, -6, 0);
      painter->drawText(inside, index.data(Qt::TextAlignmentRole).toInt(),
                        fittedText(painter->fontMetrics(), index.data().toString(), inside.width(),
                                   index.data(Qt::ToolTipRole).toString()));
    }
    painter->restore();
  }

 private:
  static void paintSwatch(QPainter* painter, const QRect& rect, const ChannelRow& row) {
    painter->setRenderHint(QPainter::Antialiasing);
    if (!row.color.isValid()) {
      if (row.judgement != Judgement::none) {
        drawJudgement(*painter, QRectF(rect.x() + 12, rect.center().y() - 5.5, 12, 12), row.judgement);
      }
      return;
    }
    const QRectF bar(rect.x() + 11, rect.center().y() - 1.5, 14, 4);
    painter->setPen(row.visible ? Qt::NoPen : QPen(row.color, 1));
    painter->setBrush(row.visible ? QBrush(row.color) : Qt::NoBrush);
    painter->drawRoundedRect(bar, 2, 2);
  }
};

}  // namespace

ChannelTable::ChannelTable(QWidget* parent) : QWidget(parent) {
  m_model = new ChannelModel(this);
  m_view = new QTableView(this);
  m_view->setModel(m_model);
  m_view->setItemDelegate(new RowPainter(m_view));
  m_view->setSelectionBehavior(QAbstractItemView::SelectRows);
  m_view->setSelectionMode(QAbstractItemView::SingleSelection);
  m_view->setShowGrid(false);
  m_view->setFrameShape(QFrame::NoFrame);
  m_view->verticalHeader()->hide();
  m_view->verticalHeader()->setMinimumSectionSize(18);
  m_view->verticalHeader()->setDefaultSectionSize(22);
  m_view->setHorizontalScrollBarPolicy(Qt::ScrollBarAlwaysOff);
  m_view->setMouseTracking(true);
  m_view->setTabKeyNavigation(false);
  auto* header = m_view->horizontalHeader();
  header->setHighlightSections(false);
  header->setMinimumSectionSize(20);
  header->setFixedHeight(26);
  header->setSectionResizeMode(QHeaderView::Fixed);
  header->setSectionResizeMode(tagColumn, QHeaderView::Stretch);
  m_view->setColumnWidth(swatchColumn, 34);
  m_view->setColumnWidth(valueColumn, 84);
  m_view->setColumnWidth(stateColumn, 74);
  m_view->viewport()->installEventFilter(this);
  new WholeRows(this, m_view);
  copyRows(m_view);
  connect(m_view->selectionModel(), &QItemSelectionModel::currentRowChanged, this,
          [this](const QModelIndex& now) { Q_EMIT selected(now.isValid() ? m_model->rows[now.row()].id : QString()); });
  connect(m_view, &QTableView::clicked, this, [this](const QModelIndex& at) {
    if (at.column() != swatchColumn || !m_model->rows[at.row()].color.isValid()) return;
    ChannelRow& row = m_model->rows[at.row()];
    row.visible = !row.visible;
    m_model->touched(at.row());
    Q_EMIT visibilityChanged(row.id, row.visible);
  });
  setHeaders(tr("Channel"), tr("Value"), tr("State"));
}

void ChannelTable::setHeaders(const QString& tag, const QString& value, const QString& state) {
  m_model->headers = {QString(), tag, value, state};
  Q_EMIT m_model->headerDataChanged(Qt::Horizontal, 0, columnCount - 1);
  m_view->setColumnHidden(stateColumn, state.isEmpty());
}

void ChannelTable::setColumnWidths(int value, int state) {
  m_view->setColumnWidth(valueColumn, value);
  m_view->setColumnWidth(stateColumn, state);
}

void ChannelTable::setRows(const QVector<ChannelRow>& rows) {
  const bool same = std::equal(rows.begin(), rows.end(), m_model->rows.begin(), m_model->rows.end(),
                               [](const ChannelRow& a, const ChannelRow& b) { return a.id == b.id; });
  if (same) {
    m_model->rows = rows;
    if (!rows.isEmpty()) {
      Q_EMIT m_model->dataChanged(m_model->index(0, 0),
                                  m_model->index(static_cast<int>(rows.size()) - 1, columnCount - 1));
    }
    return;
  }
  // The model is replaced without a reset's signals reaching the outside as a selection of the user.
  const QSignalBlocker quiet(this);
  m_view->selectionModel()->clear();
  m_model->replace(rows);
  layout()->update();
}

const QVector<ChannelRow>& ChannelTable::rows() const {
  return m_model->rows;
}

void ChannelTable::setValue(const QString& id, const QString& value, const QString& state, Judgement judgement) {
  for (int i = 0; i < m_model->rows.size(); ++i) {
    ChannelRow& row = m_model->rows[i];
    if (row.id != id) continue;
    row.value = value;
    row.state = state;
    row.judgement = judgement;
    m_model->touched(i);
    return;
  }
}

QString ChannelTable::selectedId() const {
  const QModelIndex now = m_view->selectionModel()->currentIndex();
  return now.isValid() ? m_model->rows[now.row()].id : QString();
}

void ChannelTable::select(const QString& id) {
  for (int i = 0; i < m_model->rows.size(); ++i) {
    if (m_model->rows[i].id == id) {
      m_view->setCurrentIndex(m_model->index(i, tagColumn));
      return;
    }
  }
  m_view->clearSelection();
  m_view->setCurrentIndex({});
}

bool ChannelTable::eventFilter(QObject* watched, QEvent* event) {
  if (event->type() == QEvent::MouseMove || event->type() == QEvent::Leave) {
    QString over;
    if (event->type() == QEvent::MouseMove) {
      const QModelIndex at = m_view->indexAt(static_cast<QMouseEvent*>(event)->pos());
      if (at.isValid()) over = m_model->rows[at.row()].id;
    }
    if (over != m_hovered) {
      m_hovered = over;
      Q_EMIT hovered(over);
    }
  }
  return QWidget::eventFilter(watched, event);
}

}  // namespace zerodrift::ui
