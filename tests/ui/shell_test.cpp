// The window: rail, keyboard reach, primary button, banner, palette, lamps, and that nothing is cut at 1280x720.

#include <QSignalSpy>
#include <QTest>
#include <QtWidgets>

#include "tests/ui/gallery/samples.h"
#include "ui/pages/page.h"
#include "ui/shell/help_panel.h"
#include "ui/shell/lamp.h"
#include "ui/shell/log_drawer.h"
#include "ui/shell/main_window.h"
#include "ui/shell/theme.h"
#include "ui/widgets/colors.h"
#include "ui/widgets/data_table.h"
#include "ui/widgets/progress_strip.h"

using namespace zerodrift::ui;

namespace {

/// Contrast of WCAG 2.1: relative luminances with 0.05 flare.
double contrast(const QColor& a, const QColor& b) {
  const auto luminance = [](const QColor& c) {
    const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
    return 0.2126 * linear(c.redF()) + 0.7152 * linear(c.greenF()) + 0.0722 * linear(c.blueF());
  };
  const double la = luminance(a);
  const double lb = luminance(b);
  return (std::max(la, lb) + 0.05) / (std::min(la, lb) + 0.05);
}

class PlainPage : public Page {
 public:
  explicit PlainPage(const QString& id) : Page(id) { refresh(); }
  QString title() const override { return "Title of " + id(); }
  QString sentence() const override { return "Do this now."; }
  PageAction primary() const override { return {"primary", "Go", m_enabled, "Not yet."}; }
  QVector<PageAction> secondary() const override { return {{"other", "Other"}}; }
  void setEnabledAction(bool enabled) {
    m_enabled = enabled;
    refresh();
  }

 protected:
  void render() override {}

 private:
  bool m_enabled = true;
};

}  // namespace

class ShellTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void railTellsStateInWordsAndAsksBeforeChanging();
  void primaryButtonFollowsThePage();
  void presenterCanForbidAnAction();
  void workDisablesThePrimaryButton();
  void progressMovesNoPage();
  void focusDoesNotJump();
  void helpIsThereForEveryPage();
  void helpClosesByEscapeAndLeavesTheConsentInSight();
  void quitsByKeyboard();
  void bannerShowsProblemAndAction();
  void keyboardReachesRailActionsAndFoot();
  void enterPressesTheFocusedButton();
  void tablesCanBeCopied();
  void paletteFindsStepsAndActions();
  void lampsCarryText();
  void logCanBeCopied();
  void logCountsWhatIsToldAgain();
  void textsHaveContrast();
  void curvesDiffer();
  void durationsAreCoarse();
  void firstSizeFitsBesideTheDesktopsPanels();
  void nothingIsCutAtTheSmallestSize();
};

void ShellTest::firstSizeFitsBesideTheDesktopsPanels() {
  QCOMPARE(MainWindow::firstSize({2560, 1400}), QSize(1440, 900));
  QCOMPARE(MainWindow::smallestSize({2560, 1400}), QSize(1280, 720));
  const QSize laptop(1366, 728);  // 768 less a panel of 40
  QVERIFY(MainWindow::firstSize(laptop).height() <= 690);
  QVERIFY(MainWindow::firstSize(laptop).width() <= 1366);
  QCOMPARE(MainWindow::smallestSize(laptop).width(), 1280);
  QVERIFY(MainWindow::smallestSize(laptop).height() <= MainWindow::firstSize(laptop).height());
}

void ShellTest::railTellsStateInWordsAndAsksBeforeChanging() {
  MainWindow window;
  window.addPage(new PlainPage("a"));
  window.addPage(new PlainPage("b"));
  window.setStepState("b", StepState::stale, "Sensors changed");
  StepButton* step = window.rail()->step("b");
  QVERIFY(step->accessibleName().contains("Sensors changed"));
  QSignalSpy asked(&window, &MainWindow::stepRequested);
  window.show();
  QTest::mouseClick(step, Qt::LeftButton);
  QCOMPARE(asked.count(), 1);
  QCOMPARE(asked.first().first().toString(), QString("b"));
  // Only asked: the page changes when the presenter says so.
  QCOMPARE(window.currentPage()->id(), QString("a"));
  QVERIFY(window.rail()->step("a")->isChecked());
  window.setCurrentPage("b");
  QVERIFY(step->isChecked());
  QVERIFY(step->accessibleName().contains("current page"));
}

void ShellTest::primaryButtonFollowsThePage() {
  MainWindow window;
  auto* page = new PlainPage("a");
  window.addPage(page);
  QSignalSpy pressed(page, &Page::primaryTriggered);
  window.primaryButton()->click();
  QCOMPARE(pressed.count(), 1);
  page->setEnabledAction(false);
  QVERIFY(!window.primaryButton()->isEnabled());
  QCOMPARE(window.primaryButton()->toolTip(), QString("Not yet."));
}

void ShellTest::presenterCanForbidAnAction() {
  MainWindow window;
  auto* page = new PlainPage("a");
  window.addPage(page);
  page->allow("primary", false, "Compensation is on.");
  QVERIFY(!window.primaryButton()->isEnabled());
  QCOMPARE(window.primaryButton()->toolTip(), QString("Compensation is on."));
  page->allow("primary", true);
  QVERIFY(window.primaryButton()->isEnabled());
}

void ShellTest::workDisablesThePrimaryButton() {
  MainWindow window;
  auto* page = new PlainPage("a");
  window.addPage(page);
  window.show();
  QSignalSpy cancelled(page, &Page::cancelRequested);
  page->setProgress("Fitting", 0.4, 12.0);
  QVERIFY(!window.primaryButton()->isEnabled());
  auto* cancel = window.findChild<QPushButton*>("cancelWork");
  QVERIFY(cancel->isVisible());
  cancel->click();
  QCOMPARE(cancelled.count(), 1);
  page->clearProgress();
  QVERIFY(window.primaryButton()->isEnabled());
}

void ShellTest::progressMovesNoPage() {
  MainWindow window;
  samples::fillWindow(window);
  window.resize(1280, 720);
  window.show();
  samples::play(window, {"calibrate", "planned"});
  Page* page = window.currentPage();
  page->clearProgress();
  QTest::qWait(20);
  QWidget* card = page->findChildren<QWidget*>("drawRegion").first();
  const QPoint before = card->mapTo(&window, QPoint());
  page->setProgress("Calibrating", 0.4, 12.0);
  QTest::qWait(20);
  QVERIFY(page->progressStrip()->isVisible());
  QCOMPARE(card->mapTo(&window, QPoint()), before);
  QVERIFY(window.rect().contains(page->progressStrip()->mapTo(&window, page->progressStrip()->rect().bottomRight())));
  page->clearProgress();
  QVERIFY(!page->progressStrip()->isVisible());
}

/// A button that goes off under the focus does not hand it to the next control.
void ShellTest::focusDoesNotJump() {
  MainWindow window;
  auto* page = new PlainPage("a");
  window.addPage(page);
  window.addPage(new PlainPage("b"));
  window.show();
  QVERIFY(QTest::qWaitForWindowActive(&window));
  window.primaryButton()->setFocus();
  QVERIFY(window.primaryButton()->hasFocus());
  page->setEnabledAction(false);
  QCOMPARE(QApplication::focusWidget(), window.centralWidget());
  page->setEnabledAction(true);
  window.findChild<QPushButton*>("action-other")->setFocus();
  window.setCurrentPage("b");
  for (StepButton* step : window.rail()->steps()) QVERIFY(!step->hasFocus());
}

void ShellTest::helpClosesByEscapeAndLeavesTheConsentInSight() {
  MainWindow window;
  samples::fillWindow(window);
  window.resize(1280, 720);
  window.show();
  QVERIFY(QTest::qWaitForWindowActive(&window));
  samples::play(window, {"calibrate", "solved"});
  QCoreApplication::processEvents();
  window.toggleHelp();
  QVERIFY(window.isHelpVisible());
  const auto* consent = window.findChild<QCheckBox*>("areaClear");
  const auto* help = window.findChild<HelpPanel*>();
  const QRect box(consent->mapTo(&window, QPoint(0, 0)), consent->size());
  const QRect panel(help->mapTo(&window, QPoint(0, 0)), help->size());
  QVERIFY(!panel.intersects(box));
  QVERIFY(panel.height() > 200);
  QTest::keyClick(&window, Qt::Key_Escape);
  QVERIFY(!window.isHelpVisible());
  QTest::keyClick(&window, Qt::Key_Escape);  // does not open it again
  window.setLogVisible(true);
  QTest::keyClick(&window, Qt::Key_Escape);
  QVERIFY(!window.isLogVisible());
  QVERIFY(!window.isHelpVisible());
}

void ShellTest::helpIsThereForEveryPage() {
  MainWindow window;
  samples::fillWindow(window);
  window.show();
  for (StepButton* step : window.rail()->steps()) {
    window.setCurrentPage(step->id());
    window.toggleHelp();
    QVERIFY2(window.isHelpVisible(), qPrintable(step->id()));
    auto* help = window.findChild<HelpPanel*>();
    QCOMPARE(help->pageId(), step->id());
    QVERIFY2(help->text().size() > 300, qPrintable(step->id()));
    window.toggleHelp();
    QVERIFY(!window.isHelpVisible());
  }
}

void ShellTest::quitsByKeyboard() {
  MainWindow window;
  window.addPage(new PlainPage("a"));
  window.show();
  QVERIFY(QTest::qWaitForWindowActive(&window));
  QTest::keyClick(&window, Qt::Key_Q, Qt::ControlModifier);
  QVERIFY(!window.isVisible());
}

void ShellTest::bannerShowsProblemAndAction() {
  MainWindow window;
  auto* page = new PlainPage("a");
  window.addPage(page);
  window.show();
  page->setProblem({ProblemKind::failure, "The controller does not answer.", "Check the cable.", "Try again"});
  auto* banner = page->findChild<ProblemBanner*>();
  QVERIFY(banner->isVisible());
  QCOMPARE(banner->accessibleName(), QString("The controller does not answer."));
  QSignalSpy again(page, &Page::problemActionTriggered);
  page->findChild<QPushButton*>("problemAction")->click();
  QCOMPARE(again.count(), 1);
  page->clearProblem();
  QVERIFY(!banner->isVisible());
}

void ShellTest::keyboardReachesRailActionsAndFoot() {
  MainWindow window;
  window.addPage(new PlainPage("a"));
  window.addPage(new PlainPage("b"));
  window.show();
  QVERIFY(QTest::qWaitForWindowExposed(&window));
  window.activateWindow();
  window.rail()->step("a")->setFocus();
  QSet<QString> reached;
  for (int i = 0; i < 40; ++i) {
    if (QWidget* now = QApplication::focusWidget()) reached.insert(now->objectName());
    QTest::keyClick(QApplication::focusWidget() ? QApplication::focusWidget() : &window, Qt::Key_Tab);
  }
  for (const char* name : {"step-a", "step-b", "railJob", "railLanguage", "railTheme", "railHelp", "action-other",
                           "primary", "back", "lamp-compensation"}) {
    QVERIFY2(reached.contains(name), name);
  }
}

void ShellTest::enterPressesTheFocusedButton() {
  MainWindow window;
  auto* page = new PlainPage("a");
  window.addPage(page);
  window.show();
  QVERIFY(QTest::qWaitForWindowExposed(&window));
  window.activateWindow();
  QSignalSpy pressed(page, &Page::primaryTriggered);
  auto* primary = window.findChild<QPushButton*>("primary");
  primary->setFocus();
  QTest::keyClick(primary, Qt::Key_Return);
  QCOMPARE(pressed.size(), 1);
  QTest::keyClick(primary, Qt::Key_Enter, Qt::KeypadModifier);
  QCOMPARE(pressed.size(), 2);
  page->setEnabledAction(false);
  QTest::keyClick(&window, Qt::Key_Return);
  QCOMPARE(pressed.size(), 2);
}

void ShellTest::tablesCanBeCopied() {
  DataTable table;
  table.setColumns({{"Channel"}, {"rms", 60, true}});
  table.setRows({{{"T1"}, {"0.5"}}, {{"T2"}, {"1.5"}}});
  table.show();
  QVERIFY(QTest::qWaitForWindowExposed(&table));
  table.activateWindow();
  auto* view = table.findChild<QAbstractItemView*>();
  view->setFocus();
  view->clearSelection();
  QTest::keyClick(view, Qt::Key_C, Qt::ControlModifier);
  QCOMPARE(QGuiApplication::clipboard()->text(), QStringLiteral("Channel\trms\nT1\t0.5\nT2\t1.5"));
  table.selectRow(1);
  QTest::keyClick(view, Qt::Key_C, Qt::ControlModifier);
  QCOMPARE(QGuiApplication::clipboard()->text(), QStringLiteral("Channel\trms\nT2\t1.5"));
}

void ShellTest::paletteFindsStepsAndActions() {
  QVERIFY(matchScore("warm", "Warm-up") > matchScore("wu", "Warm-up"));
  QVERIFY(matchScore("xyz", "Warm-up") < 0);
  MainWindow window;
  window.addPage(new PlainPage("a"));
  window.addPage(new PlainPage("b"));
  window.setExtraCommands({{"sensor:T1", "Sensor T1 front bearing", "Sensor", {}, true}});
  window.show();
  QVERIFY(QTest::qWaitForWindowExposed(&window));
  window.activateWindow();
  QSignalSpy step(&window, &MainWindow::stepRequested);
  QSignalSpy extra(&window, &MainWindow::commandRequested);
  auto* palette = window.findChild<CommandPalette*>();
  const auto run = [&](const QString& text) {
    QTest::keyClick(&window, Qt::Key_K, Qt::ControlModifier);
    QTRY_VERIFY(palette->isVisible());
    auto* search = palette->findChild<QLineEdit*>("paletteSearch");
    QTest::keyClicks(search, text);
    QTest::keyClick(search, Qt::Key_Return);
  };
  run("Title of b");
  QCOMPARE(step.count(), 1);
  QCOMPARE(step.first().first().toString(), QString("b"));
  run("front bearing");
  QCOMPARE(extra.count(), 1);
  QCOMPARE(extra.first().first().toString(), QString("sensor:T1"));
}

void ShellTest::lampsCarryText() {
  MainWindow window;
  window.setLamp(LampId::compensation, "Compensation ON", Judgement::ok, true);
  auto* lamp = window.findChild<Lamp*>("lamp-compensation");
  QCOMPARE(lamp->accessibleName(), QString("Compensation ON"));
}

void ShellTest::logCanBeCopied() {
  MainWindow window;
  window.appendLog(QDateTime::currentDateTime(), Judgement::bad, "The camera froze.");
  QVERIFY(window.findChild<LogDrawer*>()->text().contains("The camera froze."));
}

void ShellTest::logCountsWhatIsToldAgain() {
  MainWindow window;
  window.resize(1280, 720);
  window.setLogVisible(true);
  window.show();
  auto* log = window.findChild<LogDrawer*>();
  for (int i = 0; i < 60; ++i)
    window.appendLog(QDateTime::currentDateTime(), Judgement::none, QString("line %1").arg(i));
  auto* bar = log->findChild<QPlainTextEdit*>()->verticalScrollBar();
  QVERIFY(bar->maximum() > 0);
  QCOMPARE(bar->value(), bar->maximum());
  bar->setValue(3);  // somebody reads above
  for (int i = 0; i < 100; ++i)
    window.appendLog(QDateTime::currentDateTime(), Judgement::bad, "The controller is silent.");
  QCOMPARE(bar->value(), 3);
  QCOMPARE(log->text().count("The controller is silent."), 1);
  QVERIFY(log->text().contains("100"));
  window.appendLog(QDateTime::currentDateTime(), Judgement::ok, "Connected.");
  window.appendLog(QDateTime::currentDateTime(), Judgement::bad, "The controller is silent.");
  QCOMPARE(log->text().count("The controller is silent."), 2);
  bar->setValue(bar->maximum());
  window.appendLog(QDateTime::currentDateTime(), Judgement::none, "the last line");
  QCOMPARE(bar->value(), bar->maximum());
}

void ShellTest::textsHaveContrast() {
  for (const Colors* c : {&lightColors(), &darkColors()}) {
    for (const QColor& ground : {c->panel, c->window}) {
      for (const QColor& ink : {c->text, c->muted, c->okText, c->warnText, c->badText}) {
        QVERIFY2(contrast(ink, ground) >= 4.5, qPrintable(ink.name() + " on " + ground.name()));
      }
    }
    QVERIFY(contrast(c->onAccent, c->accent) >= 4.5);
    QVERIFY(contrast(c->railText, c->rail) >= 4.5);
    QVERIFY(contrast(c->railMuted, c->rail) >= 4.5);
  }
}

void ShellTest::curvesDiffer() {
  QSet<QRgb> seen;
  for (int i = 0; i < 24; ++i) seen.insert(curveColor(i).rgb());
  QCOMPARE(seen.size(), 24);
  QCOMPARE(curveColor(24), curveColor(0));
  // The middle of the diverging colours is neutral, its ends are not.
  QVERIFY(divergingColor(0.0).hslSaturation() < 60);
  QVERIFY(divergingColor(1.0).red() > divergingColor(1.0).blue());
  QVERIFY(divergingColor(-1.0).blue() > divergingColor(-1.0).red());
}

void ShellTest::durationsAreCoarse() {
  QCOMPARE(durationText(12.4), QString("12 s"));
  QCOMPARE(durationText(240.0), QString("4 min"));
  QCOMPARE(durationText(11100.0), QString("3 h 05 min"));
}

void ShellTest::nothingIsCutAtTheSmallestSize() {
  MainWindow window;
  samples::fillWindow(window);
  window.resize(1280, 720);
  window.show();
  QVERIFY(QTest::qWaitForWindowExposed(&window));
  for (const auto& scene : samples::scenes()) {
    if (scene.name == "log") continue;
    samples::play(window, scene);
    QCoreApplication::sendPostedEvents();
    QCoreApplication::processEvents();
    QCOMPARE(window.size(), QSize(1280, 720));
    const QByteArray where = (scene.page + ' ' + scene.name).toUtf8();
    auto* page = window.currentPage();
    QVERIFY2(page->minimumSizeHint().width() <= 1044, (where + " is too wide").constData());
    // Without a banner everything fits; nothing has to be scrolled to.
    const int room = page->parentWidget()->height();
    if (scene.name != "banner") {
      // Layouts settle over a few rounds of events.
      QTRY_VERIFY2(page->minimumSizeHint().height() <= room, where.constData());
    }
    for (QPushButton* button : window.findChildren<QPushButton*>()) {
      if (!button->isVisible() || button->text().isEmpty()) continue;
      const int text = button->fontMetrics().horizontalAdvance(button->text());
      QVERIFY2(button->width() >= text, (where + ": " + button->text().toUtf8()).constData());
    }
  }
}

int main(int argc, char** argv) {
  QApplication application(argc, argv);
  Theme theme(application);
  theme.setMode(ThemeMode::light);
  ShellTest test;
  return QTest::qExec(&test, argc, argv);
}

#include "shell_test.moc"
