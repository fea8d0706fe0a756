#include "ui/widgets/recording_list.h"

#include <QComboBox>
#include <QLineEdit>
#include <QPushButton>

#include "ui/widgets/data_table.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {

RecordingList::RecordingList(QWidget* parent) : Card(parent) {
  setObjectName("recordings");
  setBodyMargins(1, 0, 1, 10);
  m_table = new DataTable(this);
  m_table->setFitted(true);
  m_name = new QLineEdit(this);
  m_name->setObjectName("recordingName");
  m_name->setMaxLength(60);
  m_role = new QComboBox(this);
  m_role->setObjectName("recordingRole");
  m_remove = new QPushButton(this);
  m_remove->setObjectName("removeRecording");
  m_words = new WrapLabel(this);
  m_words->setProperty("role", "caption");
  auto* choice = new QHBoxLayout;
  choice->setContentsMargins(12, 6, 12, 0);
  choice->setSpacing(8);
  choice->addWidget(m_role, 1);
  choice->addWidget(m_remove);
  auto* name = new QHBoxLayout;
  name->setContentsMargins(12, 6, 12, 0);
  name->addWidget(m_name);
  auto* words = new QHBoxLayout;
  words->setContentsMargins(14, 6, 12, 0);
  words->addWidget(m_words);
  body()->setSpacing(0);
  body()->addWidget(m_table);
  body()->addLayout(words);
  body()->addLayout(name);
  body()->addLayout(choice);
  connect(m_table, &DataTable::rowSelected, this, [this](int row) {
    if (!m_filling && row >= 0 && row != m_shown) Q_EMIT shown(row);
  });
  connect(m_name, &QLineEdit::editingFinished, this, [this] {
    const QString text = m_name->text().trimmed();
    if (m_filling || m_shown >= m_rows.size() || text.isEmpty() || text == m_rows[m_shown].name) return;
    Q_EMIT renamed(m_shown, text);
  });
  connect(m_role, &QComboBox::activated, this, [this](int role) {
    const auto use = static_cast<RecordingUse>(role);
    if (m_shown < m_rows.size() && m_rows[m_shown].use != use) Q_EMIT roleChosen(m_shown, use);
  });
  connect(m_remove, &QPushButton::clicked, this, [this] { Q_EMIT removeRequested(m_shown); });
  retranslate();
}

QStringList RecordingList::roleNames() {
  return {tr("training"), tr("another day"), tr("cooling")};
}

void RecordingList::setRecordings(const QVector<RecordingRow>& rows, int shown) {
  m_rows = rows;
  m_shown = shown;
  fill();
}

void RecordingList::retranslate() {
  setTitle(tr("Recordings"));
  m_table->setColumns({{tr("Name"), 0}, {tr("Serves as"), 104}});
  m_name->setAccessibleName(tr("Name of the recording"));
  m_role->setAccessibleName(tr("What the recording serves as"));
  m_role->setToolTip(
      tr("Training: fitted too. Another day: the fit is tested on it. Cooling: fitted too, and it shows "
         "how the heat goes. The physics explains all of them together."));
  m_remove->setText(tr("Remove"));
  m_remove->setToolTip(tr("Takes the recording out of the list. Undo brings it back."));
  fill();
}

void RecordingList::fill() {
  m_filling = true;
  setSubtitle(m_rows.isEmpty() ? QString() : QString::number(m_rows.size()));
  QVector<QVector<DataCell>> cells;
  for (int i = 0; i < m_rows.size(); ++i) {
    DataCell name{m_rows[i].name};
    name.tip = m_rows[i].words;
    cells.append({name, {i == 0 ? tr("first run") : roleNames().value(static_cast<int>(m_rows[i].use))}});
  }
  m_table->setRows(cells);
  m_table->selectRow(m_shown);
  m_role->clear();
  m_role->addItems(roleNames());
  const bool some = m_shown < m_rows.size();
  const bool further = some && m_shown > 0;
  m_words->setText(some ? m_rows[m_shown].words : QString());
  for (QWidget* field :
       {static_cast<QWidget*>(m_name), static_cast<QWidget*>(m_role), static_cast<QWidget*>(m_remove)}) {
    field->setVisible(further);
  }
  if (further) {
    m_name->setText(m_rows[m_shown].name);
    m_role->setCurrentIndex(static_cast<int>(m_rows[m_shown].use));
  }
  m_filling = false;
}

}  // namespace zerodrift::ui
