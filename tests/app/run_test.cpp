// Runs in the window on a virtual machine: a controller that goes away, a run that is broken off and gone on with,
// work that is ended by a person's word.

#include <QApplication>
#include <QDir>
#include <QFile>
#include <QMessageBox>
#include <QPushButton>
#include <QTest>
#include <QTimer>
#include <array>
#include <cmath>
#include <csignal>

#include "app/desktop/application.h"
#include "app/desktop/steps/machine_presenter.h"
#include "core/acquisition/job_sink.h"
#include "tests/app/test_home.h"
#include "ui/pages/verify_page.h"
#include "ui/pages/warmup_page.h"
#include "ui/shell/lamp.h"
#include "ui/shell/rail.h"

using zerodrift::desktop::Application;
using zerodrift::desktop::MachinePresenter;
using zerodrift::ui::RunPhase;
using zerodrift::ui::VerifyPage;
using zerodrift::ui::VerifyPhase;
using zerodrift::ui::WarmupPage;

namespace {

/// The virtual machine that this process has started; 0: none.
qint64 virtual_machine() {
  qint64 found = 0;
  for (const QString& entry : QDir(QStringLiteral("/proc")).entryList(QDir::Dirs)) {
    QFile file(QStringLiteral("/proc/%1/stat").arg(entry));
    if (!file.open(QIODevice::ReadOnly)) continue;
    const QByteArray line = file.readAll();
    const auto close = line.lastIndexOf(')');
    const auto fields = line.mid(close + 2).split(' ');
    if (fields.value(0) == "Z" || fields.value(1).toLongLong() != QCoreApplication::applicationPid()) continue;
    if (line.contains("zerodrift-mach")) found = entry.toLongLong();
  }
  return found;
}

/// Presses this button of the question that comes next, and keeps what it asked.
class Answer : public QObject {
 public:
  explicit Answer(QString deed) : m_deed(std::move(deed)) {
    m_timer.setInterval(50);
    connect(&m_timer, &QTimer::timeout, this, [this] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (box == nullptr) return;
      m_details = box->detailedText();
      if (const QString folder = qEnvironmentVariable("ZERODRIFT_PICTURES"); !folder.isEmpty()) {
        box->grab().save(folder + QStringLiteral("/question-") + box->text().section(QLatin1Char(' '), 0, 1) +
                         QStringLiteral(".png"));
      }
      m_asked = box->text() + QLatin1Char('\n') + box->informativeText();
      for (auto* button : box->buttons()) {
        if (button->text() != m_deed) continue;
        m_timer.stop();
        button->click();
        return;
      }
      m_timer.stop();
      box->reject();
    });
    m_timer.start();
  }
  const QString& asked() const { return m_asked; }
  const QString& details() const { return m_details; }

 private:
  QString m_deed;
  QString m_asked;
  QString m_details;
  QTimer m_timer;
};

}  // namespace

class RunTest : public QObject, private zerodrift::desktop::TestHome {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { qputenv("HOME", m_folder.path().toUtf8()); }

  /// The run waits and says so; nothing that is not known goes on counting, and Finish keeps what there is.
  void aLostControllerStopsTheRunsClocks() {
    Application application(m_theme);
    QVERIFY(begun(application));
    auto* page = warmupPage(application);
    const auto kept = application.bench().body("warmup").value("series", 0LL);
    QTRY_VERIFY_WITH_TIMEOUT(page->state().samples > 8, 60000);
    QCOMPARE(::kill(static_cast<pid_t>(virtual_machine()), SIGKILL), 0);
    QTRY_VERIFY_WITH_TIMEOUT(!page->state().silentSince.isEmpty(), 30000);
    QVERIFY2(page->sentence().contains(page->state().silentSince), qPrintable(page->sentence()));
    QVERIFY(!page->primaryAction().enabled);
    const auto* rail = application.window().rail()->step(QStringLiteral("warmup"));
    QCOMPARE(rail->words(), QStringLiteral("Controller lost"));
    const auto* lamp = application.window().findChild<zerodrift::ui::Lamp*>(QStringLiteral("lamp-recording"));
    QTRY_VERIFY2(lamp->accessibleName().contains(QStringLiteral("waits")), qPrintable(lamp->accessibleName()));
    const auto before = page->state();
    QTest::qWait(4000);
    QVERIFY(!page->state().silentSince.isEmpty());
    QCOMPARE(page->state().timeLeft_s, before.timeLeft_s);
    QCOMPARE(page->state().samplesLost, before.samplesLost);

    const Answer finish(QStringLiteral("Finish"));
    Q_EMIT page->secondaryTriggered(QStringLiteral("finish"));
    QTRY_VERIFY_WITH_TIMEOUT(!application.bench().tasks().running(), 30000);
    QVERIFY2(finish.asked().contains(QStringLiteral("does not answer")), qPrintable(finish.asked()));
    QCOMPARE(page->state().phase, RunPhase::finished);
    QVERIFY(application.bench().body("warmup").value("series", 0LL) > kept);
    QVERIFY(page->state().samples > 8);
  }

  /// Disconnect asks while a run is on; what was recorded is shown, and drawn again when the run is gone on with on the
  /// machine that still runs.
  void aRunThatWasLeftIsDrawnFromItsBeginningWhenResumed() {
    Application application(m_theme);
    QVERIFY(begun(application));
    auto& bench = application.bench();
    auto* page = warmupPage(application);
    auto* machine = application.presenter(QStringLiteral("machine"))->page();
    QTRY_VERIFY_WITH_TIMEOUT(page->state().samples > 12, 60000);
    const qint64 process = virtual_machine();
    {
      const Answer cancel(QStringLiteral("Cancel"));
      Q_EMIT machine->secondaryTriggered(QStringLiteral("disconnect"));
      QVERIFY2(cancel.asked().contains(QStringLiteral("can be resumed")), qPrintable(cancel.asked()));
    }
    QVERIFY(bench.tasks().running());
    QVERIFY(bench.connected());
    const Answer leave(QStringLiteral("End it and disconnect"));
    Q_EMIT machine->secondaryTriggered(QStringLiteral("disconnect"));
    QTRY_VERIFY_WITH_TIMEOUT(!bench.connected() && !bench.tasks().running(), 60000);
    QCOMPARE(page->state().phase, RunPhase::interrupted);
    const auto stored = page->state().samples;
    QVERIFY(stored > 12);
    QVERIFY(!page->primaryAction().enabled);

    Q_EMIT machine->secondaryTriggered(QStringLiteral("virtual"));
    QTRY_VERIFY_WITH_TIMEOUT(bench.connected(), 60000);
    QCOMPARE(virtual_machine(), process);
    QVERIFY(page->primaryAction().enabled);
    const Answer start(QStringLiteral("Start"));
    Q_EMIT page->primaryTriggered();
    QVERIFY(bench.tasks().running());
    const auto drawn = [page] { return page->run()->sampleCount(QStringLiteral("T1_C")); };
    QVERIFY2(drawn() >= stored, qPrintable(QString::number(drawn())));
    QTRY_VERIFY_WITH_TIMEOUT(page->state().phase == RunPhase::running && page->state().samples > stored, 60000);
    QVERIFY(drawn() > stored);
    const Answer abort(QStringLiteral("Abort"));
    Q_EMIT page->secondaryTriggered(QStringLiteral("abort"));
    QTRY_VERIFY_WITH_TIMEOUT(!bench.tasks().running(), 60000);
    QCOMPARE(page->state().phase, RunPhase::finished);  // the run of before
  }

  /// The switch's lamp says at once whether a run may be started.
  void startIsThereAgainWhenTheCompensationIsSwitchedOff() {
    Application application(m_theme);
    application.openSample();
    application.openPage(QStringLiteral("warmup"));
    auto* page = warmupPage(application);
    Q_EMIT page->secondaryTriggered(QStringLiteral("again"));
    QVERIFY(!page->primaryAction().enabled);
    Q_EMIT application.presenter(QStringLiteral("machine"))->page()->secondaryTriggered(QStringLiteral("virtual"));
    QTRY_VERIFY_WITH_TIMEOUT(application.bench().connected(), 60000);
    QVERIFY(page->primaryAction().enabled);
    application.bench().tellController(true, true);
    QVERIFY(!page->primaryAction().enabled);
    application.bench().tellController(true, false);
    QVERIFY(page->primaryAction().enabled);
  }

  /// The virtual machine's time passes with the work on it, not with its reader's.
  void theVirtualMachinesClockRestsWithTheWork() {
    Application application(m_theme);
    QVERIFY(begun(application));
    auto& bench = application.bench();
    auto* page = warmupPage(application);
    QTRY_VERIFY_WITH_TIMEOUT(page->state().elapsed_s > 300.0, 60000);
    const Answer abort(QStringLiteral("Abort"));
    Q_EMIT page->secondaryTriggered(QStringLiteral("abort"));
    QTRY_VERIFY_WITH_TIMEOUT(!bench.tasks().running(), 60000);
    int looks = 0;
    connect(&bench, &zerodrift::desktop::Workbench::machineSeen, this, [&looks] { ++looks; });
    QTRY_VERIFY_WITH_TIMEOUT(looks >= 2, 20000);
    const double before_s = bench.look()->sample.machine_time_s;
    QTRY_VERIFY_WITH_TIMEOUT(looks >= 5, 20000);
    const double passed_s = bench.look()->sample.machine_time_s - before_s;
    QVERIFY2(passed_s > 1.0 && passed_s < 15.0, qPrintable(QString::number(passed_s)));
    QVERIFY2(std::abs(bench.look()->clock_difference_s) < 2.0,
             qPrintable(QString::number(bench.look()->clock_difference_s)));
  }

  /// A verification that the program did not live to end is offered like a warm-up, until a table is written.
  void aCrashInALaterRunOffersToResume() {
    using namespace zerodrift;
    Application application(m_theme);
    application.openSample();
    const QString path = QString::fromStdString(application.bench().job()->path().string());
    auto& job = *application.bench().job();
    acquisition::JobSink sink(job);
    acquisition::RunStart start;
    start.name = "verification";
    start.channels = {"spindle_rpm", "T1_C", "dX_um", "dZ_um"};
    start.plan = acquisition::preset_plans().front();
    QVERIFY(sink.begin(start).has_value());
    for (int i = 0; i < 20; ++i) {
      QVERIFY(sink.append(60.0 * i, std::array{3000.0, 20.0 + i, 0.1 * i, -0.2 * i}).has_value());
    }
    QVERIFY(sink.flush().has_value());
    QVERIFY(application.bench().closeJob().has_value());
    application.openJob(path);
    const auto* first = application.presenters().front()->page();
    QTRY_VERIFY2(first->problem().sentence.contains(QStringLiteral("verification run")),
                 qPrintable(first->problem().sentence));
    application.openPage(QStringLiteral("verify"));
    auto* page = qobject_cast<VerifyPage*>(application.presenter(QStringLiteral("verify"))->page());
    QCOMPARE(page->state().phase, VerifyPhase::interrupted);
    QCOMPARE(page->primary().text, QStringLiteral("Resume"));
    QVERIFY(!page->primaryAction().enabled);  // without its machine
    QCOMPARE(page->run()->sampleCount(QStringLiteral("T1_C")), 20);
    Q_EMIT page->secondaryTriggered(QStringLiteral("drop"));
    QCOMPARE(page->state().phase, VerifyPhase::finished);
  }

  /// Before anything is written: what, into which machine, each fact on its line; of many warnings one, the rest
  /// folded.
  void theWriteQuestionSaysWhatIsWritten() {
    Application application(m_theme);
    application.show();
    application.openSample();
    auto& bench = application.bench();
    Q_EMIT application.presenter(QStringLiteral("machine"))->page()->secondaryTriggered(QStringLiteral("virtual"));
    QTRY_VERIFY_WITH_TIMEOUT(bench.connected(), 60000);
    application.openPage(QStringLiteral("upload"));
    auto* page = application.presenter(QStringLiteral("upload"))->page();
    QTRY_VERIFY_WITH_TIMEOUT(!bench.tasks().running() && page->primaryAction().enabled, 60000);
    const Answer cancel(QStringLiteral("Cancel"));
    Q_EMIT page->primaryTriggered();
    QTRY_VERIFY_WITH_TIMEOUT(!cancel.asked().isEmpty(), 60000);
    const QStringList lines = cancel.asked().split(QLatin1Char('\n'));
    QVERIFY2(lines[0].contains(QStringLiteral("serial 8500")), qPrintable(cancel.asked()));
    QVERIFY2(lines.size() >= 6 && lines.size() <= 8, qPrintable(cancel.asked()));
    QVERIFY2(lines[1].contains(QStringLiteral("X, Y")), qPrintable(lines[1]));
    QVERIFY2(lines[2].contains(QStringLiteral("µm")), qPrintable(lines[2]));
    QVERIFY2(lines[3].startsWith(QStringLiteral("Version")), qPrintable(lines[3]));
    QVERIFY2(lines[4].startsWith(QStringLiteral("Sign")), qPrintable(lines[4]));
    QCOMPARE(lines.size() == 8 && lines[7].contains(QStringLiteral("details")), !cancel.details().isEmpty());
    QTRY_VERIFY(!bench.tasks().running());
    QCOMPARE(bench.heldTable(), zerodrift::desktop::HeldTable::none);
  }

 private:
  static WarmupPage* warmupPage(Application& application) {
    return qobject_cast<WarmupPage*>(application.presenter(QStringLiteral("warmup"))->page());
  }

  /// The sample's virtual machine, and a further warm-up run on it.
  static bool begun(Application& application) {
    application.show();
    application.openSample();
    Q_EMIT application.presenter(QStringLiteral("machine"))->page()->secondaryTriggered(QStringLiteral("virtual"));
    if (!QTest::qWaitFor([&] { return application.bench().connected(); }, 60000)) return false;
    application.openPage(QStringLiteral("warmup"));
    auto* page = warmupPage(application);
    Q_EMIT page->secondaryTriggered(QStringLiteral("again"));
    const Answer start(QStringLiteral("Start"));
    Q_EMIT page->primaryTriggered();
    return application.bench().tasks().running();
  }
};

QTEST_MAIN(RunTest)
#include "run_test.moc"
