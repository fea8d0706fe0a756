// The machine page on the rig of zerodrift-machine: each device with its lamp, and a control without a link.

#include <QApplication>
#include <QFile>
#include <QLabel>
#include <QMessageBox>
#include <QProcess>
#include <QPushButton>
#include <QTest>
#include <QTimer>
#include <cmath>
#include <nlohmann/json.hpp>

#include "app/desktop/application.h"
#include "app/desktop/operator_dialog.h"
#include "core/controller/operator.h"
#include "tests/app/test_home.h"
#include "tests/support/amount.h"
#include "ui/pages/machine_page.h"
#include "ui/shell/lamp.h"
#include "ui/shell/main_window.h"
#include "ui/widgets/toggle_segment.h"

using zerodrift::controller::OperatorAct;
using zerodrift::desktop::Application;
using zerodrift::ui::Judgement;
using zerodrift::ui::MachinePage;

class RigPageTest : public QObject, private zerodrift::desktop::TestHome {
  Q_OBJECT

 private:
  /// zerodrift-machine with this option; ended with the object.
  struct Rig {
    Rig(const QString& option, const QString& profile) {
      process.setProcessChannelMode(QProcess::ForwardedErrorChannel);
      process.start(QStringLiteral(ZERODRIFT_BIN_DIR) + QStringLiteral("/zerodrift-machine"),
                    {option, QStringLiteral("--profile"), profile, QStringLiteral("--port"), QStringLiteral("0"),
                     QStringLiteral("--camera-port"), QStringLiteral("0"), QStringLiteral("--speedup"),
                     QStringLiteral("60"), QStringLiteral("--seed"), QStringLiteral("4")});
    }
    ~Rig() {
      process.terminate();
      if (!process.waitForFinished(10000)) process.kill();
      process.waitForFinished(5000);
    }
    bool ready() {
      QByteArray said;
      while (process.waitForReadyRead(30000)) {
        said += process.readAllStandardOutput();
        if (said.contains("ready ")) return true;
      }
      return false;
    }
    QProcess process;
  };

  QString file(const char* name) const { return m_folder.filePath(QString::fromLatin1(name)); }

  static MachinePage* pageOf(Application& application) {
    return qobject_cast<MachinePage*>(application.presenters().front()->page());
  }

  bool begin(Application& application, const QString& profile) {
    application.window().resize(1280, 720);
    application.show();
    auto& bench = application.bench();
    const QString job = m_folder.filePath(QStringLiteral("%1.zdj").arg(++m_jobs));
    if (!bench.createJob(job.toStdString()) || !bench.loadProfile(profile.toStdString())) return false;
    application.openPage(QStringLiteral("machine"));
    bench.connectMachine();
    return true;
  }

  /// Into the folder that ZERODRIFT_PICTURES names, in both languages and sizes.
  static void draw(Application& application, const QString& name) {
    const QString folder = qEnvironmentVariable("ZERODRIFT_PICTURES");
    if (folder.isEmpty()) return;
    for (const char* language : {"zh_CN", "en"}) {
      application.setLanguage(QString::fromLatin1(language));
      for (const QSize size : {QSize(1440, 900), QSize(1280, 720)}) {
        application.window().resize(size);
        QTest::qWait(1500);  // a look, and the layout after it
        application.window().grab().save(
            QStringLiteral("%1/%2-%3-%4.png").arg(folder, name, QString::fromLatin1(language)).arg(size.width()));
      }
    }
  }

  /// Presses this button of the message box that comes next.
  static void agree(const QString& deed) {
    auto* timer = new QTimer(qApp);
    timer->setInterval(50);
    connect(timer, &QTimer::timeout, timer, [timer, deed] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (box == nullptr) return;
      timer->deleteLater();
      for (auto* button : box->buttons()) {
        if (button->text() == deed) return button->click();
      }
      box->reject();
    });
    timer->start();
  }

  int m_jobs = 0;

 private Q_SLOTS:
  void initTestCase() { qputenv("HOME", m_folder.path().toUtf8()); }

  /// One device that is not there is named with what is wrong; the others answer, and their sensors live.
  void eachDeviceHasALamp() {
    const QString profile = file("rig.json");
    Rig rig(QStringLiteral("--rig"), profile);
    QVERIFY(rig.ready());
    nlohmann::json document;
    {
      QFile in(profile);
      QVERIFY(in.open(QIODevice::ReadOnly));
      document = nlohmann::json::parse(in.readAll().toStdString());
      for (auto& device : document.at("devices")) {
        if (device.at("id") == "amplifier") device["port"] = 1;
      }
      QFile out(profile);
      QVERIFY(out.open(QIODevice::WriteOnly));
      out.write(QByteArray::fromStdString(document.dump()));
    }
    Application application(m_theme);
    QVERIFY(begin(application, profile));
    const auto* page = pageOf(application);
    const auto& state = page->state();
    QTRY_COMPARE_WITH_TIMEOUT(state.devices.size(), 4, 30000);
    QVERIFY(!state.manual);
    QVERIFY(!state.registers.isEmpty());
    const auto device = [&state](const char* id) {
      for (const auto& one : state.devices) {
        if (one.id == QLatin1String(id)) return one;
      }
      return zerodrift::ui::DeviceHealth();
    };
    for (const char* id : {"module-1", "module-2", "agent"}) {
      QTRY_VERIFY2_WITH_TIMEOUT(device(id).judgement == Judgement::ok, id, 20000);
      QVERIFY2(device(id).roundTrip_ms > 0.0 && (device(id).roundTrip_ms < 1000.0 || !zerodrift::judges_durations()),
               id);
      QVERIFY2(device(id).age_s >= 0.0 && device(id).age_s < 10.0, id);
      QVERIFY2(device(id).rounds > 0, id);
    }
    QTRY_VERIFY_WITH_TIMEOUT(device("amplifier").missed > 0, 20000);
    QCOMPARE(device("amplifier").judgement, Judgement::bad);
    QVERIFY(std::isnan(device("amplifier").age_s));
    QVERIFY2(device("amplifier").state.contains(QStringLiteral("port 1")), qPrintable(device("amplifier").state));
    QVERIFY(!device("amplifier").remedy.isEmpty());
    QTRY_VERIFY_WITH_TIMEOUT(std::all_of(state.sensors.begin(), state.sensors.begin() + 16,
                                         [](const auto& sensor) { return !std::isnan(sensor.value_C); }),
                             20000);
    draw(application, QStringLiteral("rig"));
    rig.process.terminate();
    QVERIFY(application.bench().disconnectMachine().has_value());
    QTRY_VERIFY_WITH_TIMEOUT(state.devices.isEmpty(), 5000);
  }

  /// Nothing is asked of a control without a link but its person; the lamp of the switch works all the same.
  void manualControlIsSwitchedByThePerson() {
    const QString profile = file("manual.json");
    Rig rig(QStringLiteral("--manual"), profile);
    QVERIFY(rig.ready());
    Application application(m_theme);
    QVERIFY(begin(application, profile));
    auto& bench = application.bench();
    const auto& questions = bench.questions();
    const auto* page = pageOf(application);
    const auto asked = [&questions](OperatorAct act) { return questions->open() && questions->open()->act == act; };
    QTRY_VERIFY_WITH_TIMEOUT(asked(OperatorAct::state), 20000);
    questions->answer({false, {}});
    QTRY_VERIFY_WITH_TIMEOUT(page->state().connected && page->state().devices.size() == 4, 20000);
    QVERIFY(page->state().manual);
    QCOMPARE(page->state().address, QStringLiteral("Manual control"));
    QVERIFY(page->state().registers.isEmpty());
    QVERIFY(!page->findChild<zerodrift::ui::ToggleSegment*>(QStringLiteral("machineView"))->isVisible());
    const auto lamp = [&application](const char* name) {
      return application.window().findChild<zerodrift::ui::Lamp*>(QLatin1String(name))->accessibleName();
    };
    QVERIFY2(lamp("lamp-controller").contains(QStringLiteral("Manual control")), qPrintable(lamp("lamp-controller")));
    draw(application, QStringLiteral("manual"));

    for (const bool on : {true, false}) {
      agree(on ? QStringLiteral("Switch ON") : QStringLiteral("Switch OFF"));
      Q_EMIT application.window().lampClicked(zerodrift::ui::LampId::compensation);
      QTRY_VERIFY_WITH_TIMEOUT(asked(OperatorAct::switch_compensation), 20000);
      QCOMPARE(questions->open()->compensation_on, on);
      QCOMPARE(bench.compensationOn(), !on);  // not before the person has done it
      questions->answer({});
      QTRY_VERIFY_WITH_TIMEOUT(!bench.tasks().running() && bench.compensationOn() == on, 30000);
      const QString word = on ? QStringLiteral("ON") : QStringLiteral("OFF");
      QTRY_VERIFY_WITH_TIMEOUT(lamp("lamp-compensation").contains(word), 10000);
      QTRY_COMPARE_WITH_TIMEOUT(page->state().compensationOn, on, 10000);
    }
    // What the person has said is not asked for again.
    QTest::qWait(2500);
    QVERIFY(!questions->open());

    // Its number is a virtual machine's; there is no such one to be started for a control without a link.
    QVERIFY(zerodrift::desktop::keeps(
        bench, zerodrift::commissioning::NewArtefact::of(
                   "machine", {{"identity", {{"name", "M"}, {"serial", bench.profile()->serial}}},
                               {"profile", bench.profileDocument()}})));
    QVERIFY(bench.disconnectMachine().has_value());
    QVERIFY(!page->startsVirtual());
    QVERIFY(page->sentence().contains(QStringLiteral("no link")));
  }
};

QTEST_MAIN(RigPageTest)
#include "rig_page_test.moc"
