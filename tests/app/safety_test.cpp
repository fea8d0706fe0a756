// What must never go by itself: axes that move without a person's word, a virtual machine that outlives its window.

#include <QApplication>
#include <QCheckBox>
#include <QDir>
#include <QFile>
#include <QProcess>
#include <QPushButton>
#include <QSignalSpy>
#include <QTest>
#include <csignal>

#include "app/desktop/application.h"
#include "core/flow/devices.h"
#include "tests/app/test_home.h"
#include "ui/pages/calibrate_page.h"
#include "ui/pages/machine_page.h"
#include "ui/pages/upload_page.h"
#include "ui/pages/verify_page.h"
#include "ui/shell/lamp.h"
#include "ui/widgets/camera_view.h"

using zerodrift::desktop::Application;
using zerodrift::desktop::DemoOptions;
using zerodrift::desktop::HeldTable;
using zerodrift::desktop::LogKind;
using zerodrift::desktop::Workbench;
using zerodrift::ui::CalibratePage;
using zerodrift::ui::MachinePage;
using zerodrift::ui::UploadPage;
using zerodrift::ui::VerifyPage;

namespace {

const QString programs = QStringLiteral(ZERODRIFT_BIN_DIR);

struct Process {
  qint64 parent = 0;
  char state = 0;
  QByteArray name;
};

/// From /proc/PID/stat: "PID (name) state parent ..."; without a state when there is no such process.
Process process_of(qint64 pid) {
  QFile file(QStringLiteral("/proc/%1/stat").arg(pid));
  if (!file.open(QIODevice::ReadOnly)) return {};
  const QByteArray line = file.readAll();
  const auto close = line.lastIndexOf(')');
  const auto fields = line.mid(close + 2).split(' ');
  return {fields.value(1).toLongLong(), fields.value(0).isEmpty() ? '\0' : fields.value(0).at(0),
          line.mid(line.indexOf('(') + 1, close - line.indexOf('(') - 1)};
}

qint64 child_of(qint64 parent) {
  for (const QString& entry : QDir(QStringLiteral("/proc")).entryList(QDir::Dirs)) {
    const Process process = process_of(entry.toLongLong());
    if (process.parent == parent && process.name.startsWith("zerodrift-mach")) return entry.toLongLong();
  }
  return 0;
}

bool lives(qint64 pid) {
  const char state = process_of(pid).state;
  return state != 0 && state != 'Z' && state != 'X';
}

/// Draws the box with the mouse on the live picture, as a person does; what the page made of it, in pixels of the
/// image.
QRectF drawn_on_the_picture(CalibratePage* page, const QRectF& box, const QSizeF& image) {
  auto* view = page->findChild<zerodrift::ui::CameraView*>();
  auto* button = page->findChild<QPushButton*>(QStringLiteral("drawRegion"));
  button->click();
  if (!button->isChecked()) return {};
  const double scale = std::min(view->width() / image.width(), view->height() / image.height());
  const auto on_screen = [&](const QPointF& at) {
    return ((at - QPointF(image.width(), image.height()) / 2.0) * scale + QRectF(view->rect()).center()).toPoint();
  };
  QSignalSpy drawn(page, &CalibratePage::regionDrawn);
  for (int attempt = 0; attempt < 100 && drawn.isEmpty(); ++attempt) {
    QTest::qWait(200);  // until a picture has arrived nothing can be drawn on it
    QTest::mousePress(view, Qt::LeftButton, {}, on_screen(box.topLeft()));
    QTest::mouseMove(view, on_screen(box.center()));
    QTest::mouseMove(view, on_screen(box.bottomRight()));
    QTest::mouseRelease(view, Qt::LeftButton, {}, on_screen(box.bottomRight()));
  }
  return drawn.isEmpty() || button->isChecked() ? QRectF() : drawn.first().first().toRectF();
}

}  // namespace

class SafetyTest : public QObject, private zerodrift::desktop::TestHome {
  Q_OBJECT

 private Q_SLOTS:
  /// One consent, one sequence of moves: the next camera asks again, and so does measuring again.
  void consentIsForOneSequence() {
    Application application(m_theme);
    application.show();
    DemoOptions demo;
    demo.program = programs + QStringLiteral("/zerodrift-machine");
    application.startDemo(demo, m_folder.filePath(QStringLiteral("consent.zdj")));
    bool started = false;
    application.presenter(QStringLiteral("machine"))->tour([&](bool good) { started = good; });
    QTRY_VERIFY_WITH_TIMEOUT(started, 60000);
    auto& bench = application.bench();
    QTRY_VERIFY(!bench.tasks().running());

    application.openPage(QStringLiteral("calibrate"));
    auto* page = qobject_cast<CalibratePage*>(application.presenter(QStringLiteral("calibrate"))->page());
    auto* clear = page->findChild<QCheckBox*>(QStringLiteral("areaClear"));
    QCOMPARE(page->state().moveOf, 2);
    Q_EMIT page->primaryTriggered();
    QVERIFY(!bench.tasks().running());

    // A region drawn by hand is where the first camera's target is looked for.
    const auto& planned = bench.profile()->cameras.front().target_roi_px;
    const QRectF wanted = QRectF(planned[0], planned[1], planned[2], planned[3]).adjusted(-9, -7, 5, 8);
    const QRectF drawn = drawn_on_the_picture(page, wanted, {640, 480});
    QVERIFY(std::abs(drawn.left() - wanted.left()) < 3.0 && std::abs(drawn.bottom() - wanted.bottom()) < 3.0);

    // Of its two fixed marks one is left out, of the other camera's none.
    QCOMPARE(page->state().marks, 2);
    Q_EMIT page->markRemoved(0);
    QCOMPARE(page->state().marks, 1);

    const QString first = page->state().moveCamera;
    clear->setChecked(true);
    QVERIFY(page->primaryAction().enabled);
    Q_EMIT page->primaryTriggered();
    QVERIFY(bench.tasks().running());
    QVERIFY(!clear->isChecked());
    QTRY_VERIFY_WITH_TIMEOUT(page->state().waiting, 180000);
    QVERIFY(page->state().moveCamera != first);
    QVERIFY(!clear->isChecked());
    QVERIFY(!page->primaryAction().enabled);

    // Until the second word is given the axes stand, also when the button is pressed all the same.
    auto devices = zerodrift::flow::Devices::open(*bench.profile(), false);
    QVERIFY(devices.has_value());
    const auto before = devices->machine->read();
    QVERIFY(before.has_value());
    Q_EMIT page->primaryTriggered();
    QTest::qWait(1500);
    const auto after = devices->machine->read();
    QVERIFY(after.has_value());
    QCOMPARE(after->axes == before->axes, true);
    QVERIFY(page->state().waiting);

    clear->setChecked(true);
    Q_EMIT page->primaryTriggered();
    QTRY_VERIFY_WITH_TIMEOUT(!bench.tasks().running(), 180000);
    QVERIFY2(bench.has("calibration"), qPrintable(page->problem().sentence));
    const QRect used = drawn.toRect();
    const auto cameras = bench.body("calibration").at("cameras");
    QCOMPARE(cameras.at(0).at("roi") == nlohmann::json({used.x(), used.y(), used.width(), used.height()}), true);
    const auto& marks = bench.profile()->cameras.back().reference_rois_px;
    QCOMPARE(marks.size(), std::size_t(2));
    QCOMPARE(cameras.at(0).at("reference_roi") == nlohmann::json(marks.back()), true);
    QVERIFY(!cameras.at(0).contains("takes_off"));
    QCOMPARE(cameras.at(1).at("reference_roi") == nlohmann::json(marks), true);
    QCOMPARE(cameras.at(1).at("takes_off") == "turn", true);
    QCOMPARE(page->state().marks, page->state().camera == 0 ? 1 : 2);
    const auto& other = bench.profile()->cameras[1].target_roi_px;
    QCOMPARE(cameras.at(1).at("roi") == nlohmann::json(other), true);
    QVERIFY(!clear->isChecked());
    Q_EMIT page->secondaryTriggered(QStringLiteral("repeat"));
    QVERIFY(!bench.tasks().running());

    // Who has looked elsewhere does not know whether the area is still clear.
    clear->setChecked(true);
    application.openPage(QStringLiteral("machine"));
    application.openPage(QStringLiteral("calibrate"));
    QVERIFY(!clear->isChecked());
  }

  /// A controller that goes away in the middle: nothing goes on looking as if it were there, and the log says it once.
  void aLostControllerIsTold() {
    Application application(m_theme);
    application.show();
    DemoOptions demo;
    demo.program = programs + QStringLiteral("/zerodrift-machine");
    application.startDemo(demo, m_folder.filePath(QStringLiteral("lost.zdj")));
    auto& bench = application.bench();
    QTRY_VERIFY_WITH_TIMEOUT(bench.connected(), 60000);
    const auto lamp = [&application](const char* name) {
      return application.window().findChild<zerodrift::ui::Lamp*>(QString::fromLatin1(name))->accessibleName();
    };
    QTRY_VERIFY(lamp("lamp-controller").contains(QStringLiteral("connected")));
    QVERIFY(lamp("lamp-camera").contains(QStringLiteral("off")));  // nobody has asked for a picture
    QVERIFY(lamp("lamp-compensation").contains(QStringLiteral("OFF")));
    int red = 0;
    connect(&bench, &Workbench::logged, this,
            [&red](const QDateTime&, LogKind kind, const QString&) { red += kind == LogKind::bad ? 1 : 0; });
    const qint64 machine = child_of(QCoreApplication::applicationPid());
    QVERIFY(machine != 0);
    QCOMPARE(::kill(static_cast<pid_t>(machine), SIGKILL), 0);
    QTRY_VERIFY_WITH_TIMEOUT(bench.lost(), 20000);
    QVERIFY(lamp("lamp-controller").contains(QStringLiteral("lost")));
    QVERIFY(lamp("lamp-compensation").contains(QStringLiteral("unknown")));
    const auto* page = qobject_cast<MachinePage*>(application.presenter(QStringLiteral("machine"))->page());
    QVERIFY(!page->state().connected);
    QTest::qWait(5000);  // it is tried every second
    QVERIFY2(red <= 2, qPrintable(QString::number(red)));
    QVERIFY(lamp("lamp-controller").contains(QStringLiteral("lost")));
  }

  /// The virtual machine ends with its window; its job starts the same one again. With a job of another machine the
  /// connection is given up, and the page says so.
  void aJobFindsItsVirtualMachineAgain() {
    const QString path = m_folder.filePath(QStringLiteral("again.zdj"));
    {
      Application application(m_theme);
      DemoOptions demo;
      demo.program = programs + QStringLiteral("/zerodrift-machine");
      demo.seed = 4;
      application.startDemo(demo, path);
      bool tested = false;
      application.presenter(QStringLiteral("machine"))->tour([&](bool good) { tested = good; });
      QTRY_VERIFY_WITH_TIMEOUT(tested, 60000);
      QTRY_VERIFY(!application.bench().tasks().running());
    }
    Application application(m_theme);
    application.openJob(path);
    auto* page = application.presenter(QStringLiteral("machine"))->page();
    QVERIFY(qobject_cast<MachinePage*>(page)->startsVirtual());
    Q_EMIT page->primaryTriggered();
    auto& bench = application.bench();
    QTRY_VERIFY_WITH_TIMEOUT(bench.connected(), 60000);
    QCOMPARE(bench.look()->identity.serial, 850004U);

    QVERIFY(
        bench.openJob(QStringLiteral(ZERODRIFT_SOURCE_DIR "/resources/samples/sample.zdj").toStdString()).has_value());
    QVERIFY(!bench.connected());
    QTRY_VERIFY(page->problem().sentence.contains(QStringLiteral("850004")));
  }

  /// A controller that was started anew holds no table. Nothing is proved with it, and what is written into it is the
  /// table this job wrote last, with its corrections, not the model's own.
  void aMachineThatLostItsTableGetsItBack() {
    const QString path = m_folder.filePath(QStringLiteral("sample.zdj"));
    QVERIFY(QFile::copy(QStringLiteral(ZERODRIFT_SOURCE_DIR "/resources/samples/sample.zdj"), path));
    QVERIFY(QFile::setPermissions(path, QFile::ReadOwner | QFile::WriteOwner));
    Application application(m_theme);
    application.openJob(path);
    auto& bench = application.bench();
    const auto words = [&bench] {
      return bench.body("upload").at("record").value("new_words", std::vector<std::uint16_t>{});
    };
    const auto last = words();
    QVERIFY(last.size() > 10);
    Q_EMIT application.presenter(QStringLiteral("machine"))->page()->secondaryTriggered(QStringLiteral("virtual"));
    QTRY_COMPARE_WITH_TIMEOUT(bench.heldTable(), HeldTable::none, 60000);

    auto* verify = qobject_cast<VerifyPage*>(application.presenter(QStringLiteral("verify"))->page());
    QCOMPARE(verify->state().phase, zerodrift::ui::VerifyPhase::finished);
    const auto in_rail = [&](const QString& id) { return application.presenter(id)->standing().words; };
    QVERIFY2(verify->sentence().contains(QStringLiteral("of before")), qPrintable(verify->sentence()));
    QVERIFY2(in_rail(QStringLiteral("upload")).contains(QStringLiteral("none")), qPrintable(in_rail("upload")));
    QVERIFY2(in_rail(QStringLiteral("verify")).contains(QStringLiteral("none")), qPrintable(in_rail("verify")));
    auto* machine = qobject_cast<MachinePage*>(application.presenter(QStringLiteral("machine"))->page());
    QTRY_VERIFY(machine->tableLost());
    QVERIFY2(machine->primary().text.contains(QStringLiteral("back")), qPrintable(machine->primary().text));
    Q_EMIT verify->secondaryTriggered(QStringLiteral("again"));
    QVERIFY(!verify->primary().enabled);
    QVERIFY2(verify->sentence().contains(QStringLiteral("holds no table")), qPrintable(verify->sentence()));
    bool good = true;
    bool ended = false;
    application.presenter(QStringLiteral("verify"))->tour([&](bool is_good) { good = is_good, ended = true; });
    QTRY_VERIFY_WITH_TIMEOUT(ended, 60000);
    QVERIFY(!good);
    QVERIFY2(verify->problem().sentence.contains(QStringLiteral("no table")), qPrintable(verify->problem().sentence));

    QTRY_VERIFY(!bench.tasks().running());
    application.openPage(QStringLiteral("upload"));
    auto* upload = application.presenter(QStringLiteral("upload"));
    QTRY_VERIFY_WITH_TIMEOUT(upload->page()->problem().sentence.contains(QStringLiteral("holds no table")), 60000);
    ended = false;
    upload->tour([&](bool is_good) { good = is_good, ended = true; });
    QTRY_VERIFY_WITH_TIMEOUT(ended, 120000);
    QVERIFY2(good, qPrintable(upload->page()->problem().sentence));
    QVERIFY(words() == last);
    QTRY_COMPARE_WITH_TIMEOUT(bench.heldTable(), HeldTable::own, 10000);
    QVERIFY(verify->primary().enabled);
    QVERIFY(in_rail(QStringLiteral("upload")).isEmpty());
    // Nobody compensates beside it.
    const auto* compensator = application.presenter(QStringLiteral("compensator"))->page();
    QVERIFY2(compensator->sentence().contains(QStringLiteral("table of its own")), qPrintable(compensator->sentence()));
    QVERIFY(!compensator->primaryAction().enabled);
    QVERIFY(!machine->tableLost());

    // Gone back to before the first table, on purpose: it can be put back the same way.
    auto* upload_page = qobject_cast<UploadPage*>(upload->page());
    const auto& history = upload_page->state().history;
    const auto none = std::find_if(history.begin(), history.end(), [](const auto& one) { return one.version == 0; });
    QVERIFY(none != history.end());
    Q_EMIT upload_page->rollbackRequested(none->id);
    QTRY_VERIFY_WITH_TIMEOUT(words().size() <= 2 && !bench.tasks().running(), 60000);
    QVERIFY(!upload_page->state().written);
    QVERIFY2(upload_page->sentence().contains(QStringLiteral("no compensation")), qPrintable(upload_page->sentence()));
    ended = false;
    upload->tour([&](bool is_good) { good = is_good, ended = true; });
    QTRY_VERIFY_WITH_TIMEOUT(ended, 120000);
    QVERIFY2(good, qPrintable(upload->page()->problem().sentence));
    QVERIFY(words() == last);
    QVERIFY(upload_page->state().written);
  }

  void virtualMachineEndsWithTheWindow_data() {
    QTest::addColumn<bool>("hard");
    QTest::newRow("SIGTERM") << false;
    QTest::newRow("SIGKILL") << true;
  }

  void virtualMachineEndsWithTheWindow() {
    QFETCH(const bool, hard);
    QProcess window;
    auto environment = QProcessEnvironment::systemEnvironment();
    environment.insert(QStringLiteral("HOME"), m_folder.path());
    environment.insert(QStringLiteral("XDG_CONFIG_HOME"), m_folder.path());
    environment.insert(QStringLiteral("QT_QPA_PLATFORM"), QStringLiteral("offscreen"));
    window.setProcessEnvironment(environment);
    window.start(programs + QStringLiteral("/zerodrift"), {QStringLiteral("--demo")});
    QVERIFY(window.waitForStarted());
    qint64 machine = 0;
    QTRY_VERIFY_WITH_TIMEOUT((machine = child_of(window.processId())) != 0, 30000);
    if (hard) {
      window.kill();
    } else {
      window.terminate();
    }
    QVERIFY(window.waitForFinished(20000));
    if (!hard) QCOMPARE(window.exitCode(), 128 + 15);
    QTRY_VERIFY_WITH_TIMEOUT(!lives(machine), 10000);
  }
};

QTEST_MAIN(SafetyTest)
#include "safety_test.moc"
