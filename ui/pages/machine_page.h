#pragma once
// Which machine, is it alive, is it at rest: start of a job, connection, health list on the drawing of the machine.

#include <QString>
#include <QVector>
#include <limits>

#include "ui/pages/machine_start.h"
#include "ui/pages/page.h"
#include "ui/widgets/colors.h"
#include "ui/widgets/register_table.h"

class QComboBox;
class QLabel;
class QPushButton;
class QStackedWidget;

namespace zerodrift::ui {

class Card;
class ChannelTable;
class DataTable;
class MachineDrawing;
class RigSetup;
class ToggleSegment;

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

/// A device that is read beside the control.
struct DeviceHealth {
  QString id{};                                                    // "module-1"
  Judgement judgement = Judgement::none;                           // ok: answers, bad: does not, none: not asked yet
  double roundTrip_ms = std::numeric_limits<double>::quiet_NaN();  // NaN: the last round was not answered
  double age_s = std::numeric_limits<double>::quiet_NaN();         // of the last answer, NaN: there was none
  long missed = 0;                                                 // rounds without an answer
  long rounds = 0;                                                 // all of them
  QString state{};                                                 // the fault in a sentence, else the remarks
  QString remedy{};
};

/// How the machine stands before a run. The spread alone says little: a sensor by a motor that always holds is always
/// warmer. What matters is whether anything still changes.
struct RestState {
  double spread_K = std::numeric_limits<double>::quiet_NaN();  // warmest - coldest of the sensors that live
  bool atStart = false;  // that is the job's: of when the commissioning began; else of now
  double now_K = std::numeric_limits<double>::quiet_NaN();  // the same of now; NaN: not connected
  double spreadLimit_K = 1.0;
  QString warmest{};                                             // the sensor farthest from the middle
  double apart_K = std::numeric_limits<double>::quiet_NaN();     // from the middle one, with sign
  QString quickest{};                                            // the sensor that changes fastest
  double change_K_h = std::numeric_limits<double>::quiet_NaN();  // NaN: not watched for long enough
  double changeLimit_K_h = 1.0;
};

struct MachineState {
  bool jobOpen = false;
  bool connected = false;
  bool connecting = false;
  bool manual = false;          // the control has no link: a person does what is asked
  bool settingUp = false;       // the profile is set up
  bool setupValid = false;      // and can be saved
  bool virtualOffered = false;  // the job's machine is a virtual one, which can be started here
  bool compensationOn = false;
  int writtenVersion = 0;  // of the table that this job has put into the machine; 0: none yet
  bool tableGone = false;  // the machine does not hold it
  /// Not connected, but the job has kept how the machine stood: when that was. Sensors and figures are those.
  QString keptFrom{};
  bool known() const { return connected || !keptFrom.isEmpty(); }
  QString machineName{};
  QString address{};  // "Modbus TCP 127.0.0.1:1502, unit 1"
  QStringList profiles{};
  int profile = -1;
  QVector<RecentJob> recent{};
  QVector<SensorHealth> sensors{};
  QVector<PartHealth> parts{};
  QVector<DeviceHealth> devices{};
  QVector<RegisterRow> registers{};
  QStringList registerNames{};  // what a register may be
  QString mapNotes{};           // "plc.json, changed; no table"
  bool mapChanged = false;
  RestState rest{};
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
  /// Shown while the profile is set up.
  RigSetup* rigSetup() const { return m_setup; }
  /// 0 drawing, 1 registers.
  void showView(int index);

  /// The job's machine is a virtual one that does not run: the main button starts it.
  bool startsVirtual() const;
  /// The connected machine does not hold what this job wrote: the main button leads to where it is put back.
  bool tableLost() const;
  QString title() const override;
  QString sentence() const override;
  /// Connect, then Start commissioning.
  PageAction primary() const override;
  /// "job" (another job), "import", "setup", "test", "disconnect"; while a profile is set up "setup-open",
  /// "setup-save-as", "setup-leave".
  QVector<PageAction> secondary() const override;

 Q_SIGNALS:
  void newJobRequested();
  void ownRecordingRequested();
  void openJobRequested(const QString& path);  // empty: let the user choose
  void sampleRequested();
  void virtualMachineRequested();
  void profileImportRequested();
  void profileChosen(int index);
  void sensorSelected(const QString& id);
  void registersShown(bool shown);
  void registerEdited(int row, int column, const QString& text);
  void registerAdded();
  void registerRemoved(int row);
  void registersImportRequested();
  void registersSaveRequested();

 protected:
  void render() override;

 private:
  PageAction startAction(const QString& id) const;
  QWidget* makeMachine();
  QWidget* makeRegisters();
  void viewShown(int index);
  void renderMachine();
  void renderParts();
  void renderDevices();
  void renderRegisters();
  QVector<Figure> figures() const;
  Figure restFigure() const;
  Figure devicesFigure() const;

  MachineState m_state;
  QStackedWidget* m_views;
  MachineStart* m_start;
  RigSetup* m_setup;
  QWidget* m_machine;
  Card* m_drawingCard;
  Card* m_sensorCard;
  MachineDrawing* m_drawing;
  RegisterTable* m_registers;
  QLabel* m_mapNotes;
  QVector<QPushButton*> m_mapButtons;  // import, add, remove, save
  QStackedWidget* m_drawingViews;
  ToggleSegment* m_view;
  QComboBox* m_profile;
  QLabel* m_parts;
  DataTable* m_devices;
  QLabel* m_deviceState;
  ChannelTable* m_table;
};

}  // namespace zerodrift::ui
