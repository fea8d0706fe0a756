#pragma once
// The registers of a controller with their decoded values, live; everything but the value can be edited.

#include <QString>
#include <QStringList>
#include <QVector>
#include <QWidget>

#include "ui/widgets/colors.h"

class QTableWidget;

namespace zerodrift::ui {

struct RegisterRow {
  QString name{};     // "temperature_C"
  QString meaning{};  // "temperatures, C"; empty: no use is known
  int address = 0;
  QString function{};  // "holding", "input"
  QString type{};      // "int16"
  int count = 1;
  QString scale{};  // "0.0625", with the sign
  QString order{};  // "ABCD"
  QString value{};  // decoded, live
  QString raw{};    // the words, in hex
  bool failed = false;

  bool operator==(const RegisterRow& other) const = default;
};

class RegisterTable : public QWidget {
  Q_OBJECT

 public:
  enum Column { name, address, function, type, count, scale, order, value, meaning, columns };

  explicit RegisterTable(QWidget* parent = nullptr);
  /// A cell that is being edited keeps what the user types.
  void setRows(const QVector<RegisterRow>& rows);
  /// What the editor of a name offers.
  void setNames(const QStringList& names);
  int currentRow() const;
  void selectRow(int row);
  void setHeaders();

 Q_SIGNALS:
  void edited(int row, int column, const QString& text);
  void rowSelected(int row);

 private:
  QTableWidget* m_table;
  QStringList m_names;
  bool m_filling = false;
};

}  // namespace zerodrift::ui
