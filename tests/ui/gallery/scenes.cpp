#include "tests/ui/gallery/page_samples.h"
#include "tests/ui/gallery/samples.h"
#include "ui/pages/axis_page.h"
#include "ui/pages/calibrate_page.h"
#include "ui/pages/compensator_page.h"
#include "ui/pages/fit_page.h"
#include "ui/pages/machine_page.h"
#include "ui/pages/physics_page.h"
#include "ui/pages/report_page.h"
#include "ui/pages/sensors_page.h"
#include "ui/pages/upload_page.h"
#include "ui/pages/verify_page.h"
#include "ui/pages/warmup_page.h"
#include "ui/shell/main_window.h"

namespace zerodrift::ui::samples {

void addPages(MainWindow& window) {
  window.addPage(new MachinePage);
  window.addPage(new CalibratePage);
  window.addPage(new WarmupPage);
  window.addPage(new SensorsPage);
  window.addPage(new FitPage);
  window.addPage(new PhysicsPage);
  window.addPage(new UploadPage);
  window.addPage(new VerifyPage);
  window.addPage(new ReportPage);
  window.addPage(new AxisPage, true);
  window.addPage(new CompensatorPage, true);
}

QVector<Scene> scenes() {
  return {
      {"machine", "start"},        {"machine", "filled"},      {"machine", "registers"}, {"machine", "kept"},
      {"machine", "devices"},      {"machine", "manual"},      {"machine", "setup"},     {"machine", "signals"},
      {"machine", "log"},          {"calibrate", "empty"},     {"calibrate", "running"}, {"calibrate", "solved"},
      {"warmup", "plan"},          {"warmup", "running"},      {"warmup", "banner"},     {"warmup", "trouble"},
      {"compensator", "empty"},    {"compensator", "running"}, {"sensors", "clusters"},  {"sensors", "leftout"},
      {"fit", "prediction"},       {"physics", "before"},      {"physics", "where"},     {"physics", "channels"},
      {"physics", "unexplained"},  {"physics", "trial"},       {"upload", "ready"},      {"upload", "writing"},
      {"upload", "history"},       {"upload", "away"},         {"verify", "running"},    {"verify", "correction"},
      {"verify", "worse"},         {"report", "preview"},      {"axis_errors", "empty"}, {"axis_errors", "measurement"},
      {"axis_errors", "segments"}, {"verify", "help"},         {"verify", "run"},        {"verify", "again"}};
}

// The rail as it would stand with everything before this page done.
static void showProgressOfJob(MainWindow& window, const QString& page) {
  const QStringList ids = {"machine", "calibrate", "warmup", "sensors", "fit", "physics", "upload", "verify", "report"};
  const QStringList words = {"20 of 20 sensors", "0.09 µm, 9 positions", "4 h 30 min recorded",
                             "5 of 20 sensors",  "2.1 µm expected",      "1 effect adopted",
                             "Version 4 active", "94 % removed",         "Saved"};
  const auto here = ids.indexOf(page);
  for (int i = 0; i < ids.size(); ++i) {
    const bool done = here < 0 ? i < 3 : i < here;
    const bool stale = ids[i] == "fit" && here > 4;
    window.setStepState(ids[i],
                        stale       ? StepState::stale
                        : done      ? StepState::current
                        : i == here ? StepState::ready
                                    : StepState::blocked,
                        stale       ? "Sensors changed: redo"
                        : done      ? words[i]
                        : i == here ? "In work"
                                    : "Not started");
  }
  window.setStepState("axis_errors", StepState::ready, "Optional");
  window.setStepState("compensator", StepState::ready, "When needed");
}

void play(MainWindow& window, const Scene& scene) {
  window.setCurrentPage(scene.page);
  window.setLogVisible(scene.name == "log");
  if (window.isHelpVisible() != (scene.name == "help")) window.toggleHelp();
  Page* page = window.currentPage();
  page->clearProblem();
  page->clearProgress();
  using Fill = void (*)(Page*, const QString&);
  static const QHash<QString, Fill> fills = {
      {"machine", fillMachine}, {"calibrate", fillCalibrate}, {"warmup", fillWarmup},          {"sensors", fillSensors},
      {"fit", fillFit},         {"physics", fillPhysics},     {"upload", fillUpload},          {"verify", fillVerify},
      {"report", fillReport},   {"axis_errors", fillAxis},    {"compensator", fillCompensator}};
  fills.value(scene.page)(page, scene.name);
  window.setLamp(LampId::recording,
                 scene.name == "running" && scene.page != "calibrate" ? "Recording, 10 s" : "Not recording",
                 scene.name == "running" && scene.page != "calibrate" ? Judgement::ok : Judgement::none);
  const bool on = scene.page == "verify";
  window.setLamp(LampId::compensation, on ? "Compensation ON" : "Compensation OFF",
                 on ? Judgement::ok : Judgement::none, true);
  showProgressOfJob(window, scene.page);
}

}  // namespace zerodrift::ui::samples
