#include <cmath>

#include "tests/ui/gallery/page_samples.h"
#include "ui/pages/machine_page.h"
#include "ui/pages/rig_setup.h"

namespace zerodrift::ui::samples {

struct Place {
  const char* label;
  const char* place;
  double along;
};

static const Place places[] = {
    {"Spindle front bearing", "spindle", 0.86},
    {"Spindle between front bearing and motor", "spindle", 0.65},
    {"Spindle motor, front end", "spindle", 0.45},
    {"Spindle motor, rear end", "spindle", 0.25},
    {"Spindle rear bearing", "spindle", 0.06},
    {"Headstock", "headstock", -1},
    {"Column front, top", "column_front", -1},
    {"Column rear, top", "column_rear", -1},
    {"X screw nut", "screw_x", -1},
    {"X screw support bearing", "screw_x", -1},
    {"Y screw nut", "screw_y", -1},
    {"Y screw support bearing", "screw_y", -1},
    {"Z screw nut", "screw_z", -1},
    {"Z screw support bearing", "screw_z", -1},
    {"X guide", "guide_x", -1},
    {"A trunnion drive", "trunnion", -1},
    {"C table drive", "table_drive", -1},
    {"Table", "table", -1},
    {"Bed", "bed", -1},
    {"Coolant tank", "coolant", -1},
};

/// A module that was tested, and what is read from two of them.
static RigSetupState rigSample() {
  RigSetupState rig;
  FormItem module{"devices[0]", "module-1", 1, false, true};
  module.fields = {{"id", "Name", {}, "module-1"},
                   {"device", "Serial port", {}, "/dev/serial/by-id/usb-Adapter_A17-if00-port0"},
                   {"baud", "Speed", "baud", "9600"},
                   {"parity", "Parity", {}, "N", {"N  (none)", "E  (even)", "O  (odd)"}, true},
                   {"unit", "Unit number", {}, "300", {}, false, "1", {}, "Expected: a whole number from 0 to 255"}};
  FormItem devices;
  devices.title = "Devices";
  devices.heading = true;
  rig.form.items = {{"machine", "Machine"},
                    {"controller", "Control", 1},
                    devices,
                    module,
                    {"devices[1]", "module-2", 1, false, true}};
  rig.form.current = "devices[0]";
  rig.form.offers = {{"modbus-rtu", "Modbus RTU, serial line"}};
  rig.form.canUndo = true;
  rig.file = "/jobs/profile.json";
  rig.changed = true;
  rig.sentence = "module-1, Unit number: this value cannot be.";
  rig.remedy = "Expected: a whole number from 0 to 255";
  rig.searches = {"ports", "units"};
  rig.canTest = true;
  rig.canAddSensors = true;
  rig.result = "Answers in 11.8 ms.";
  rig.resultJudgement = Judgement::ok;
  for (int i = 1; i <= 8; ++i) rig.found.append({QStringLiteral("temperature_C[%1]").arg(i), "20.31"});
  for (int i = 0; i < 20; ++i) {
    SignalLine line;
    line.name = QStringLiteral("T%1_C").arg(i + 1);
    line.label = places[i].label;
    line.sensor = true;
    line.device = i < 8 ? "module-1" : "module-2";
    line.signal = QStringLiteral("temperature_C[%1]").arg(i % 8 + 1);
    line.unit = "°C";
    line.scale = "0.01";
    line.value = i == 5 ? "850.00" : "20.31";
    line.judgement = i == 5 ? Judgement::bad : i == 2 ? Judgement::warn : Judgement::ok;
    line.state = i == 5 ? "out of range" : i == 2 ? "never changes" : "plausible";
    rig.lines.append(line);
  }
  rig.live = true;
  return rig;
}

void fillMachine(Page* page, const QString& scene) {
  auto* machine = qobject_cast<MachinePage*>(page);
  MachineState s;
  s.recent = {{"/jobs/vmc850-3.zdj", "VMC-850 #3", "Warm-up recorded, 20 November 2026"},
              {"/jobs/dmu65-11.zdj", "DMU 65 #11", "Report saved, 14 November 2026"},
              {"/jobs/haas-umc.zdj", "UMC-500 cell 2", "Stale: sensors changed after the fit, 2 November 2026"}};
  if (scene == "start") return machine->setState(s);
  s.jobOpen = true;
  s.connected = true;
  s.machineName = "Virtual five-axis";
  s.address = "Modbus TCP 127.0.0.1:1502, unit 1";
  s.profiles = {"Virtual five-axis", "VMC-850 shop floor", "Import a profile"};
  s.profile = 0;
  s.rest.spread_K = 0.62;
  s.roundTrip_ms = 1.8;
  s.clockDifference_s = 0.4;
  for (int i = 0; i < 20; ++i) {
    SensorHealth h;
    h.tag = QStringLiteral("T%1").arg(i + 1);
    h.id = h.tag + "_C";
    h.label = places[i].label;
    h.place = places[i].place;
    h.along = places[i].along;
    h.value_C = 20.1 + 0.05 * ((i * 37) % 13);
    h.age_s = 0.2 + 0.1 * (i % 4);
    h.noise_K = 0.04 + 0.01 * (i % 3);
    h.judgement = Judgement::ok;
    h.state = "OK";
    if (i == 13) {
      h.judgement = Judgement::warn;
      h.state = "Noisy 0.21 K";
    }
    s.sensors.append(h);
  }
  s.parts = {{"X", "X", "0.000 mm", Judgement::ok},
             {"Y", "Y", "0.000 mm", Judgement::ok},
             {"Z", "Z", "0.000 mm", Judgement::ok},
             {"A", "A", "0.000°", Judgement::ok},
             {"C", "C", "0.000°", Judgement::ok},
             {"spindle", "Spindle", "0 rpm", Judgement::ok},
             {"front", "Camera front", "25 frames/s", Judgement::ok},
             {"side", "Camera side", "25 frames/s", Judgement::ok},
             {"switch", "Compensation", "OFF", Judgement::ok}};
  s.registers = {
      {"magic", "identity: fixed number", 0, "holding", "uint16", 1, "1", "ABCD", "23108", "5A44", false},
      {"compensation_state", "compensation switch, 0 or 1", 17, "holding", "uint16", 1, "1", "ABCD", "0", "0000",
       false},
      {"position_X_mm", "position X, mm", 20, "holding", "float32", 1, "1", "ABCD", "0.000", "0000 0000", false},
      {"ambient_C", "room temperature, C", 96, "holding", "int16", 1, "0.0625", "ABCD", "20.312", "0145", false},
      {"temperature_C", "temperatures, C, in the profile's order", 100, "holding", "int16", 20, "0.0625", "ABCD",
       "20.250, 20.188, 20.312, 20.250, 20.375, 20.250, 20.188, 20.250, ... (20)", "0144 0143", false},
      {"probe_um", "probes X1 X2 Y1 Y2 Z, um", 162, "input", "float32", 5, "-1", "CDAB", "refused", "", true}};
  s.registerNames = {"ambient_C", "compensation_state", "temperature_C"};
  s.mapNotes = "zerodrift-virtual";
  if (scene == "kept") {
    s.connected = false;
    s.virtualOffered = true;
    s.keptFrom = "30 Sep 2026, 13:06";
    s.writtenVersion = 4;
  }
  if (scene == "devices" || scene == "manual") {
    s.devices = {
        {"module-1", Judgement::ok, 11.8, 0.4, 2, 1260, {}, {}},
        {"module-2", Judgement::ok, 12.1, 0.7, 0, 1258, {}, {}},
        {"amplifier", Judgement::bad, NAN, 75.0, 6, 1190,
         "No connection to 192.168.0.21, port 502 (Connection refused).",
         "Check cable, address and port, that the Modbus server, broker or agent there is on, and user and password "
         "where it asks for them."},
        {"shop", Judgement::ok, 0.1, 1.2, 0, 1260, "the connection to the broker was lost and opened anew", {}}};
  }
  if (scene == "manual") {
    s.manual = true;
    s.address = "Manual control";
    s.registers.clear();
    s.mapNotes.clear();
  }
  s.settingUp = scene == "setup" || scene == "signals";
  if (s.settingUp) {
    machine->rigSetup()->setState(rigSample());
    machine->rigSetup()->showView(scene == "signals" ? 1 : 0);
  }
  machine->setState(s);
  machine->selectSensor("T1_C");
  machine->showView(scene == "registers" ? 1 : 0);
}

}  // namespace zerodrift::ui::samples
