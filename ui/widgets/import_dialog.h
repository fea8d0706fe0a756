#pragma once
// A recording of any logger before it is taken: its first rows as they were read, what each column becomes, and what
// stands in the way. It shows what it is told and tells what was changed.

#include <QDialog>
#include <QString>
#include <QStringList>
#include <QVector>

class QComboBox;
class QLabel;
class QLineEdit;
class QPushButton;
class QTableWidget;

namespace zerodrift::ui {

class ProblemBanner;
struct Problem;

/// What a column of the file is; in the order of ImportDialog::roleNames().
enum class ImportRole {
  unused,
  time,
  temperature,
  room,
  displacement,
  tilt,
  speed,
  coolant,
  load,
  input,
};

struct ImportColumn {
  QString name{};     // as in the header; "#3" where it has none
  QString detail{};   // below it: the label in the logger's block, why it is not used
  QString example{};  // its first values
  ImportRole role = ImportRole::unused;
  QString channel{};   // of the recording
  QString unit{};      // of the values in the file
  QString scale{};     // beside the unit; empty: by the unit
  QString axis{};      // displacement: X, Y, Z; tilt: A, B; empty: none
  QString location{};  // sensor
  QString format{};    // time: as strptime reads it; empty: found from the cells
  bool problem = false;
};

/// How the table is read; empty: as found from the file.
struct ImportTable {
  QString decimal{};
  QString separator{};
  QString sheet{};
  QStringList missing{};  // further words for a missing sample

  bool operator==(const ImportTable& other) const = default;
};

struct ImportState {
  QString file{};
  QString form{};  // "UTF-8, separated by comma, decimal point; time in s; 1201 rows over 5 h"
  QStringList heads{};
  QVector<QStringList> rows{};  // the first, as they are in the file
  QVector<ImportColumn> columns{};
  QString sentence{};  // what stands in the way; empty: nothing
  QString remedy{};
  QStringList notes{};  // what the import has to say
  ImportTable table{};
  bool workbook = false;
  bool reading = false;
  bool ready = false;
  QString take{};        // the button: "Use this recording"
  QStringList places{};  // where in the job it can go; empty: there is no choice
  int place = 0;
};

class ImportDialog : public QDialog {
  Q_OBJECT

 public:
  explicit ImportDialog(QWidget* parent = nullptr);
  void setState(const ImportState& state);
  const ImportState& state() const { return m_state; }
  /// The file is being read with another map: nothing can be taken until it is.
  void setReading();
  static QStringList roleNames();

 Q_SIGNALS:
  void columnEdited(int row, const zerodrift::ui::ImportColumn& before, const zerodrift::ui::ImportColumn& column);
  void tableEdited(const zerodrift::ui::ImportTable& table);
  void placeChosen(int place);
  void mapLoadRequested();
  void mapSaveRequested();

 protected:
  void changeEvent(QEvent* event) override;

 private:
  struct Row {
    QComboBox* role;
    QLineEdit* channel;
    QComboBox* unit;
    QLineEdit* scale;
    QComboBox* axis;
    QLineEdit* location;  // of a sensor; the format of a time
  };
  void makeRows(int count);
  Row makeRow(int number);
  void fillRow(int number);
  void colourRow(int number);
  void fillPreview();
  void retranslate();
  void edited(int number);
  void tableTouched();

  ImportState m_state;
  QLabel* m_file;
  QLabel* m_form;
  ProblemBanner* m_problem;
  QTableWidget* m_preview;
  QTableWidget* m_table;
  QVector<Row> m_rows;
  QVector<QLabel*> m_names;  // of the options
  QComboBox* m_decimal;
  QComboBox* m_separator;
  QLineEdit* m_missing;
  QLineEdit* m_sheet;
  QLabel* m_notes;
  QLabel* m_placeName;
  QComboBox* m_place;
  QPushButton* m_load;
  QPushButton* m_save;
  QPushButton* m_cancel;
  QPushButton* m_take;
  bool m_filling = false;
};

}  // namespace zerodrift::ui
