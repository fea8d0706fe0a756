#include "ui/widgets/column_dialog.h"

#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

constexpr int role_row = 0;

}  // namespace

QStringList ColumnDialog::roleNames() {
  return {tr("not used"),
          tr("position"),
          tr("error"),
          tr("error, upwards"),
          tr("error, downwards"),
          tr("measured position"),
          tr("measured, upwards"),
          tr("measured, downwards"),
          tr("direction"),
          tr("run")};
}

ColumnDialog::ColumnDialog(const QStringList& names, const QVector<QStringList>& rows, const ColumnChoice& choice,
                           QWidget* parent)
    : QDialog(parent) {
  setWindowTitle(tr("Columns of the laser table"));
  auto* what = new WrapLabel(this);
  what->setText(tr("Say what each column holds. Errors are actual minus commanded position."));
  const int count = static_cast<int>(choice.roles.size());
  m_table = new QTableWidget(static_cast<int>(rows.size()) + 1, count, this);
  m_table->setObjectName("columns");
  m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  m_table->setSelectionMode(QAbstractItemView::NoSelection);
  m_table->verticalHeader()->hide();
  m_table->setRowHeight(role_row, 40);
  QStringList heads;
  for (int column = 0; column < count; ++column) {
    const QString name = names.value(column);
    heads.append(name.isEmpty() ? tr("Column %1").arg(column + 1) : name);
    auto* role = new QComboBox(m_table);
    role->setObjectName(QStringLiteral("role%1").arg(column));
    role->setAccessibleName(heads.last());
    role->addItems(roleNames());
    role->setCurrentIndex(choice.roles[column]);
    connect(role, &QComboBox::currentIndexChanged, this, &ColumnDialog::changed);
    m_table->setCellWidget(role_row, column, role);
    m_table->setColumnWidth(column, 172);
    m_roles.append(role);
    for (int row = 0; row < rows.size(); ++row) {
      m_table->setItem(row + 1, column, new QTableWidgetItem(rows[row].value(column)));
    }
  }
  m_table->setHorizontalHeaderLabels(heads);

  m_positionUnit = new QComboBox(this);
  m_positionUnit->setObjectName("positionUnit");
  m_positionUnit->addItems({tr("mm"), tr("µm"), tr("inch")});
  m_positionUnit->setCurrentIndex(choice.positionUnit);
  m_errorUnit = new QComboBox(this);
  m_errorUnit->setObjectName("errorUnit");
  m_errorUnit->addItems({tr("µm"), tr("mm"), tr("inch"), tr("microinch"), tr("mil (0.001 inch)"), tr("0.0001 inch")});
  m_errorUnit->setCurrentIndex(choice.errorUnit);
  m_negated = new QCheckBox(tr("The file holds compensations (turn the sign)"), this);
  m_negated->setObjectName("negated");
  m_negated->setChecked(choice.negated);
  m_order = new QCheckBox(tr("Rows towards smaller positions are the downward approach"), this);
  m_order->setObjectName("order");
  m_order->setChecked(choice.order);
  auto* form = new QFormLayout;
  form->addRow(tr("Positions in"), m_positionUnit);
  form->addRow(tr("Errors in"), m_errorUnit);
  form->addRow(m_negated);
  form->addRow(m_order);
  m_verdict = new WrapLabel(this);
  m_verdict->setObjectName("verdict");
  auto* buttons = new QDialogButtonBox(QDialogButtonBox::Cancel, this);
  m_take = buttons->addButton(tr("Use these columns"), QDialogButtonBox::AcceptRole);
  m_take->setProperty("primary", true);
  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(20, 16, 20, 16);
  all->setSpacing(12);
  all->addWidget(what);
  all->addWidget(m_table, 1);
  all->addLayout(form);
  all->addWidget(m_verdict);
  all->addWidget(buttons);
  resize(std::clamp(180 * count + 60, 560, 1100), 560);
  for (QComboBox* unit : {m_positionUnit, m_errorUnit}) {
    connect(unit, &QComboBox::currentIndexChanged, this, &ColumnDialog::changed);
  }
  for (QCheckBox* box : {m_negated, m_order}) connect(box, &QCheckBox::toggled, this, &ColumnDialog::changed);
  connect(buttons, &QDialogButtonBox::accepted, this, &QDialog::accept);
  connect(buttons, &QDialogButtonBox::rejected, this, &QDialog::reject);
}

ColumnChoice ColumnDialog::choice() const {
  ColumnChoice out;
  for (const QComboBox* role : m_roles) out.roles.append(role->currentIndex());
  out.positionUnit = m_positionUnit->currentIndex();
  out.errorUnit = m_errorUnit->currentIndex();
  out.negated = m_negated->isChecked();
  out.order = m_order->isChecked();
  return out;
}

void ColumnDialog::setVerdict(const QString& text, bool good) {
  m_verdict->setText(text);
  m_verdict->setProperty("role", good ? "ok" : "bad");
  m_verdict->style()->unpolish(m_verdict);
  m_verdict->style()->polish(m_verdict);
  m_take->setEnabled(good);
}

}  // namespace zerodrift::ui
