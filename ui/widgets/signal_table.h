#pragma once
// What a profile reads, row by row: the quantity, who reads it, its value now and whether that can be.

#include <QString>
#include <QStringList>
#include <QVector>
#include <QWidget>

#include "ui/widgets/colors.h"

class QTableWidget;

namespace zerodrift::ui {

struct SignalLine {
  QString name{};         // channel of a sensor, or the quantity in words
  QString label{};        // of a sensor
  bool sensor = false;    // name and label can be edited, and it can be removed
  QString device{};       // as shown; empty: nobody reads it
  QString signal{};       // register, topic, data item
  QStringList offered{};  // signals of its device
  QString unit{};
  QString scale{};   // of a Modbus register; empty: there is none to edit
  QString value{};   // as it is now
  QString change{};  // since reading began, for the tool tip
  Judgement judgement = Judgement::none;
  QString state{};    // in words
  QString problem{};  // what is expected instead, at `problemColumn`
  int problemColumn = -1;
};

class SignalTable : public QWidget {
  Q_OBJECT

 public:
  enum Column { name, label, device, signal, unit, scale, value, state, columns };

  explicit SignalTable(QWidget* parent = nullptr);
  /// A cell that is being edited keeps what the user types.
  void setRows(const QVector<SignalLine>& rows);
  /// What the editor of a device offers.
  void setDevices(const QStringList& devices);
  int currentRow() const;
  void selectRow(int row);
  void retranslate();

 Q_SIGNALS:
  void edited(int row, int column, const QString& text);
  void rowSelected(int row);

 private:
  QStringList choices(int row, int column) const;
  void fill(int row, const SignalLine& line);

  QTableWidget* m_table;
  QStringList m_devices;
  QVector<SignalLine> m_rows;
  int m_mend = -1;  // the row that was brought into sight because of its problem
  bool m_filling = false;
};

}  // namespace zerodrift::ui
