// The pages that end in a write to the machine, and the proof of it: what may be pressed when, and what is said.

#include <QSignalSpy>
#include <QTest>
#include <QtWidgets>

#include "tests/ui/gallery/page_samples.h"
#include "ui/pages/upload_page.h"
#include "ui/pages/verify_page.h"
#include "ui/widgets/figure_card.h"

using namespace zerodrift::ui;

class MachineWritesTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void uploadIsLockedWhileCompensationIsOn();
  void uploadIsLockedByAWrongSign();
  void awayFromTheMachineNothingIsTried();
  void rollbackSaysWhatItWouldDo();
  void verifyProposesTheCorrection();
  void aCorrectionWithinTheLimitsIsOffered();
  void proofIsOnlyCompleteWithinTheLimit();
  void afterAFailedVerificationTheNextActIsOffered();
  void removedIsToldForEachDirection();
};

void MachineWritesTest::uploadIsLockedWhileCompensationIsOn() {
  UploadPage page;
  samples::fillUpload(&page, "ready");
  QVERIFY(page.primaryAction().enabled);
  UploadState state = page.state();
  state.compensationOn = true;
  page.setState(state);
  QVERIFY(!page.primaryAction().enabled);
}

void MachineWritesTest::uploadIsLockedByAWrongSign() {
  UploadPage page;
  samples::fillUpload(&page, "ready");
  UploadState state = page.state();
  state.sign.judgement = Judgement::bad;
  page.setState(state);
  QVERIFY(!page.primaryAction().enabled);
  QVERIFY(page.primaryAction().reason.contains("direction"));
}

void MachineWritesTest::rollbackSaysWhatItWouldDo() {
  UploadPage page;
  samples::fillUpload(&page, "ready");
  auto* button = page.findChild<QPushButton*>("rollback");
  QSignalSpy wanted(&page, &UploadPage::rollbackRequested);
  QVERIFY(button->isEnabled());  // what is proposed is chosen already
  QCOMPARE(button->text(), QString("Roll back to version 2"));
  button->click();
  QCOMPARE(wanted.first().first().toString(), QString("2"));
  // A button that cannot be pressed says why, in the page and as a tip.
  page.showHistory(3);
  QVERIFY(!button->isEnabled());
  QVERIFY(button->toolTip().contains("same table"));
  UploadState state = page.state();
  state.rollbackBlocked = "No machine is connected.";
  page.setState(state);
  QVERIFY(!button->isEnabled());
  QCOMPARE(button->toolTip(), state.rollbackBlocked);
  QVERIFY(page.findChild<QLabel*>("rollbackHint")->text().contains("No machine"));
  state.history.clear();
  state.rollbackBlocked.clear();
  page.setState(state);
  QVERIFY(!button->isEnabled() && !button->toolTip().isEmpty());
}

void MachineWritesTest::verifyProposesTheCorrection() {
  VerifyPage page;
  samples::fillVerify(&page, "correction");
  QCOMPARE(page.primaryAction().text, QString("Apply correction"));
  QVERIFY(page.correctionNeeded());  // X is over its limit
  QSignalSpy threshold(&page, &VerifyPage::thresholdChanged);
  page.findChild<QDoubleSpinBox*>("threshold")->setValue(4.5);
  QCOMPARE(threshold.count(), 1);
}

static void leave(VerifyState& state, double before_um, double after_um) {
  for (auto& axis : state.results) {
    axis.before_um = before_um;
    axis.after_um = after_um;
    axis.removed_percent = 100.0 * (1.0 - after_um / before_um);
  }
  state.peakAfter_um = after_um;
}

void MachineWritesTest::proofIsOnlyCompleteWithinTheLimit() {
  VerifyPage page;
  samples::fillVerify(&page, "correction");
  VerifyState state = page.state();
  state.correctionProposed = false;
  state.peakLimit_um = 5.0;
  QVERIFY(state.results[0].after_um > 5.0);
  page.setState(state);
  QVERIFY(!page.sentence().contains("complete"));
  QVERIFY(page.sentence().contains("X"));
  leave(state, 12.0, 3.0);
  page.setState(state);
  QVERIFY2(page.sentence().contains("less than 85 %"), qPrintable(page.sentence()));
  leave(state, 30.0, 3.0);
  page.setState(state);
  QVERIFY2(page.sentence().contains("complete"), qPrintable(page.sentence()));
  state.versionBefore = 1;
  state.worseThanBefore = {{"X", 1.2, 2.4}};
  page.setState(state);
  QVERIFY(page.sentence().contains("X") && page.sentence().contains("version 1: X"));
  QVERIFY(page.rollbackNeeded());
  QCOMPARE(page.primaryAction().text, QString("Roll back to version 1"));
  // An earlier run said the opposite: going back and forth would not end.
  state.runsDisagree = true;
  page.setState(state);
  QCOMPARE(page.primaryAction().text, QString("Plan a further run"));
  QVERIFY(page.sentence().contains("run to run"));
  const auto actions = page.secondaryActions();
  QVERIFY(std::any_of(actions.begin(), actions.end(), [](const PageAction& a) { return a.id == "rollback"; }));
}

/// What is above its limit is not gone on with by the button that is filled.
void MachineWritesTest::afterAFailedVerificationTheNextActIsOffered() {
  VerifyPage page;
  VerifyState state;
  state.phase = VerifyPhase::finished;
  state.peakLimit_um = 5.0;
  AxisResult z;
  z.axis = "Z";
  z.before_um = 40.0;
  z.after_um = 6.8;
  z.removed_percent = 83.0;
  state.results = {z};
  const auto offers = [&page](const char* id) {
    const auto actions = page.secondaryActions();
    return std::any_of(actions.begin(), actions.end(), [id](const PageAction& a) { return a.id == QLatin1String(id); });
  };
  page.setState(state);
  QCOMPARE(page.primaryAction().text, QString("Verify again"));
  QVERIFY(page.verifyAgainNeeded());
  QVERIFY(offers("goOn") && !offers("again"));
  state.correctionProposed = true;
  page.setState(state);
  QCOMPARE(page.primaryAction().text, QString("Apply correction"));
  state.outsideRange = QStringList{"T3"};
  page.setState(state);
  QCOMPARE(page.primaryAction().text, QString("Plan a further run"));
  QVERIFY(offers("again") && offers("goOn"));
  state.leftAsItIs = true;
  page.setState(state);
  QCOMPARE(page.primaryAction().text, QString("Go on"));
}

void MachineWritesTest::removedIsToldForEachDirection() {
  VerifyPage page;
  VerifyState state;
  state.phase = VerifyPhase::finished;
  state.peakLimit_um = 5.0;
  state.removedTarget_percent = 85.0;
  const auto axis = [](const char* name, double before_um, double after_um) {
    AxisResult result;
    result.axis = name;
    result.before_um = before_um;
    result.after_um = after_um;
    result.removed_percent = 100.0 * (1.0 - after_um / before_um);
    return result;
  };
  state.results = {axis("X", 2.0, 1.0), axis("Y", 20.0, 2.0), axis("Z", 50.0, 1.0)};
  page.setState(state);
  const auto removed = [&page] {
    for (const auto* card : page.findChildren<FigureCard*>()) {
      if (card->figure().label.startsWith("Removed")) return card->figure();
    }
    return Figure{};
  };
  QCOMPARE(removed().label, QString("Removed in X, Y, Z"));
  QCOMPARE(removed().value, QString("50 / 90 / 98"));
  QCOMPARE(removed().judgement, Judgement::ok);  // what was small in X needs no removing
  state.results[1].removed_percent = 40.0;
  page.setState(state);
  QCOMPARE(removed().judgement, Judgement::bad);
}

void MachineWritesTest::awayFromTheMachineNothingIsTried() {
  UploadPage page;
  samples::fillUpload(&page, "ready");
  UploadState state = page.state();
  state.offline = "No machine is connected.";
  page.setState(state);
  QVERIFY(!page.primaryAction().enabled);
  QCOMPARE(page.primaryAction().reason, state.offline);
  for (const PageAction& action : page.secondaryActions()) {
    QCOMPARE(action.enabled, action.id == "export");  // a file needs no machine
    if (!action.enabled) QCOMPARE(action.reason, state.offline);
  }
  state.written = true;
  state.asOf = "21 Nov 2026, 13:06";
  page.setState(state);
  QVERIFY(page.sentence().contains(state.asOf));
  QVERIFY(page.primaryAction().enabled);  // going on is free
}

/// Within the limits another table is the engineer's choice.
void MachineWritesTest::aCorrectionWithinTheLimitsIsOffered() {
  VerifyPage page;
  samples::fillVerify(&page, "correction");
  VerifyState state = page.state();
  leave(state, 30.0, 2.5);
  page.setState(state);
  QVERIFY(page.state().correctionProposed && !page.correctionNeeded());
  QCOMPARE(page.primaryAction().text, QString("Go on"));
  QVERIFY(page.sentence().contains("complete"));
  const auto actions = page.secondaryActions();
  QVERIFY(std::any_of(actions.begin(), actions.end(), [](const PageAction& a) { return a.id == "correct"; }));
}

QTEST_MAIN(MachineWritesTest)
#include "machine_writes_test.moc"
