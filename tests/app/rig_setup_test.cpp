// A rig is set up in the window without touching a file: two modules on one serial line, a camera and a control without
// a link, as zerodrift-machine serves them.

#include "ui/pages/rig_setup.h"

#include <QApplication>
#include <QFileDialog>
#include <QLabel>
#include <QLineEdit>
#include <QMenu>
#include <QProcess>
#include <QPushButton>
#include <QRegularExpression>
#include <QTableWidget>
#include <QTest>
#include <QTimer>
#include <nlohmann/json.hpp>

#include "app/desktop/application.h"
#include "core/base/json.h"
#include "core/controller/operator.h"
#include "core/controller/profile.h"
#include "tests/app/test_home.h"
#include "ui/pages/machine_page.h"
#include "ui/shell/main_window.h"

using zerodrift::desktop::Application;
using zerodrift::ui::Judgement;
using zerodrift::ui::MachinePage;
using zerodrift::ui::RigSetup;
using zerodrift::ui::SignalTable;

class RigSetupTest : public QObject, private zerodrift::desktop::TestHome {
  Q_OBJECT

 private:
  QString file(const char* name) const { return m_folder.filePath(QString::fromLatin1(name)); }

  /// What follows this word in the ready line.
  QString served(const char* word) const {
    const QRegularExpression at(QStringLiteral("%1=(\\S+)").arg(QString::fromLatin1(word)));
    return at.match(m_ready).captured(1);
  }

  /// Enters this path into the file dialog that comes next.
  static void chooseFile(const QString& path) {
    auto* timer = new QTimer(qApp);
    timer->setInterval(50);
    connect(timer, &QTimer::timeout, timer, [timer, path] {
      auto* dialog = qobject_cast<QFileDialog*>(QApplication::activeModalWidget());
      if (dialog == nullptr) return;
      timer->deleteLater();
      dialog->findChild<QLineEdit*>(QStringLiteral("fileNameEdit"))->setText(path);
      QMetaObject::invokeMethod(dialog, "accept");
    });
    timer->start();
  }

  static MachinePage* pageOf(Application& application) {
    return qobject_cast<MachinePage*>(application.presenters().front()->page());
  }

  static void press(QWidget& in, const QString& name) {
    const auto shown = [&]() -> QPushButton* {
      for (auto* button : in.findChildren<QPushButton*>(name)) {
        if (button->isVisible() && button->isEnabled()) return button;
      }
      return nullptr;
    };
    QTRY_VERIFY2(shown() != nullptr, qPrintable(name));
    QTest::mouseClick(shown(), Qt::LeftButton);
  }

  static void add(RigSetup& setup, const QString& kind) {
    auto* menu = setup.findChild<QPushButton*>(QStringLiteral("addPart"))->menu();
    auto* action = menu->findChild<QAction*>(QStringLiteral("add:") + kind);
    QVERIFY2(action != nullptr, qPrintable(kind));
    action->trigger();
  }

  /// Types into a field of the form as a person does.
  static void type(RigSetup& setup, const QString& key, const QString& text) {
    auto* edit = setup.findChild<QLineEdit*>(QStringLiteral("field:") + key);
    QVERIFY2(edit != nullptr, qPrintable(key));
    edit->setFocus();
    edit->selectAll();
    if (text.isEmpty()) QTest::keyClick(edit, Qt::Key_Delete);
    QTest::keyClicks(edit, text);
    QTest::keyClick(edit, Qt::Key_Return);
  }

  static QString problemAt(RigSetup& setup, const QString& key) {
    const auto* label = setup.findChild<QLabel*>(QStringLiteral("problem:") + key);
    return label == nullptr ? QString() : label->text();
  }

  static QString resultOf(RigSetup& setup) { return setup.findChild<QLabel*>(QStringLiteral("rigResult"))->text(); }

  static int rowOf(const RigSetup& setup, const QString& name) {
    const auto& lines = setup.state().lines;
    for (int i = 0; i < lines.size(); ++i) {
      if (lines[i].name == name) return i;
    }
    return -1;
  }

  static void enter(RigSetup& setup, const QString& quantity, int column, const QString& text) {
    auto* table = setup.findChild<QTableWidget*>(QStringLiteral("signals"));
    const int row = rowOf(setup, quantity);
    QVERIFY2(row >= 0, qPrintable(quantity));
    table->item(row, column)->setText(text);
    QTest::qWait(10);  // the table's editor closes first
  }

  /// Into the folder that ZERODRIFT_PICTURES names: both languages, sizes and themes.
  void draw(Application& application, const QString& name) {
    const QString folder = qEnvironmentVariable("ZERODRIFT_PICTURES");
    if (folder.isEmpty()) return;
    for (const char* language : {"zh_CN", "en"}) {
      application.setLanguage(QString::fromLatin1(language));
      for (const auto mode : {zerodrift::ui::ThemeMode::dark, zerodrift::ui::ThemeMode::light}) {
        m_theme.setMode(mode);
        for (const QSize size : {QSize(1440, 900), QSize(1280, 720)}) {
          application.window().resize(size);
          QTest::qWait(400);
          application.window().grab().save(
              QStringLiteral("%1/%2-%3-%4-%5.png")
                  .arg(folder, name, QString::fromLatin1(language), m_theme.isDark() ? "dark" : "light")
                  .arg(size.width()));
        }
      }
    }
  }

  QProcess m_machine;
  QString m_ready;

 private Q_SLOTS:
  void initTestCase() {
    qputenv("HOME", m_folder.path().toUtf8());
    m_machine.setProcessChannelMode(QProcess::ForwardedErrorChannel);
    m_machine.start(QStringLiteral(ZERODRIFT_BIN_DIR) + QStringLiteral("/zerodrift-machine"),
                    {QStringLiteral("--manual"), QStringLiteral("--camera-port"), QStringLiteral("0"),
                     QStringLiteral("--speedup"), QStringLiteral("60"), QStringLiteral("--seed"), QStringLiteral("4")});
    while (!m_ready.contains(QStringLiteral("ready ")) && m_machine.waitForReadyRead(30000)) {
      m_ready += QString::fromUtf8(m_machine.readAllStandardOutput());
    }
    QVERIFY(m_ready.contains(QStringLiteral("rtu=")));
  }

  void cleanupTestCase() {
    m_machine.terminate();
    if (!m_machine.waitForFinished(10000)) m_machine.kill();
    m_machine.waitForFinished(5000);
  }

  void aRigIsSetUpWithoutTouchingAFile() {
    Application application(m_theme);
    auto& window = application.window();
    window.resize(1280, 720);
    application.show();
    auto* page = pageOf(application);
    chooseFile(file("job.zdj"));
    press(window, QStringLiteral("startNew"));
    QVERIFY(application.bench().job() != nullptr);
    press(window, QStringLiteral("action-setup"));
    RigSetup& setup = *page->rigSetup();
    QVERIFY(setup.isVisible());
    draw(application, QStringLiteral("setup-1-new"));

    for (const char* axis : {"X", "Y", "Z"}) {
      type(setup, QStringLiteral("measure_position_mm.") + QString::fromLatin1(axis), QStringLiteral("0"));
    }

    // The first module: its port is missing, and that is said at its field.
    const QString module = QStringLiteral("template:temperature-module-8-pt100");
    add(setup, module);
    QVERIFY(!problemAt(setup, QStringLiteral("device")).isEmpty());
    QVERIFY(!page->primaryAction().enabled);
    draw(application, QStringLiteral("setup-2-problem"));
    type(setup, QStringLiteral("device"), served("rtu"));
    QVERIFY2(problemAt(setup, QStringLiteral("device")).isEmpty(), qPrintable(problemAt(setup, "device")));
    QVERIFY(page->primaryAction().enabled);

    // Its units are found, and the search is ended when both are there.
    press(setup, QStringLiteral("find:units"));
    QTRY_VERIFY_WITH_TIMEOUT(setup.state().found.size() >= 2, 20000);
    draw(application, QStringLiteral("setup-3-search"));
    press(setup, QStringLiteral("cancelWork"));
    QTRY_VERIFY_WITH_TIMEOUT(setup.state().busy.isEmpty(), 5000);
    QCOMPARE(setup.state().found[1].what, QStringLiteral("Unit 2"));
    press(setup, QStringLiteral("rigTest"));
    QTRY_VERIFY_WITH_TIMEOUT(resultOf(setup).contains(QStringLiteral("Answers in")), 10000);
    QCOMPARE(setup.state().found.size(), 8);
    press(setup, QStringLiteral("addSensors"));
    draw(application, QStringLiteral("setup-4-tested"));

    // The second one is on the same line with the next unit; a unit twice is named at its field and taken back.
    add(setup, module);
    QCOMPARE(setup.findChild<QLineEdit*>(QStringLiteral("field:unit"))->text(), QStringLiteral("2"));
    type(setup, QStringLiteral("unit"), QStringLiteral("1"));
    QVERIFY(!problemAt(setup, QStringLiteral("unit")).isEmpty());
    press(setup, QStringLiteral("rigUndo"));
    QVERIFY(problemAt(setup, QStringLiteral("unit")).isEmpty());
    type(setup, QStringLiteral("unit"), QStringLiteral("77"));
    press(setup, QStringLiteral("rigTest"));
    QTRY_VERIFY_WITH_TIMEOUT(setup.state().resultJudgement == Judgement::bad, 10000);
    press(setup, QStringLiteral("rigUndo"));
    press(setup, QStringLiteral("addSensors"));
    QCOMPARE(rowOf(setup, QStringLiteral("T16_C")), 15);

    // The camera.
    add(setup, QStringLiteral("camera"));
    type(setup, QStringLiteral("url"), served("camera") + QStringLiteral("front.mjpg"));
    press(setup, QStringLiteral("rigPreview"));
    const auto* note = setup.findChild<QLabel*>(QStringLiteral("cameraNote"));
    QTRY_VERIFY2_WITH_TIMEOUT(note->text().contains(QStringLiteral(" px")), qPrintable(note->text()), 15000);
    QTest::qWait(600);
    draw(application, QStringLiteral("setup-5-camera"));
    Q_EMIT setup.regionDrawn(QRectF(236.0, 158.0, 168.0, 164.0));
    QCOMPARE(setup.findChild<QLineEdit*>(QStringLiteral("field:target_roi_px"))->text(),
             QStringLiteral("236, 158, 168, 164"));
    press(setup, QStringLiteral("rigPreview"));

    // Signals: the room is read by the second module in place of its last sensor.
    setup.showView(1);
    auto* table = setup.findChild<QTableWidget*>(QStringLiteral("signals"));
    table->setCurrentCell(rowOf(setup, QStringLiteral("T16_C")), 0);
    press(setup, QStringLiteral("removeSensor"));
    enter(setup, QStringLiteral("Room temperature"), SignalTable::device, QStringLiteral("module-2"));
    QVERIFY(!page->primaryAction().enabled);
    draw(application, QStringLiteral("setup-6-signal-problem"));
    enter(setup, QStringLiteral("Room temperature"), SignalTable::signal, QStringLiteral("temperature_C[8]"));
    QVERIFY(page->primaryAction().enabled);
    enter(setup, QStringLiteral("T1_C"), SignalTable::label, QStringLiteral("Spindle front bearing"));
    enter(setup, QStringLiteral("T2_C"), SignalTable::name, QStringLiteral("T1_C"));
    QVERIFY2(!setup.state().sentence.isEmpty(), "a channel twice");
    press(setup, QStringLiteral("rigUndo"));
    QVERIFY(setup.state().sentence.isEmpty());
    press(setup, QStringLiteral("rigLive"));
    const auto plausible = [&setup] {
      int count = 0;
      for (const auto& line : setup.state().lines) count += line.judgement == Judgement::ok ? 1 : 0;
      return count;
    };
    QTRY_COMPARE_WITH_TIMEOUT(plausible(), 16, 15000);
    draw(application, QStringLiteral("setup-7-live"));

    // Saved, and read by the same loader as of the command line.
    const QString path = file("profile.json");
    chooseFile(path);
    press(window, QStringLiteral("primary"));
    QTRY_VERIFY(!page->state().settingUp);
    const auto read = zerodrift::controller::read_profile(path.toStdString());
    QVERIFY(read.has_value());
    QVERIFY(read->manual);
    QCOMPARE(read->devices.size(), std::size_t{2});
    QCOMPARE(read->measure_position_mm.size(), std::size_t{3});
    QCOMPARE(read->sensors.size(), std::size_t{15});
    QCOMPARE(read->sensors[0].label, std::string("Spindle front bearing"));
    QCOMPARE(read->cameras.at(0).target_roi_px[2], 168);
    QVERIFY(read->sources.ambient.has_value());
    QProcess cli;
    cli.start(QStringLiteral(ZERODRIFT_BIN_DIR) + QStringLiteral("/zerodrift-cli"),
              {QStringLiteral("machine"), QStringLiteral("check"), QStringLiteral("--profile"), path});
    QVERIFY(cli.waitForFinished(30000));
    QVERIFY2(cli.exitCode() == 0, cli.readAllStandardError().constData());

    // And the page connects with it.
    press(window, QStringLiteral("primary"));
    const auto& questions = application.bench().questions();
    QTRY_VERIFY_WITH_TIMEOUT(questions->open().has_value(), 20000);
    questions->answer({false, {}});
    QTRY_VERIFY_WITH_TIMEOUT(page->state().connected && page->state().devices.size() == 2, 20000);
    QTRY_VERIFY_WITH_TIMEOUT(std::all_of(page->state().sensors.begin(), page->state().sensors.end(),
                                         [](const auto& sensor) { return sensor.judgement == Judgement::ok; }),
                             20000);
    draw(application, QStringLiteral("setup-8-connected"));
    QVERIFY(application.bench().disconnectMachine().has_value());
  }

  /// What the page cannot edit stays in the file.
  void editingAnExampleLosesNoKey() {
    using nlohmann::json;
    json document = *zerodrift::read_json_file(std::string(ZERODRIFT_SOURCE_DIR) + "/examples/rig-profile.json");
    document["maintenance"] = {{"next", "2027-03"}};
    const QString path = file("rig.json");
    QVERIFY(zerodrift::write_json_file(path.toStdString(), document).has_value());
    Application application(m_theme);
    application.show();
    QVERIFY(application.bench().createJob(file("second.zdj").toStdString()).has_value());
    QVERIFY(application.bench().loadProfile(path.toStdString()).has_value());
    application.openPage(QStringLiteral("machine"));
    auto& window = application.window();
    window.resize(1440, 900);
    press(window, QStringLiteral("action-setup"));
    RigSetup& setup = *pageOf(application)->rigSetup();
    QCOMPARE(setup.state().lines.size(), 35);  // 20 sensors, 5 quantities, 5 axes, 5 probes
    setup.showView(1);
    draw(application, QStringLiteral("setup-9-example"));
    enter(setup, QStringLiteral("T3_C"), SignalTable::label, QStringLiteral("Motor"));
    press(window, QStringLiteral("primary"));
    document["sensors"][2]["label"] = "Motor";
    QVERIFY(*zerodrift::read_json_file(path.toStdString()) == document);
  }
};

QTEST_MAIN(RigSetupTest)
#include "rig_setup_test.moc"
