#pragma once
// Which machine, is it alive, is it at rest: start of a job, connection, health list on the drawing of the machine.

#include <QString>
#include <QVector>
#include <limits>

#include "ui/pages/page.h"
#include "ui/widgets/colors.h"

class QComboBox;
class QLabel;
class QListWidget;
class QPushButton;
class QStackedWidget;
class QTableWidget;

namespace zerodrift::ui {

class Card;
class ChannelTable;
class MachineDrawing;
class ToggleSegment;

struct RecentJob {
  QString path{};
  QString name{};    // "VMC-850 #3"
  QString detail{};  // "Warm-up recorded, 20 Nov 2026"
};

struct SensorHealth {
  QString id{};         // channel: "T1_C"
  QString tag{};        // "T1"
  QString label{};      // "Spindle front bearing"
  QString place{};      // component, for the drawing: "spindle", "screw_x", "table", ...
  double along = -1.0;  // 0 fixed end .. 1 free end of the component, negative: unknown
  double value_C = std::numeric_limits<double>::quiet_NaN();
  double age_s = std::numeric_limits<double>::quiet_NaN();
  double noise_K = std::numeric_limits<double>::quiet_NaN();
  Judgement judgement = Judgement::none;
  QString state{};  // "OK", "No signal", "Stuck"
};

struct PartHealth {
  QString id{};     // "X", "spindle", "camera-front", "switch"
  QString label{};  // "X axis", "Camera front", "Compensation switch"
  QString value{};  // "-12.000 mm", "25 frames/s", "OFF"
  Judgement judgement = Judgement::none;
};

struct RegisterRow {
  int address = 0;
  QString type{};
  QString access{};
  QString meaning{};
  QString value{};  // decoded, live
};

struct MachineState {
  bool jobOpen = false;
  bool connected = false;
  bool connecting = false;
  bool compensationOn = false;
  QString machineName{};
  QString address{};  // "Modbus TCP 127.0.0.1:1502, unit 1"
  QStringList profiles{};
  int profile = -1;
  QVector<RecentJob> recent{};
  QVector<SensorHealth> sensors{};
  QVector<PartHealth> parts{};
  QVector<RegisterRow> registers{};
  double spread_K = std::numeric_limits<double>::quiet_NaN();  // largest - smallest temperature at rest
  double spreadLimit_K = 1.0;
  double roundTrip_ms = std::numeric_limits<double>::quiet_NaN();
  double roundTripLimit_ms = 100.0;
  double clockDifference_s = std::numeric_limits<double>::quiet_NaN();
  double clockLimit_s = 2.0;
  bool sampleAvailable = true;
};

class MachinePage : public Page {
  Q_OBJECT

 public:
  explicit MachinePage(QWidget* parent = nullptr);
  void setState(const MachineState& state);
  const MachineState& state() const { return m_state; }
  void selectSensor(const QString& id);

  QString title() const override;
  QString sentence() const override;
  /// Connect, then Start commissioning.
  PageAction primary() const override;
  /// "job" (another job), "import", "test", "disconnect".
  QVector<PageAction> secondary() const override;

 Q_SIGNALS:
  void newJobRequested();
  void openJobRequested(const QString& path);  // empty: let the user choose
  void sampleRequested();
  void virtualMachineRequested();
  void profileImportRequested();
  void profileChosen(int index);
  void sensorSelected(const QString& id);
  void registerEdited(int row, const QString& meaning, int address);

 protected:
  void render() override;

 private:
  QWidget* makeStart();
  QWidget* makeMachine();
  void renderStart();
  void renderMachine();
  void renderParts();
  void renderRegisters();
  QVector<Figure> figures() const;

  MachineState m_state;
  QStackedWidget* m_views;
  QWidget* m_start;
  QWidget* m_machine;
  Card* m_startCard;
  Card* m_recentCard;
  QVector<QPushButton*> m_startButtons;
  QVector<QLabel*> m_startNotes;
  QListWidget* m_recent;
  QLabel* m_noRecent;
  Card* m_wayCard;
  QVector<QLabel*> m_way;
  Card* m_drawingCard;
  Card* m_sensorCard;
  MachineDrawing* m_drawing;
  QTableWidget* m_registers;
  QStackedWidget* m_drawingViews;
  ToggleSegment* m_view;
  QComboBox* m_profile;
  QLabel* m_parts;
  ChannelTable* m_table;
  bool m_filling = false;
};

}  // namespace zerodrift::ui
