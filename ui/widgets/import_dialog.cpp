#include "ui/widgets/import_dialog.h"

#include <algorithm>

#include "ui/widgets/colors.h"
#include "ui/widgets/problem_banner.h"
#include "ui/widgets/wrap_label.h"

namespace zerodrift::ui {
namespace {

enum Column { column_name, column_role, column_channel, column_unit, column_scale, column_axis, column_location };
constexpr int columns = column_location + 1;
constexpr int most_notes = 6;
constexpr int preview_height = 178;

/// As they are written in files; the list is open.
QStringList unitsOf(ImportRole role) {
  switch (role) {
    case ImportRole::temperature:
    case ImportRole::room:
      return {"degC", "degF", "K"};
    case ImportRole::displacement:
      return {"um", "mm", "inch", "mil", "microinch"};
    case ImportRole::tilt:
      return {"urad", "mrad"};
    case ImportRole::speed:
      return {"rpm", "1/s"};
    case ImportRole::load:
      return {"W", "kW"};
    case ImportRole::time:
      return {"s", "ms", "us", "ns", "min", "h", "d"};
    case ImportRole::unused:
    case ImportRole::coolant:
    case ImportRole::input:
      break;
  }
  return {};
}

QStringList axesOf(ImportRole role) {
  if (role == ImportRole::displacement) return {"X", "Y", "Z"};
  if (role == ImportRole::tilt) return {"A", "B"};
  return {};
}

bool hasLocation(ImportRole role) {
  return role == ImportRole::temperature || role == ImportRole::room || role == ImportRole::time;
}

void setList(QComboBox* box, const QStringList& items, const QString& now) {
  QStringList all{QString()};
  all << items;
  if (!all.contains(now)) all << now;
  QStringList before;
  for (int i = 0; i < box->count(); ++i) before << box->itemText(i);
  if (before != all) {
    box->clear();
    box->addItems(all);
  }
  if (box->currentText() != now) box->setCurrentIndex(static_cast<int>(all.indexOf(now)));
}

void setLine(QLineEdit* line, const QString& text) {
  if (line->text() != text) line->setText(text);
}

}  // namespace

QStringList ImportDialog::roleNames() {
  return {tr("not used"), tr("time"),          tr("temperature"), tr("room temperature"), tr("displacement"),
          tr("tilt"),     tr("spindle speed"), tr("coolant"),     tr("spindle load"),     tr("other input")};
}

ImportDialog::ImportDialog(QWidget* parent) : QDialog(parent) {
  setObjectName("import");
  m_file = new QLabel(this);
  m_file->setProperty("role", "heading");
  m_form = new WrapLabel(this);
  m_form->setProperty("role", "muted");
  m_form->setObjectName("form");
  m_problem = new ProblemBanner(this);
  m_preview = new QTableWidget(this);
  m_preview->setObjectName("preview");
  m_preview->setEditTriggers(QAbstractItemView::NoEditTriggers);
  m_preview->setSelectionMode(QAbstractItemView::NoSelection);
  m_preview->verticalHeader()->hide();
  m_preview->verticalHeader()->setDefaultSectionSize(24);
  m_preview->setFixedHeight(preview_height);
  m_table = new QTableWidget(0, columns, this);
  m_table->setObjectName("mapping");
  m_table->setEditTriggers(QAbstractItemView::NoEditTriggers);
  m_table->setSelectionMode(QAbstractItemView::NoSelection);
  m_table->setFocusPolicy(Qt::NoFocus);
  m_table->verticalHeader()->hide();
  m_table->verticalHeader()->setDefaultSectionSize(42);
  const QVector<int> widths = {230, 150, 150, 96, 90, 70, 200};
  for (int i = 0; i < columns; ++i) m_table->setColumnWidth(i, widths[i]);
  m_table->horizontalHeader()->setStretchLastSection(true);

  m_decimal = new QComboBox(this);
  m_decimal->setObjectName("decimal");
  m_separator = new QComboBox(this);
  m_separator->setObjectName("separator");
  m_missing = new QLineEdit(this);
  m_missing->setObjectName("missing");
  m_missing->setMaximumWidth(140);
  m_sheet = new QLineEdit(this);
  m_sheet->setObjectName("sheet");
  m_sheet->setMaximumWidth(140);
  auto* options = new QHBoxLayout;
  options->setSpacing(8);
  for (QWidget* field : {static_cast<QWidget*>(m_decimal), static_cast<QWidget*>(m_separator),
                         static_cast<QWidget*>(m_missing), static_cast<QWidget*>(m_sheet)}) {
    auto* name = new QLabel(this);
    name->setProperty("role", "muted");
    name->setBuddy(field);
    m_names.append(name);
    options->addWidget(name);
    options->addWidget(field);
    options->addSpacing(12);
  }
  options->addStretch();
  m_load = new QPushButton(this);
  m_load->setObjectName("loadMap");
  m_save = new QPushButton(this);
  m_save->setObjectName("saveMap");
  options->addWidget(m_load);
  options->addWidget(m_save);
  m_notes = new WrapLabel(this);
  m_notes->setObjectName("notes");
  m_notes->setProperty("role", "caption");
  m_cancel = new QPushButton(this);
  m_cancel->setObjectName("cancel");
  m_take = new QPushButton(this);
  m_take->setObjectName("take");
  m_take->setProperty("primary", true);
  m_take->setDefault(true);
  m_place = new QComboBox(this);
  m_place->setObjectName("place");
  m_placeName = new QLabel(this);
  m_placeName->setProperty("role", "muted");
  m_placeName->setBuddy(m_place);
  auto* foot = new QHBoxLayout;
  foot->setSpacing(8);
  foot->addWidget(m_placeName);
  foot->addWidget(m_place);
  foot->addStretch();
  foot->addWidget(m_cancel);
  foot->addWidget(m_take);

  auto* all = new QVBoxLayout(this);
  all->setContentsMargins(20, 16, 20, 16);
  all->setSpacing(10);
  all->addWidget(m_file);
  all->addWidget(m_form);
  all->addWidget(m_problem);
  all->addWidget(m_preview);
  all->addLayout(options);
  all->addWidget(m_table, 1);
  all->addWidget(m_notes);
  all->addLayout(foot);
  resize(1060, 680);

  connect(m_cancel, &QPushButton::clicked, this, &QDialog::reject);
  connect(m_take, &QPushButton::clicked, this, &QDialog::accept);
  connect(m_load, &QPushButton::clicked, this, &ImportDialog::mapLoadRequested);
  connect(m_save, &QPushButton::clicked, this, &ImportDialog::mapSaveRequested);
  connect(m_decimal, &QComboBox::activated, this, &ImportDialog::tableTouched);
  connect(m_separator, &QComboBox::activated, this, &ImportDialog::tableTouched);
  connect(m_place, &QComboBox::activated, this, [this](int place) {
    if (!m_filling) Q_EMIT placeChosen(place);
  });
  connect(m_missing, &QLineEdit::editingFinished, this, &ImportDialog::tableTouched);
  connect(m_sheet, &QLineEdit::editingFinished, this, &ImportDialog::tableTouched);
  retranslate();
}

ImportDialog::Row ImportDialog::makeRow(int number) {
  Row row{new QComboBox(m_table), new QLineEdit(m_table), new QComboBox(m_table),
          new QLineEdit(m_table), new QComboBox(m_table), new QLineEdit(m_table)};
  row.unit->setEditable(true);
  row.unit->setInsertPolicy(QComboBox::NoInsert);
  const QVector<QWidget*> fields = {row.role, row.channel, row.unit, row.scale, row.axis, row.location};
  const QStringList names = {"role", "channel", "unit", "scale", "axis", "location"};
  for (int i = 0; i < fields.size(); ++i) {
    fields[i]->setObjectName(names[i] + QString::number(number));
    m_table->setCellWidget(number, column_role + i, fields[i]);
  }
  const auto told = [this, number] { edited(number); };
  for (QComboBox* box : {row.role, row.unit, row.axis}) connect(box, &QComboBox::activated, this, told);
  connect(row.unit->lineEdit(), &QLineEdit::editingFinished, this, told);
  for (QLineEdit* line : {row.channel, row.scale, row.location}) {
    connect(line, &QLineEdit::editingFinished, this, told);
  }
  return row;
}

void ImportDialog::makeRows(int count) {
  m_table->setRowCount(0);
  m_table->setRowCount(count);
  m_rows.clear();
  for (int i = 0; i < count; ++i) {
    m_table->setItem(i, column_name, new QTableWidgetItem);
    m_rows.append(makeRow(i));
  }
}

void ImportDialog::colourRow(int number) {
  const ImportColumn& column = m_state.columns[number];
  const bool used = column.role != ImportRole::unused;
  QTableWidgetItem* name = m_table->item(number, column_name);
  name->setForeground(column.problem ? colors().bad : used ? colors().text : colors().muted);
  name->setBackground(column.problem ? QBrush(colors().soft(colors().bad)) : QBrush());
}

void ImportDialog::fillRow(int number) {
  const ImportColumn& column = m_state.columns[number];
  const Row& row = m_rows[number];
  QTableWidgetItem* name = m_table->item(number, column_name);
  const QString below = column.detail.isEmpty() ? column.example : column.detail;
  name->setText(below.isEmpty() ? column.name : column.name + QLatin1Char('\n') + below);
  name->setToolTip(column.name + QLatin1Char('\n') + column.example);
  const bool used = column.role != ImportRole::unused;
  const bool time = column.role == ImportRole::time;
  colourRow(number);
  const QStringList roles = roleNames();
  if (row.role->count() != roles.size() || row.role->itemText(0) != roles.front()) {
    row.role->clear();
    row.role->addItems(roles);
  }
  row.role->setCurrentIndex(static_cast<int>(column.role));
  setLine(row.channel, column.channel);
  setList(row.unit, unitsOf(column.role), column.unit);
  setLine(row.scale, column.scale);
  row.scale->setPlaceholderText(tr("by unit"));
  const QStringList axes = axesOf(column.role);
  setList(row.axis, axes, column.axis);
  setLine(row.location, time ? column.format : column.location);
  row.location->setPlaceholderText(time ? tr("format, e.g. %d.%m.%Y %H:%M:%S") : QString());
  row.channel->setEnabled(used && !time);
  row.unit->setEnabled(used && (time || !unitsOf(column.role).isEmpty()));
  row.scale->setEnabled(used && !time);
  row.axis->setEnabled(!axes.isEmpty());
  row.location->setEnabled(hasLocation(column.role));
  const QVector<QWidget*> fields = {row.role, row.channel, row.unit, row.scale, row.axis, row.location};
  for (int i = 0; i < fields.size(); ++i) {
    fields[i]->setAccessibleName(column.name + ", " + m_table->horizontalHeaderItem(column_role + i)->text());
  }
}

void ImportDialog::fillPreview() {
  m_preview->setColumnCount(static_cast<int>(m_state.heads.size()));
  m_preview->setRowCount(static_cast<int>(m_state.rows.size()));
  m_preview->setHorizontalHeaderLabels(m_state.heads);
  for (int r = 0; r < m_state.rows.size(); ++r) {
    for (int c = 0; c < m_state.heads.size(); ++c) {
      m_preview->setItem(r, c, new QTableWidgetItem(m_state.rows[r].value(c)));
    }
  }
}

void ImportDialog::setState(const ImportState& state) {
  const bool preview = state.rows != m_state.rows || state.heads != m_state.heads;
  m_state = state;
  m_filling = true;
  m_file->setText(state.file);
  m_form->setText(state.form);
  if (state.sentence.isEmpty()) {
    m_problem->clear();
  } else {
    m_problem->setProblem({ProblemKind::failure, state.sentence, state.remedy, {}});
  }
  if (preview) fillPreview();
  if (m_rows.size() != state.columns.size()) makeRows(static_cast<int>(state.columns.size()));
  for (int i = 0; i < m_rows.size(); ++i) fillRow(i);
  m_decimal->setCurrentIndex(std::max(0, m_decimal->findData(state.table.decimal)));
  m_separator->setCurrentIndex(std::max(0, m_separator->findData(state.table.separator)));
  setLine(m_missing, state.table.missing.join(QStringLiteral(", ")));
  setLine(m_sheet, state.table.sheet);
  for (QWidget* field : {static_cast<QWidget*>(m_sheet), static_cast<QWidget*>(m_names.last())}) {
    field->setVisible(state.workbook);
  }
  QStringList notes = state.notes.mid(0, most_notes);
  if (state.notes.size() > most_notes) {
    notes << tr("and %n more", nullptr, static_cast<int>(state.notes.size()) - most_notes);
  }
  m_notes->setText(notes.join(QLatin1Char('\n')));
  m_notes->setToolTip(state.notes.join(QLatin1Char('\n')));
  m_notes->setVisible(!notes.isEmpty());
  m_place->clear();
  m_place->addItems(state.places);
  m_place->setCurrentIndex(state.place);
  for (QWidget* field : {static_cast<QWidget*>(m_place), static_cast<QWidget*>(m_placeName)}) {
    field->setVisible(!state.places.isEmpty());
  }
  m_take->setText(state.take);
  m_take->setEnabled(state.ready && !state.reading);
  m_take->setToolTip(state.ready ? QString() : state.sentence);
  m_save->setEnabled(state.ready);
  m_filling = false;
}

void ImportDialog::setReading() {
  m_state.reading = true;
  m_take->setEnabled(false);
}

void ImportDialog::edited(int number) {
  if (m_filling || number >= m_state.columns.size()) return;
  const Row& row = m_rows[number];
  ImportColumn column = m_state.columns[number];
  const ImportColumn before = column;
  column.role = static_cast<ImportRole>(row.role->currentIndex());
  column.channel = row.channel->text().trimmed();
  column.unit = row.unit->currentText().trimmed();
  column.scale = row.scale->text().trimmed();
  column.axis = row.axis->currentText();
  (before.role == ImportRole::time ? column.format : column.location) = row.location->text().trimmed();
  const auto parts = [](const ImportColumn& c) {
    return std::tuple(c.role, c.channel, c.unit, c.scale, c.axis, c.location, c.format);
  };
  if (parts(column) == parts(before)) return;
  m_state.columns[number] = column;
  Q_EMIT columnEdited(number, before, column);
}

void ImportDialog::tableTouched() {
  if (m_filling) return;
  ImportTable table{
      m_decimal->currentData().toString(), m_separator->currentData().toString(), m_sheet->text().trimmed(), {}};
  for (const QString& word : m_missing->text().split(QLatin1Char(','), Qt::SkipEmptyParts)) {
    if (!word.trimmed().isEmpty()) table.missing << word.trimmed();
  }
  if (table == m_state.table) return;
  m_state.table = table;
  Q_EMIT tableEdited(table);
}

void ImportDialog::retranslate() {
  m_filling = true;
  setWindowTitle(tr("Import a recording"));
  m_table->setHorizontalHeaderLabels({tr("Column of the file"), tr("is"), tr("Channel"), tr("Unit"), tr("Scale"),
                                      tr("Axis"), tr("Location or format")});
  const QStringList names = {tr("Decimal sign"), tr("Separator"), tr("Missing"), tr("Sheet")};
  for (int i = 0; i < names.size(); ++i) m_names[i]->setText(names[i]);
  m_decimal->clear();
  m_decimal->addItem(tr("as found"), QString());
  m_decimal->addItem(tr("point"), QStringLiteral("."));
  m_decimal->addItem(tr("comma"), QStringLiteral(","));
  m_separator->clear();
  m_separator->addItem(tr("as found"), QString());
  m_separator->addItem(tr("comma"), QStringLiteral(","));
  m_separator->addItem(tr("semicolon"), QStringLiteral(";"));
  m_separator->addItem(tr("tab"), QStringLiteral("tab"));
  m_separator->addItem(tr("blanks"), QStringLiteral("blanks"));
  m_missing->setPlaceholderText(tr("further words"));
  m_missing->setToolTip(tr("Words that stand for a missing sample in this file, with commas between them"));
  m_load->setText(tr("Load map"));
  m_load->setToolTip(tr("What the columns are, from a file that was saved for another recording of this logger"));
  m_save->setText(tr("Save map"));
  m_save->setToolTip(tr("Keeps what the columns are, for the next recording of this logger"));
  m_placeName->setText(tr("Take as"));
  m_cancel->setText(tr("Cancel"));
  m_filling = false;
}

void ImportDialog::changeEvent(QEvent* event) {
  if (event->type() == QEvent::LanguageChange) {
    retranslate();
    setState(ImportState(m_state));
  }
  // What is being typed stays: the colours alone follow a change of theme.
  if (event->type() == QEvent::PaletteChange || event->type() == QEvent::StyleChange)
    for (int i = 0; i < m_rows.size(); ++i) colourRow(i);
  QDialog::changeEvent(event);
}

}  // namespace zerodrift::ui
