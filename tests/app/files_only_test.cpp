// A job from files only, as somebody does it who brings a logger's recording and no machine: every page, by hand.

#include <QApplication>
#include <QComboBox>
#include <QFile>
#include <QLineEdit>
#include <QPushButton>
#include <QTableWidget>
#include <QTest>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/desktop/application.h"
#include "app/desktop/file_opener.h"
#include "core/flow/flow.h"
#include "core/flow/steps/fit_step.h"
#include "tests/app/test_home.h"
#include "ui/pages/fit_page.h"
#include "ui/pages/machine_page.h"
#include "ui/pages/physics_page.h"
#include "ui/pages/report_page.h"
#include "ui/pages/sensors_page.h"
#include "ui/pages/warmup_page.h"
#include "ui/widgets/import_dialog.h"
#include "ui/widgets/machine_dialog.h"

using zerodrift::commissioning::JobKind;
using zerodrift::desktop::Application;
using zerodrift::desktop::FileOpener;
using zerodrift::ui::ImportDialog;
using zerodrift::ui::ImportRole;

namespace {

constexpr int sensors = 4;
constexpr double kelvin[sensors] = {14.0, 9.0, 5.0, 2.0};
constexpr double minutes[sensors] = {20.0, 45.0, 80.0, 140.0};
constexpr int rows = 420;  // one a minute

double temperature_C(int sensor, int row) {
  const double own = 0.03 * std::sin(0.7 * row * (sensor + 1));
  return 22.0 + kelvin[sensor] * (1.0 - std::exp(-row / minutes[sensor])) + own;
}

/// As ../shared/data/spindle-drift is written: seconds, speed, displacements and temperatures by number.
QByteArray by_number(bool errors = true) {
  QByteArray text = errors ? "time_s,spindle_rpm,ch1_um,ch2_um,ch3_um,ch4_um,t1_C,t2_C,t3_C,t4_C\n"
                           : "time_s,heater_on,t1_C,t2_C,t3_C,t4_C\n";
  for (int i = 0; i < rows; ++i) {
    text += QByteArray::number(60 * i) + (errors ? ",4000" : ",1");
    for (int e = 0; errors && e < 4; ++e) {
      const double um = 0.4 * (e + 1) * (temperature_C(0, i) - 22.0) + 0.5 * e * (temperature_C(2, i) - 22.0);
      text += ',' + QByteArray::number(um + 0.1 * std::cos(1.3 * i + e), 'f', 4);
    }
    for (int s = 0; s < sensors; ++s) text += ',' + QByteArray::number(temperature_C(s, i), 'f', 4);
    text += '\n';
  }
  return text;
}

/// As a German spreadsheet writes it: semicolons, decimal commas, a date, names that say little.
QByteArray of_a_spreadsheet() {
  QByteArray text = "Datum/Zeit;Vorne [°C];Mitte [°C];Hinten [°C];Taster 1;Bemerkung\r\n";
  for (int i = 0; i < rows; ++i) {
    const QString at = QStringLiteral("14.03.2026 %1:%2:00")
                           .arg(8 + i / 60, 2, 10, QLatin1Char('0'))
                           .arg(i % 60, 2, 10, QLatin1Char('0'));
    text += at.toUtf8();
    for (int s = 0; s < 3; ++s) text += ';' + QByteArray::number(temperature_C(s, i), 'f', 2).replace('.', ',');
    const double mm = 0.001 * (1.2 * (temperature_C(0, i) - 22.0) + 0.8 * (temperature_C(2, i) - 22.0));
    text += ';' + QByteArray::number(mm, 'f', 5).replace('.', ',') + ";ok\r\n";
  }
  return text;
}

const char* const machine_json = R"({"format": "zerodrift-machine/1", "name": "four lumps",
  "components": [
    {"id": "L1", "kind": "lump", "heat_sources": [{"id": "s1", "kind": "speed", "channel": "spindle_rpm", "law": ["on", "n"], "power_unknown": true}]},
    {"id": "L2", "kind": "lump", "heat_sources": [{"id": "s2", "kind": "speed", "channel": "spindle_rpm", "law": ["on", "n"], "power_unknown": true}]}],
  "sensors": [{"channel": "t1_C", "component": "L1", "accuracy_C": 0.5}, {"channel": "t2_C", "component": "L2", "accuracy_C": 0.5}],
  "displacements": [{"channel": "ch3_um", "direction": "Z", "component": null}]})";

}  // namespace

class FilesOnlyTest : public QObject, private zerodrift::desktop::TestHome {
  Q_OBJECT

 private Q_SLOTS:
  /// A recording with its columns as they are, a fit, the physics with its machine.json, a report.
  void aRecordingBecomesAReport() {
    Application application(m_theme);
    auto& bench = application.bench();
    application.openFiles({write("drift.csv", by_number())});
    ImportDialog* dialog = shown(application);
    QVERIFY(dialog != nullptr);
    QVERIFY2(dialog->state().sentence.isEmpty(), qPrintable(dialog->state().sentence));
    QCOMPARE(dialog->state().columns.size(), 10);
    QCOMPARE(dialog->state().columns[0].role, ImportRole::time);
    QCOMPARE(dialog->state().columns[2].role, ImportRole::displacement);
    QCOMPARE(dialog->state().rows.first().value(0), QStringLiteral("0"));
    QVERIFY(choose(dialog, "axis4", QStringLiteral("Z")));
    QVERIFY(choose(dialog, "axis2", QStringLiteral("X")));
    QVERIFY(type(dialog, "location6", QStringLiteral("front bearing")));
    dialog->findChild<QPushButton*>("take")->click();
    QVERIFY2(application.window().currentPage()->problem().sentence.isEmpty(),
             qPrintable(application.window().currentPage()->problem().sentence));

    QVERIFY(bench.job() != nullptr);
    QCOMPARE(bench.kind(), JobKind::files);
    QCOMPARE(application.window().currentPage()->id(), QStringLiteral("warmup"));
    auto* warmup = page<zerodrift::ui::WarmupPage>(application, "warmup");
    QCOMPARE(warmup->state().temperatures, sensors);
    QCOMPARE(warmup->state().errors, 4);
    QVERIFY(warmup->state().largestError_um > 5.0);
    QVERIFY(warmup->primaryAction().enabled);
    // The map stays with the run, and its import can be done again with it.
    QCOMPARE(bench.body("warmup").at("import").at("map").at("columns").at("ch3_um").value("axis", ""),
             std::string("Z"));
    everyPageMakesSense(application);

    pressPrimary(application);
    QCOMPARE(application.window().currentPage()->id(), QStringLiteral("sensors"));
    QTRY_VERIFY_WITH_TIMEOUT(!bench.tasks().running(), 60000);
    QVERIFY2(bench.has("sensors"), qPrintable(application.window().currentPage()->problem().sentence));
    auto* chosen = page<zerodrift::ui::SensorsPage>(application, "sensors");
    QCOMPARE(chosen->state().errors, QStringList({"X", "Z", "ch2", "ch4"}));
    for (const auto& row : chosen->state().sensors) {
      for (const double r : row.r) QVERIFY2(std::isfinite(r), qPrintable(row.tag));
      if (row.id == QStringLiteral("t1_C")) QCOMPARE(row.label, QStringLiteral("front bearing"));
    }
    pressPrimary(application);
    QCOMPARE(application.window().currentPage()->id(), QStringLiteral("fit"));
    QTRY_VERIFY_WITH_TIMEOUT(!bench.tasks().running(), 60000);
    QVERIFY2(bench.has("model"), qPrintable(application.window().currentPage()->problem().sentence));
    QStringList names;
    for (const auto& series : page<zerodrift::ui::FitPage>(application, "fit")->state().series) {
      names << series.name;
      QVERIFY(series.measured_um.size() > 100);
    }
    names.sort();
    QCOMPARE(names, QStringList({"X", "Z", "ch2", "ch4"}));

    pressPrimary(application);
    auto* physics = page<zerodrift::ui::PhysicsPage>(application, "physics");
    QCOMPARE(application.window().currentPage()->id(), QStringLiteral("physics"));
    QVERIFY(physics->state().undescribed);
    application.openFiles({write("machine.json", machine_json)});  // dropped
    QVERIFY2(physics->problem().sentence.isEmpty(), qPrintable(physics->problem().sentence));
    QVERIFY(!physics->state().undescribed);
    pressPrimary(application);
    QTRY_VERIFY_WITH_TIMEOUT(bench.has("physics") && !bench.tasks().running(), 120000);
    QVERIFY2(physics->problem().sentence.isEmpty(), qPrintable(physics->problem().sentence));
    QVERIFY(physics->state().verdict != zerodrift::ui::PhysicsVerdict::none);

    pressPrimary(application);  // what would write to a machine is passed over
    QCOMPARE(application.window().currentPage()->id(), QStringLiteral("report"));
    bool saved = false;
    application.presenter("report")->tour([&saved](bool good) { saved = good; });
    QTRY_VERIFY_WITH_TIMEOUT(saved, 60000);
    const QString html = QString::fromStdString((bench.job()->path().parent_path() / "report.html").string());
    QFile file(html);
    QVERIFY(file.open(QIODevice::ReadOnly));
    const QByteArray text = file.readAll();
    QVERIFY(text.contains("front bearing"));
    QVERIFY(text.contains("made from recordings in files"));
    const auto status = zerodrift::flow::Flow().status(*bench.job());
    QVERIFY(status.has_value());
    QVERIFY(zerodrift::flow::Flow::next(*status) == nullptr);
    everyPageMakesSense(application);

    // The table is by the axes that were assigned.
    const auto table = zerodrift::flow::table_of_job(*bench.job());
    QVERIFY(table.has_value());
    QVERIFY(table->axes.contains("Z") && table->axes.contains("X") && !table->axes.contains("Y"));
  }

  /// Names that say nothing are assigned by hand; the next file of the same logger needs no hand.
  void aSpreadsheetIsMappedByHand() {
    Application application(m_theme);
    auto& bench = application.bench();
    const QString path = write("messung.csv", of_a_spreadsheet());
    application.openFiles({path});
    ImportDialog* dialog = shown(application);
    QVERIFY(dialog != nullptr);
    QCOMPARE(dialog->state().columns[0].role, ImportRole::time);
    QCOMPARE(dialog->state().columns[1].role, ImportRole::temperature);
    QCOMPARE(dialog->state().columns[5].role, ImportRole::unused);
    QVERIFY(choose(dialog, "role4", ImportDialog::roleNames()[static_cast<int>(ImportRole::displacement)]));
    QVERIFY(choose(dialog, "unit4", QStringLiteral("mm")));
    QVERIFY(choose(dialog, "axis4", QStringLiteral("Z")));
    QVERIFY2(dialog->state().ready, qPrintable(dialog->state().sentence));
    dialog->findChild<QPushButton*>("take")->click();
    const auto& run = bench.warmupRun();
    QCOMPARE(static_cast<int>(run.rows()), rows);
    QCOMPARE(page<zerodrift::ui::WarmupPage>(application, "warmup")->state().largestErrorAxis, QStringLiteral("Z"));
    const auto errors = run.names(zerodrift::recording::ChannelKind::error);
    QCOMPARE(errors.size(), std::size_t{1});
    QVERIFY(std::abs(run.find(errors[0])->values.back() - 19.0) < 3.0);  // mm became um

    QVERIFY(bench.closeJob().has_value());
    application.openFiles({path});
    dialog = shown(application);
    QVERIFY(dialog != nullptr);
    QCOMPARE(dialog->state().columns[4].role, ImportRole::displacement);
    QCOMPARE(dialog->state().columns[4].axis, QStringLiteral("Z"));
    dialog->findChild<QPushButton*>("cancel")->click();
    QVERIFY(bench.job() == nullptr);  // nothing was made
  }

  /// What stands in the way is said in the dialog, at its column, and nothing can be taken.
  void aProblemIsSaidInPlace() {
    Application application(m_theme);
    application.openFiles({write("typo.csv", "time_s,t1_C\n" + QByteArray("0,20\n60,2O\n120,21\n"))});
    ImportDialog* dialog = shown(application);
    QVERIFY(dialog != nullptr);
    QVERIFY(!dialog->state().sentence.isEmpty());
    QVERIFY(!dialog->state().remedy.isEmpty());
    QVERIFY(dialog->state().columns[1].problem);
    QVERIFY(!dialog->findChild<QPushButton*>("take")->isEnabled());
    QCOMPARE(dialog->state().columns[0].role, ImportRole::time);
    const QTableWidgetItem* name = dialog->findChild<QTableWidget*>("mapping")->item(0, 0);
    m_theme.setMode(zerodrift::ui::ThemeMode::dark);
    QCOMPARE(name->foreground().color(), zerodrift::ui::colors().text);
    m_theme.setMode(zerodrift::ui::ThemeMode::light);
    QCOMPARE(name->foreground().color(), zerodrift::ui::colors().text);
    QVERIFY(type(dialog, "missing", QStringLiteral("2O")));
    QVERIFY(!dialog->state().columns[1].problem);
  }

  /// A question of heat alone: no errors, no drawing.
  void heatAloneIsExplained() {
    Application application(m_theme);
    auto& bench = application.bench();
    application.openFiles({write("rod.csv", by_number(false))});
    ImportDialog* dialog = shown(application);
    QVERIFY(dialog != nullptr);
    QVERIFY2(dialog->state().ready, qPrintable(dialog->state().sentence));
    dialog->findChild<QPushButton*>("take")->click();
    QCOMPARE(page<zerodrift::ui::WarmupPage>(application, "warmup")->state().errors, 0);
    for (const char* id : {"sensors", "fit"}) {
      application.openPage(id);
      QTRY_VERIFY_WITH_TIMEOUT(!bench.tasks().running(), 60000);
      QVERIFY2(application.window().currentPage()->problem().sentence.isEmpty(), id);
      QVERIFY(!application.window().currentPage()->primaryAction().enabled ||
              application.window().currentPage()->isNotNeeded());
    }
    application.openPage("physics");
    auto* physics = page<zerodrift::ui::PhysicsPage>(application, "physics");
    Q_EMIT physics->secondaryTriggered("lumps");
    QVERIFY2(!physics->state().undescribed, qPrintable(physics->problem().sentence));
    pressPrimary(application);
    QTRY_VERIFY_WITH_TIMEOUT(bench.has("physics") && !bench.tasks().running(), 120000);
    QVERIFY(physics->state().verdict != zerodrift::ui::PhysicsVerdict::none);
    application.openPage("report");
    auto* report = page<zerodrift::ui::ReportPage>(application, "report");
    QTRY_VERIFY_WITH_TIMEOUT(!report->state().pages.isEmpty(), 60000);
    QVERIFY(report->state().blocked.isEmpty());
  }

  /// Further recordings stand beside the first: listed, shown, given a role, removed, and back with Undo.
  void severalRecordingsOfOneMachine() {
    Application application(m_theme);
    auto& bench = application.bench();
    auto* warmup = page<zerodrift::ui::WarmupPage>(application, "warmup");
    const auto import = [&](const QString& path, int place) {
      application.openFiles({path});
      ImportDialog* dialog = shown(application);
      if (dialog == nullptr || !dialog->state().ready) return false;
      auto* box = dialog->findChild<QComboBox*>("place");
      if (box->isVisible() != (bench.job() != nullptr)) return false;
      box->setCurrentIndex(place);
      Q_EMIT box->activated(place);
      dialog->findChild<QPushButton*>("take")->click();
      return true;
    };
    QVERIFY(import(write("first.csv", by_number()), 0));
    QVERIFY(warmup->state().recordings.isEmpty());
    QVERIFY(import(write("second.csv", by_number()), 1));
    QVERIFY2(warmup->problem().sentence.isEmpty(), qPrintable(warmup->problem().sentence));
    QVERIFY(import(write("night.csv", by_number(false)), 2));
    QCOMPARE(warmup->state().recordings.size(), 3);
    QCOMPARE(warmup->state().shownRecording, 2);
    QCOMPARE(warmup->state().errors, 0);
    QCOMPARE(warmup->state().recordings[1].name, QStringLiteral("second"));
    QCOMPARE(warmup->state().recordings[1].use, zerodrift::ui::RecordingUse::otherDay);

    warmup->findChild<QPushButton*>("removeRecording")->click();
    QCOMPARE(warmup->state().recordings.size(), 2);
    application.presenter("warmup")->undo();
    QCOMPARE(warmup->state().recordings.size(), 3);
    Q_EMIT warmup->recordingRenamed(1, QStringLiteral("Tuesday"));
    QCOMPARE(warmup->state().recordings[1].name, QStringLiteral("Tuesday"));

    application.openPage("sensors");
    QTRY_VERIFY_WITH_TIMEOUT(bench.has("sensors") && !bench.tasks().running(), 60000);
    application.openPage("fit");
    QTRY_VERIFY_WITH_TIMEOUT(bench.has("model") && !bench.tasks().running(), 60000);
    const auto& fit = page<zerodrift::ui::FitPage>(application, "fit")->state();
    QVERIFY2(fit.advice.join(' ').contains("Tuesday"), qPrintable(fit.advice.join('\n')));
    QVERIFY(fit.updatedBy.isEmpty());
    application.openPage("warmup");
    for (int i = 0; i < 3; ++i) application.presenter("warmup")->undo();
    QVERIFY(warmup->state().recordings.isEmpty());  // as it began
    QVERIFY(bench.has("warmup"));
  }

  /// The machine is described in the form: drawn, checked as it is entered, taken back, kept in the job.
  void theMachineIsDescribedInTheForm() {
    Application application(m_theme);
    auto& bench = application.bench();
    application.findChild<FileOpener*>()->setAsking(false);
    application.openFiles({write("spindle.csv", by_number())});
    application.openPage("physics");
    auto* physics = page<zerodrift::ui::PhysicsPage>(application, "physics");
    QVERIFY(physics->state().undescribed);
    pressPrimary(application);
    auto* form = application.window().findChild<zerodrift::ui::MachineDialog*>();
    QVERIFY(form != nullptr && form->isVisible());
    QVERIFY2(form->state().sentence.isEmpty(), qPrintable(form->state().sentence));
    QCOMPARE(form->state().sketch.parts.size(), 1);
    QCOMPARE(form->state().sketch.parts[0].sensors.size(), 4);
    const auto enter = [&](const char* key, const QString& value) {
      auto* editor = form->findChild<QWidget*>(QStringLiteral("field:") + QString::fromLatin1(key));
      if (auto* box = qobject_cast<QComboBox*>(editor)) {
        const int at = box->findText(value, Qt::MatchStartsWith);
        if (at < 0) return false;
        box->setCurrentIndex(at);
        Q_EMIT box->activated(at);
        return true;
      }
      auto* edit = qobject_cast<QLineEdit*>(editor);
      if (edit == nullptr) return false;
      edit->setText(value);
      edit->setModified(true);
      Q_EMIT edit->editingFinished();
      return true;
    };
    const auto add = [&](const char* kind) {
      form->findChild<QAction*>(QStringLiteral("add:") + QString::fromLatin1(kind))->trigger();
    };
    QVERIFY(enter("length_mm", QStringLiteral("0,4")));  // metres
    QVERIFY(!form->state().sentence.isEmpty());
    QVERIFY(!form->findChild<QPushButton*>("take")->isEnabled());
    QVERIFY(form->findChild<QLabel*>("problem:length_mm")->text().contains("is it in metres"));
    form->findChild<QPushButton*>("undoForm")->click();
    QVERIFY(form->state().sentence.isEmpty());
    QVERIFY(enter("material", QStringLiteral("Aluminium")));
    QVERIFY(enter("id", QStringLiteral("ram")));  // the sensors go with it
    QVERIFY2(form->state().sentence.isEmpty(), qPrintable(form->state().sentence));
    add("source");
    QVERIFY(enter("mean_diameter_mm", QStringLiteral("77.5")));
    QCOMPARE(form->state().sketch.parts[0].sources.size(), 1);
    add("lump");
    add("coupling");
    QCOMPARE(form->state().sketch.couplings.size(), 1);
    add("sensor");
    QVERIFY(!form->state().sentence.isEmpty());  // every temperature is placed already
    form->findChild<QPushButton*>("undoForm")->click();
    form->findChild<QPushButton*>("take")->click();
    QVERIFY2(physics->problem().sentence.isEmpty(), qPrintable(physics->problem().sentence));
    QVERIFY(!physics->state().undescribed);
    const auto& machine = bench.body("description")["machine"];
    QCOMPARE(machine["components"].size(), std::size_t{2});
    QCOMPARE(machine["components"][0]["material"]["density_kg_m3"].get<double>(), 2700.0);
    QCOMPARE(machine["components"][0]["heat_sources"][0]["mean_diameter_mm"].get<double>(), 77.5);
    QCOMPARE(machine["sensors"][0]["component"].get<std::string>(), std::string("ram"));

    Q_EMIT physics->secondaryTriggered("describe");  // and edited again: a part goes with what joins it
    QTRY_VERIFY((form = application.window().findChild<zerodrift::ui::MachineDialog*>()) != nullptr &&
                form->isVisible());
    Q_EMIT form->selected("components[1]");
    form->findChild<QPushButton*>("removePart")->click();
    QVERIFY2(form->state().sentence.isEmpty(), qPrintable(form->state().sentence));
    QCOMPARE(form->state().sketch.parts.size(), 1);
    QCOMPARE(form->state().sketch.couplings.size(), 0);
    form->findChild<QPushButton*>("cancel")->click();
    QCOMPARE(bench.body("description")["machine"]["components"].size(), std::size_t{2});
  }

  /// A machine is connected later: the steps that were not needed are.
  void aMachineMayComeLater() {
    Application application(m_theme);
    application.findChild<FileOpener*>()->setAsking(false);
    application.openFiles({write("later.csv", by_number())});
    application.openPage("machine");
    auto* machine = page<zerodrift::ui::MachinePage>(application, "machine");
    QVERIFY(machine->isNotNeeded());
    Q_EMIT machine->emptyActionTriggered();
    QVERIFY(!machine->isNotNeeded());
    QCOMPARE(application.bench().kind(), JobKind::machine);
    QVERIFY(application.bench().has("warmup"));
  }

  /// Each page as it is drawn, into the folder that ZERODRIFT_PICTURES names; of the files that ZERODRIFT_RECORDING and
  /// ZERODRIFT_MACHINE name, else of made ones.
  void pictures() {
    const QString folder = qEnvironmentVariable("ZERODRIFT_PICTURES");
    if (folder.isEmpty()) QSKIP("ZERODRIFT_PICTURES names no folder");
    const QString recording = qEnvironmentVariable("ZERODRIFT_RECORDING", write("drift.csv", by_number()));
    const QString machine = qEnvironmentVariable("ZERODRIFT_MACHINE", write("machine.json", machine_json));
    Application application(m_theme);
    auto& bench = application.bench();
    application.window().show();
    const auto draw = [&](const QString& name, QWidget* dialog = nullptr) {
      for (const char* language : {"en", "zh_CN"}) {
        application.setLanguage(QString::fromLatin1(language));
        for (const bool dark : {false, true}) {
          m_theme.setMode(dark ? zerodrift::ui::ThemeMode::dark : zerodrift::ui::ThemeMode::light);
          for (const QSize size : {QSize(1440, 900), QSize(1280, 720)}) {
            if (dark != (size.width() == 1280)) continue;  // each once
            application.window().resize(size);
            QTest::qWait(150);
            (dialog != nullptr ? dialog : &application.window())
                ->grab()
                .save(QStringLiteral("%1/%2-%3-%4.png")
                          .arg(folder, name, QString::fromLatin1(language))
                          .arg(size.width()));
          }
        }
      }
      application.setLanguage(QStringLiteral("en"));
    };
    draw("00-start");
    application.openFiles({recording});
    ImportDialog* dialog = shown(application);
    QVERIFY(dialog != nullptr);
    draw("01-import", dialog);
    choose(dialog, "axis4", QStringLiteral("Z"));
    type(dialog, "location7", QStringLiteral("front bearing"));
    dialog->findChild<QPushButton*>("take")->click();
    QVERIFY(bench.job() != nullptr);
    application.openPage("physics");
    draw("02-physics-empty");
    Q_EMIT application.presenter("physics")->page()->primaryTriggered();
    auto* form = application.window().findChild<zerodrift::ui::MachineDialog*>();
    for (const char* kind : {"source", "lump", "coupling"}) Q_EMIT form->addRequested(kind);
    Q_EMIT form->selected("components[0]");
    draw("03-form", form);
    Q_EMIT form->selected("components[0].heat_sources[0]");
    Q_EMIT form->edited("components[0].heat_sources[0]", "to_mm", "4000");
    draw("04-form-source", form);
    form->reject();
    application.openFiles({machine});
    for (auto* presenter : application.presenters()) {
      application.openPage(presenter->id());
      QTRY_VERIFY_WITH_TIMEOUT(!bench.tasks().running(), 300000);
      if (presenter->id() == QStringLiteral("physics")) {
        auto* physics = page<zerodrift::ui::PhysicsPage>(application, "physics");
        if (physics->state().undescribed) Q_EMIT physics->secondaryTriggered("lumps");
        pressPrimary(application);
        QTRY_VERIFY_WITH_TIMEOUT(!bench.tasks().running(), 900000);
      }
      QTest::qWait(presenter->id() == QStringLiteral("report") ? 8000 : 300);
      draw(QStringLiteral("10-") + presenter->id());
    }
    for (const char* name : {"second-day.csv", "night-without-heating-of-the-machine.csv"}) {
      application.openFiles({write(name, by_number(*name == 's'))});
      dialog = shown(application);
      QVERIFY(dialog != nullptr);
      if (*name == 's') draw("11-import-beside", dialog);
      dialog->findChild<QPushButton*>("take")->click();
    }
    draw("11-recordings");
    application.openFiles({write("typo.csv", "time_s,t1_C\n0,20\n60,2O\n120,21\n")});
    dialog = shown(application);
    QVERIFY(dialog != nullptr);
    draw("20-import-problem", dialog);
    dialog->reject();
  }

 private:
  QString write(const char* name, const QByteArray& text) {
    const QString path = m_folder.filePath(QString::fromLatin1(name));
    QFile file(path);
    if (!file.open(QIODevice::WriteOnly) || file.write(text) != text.size()) return {};
    return path;
  }

  template <class PageType>
  static PageType* page(Application& application, const char* id) {
    return qobject_cast<PageType*>(application.presenter(QString::fromLatin1(id))->page());
  }

  /// The import's dialog, when it has read its file.
  static ImportDialog* shown(Application& application) {
    ImportDialog* dialog = nullptr;
    const bool there = QTest::qWaitFor(
        [&] {
          for (auto* one : application.window().findChildren<ImportDialog*>()) {
            if (one->isVisible()) dialog = one;
          }
          return dialog != nullptr && settled(dialog) && !dialog->state().columns.isEmpty();
        },
        20000);
    return there ? dialog : nullptr;
  }

  static bool settled(ImportDialog* dialog) { return !dialog->state().reading; }

  static bool choose(ImportDialog* dialog, const char* name, const QString& text) {
    auto* box = dialog->findChild<QComboBox*>(QString::fromLatin1(name));
    if (box == nullptr || box->findText(text) < 0) return false;
    box->setCurrentIndex(box->findText(text));
    Q_EMIT box->activated(box->currentIndex());
    return QTest::qWaitFor([&] { return settled(dialog); }, 20000);
  }

  static bool type(ImportDialog* dialog, const char* name, const QString& text) {
    auto* line = dialog->findChild<QLineEdit*>(QString::fromLatin1(name));
    if (line == nullptr || !line->isEnabled()) return false;
    line->setText(text);
    Q_EMIT line->editingFinished();
    return QTest::qWaitFor([&] { return settled(dialog); }, 20000);
  }

  static void pressPrimary(Application& application) { application.window().primaryButton()->click(); }

  /// Each page that is about a controller says that it is not needed and why, and leads on; no other does.
  static void everyPageMakesSense(Application& application) {
    const QString open = application.window().currentPage()->id();
    const QStringList unneeded{"machine", "calibrate", "upload", "verify", "compensator"};
    for (auto* presenter : application.presenters()) {
      application.openPage(presenter->id());
      if (!QTest::qWaitFor([&] { return !application.bench().tasks().running(); }, 60000)) QFAIL("works on");
      const bool spared = unneeded.contains(presenter->id());
      QCOMPARE(presenter->page()->isNotNeeded(), spared);
      QCOMPARE(application.window().rail()->step(presenter->id())->state() == zerodrift::ui::StepState::notNeeded,
               spared);
      if (!spared) continue;
      QVERIFY(presenter->page()->primaryAction().enabled);
      QVERIFY2(presenter->page()->problem().sentence.isEmpty(), qPrintable(presenter->page()->problem().sentence));
    }
    application.openPage(open);
  }
};

QTEST_MAIN(FilesOnlyTest)
#include "files_only_test.moc"
