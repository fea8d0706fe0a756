// Pages: what they are told they show, what the user does they tell; without data they say how to get it.

#include <QSignalSpy>
#include <QTest>
#include <QtWidgets>

#include "tests/ui/gallery/page_samples.h"
#include "tests/ui/gallery/samples.h"
#include "ui/pages/axis_page.h"
#include "ui/pages/calibrate_page.h"
#include "ui/pages/fit_page.h"
#include "ui/pages/machine_page.h"
#include "ui/pages/physics_page.h"
#include "ui/pages/report_page.h"
#include "ui/pages/sensors_page.h"
#include "ui/pages/upload_page.h"
#include "ui/pages/verify_page.h"
#include "ui/pages/warmup_page.h"
#include "ui/plots/plot_widget.h"
#include "ui/plots/xy_plot.h"
#include "ui/shell/main_window.h"
#include "ui/shell/theme.h"
#include "ui/widgets/channel_table.h"
#include "ui/widgets/column_dialog.h"
#include "ui/widgets/data_table.h"
#include "ui/widgets/empty_state.h"
#include "ui/widgets/figure_card.h"
#include "ui/widgets/machine_drawing.h"
#include "ui/widgets/number_text.h"
#include "ui/widgets/toggle_segment.h"

using namespace zerodrift::ui;

class PagesTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void figuresAreJudgedWithWords();
  void emptyPagesSayHowToGetThere();
  void machineStartsJobsAndSelectsSensors();
  void registersAreEdited();
  void devicesAreListedWithWhatIsWrong();
  void manualControlHasNoRegisters();
  void warmthIsJudgedByItsChange();
  void columnsAreTold();
  void compensationOnLocksStart();
  void calibrationNeedsConfirmation();
  void marksAreDrawnAndRemoved();
  void planIsEditedByFieldsAndTimeline();
  void warmupButtonsFollowThePhase();
  void everyDirectionIsSeenInALowWindow();
  void sensorsAreTickedInAndOut();
  void nothingIsMinusZero();
  void physicsAdoptsAndRejects();
  void blindTrialIsOpenedLast();
  void axisRefusesATableThatTurnsBack();
  void doubtsStandByWhatTheyAreAbout();
  void nothingIsPromisedOfADriftThatNobodyKnows();
  void whatIsGreenIsWithinTheLimitShown();
  void sensorsFiguresAreWholeInTheSmallestWindow();
  void everyPageSurvivesNewLanguageAndNothing();
  void everyActionIsExplained();
  void plotsOfAnOpenPageFollowTheTheme();
  void plotsOfAPageOpenedLaterFollowTheTheme();
};

template <class P>
static P* shown(P* page) {
  page->resize(1044, 584);
  page->show();
  return page;
}

void PagesTest::figuresAreJudgedWithWords() {
  QCOMPARE(figureAtMost("a", 0.4, 2, "K", 0.5).judgement, Judgement::ok);
  QCOMPARE(figureAtMost("a", 0.55, 2, "K", 0.5).judgement, Judgement::warn);
  QCOMPARE(figureAtMost("a", -2.0, 2, "K", 0.5).judgement, Judgement::bad);
  QCOMPARE(figureAtLeast("a", 92.0, 0, "%", 85).judgement, Judgement::ok);
  QCOMPARE(figureAtLeast("a", 40.0, 0, "%", 85).judgement, Judgement::bad);
  const Figure none = figureAtMost("a", std::nan(""), 2, "K", 0.5);
  QCOMPARE(none.judgement, Judgement::none);
  QVERIFY(none.value.isEmpty());
  QVERIFY(!none.word.isEmpty());
  FigureCard card;
  card.setFigure(figureAtMost("Spread", 0.4, 2, "K", 0.5));
  QVERIFY(card.accessibleName().contains("0.40 K"));
  QVERIFY(card.accessibleName().contains("good"));
}

void PagesTest::emptyPagesSayHowToGetThere() {
  MainWindow window;
  samples::addPages(window);
  window.show();
  for (const char* id : {"calibrate", "warmup", "sensors", "fit", "physics", "upload", "verify", "report",
                         "axis_errors", "compensator"}) {
    samples::play(window, {id, "empty"});
    auto* empty = window.currentPage()->findChild<EmptyState*>();
    QVERIFY2(empty->isVisible(), id);
    if (QString(id) != "axis_errors") QVERIFY2(!window.currentPage()->primaryAction().enabled, id);
    QVERIFY2(!window.currentPage()->primaryAction().text.isEmpty(), id);
  }
}

void PagesTest::machineStartsJobsAndSelectsSensors() {
  MachinePage page;
  shown(&page);
  QSignalSpy made(&page, &MachinePage::newJobRequested);
  QSignalSpy virtualMachine(&page, &MachinePage::virtualMachineRequested);
  page.findChild<QPushButton*>("startNew")->click();
  page.findChild<QPushButton*>("startVirtual")->click();
  QCOMPARE(made.count(), 1);
  QCOMPARE(virtualMachine.count(), 1);
  samples::fillMachine(&page, "filled");
  QSignalSpy selected(&page, &MachinePage::sensorSelected);
  auto* drawing = page.findChild<MachineDrawing*>();
  Q_EMIT drawing->selected("T7_C");
  QCOMPARE(page.findChild<ChannelTable*>()->selectedId(), QString("T7_C"));
  QVERIFY(selected.count() >= 1);
}

void PagesTest::registersAreEdited() {
  MachinePage page;
  shown(&page);
  samples::fillMachine(&page, "registers");
  QSignalSpy edited(&page, &MachinePage::registerEdited);
  QSignalSpy seen(&page, &MachinePage::registersShown);
  auto* table = page.findChild<QTableWidget*>("registers");
  QCOMPARE(table->rowCount(), 6);
  QCOMPARE(table->item(4, RegisterTable::value)->text().left(6), QString("20.250"));
  table->item(4, RegisterTable::scale)->setText("-0.1");
  QCOMPARE(edited.count(), 1);
  QCOMPARE(edited[0][0].toInt(), 4);
  QCOMPARE(edited[0][2].toString(), QString("-0.1"));
  page.showView(0);
  QCOMPARE(seen.last()[0].toBool(), false);
  // New values leave the rows as they are and tell nobody.
  MachineState state = page.state();
  state.registers[4].value = "21.000";
  page.setState(state);
  QCOMPARE(edited.count(), 1);
  QCOMPARE(table->item(4, RegisterTable::value)->text(), QString("21.000"));
}

void PagesTest::devicesAreListedWithWhatIsWrong() {
  MachinePage page;
  shown(&page);
  auto* devices = page.findChild<DataTable*>("devices");
  auto* words = page.findChild<QLabel*>("deviceState");
  samples::fillMachine(&page, "filled");  // the control has all of it
  QVERIFY(!devices->isVisible() && !words->isVisible());
  samples::fillMachine(&page, "devices");
  QVERIFY(devices->isVisible());
  auto* table = devices->findChild<QTableWidget*>();
  const auto row = [table](int at) {
    QStringList texts;
    for (int i = 0; i < table->columnCount(); ++i) texts << table->item(at, i)->text();
    return texts;
  };
  QCOMPARE(row(0), QStringList({"module-1", "11.8 ms", "0.4 s", "2", "answers"}));
  QCOMPARE(row(2).mid(0, 4), QStringList({"amplifier", "–", "75.0 s", "6"}));
  QVERIFY(row(2)[4].startsWith("No connection to 192.168.0.21"));
  QVERIFY(row(3)[4].contains("opened anew"));
  // What is wrong is read without a pointer: of the first that does not answer, or of the selected one.
  QVERIFY(words->isVisible() && words->text().startsWith("amplifier: No connection"));
  QVERIFY(words->toolTip().contains("cable"));  // what to do
  table->setCurrentCell(3, 0);
  QVERIFY(words->text().contains("opened anew"));
  page.showView(1);  // the registers need the room
  QVERIFY(!devices->isVisible() && !words->isVisible());
  page.showView(0);
  QVERIFY(devices->isVisible());
  // A rig of many devices leaves the drawing its room.
  MachineState state = page.state();
  while (state.devices.size() < 12) state.devices.append(state.devices.first());
  page.setState(state);
  QVERIFY(devices->height() < 200);
  QCOMPARE(devices->rowCount(), 12);
}

void PagesTest::manualControlHasNoRegisters() {
  MachinePage page;
  shown(&page);
  samples::fillMachine(&page, "registers");
  auto* registers = page.findChild<QTableWidget*>("registers");
  QVERIFY(registers->isVisible());
  samples::fillMachine(&page, "manual");
  QVERIFY(!registers->isVisible());
  QVERIFY(!page.findChild<ToggleSegment*>("machineView")->isVisible());
  QVERIFY(page.findChild<MachineDrawing*>()->isVisible());
  // No link, so no round trip and no other clock: its devices instead.
  const auto cards = page.findChildren<FigureCard*>();
  QStringList labels;
  for (const FigureCard* card : cards) {
    if (card->isVisible()) labels << card->figure().label;
  }
  QCOMPARE(labels, QStringList({"Sensors alive", "Spread at rest", "Devices that answer"}));
  MachineState state = page.state();
  state.connected = false;
  page.setState(state);
  QVERIFY(page.sentence().contains("no link"));
  QVERIFY(!page.findChild<DataTable*>("devices")->isVisible());
  samples::fillMachine(&page, "registers");
  QVERIFY(page.findChild<ToggleSegment*>("machineView")->isVisible());
}

void PagesTest::warmthIsJudgedByItsChange() {
  MachinePage page;
  samples::fillMachine(&page, "filled");
  MachineState state = page.state();
  const auto word = [&] {
    page.setState(state);
    return page.findChildren<FigureCard*>()[1]->figure();
  };
  state.rest.spread_K = 3.1;
  state.rest.warmest = "T14";
  state.rest.apart_K = 2.9;
  QCOMPARE(word().judgement, Judgement::warn);  // not watched for long enough
  QVERIFY(page.primaryAction().enabled);
  state.rest.change_K_h = 6.0;
  state.rest.quickest = "T14";
  QCOMPARE(word().judgement, Judgement::warn);
  QVERIFY(word().limit.contains("6.0"));
  QVERIFY(page.sentence().contains("T14"));
  state.rest.change_K_h = 0.2;  // it stands there for ever: that is no reason to wait
  QCOMPARE(word().judgement, Judgement::ok);
  QVERIFY(word().limit.contains("T14"));
  QVERIFY(page.sentence().contains("2.9"));
  // Once the commissioning began the figure is of then, and says so; what is now stands beside it.
  const QString before = word().label;
  state.rest.atStart = true;
  state.rest.spread_K = 0.8;
  state.rest.now_K = 3.1;
  const Figure began = word();
  QVERIFY(began.label != before);
  QCOMPARE(began.value, QString("0.80"));
  QCOMPARE(began.judgement, Judgement::ok);
  QVERIFY(began.limit.contains("3.10"));
  state.rest.spread_K = 2.9;
  QCOMPARE(word().judgement, Judgement::warn);
}

void PagesTest::columnsAreTold() {
  ColumnChoice choice;
  choice.roles = {0, 1, 2};
  ColumnDialog dialog({"No.", "Pos", ""}, {{"1", "0", "0.5"}, {"2", "10", "0.7"}}, choice);
  QSignalSpy changed(&dialog, &ColumnDialog::changed);
  QCOMPARE(dialog.choice(), choice);
  dialog.findChild<QComboBox*>("role2")->setCurrentIndex(3);
  dialog.findChild<QComboBox*>("errorUnit")->setCurrentIndex(1);
  dialog.findChild<QCheckBox*>("negated")->setChecked(true);
  QCOMPARE(changed.count(), 3);
  QCOMPARE(dialog.choice().roles, (QVector<int>{0, 1, 3}));
  QCOMPARE(dialog.choice().errorUnit, 1);
  QVERIFY(dialog.choice().negated);
  dialog.setVerdict("no position", false);
  QVERIFY(dialog.findChild<QLabel*>("verdict")->text().contains("position"));
}

void PagesTest::compensationOnLocksStart() {
  MachinePage page;
  samples::fillMachine(&page, "filled");
  QVERIFY(page.primaryAction().enabled);
  MachineState state = page.state();
  state.compensationOn = true;
  page.setState(state);
  QVERIFY(!page.primaryAction().enabled);
  QVERIFY(page.primaryAction().reason.contains("ON"));
}

void PagesTest::calibrationNeedsConfirmation() {
  CalibratePage page;
  samples::fillCalibrate(&page, "planned");
  CalibrateState state = page.state();
  state.running = false;
  page.clearProgress();
  page.setState(state);
  QVERIFY(!page.primaryAction().enabled);
  page.findChild<QCheckBox*>("areaClear")->setChecked(true);
  QVERIFY(page.primaryAction().enabled);
  // It serves once, and not for other moves than those that were shown.
  QVERIFY(page.takeConsent());
  QVERIFY(!page.takeConsent());
  auto* clear = page.findChild<QCheckBox*>("areaClear");
  const auto forgets = [&](auto change) {
    clear->setChecked(true);
    change(state);
    page.setState(state);
    return !clear->isChecked();
  };
  QVERIFY(forgets([](CalibrateState& s) { s.camera = 1; }));
  QVERIFY(forgets([](CalibrateState& s) { s.moveCamera = "Side"; }));
  QVERIFY(forgets([](CalibrateState& s) { s.moveAxes = QStringList{"Y", "Z"}; }));
  QVERIFY(forgets([](CalibrateState& s) { s.span_mm = 4.0; }));
  QVERIFY(forgets([](CalibrateState& s) { s.running = true; }));
  QVERIFY(forgets([](CalibrateState& s) { s.running = false; }));
  QVERIFY(!forgets([](CalibrateState&) {}));
  clear->setChecked(false);
  state.solved = state.accepted = true;
  page.setState(state);
  QVERIFY(!page.secondaryActions().first().enabled);  // measuring again moves the axes, too
  state.accepted = false;
  state.solved = true;
  state.rms_um = 5.0;
  page.setState(state);
  QVERIFY(!page.primaryAction().enabled);  // the residual is above its limit
}

void PagesTest::marksAreDrawnAndRemoved() {
  CalibratePage page;
  shown(&page);
  samples::fillCalibrate(&page, "planned");
  CalibrateState state = page.state();
  state.running = false;
  page.setState(state);
  auto* view = page.findChild<CameraView*>();
  auto* menu = page.findChild<QPushButton*>("marks")->menu();
  const auto actions = [&] {
    Q_EMIT menu->aboutToShow();
    return menu->actions();
  };
  const auto notes = [&] {
    QString all;
    for (const auto* label : page.findChildren<QLabel*>()) all += label->text() + '\n';
    return all;
  };
  const auto draw = [&] {
    const QPoint from = view->rect().center() - QPoint(60, 60);
    QTest::mousePress(view, Qt::LeftButton, {}, from);
    QTest::mouseMove(view, from + QPoint(20, 20));
    QTest::mouseMove(view, from + QPoint(60, 60));
    QTest::mouseRelease(view, Qt::LeftButton, {}, from + QPoint(60, 60));
  };
  QSignalSpy region(&page, &CalibratePage::regionDrawn);
  QSignalSpy mark(&page, &CalibratePage::markDrawn);
  QSignalSpy removed(&page, &CalibratePage::markRemoved);
  QCOMPARE(actions().size(), 2);
  QVERIFY(notes().contains("0.30 µm for 0.1 mrad"));  // what stays with one mark
  menu->actions().at(0)->trigger();
  QVERIFY(actions().at(0)->isChecked());
  draw();
  QCOMPARE(mark.count(), 1);
  QCOMPARE(region.count(), 0);
  QVERIFY(!actions().at(0)->isChecked());
  draw();  // one box, one mark
  QCOMPARE(mark.count(), 1);
  // The box of the target is drawn as before, also when a mark was meant first.
  menu->actions().at(0)->trigger();
  page.findChild<QPushButton*>("drawRegion")->click();
  draw();
  QCOMPARE(mark.count(), 1);
  QCOMPARE(region.count(), 1);
  state.marks = 2;
  state.takeOff = MarksTakeOff::shiftTurnScale;
  page.setState(state);
  QVERIFY(notes().contains("shifts, turns or changes its scale"));
  QCOMPARE(actions().size(), 3);
  menu->actions().at(2)->trigger();
  QCOMPARE(removed.count(), 1);
  QCOMPARE(removed.first().first().toInt(), 1);
  state.marks = 0;
  state.takeOff = MarksTakeOff::nothing;
  page.setState(state);
  QVERIFY(notes().contains("no reference mark"));
  QVERIFY(notes().contains("the camera's own drift stays"));
  state.running = true;
  page.setState(state);
  QVERIFY(!page.findChild<QPushButton*>("marks")->isEnabled());
}

void PagesTest::planIsEditedByFieldsAndTimeline() {
  WarmupPage page;
  shown(&page);
  samples::fillWarmup(&page, "plan");
  QSignalSpy edited(&page, &WarmupPage::planEdited);
  page.findChild<QSpinBox*>("stepSpeed")->setValue(1200);
  QCOMPARE(edited.count(), 1);
  QCOMPARE(page.state().plan.first().speed_rpm, 1200.0);
  const auto steps = page.state().plan.size();
  page.findChild<QPushButton*>("addStep")->click();
  QCOMPARE(page.state().plan.size(), steps + 1);
  auto* timeline = page.findChild<PlanTimeline*>();
  const double before = timeline->steps()[timeline->selectedStep()].duration_s;
  QTest::keyClick(timeline, Qt::Key_Right, Qt::ShiftModifier);
  QCOMPARE(page.state().plan[timeline->selectedStep()].duration_s, before + 300.0);
}

void PagesTest::warmupButtonsFollowThePhase() {
  WarmupPage page;
  WarmupState state;
  state.plan = {PlanStepRow{}};
  page.setState(state);
  QCOMPARE(page.primaryAction().text, QString("Start"));
  state.compensationOn = true;
  page.setState(state);
  QVERIFY(!page.primaryAction().enabled);
  state.compensationOn = false;
  state.phase = RunPhase::running;
  page.setState(state);
  QCOMPARE(page.primaryAction().text, QString("Pause"));
  state.phase = RunPhase::interrupted;
  page.setState(state);
  QCOMPARE(page.primaryAction().text, QString("Resume"));
}

/// In the smallest window, with trouble told above: the three errors are what the run is for.
void PagesTest::everyDirectionIsSeenInALowWindow() {
  MainWindow window;
  samples::fillWindow(window);
  window.resize(1280, 720);
  window.show();
  samples::play(window, {"warmup", "trouble"});
  QVERIFY(QTest::qWaitForWindowExposed(&window));
  QCoreApplication::processEvents();
  QCOMPARE(window.height(), 720);
  const auto tables = window.currentPage()->findChildren<ChannelTable*>();
  const auto errors =
      std::find_if(tables.begin(), tables.end(), [](const ChannelTable* one) { return one->rows().size() == 3; });
  QVERIFY(errors != tables.end());
  const auto* view = (*errors)->findChild<QTableView*>();
  const QRect last = view->visualRect(view->model()->index(2, 1));
  QVERIFY2(last.bottom() <= view->viewport()->height(), qPrintable(QString::number(view->viewport()->height())));
}

void PagesTest::sensorsAreTickedInAndOut() {
  SensorsPage page;
  samples::fillSensors(&page, "filled");
  QSignalSpy changed(&page, &SensorsPage::keptChanged);
  auto* table = page.findChild<QTableWidget*>();
  table->item(1, 0)->setCheckState(Qt::Checked);
  QCOMPARE(changed.count(), 1);
  QCOMPARE(changed.first().first().toString(), QString("T2_C"));
  QVERIFY(page.state().sensors[1].kept);
  SensorsState state = page.state();
  for (auto& sensor : state.sensors) sensor.kept = false;
  page.setState(state);
  QVERIFY(!page.primaryAction().enabled);
}

void PagesTest::nothingIsMinusZero() {
  QCOMPARE(fixedText(-0.04, 1), QString("0.0"));
  QCOMPARE(fixedText(-0.06, 1), QString("-0.1"));
  QCOMPARE(fixedText(-0.4, 0), QString("0"));
  QCOMPARE(sentencesText({"One.", "Two.", QString(), "Three."}), QString("One. Two. Three."));
  QCOMPARE(sentencesText({QString::fromUtf8("一。"), QString::fromUtf8("二。")}), QString::fromUtf8("一。二。"));
  QCOMPARE(figureOf("x", -0.004, 2, "µm").value, QString("0.00"));
}

void PagesTest::blindTrialIsOpenedLast() {
  PhysicsPage page;
  samples::fillPhysics(&page, "trial");
  PhysicsState state = page.state();
  const auto action = [&](const char* id) {
    const auto actions = page.secondaryActions();
    const auto at = std::find_if(actions.begin(), actions.end(), [&](const PageAction& a) { return a.id == id; });
    return at == actions.end() ? PageAction{} : *at;
  };
  state.trial.stage = TrialStage::none;
  page.setState(state);
  QVERIFY(action("open").text.isEmpty());
  state.trial.stage = TrialStage::sealed;
  page.setState(state);
  QVERIFY(!action("trial").enabled);
  QVERIFY(!action("open").enabled);
  state.trial.stage = TrialStage::answered;
  page.setState(state);
  QVERIFY(action("open").enabled);
  QVERIFY(!action("trial").enabled);  // one trial after the other
  state.trial.stage = TrialStage::opened;
  page.setState(state);
  QVERIFY(!action("open").enabled);
  QVERIFY(action("trial").enabled);
  // Opening the seal must not put another deed under the pointer.
  QCOMPARE(page.secondaryActions().first().id, QString("open"));
}

void PagesTest::physicsAdoptsAndRejects() {
  PhysicsPage page;
  samples::fillPhysics(&page, "where");
  QSignalSpy adopted(&page, &PhysicsPage::adopted);
  page.findChildren<QPushButton*>("adopt").first()->click();
  QCOMPARE(adopted.count(), 1);
  QCOMPARE(adopted.first().first().toString(), QString("extra_heat_source"));
  QSignalSpy experiment(&page, &PhysicsPage::experimentRequested);
  page.findChild<QPushButton*>("experiment")->click();
  QCOMPARE(experiment.count(), 1);
}

void PagesTest::axisRefusesATableThatTurnsBack() {
  AxisPage page;
  samples::fillAxis(&page, "segments");
  QVERIFY(page.primaryAction().enabled);
  AxisState state = page.state();
  state.monotonic = false;
  page.setState(state);
  QVERIFY(!page.primaryAction().enabled);
}

void PagesTest::doubtsStandByWhatTheyAreAbout() {
  ReportPage page;
  ReportState state;
  state.doubtful = {{"Z above its limit", Judgement::bad, "verify", "Verify"},
                    {"samples were lost", Judgement::warn, "warmup", "Warm-up"},
                    {"Y became worse", Judgement::warn, "verify", "Verify"}};
  page.setState(state);
  const auto* list = page.findChild<QListWidget*>("doubtful");
  QStringList lines;
  for (int i = 0; i < list->count(); ++i) lines << list->item(i)->text();
  QCOMPARE(lines,
           (QStringList{"Verify (2)", "Z above its limit", "Y became worse", "Warm-up (1)", "samples were lost"}));
  const auto ids = [&page] {
    QStringList all;
    for (const PageAction& action : page.secondary()) all << action.id;
    return all;
  };
  QVERIFY(ids().contains("print") && !ids().contains("open"));
  state.savedTo = "/jobs/report.pdf";
  page.setState(state);
  QVERIFY(ids().contains("open") && ids().contains("folder"));
}

void PagesTest::nothingIsPromisedOfADriftThatNobodyKnows() {
  WarmupPage page;
  WarmupState state;
  state.plan = {{600.0, 3000.0, false, false}};
  page.setState(state);
  const auto plots = page.findChildren<XyPlot*>();
  QVERIFY(std::none_of(plots.begin(), plots.end(), [&page](const XyPlot* plot) { return plot->isVisibleTo(&page); }));
  for (const auto* card : page.findChildren<FigureCard*>()) QVERIFY(card->figure().label != "Expected drift");
}

/// The narrowest table of sensors holds the longest of its figures.
void PagesTest::sensorsFiguresAreWholeInTheSmallestWindow() {
  SensorsPage page;
  SensorsState state;
  SensorRow sensor;
  sensor.id = "T1_C";
  sensor.kept = true;
  sensor.r = {-0.99, -0.44, -0.66};
  sensor.sum = -2.09;
  sensor.lag_s = -3600.0;
  sensor.vif = 99.9;
  sensor.price_um = -10.44;
  state.sensors = {sensor};
  page.setState(state);
  page.resize(1280 - 236, 720 - 136);
  page.show();
  QVERIFY(QTest::qWaitForWindowExposed(&page));
  auto* table = page.findChild<QTableView*>();
  QVERIFY(table != nullptr);
  const int last = table->model()->columnCount() - 1;
  for (int column = 1; column <= last; ++column) {
    const QFontMetrics metrics(uiFont(12, column == last ? QFont::DemiBold : QFont::Normal));
    const QString text = table->model()->index(0, column).data().toString();
    constexpr int padding_px = 9;
    QVERIFY2(metrics.horizontalAdvance(text) + padding_px <= table->columnWidth(column), qPrintable(text));
  }
}

/// Where a share is within its limit for being small in micrometres, those are what is shown.
void PagesTest::whatIsGreenIsWithinTheLimitShown() {
  SensorsPage page;
  SensorsState state;
  SensorRow sensor;
  sensor.id = "T1_C";
  sensor.kept = true;
  state.sensors = {sensor};
  state.error_um = 0.6;
  state.lost_percent = 25.0;
  state.lostLimit_um = 0.2;
  page.setState(state);
  const auto lost = [&page] {
    for (const auto* card : page.findChildren<FigureCard*>()) {
      if (card->figure().label == "Lost against all") return card->figure();
    }
    return Figure{};
  };
  QCOMPARE(lost().judgement, Judgement::ok);
  QCOMPARE(lost().unit, QString::fromUtf8("µm"));
  QVERIFY(lost().limit.contains("0.2"));
  state.lostLimit_um = 0.1;
  page.setState(state);
  QVERIFY(lost().judgement != Judgement::ok);
  QCOMPARE(lost().unit, QString("%"));
}

void PagesTest::everyPageSurvivesNewLanguageAndNothing() {
  MainWindow window;
  samples::fillWindow(window);
  window.show();
  for (const auto& scene : samples::scenes()) {
    samples::play(window, scene);
    QEvent language(QEvent::LanguageChange);
    QCoreApplication::sendEvent(window.currentPage(), &language);
    QVERIFY(!window.currentPage()->title().isEmpty());
    QVERIFY(!window.currentPage()->sentence().isEmpty());
  }
  CalibratePage().setState({});
  WarmupPage().setState({});
  SensorsPage().setState({});
  FitPage().setState({});
  PhysicsPage().setState({});
  UploadPage().setState({});
  VerifyPage().setState({});
  ReportPage().setState({});
  AxisPage().setState({});
  MachinePage().setState({});
}

/// What a button does, or why it is off, is in its tooltip; "Go on" says it all.
void PagesTest::everyActionIsExplained() {
  MainWindow window;
  samples::fillWindow(window);
  for (const auto& scene : samples::scenes()) {
    samples::play(window, scene);
    auto actions = window.currentPage()->secondaryActions();
    actions.append(window.currentPage()->primaryAction());
    for (const PageAction& action : actions) {
      if (action.text.isEmpty() || action.text == "Go on" || scene.page == "machine") continue;
      const QString& said = action.enabled ? action.tip : action.reason;
      QVERIFY2(!said.isEmpty(), qPrintable(scene.page + " " + scene.name + ": " + action.text));
    }
  }
}

/// All plots of the current page, in each of its views, have the ground of this theme.
static void expectGround(MainWindow& window, ThemeMode mode) {
  const auto expectAll = [&](int view) {
    for (auto* plot : window.currentPage()->findChildren<PlotWidget*>()) {
      if (!plot->isVisible()) continue;
      const QColor corner = plot->grab().toImage().pixelColor(plot->width() - 3, 3);
      const QString where = QStringLiteral("%1 view %2 %3 %4")
                                .arg(window.currentPage()->id())
                                .arg(view)
                                .arg(plot->metaObject()->className(), corner.name());
      QVERIFY2(mode == ThemeMode::dark ? corner.lightness() < 90 : corner.lightness() > 165, qPrintable(where));
    }
  };
  expectAll(0);
  for (auto* views : window.currentPage()->findChildren<QStackedWidget*>()) {
    for (int i = 0; views->isVisible() && i < views->count(); ++i) {
      views->setCurrentIndex(i);
      QTest::qWait(5);
      expectAll(i);
    }
  }
}

/// One filled scene of each page.
static QVector<samples::Scene> filledPages() {
  QVector<samples::Scene> pages;
  for (const auto& scene : samples::scenes()) {
    if (scene.name != "empty" && (pages.isEmpty() || pages.last().page != scene.page)) pages.append(scene);
  }
  return pages;
}

/// A window takes most of a second to change its theme: every second page sees it become dark, the others light.
void PagesTest::plotsOfAnOpenPageFollowTheTheme() {
  Theme theme(*qApp);
  MainWindow window;
  samples::fillWindow(window);
  window.show();
  ThemeMode mode = ThemeMode::light;
  theme.setMode(mode);
  for (const auto& scene : filledPages()) {
    samples::play(window, scene);
    QTest::qWait(60);
    mode = mode == ThemeMode::light ? ThemeMode::dark : ThemeMode::light;
    theme.setMode(mode);
    QTest::qWait(90);
    expectGround(window, mode);
    if (QTest::currentTestFailed()) return;
  }
  theme.setMode(ThemeMode::light);
}

void PagesTest::plotsOfAPageOpenedLaterFollowTheTheme() {
  Theme theme(*qApp);
  MainWindow window;
  samples::fillWindow(window);
  window.show();
  theme.setMode(ThemeMode::light);
  for (const auto& scene : filledPages()) {
    samples::play(window, scene);
    QTest::qWait(60);
  }
  // Two changes, so that the page that is open at the first is not open at the second.
  for (const auto& [open, mode] : {std::pair{"machine", ThemeMode::dark}, std::pair{"fit", ThemeMode::light}}) {
    window.setCurrentPage(open);
    theme.setMode(mode);
    for (const auto& scene : filledPages()) {
      if (scene.page == open) continue;
      window.setCurrentPage(scene.page);
      QTest::qWait(90);
      expectGround(window, mode);
      if (QTest::currentTestFailed()) return;
    }
  }
}

QTEST_MAIN(PagesTest)
#include "pages_test.moc"
