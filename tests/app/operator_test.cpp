// The person at a control without a link, as the window asks: questions, answers, refusals, and a machine that is
// connected by nothing else.

#include <QApplication>
#include <QLabel>
#include <QLineEdit>
#include <QProcess>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>
#include <future>

#include "app/desktop/application.h"
#include "app/desktop/operator_dialog.h"
#include "tests/app/test_home.h"

using zerodrift::Result;
using zerodrift::controller::OperatorAct;
using zerodrift::controller::OperatorAnswer;
using zerodrift::controller::OperatorRequest;
using zerodrift::desktop::Application;
using zerodrift::desktop::OperatorDialog;
using zerodrift::desktop::OperatorQuestions;

namespace {

QPushButton* button(const QWidget& dialog, const QString& text) {
  for (auto* one : dialog.findChildren<QPushButton*>()) {
    if (one->text() == text && one->isVisible()) return one;
  }
  return nullptr;
}

OperatorDialog* open_dialog() {
  for (QWidget* widget : QApplication::topLevelWidgets()) {
    auto* dialog = qobject_cast<OperatorDialog*>(widget);
    if (dialog != nullptr && dialog->isVisible()) return dialog;
  }
  return nullptr;
}

}  // namespace

class OperatorTest : public QObject, zerodrift::desktop::TestHome {
  Q_OBJECT

 private:
  std::shared_ptr<OperatorQuestions> m_questions = std::make_shared<OperatorQuestions>();
  zerodrift::controller::Profile m_manual;
  std::future<Result<OperatorAnswer>> m_asked;

  void ask(const OperatorRequest& request, std::stop_token stop = {}) {
    m_asked =
        std::async(std::launch::async, [this, request, stop] { return m_questions->of(m_manual, stop)->ask(request); });
  }
  bool answered() {
    return QTest::qWaitFor([this] { return m_asked.wait_for(std::chrono::seconds(0)) == std::future_status::ready; },
                           20000);
  }

 private Q_SLOTS:
  void init() {
    m_manual.manual = true;
    m_questions->forget();
  }

  void aControlWithALinkAsksNobody() { QVERIFY(m_questions->of({}, {}) == nullptr); }

  void enterSaysThatItIsDone() {
    OperatorDialog dialog(m_questions, nullptr);
    OperatorRequest request;
    request.act = OperatorAct::move;
    request.target_mm = {{"X", 1.5}, {"Y", 0}, {"Z", -20}};
    ask(request);
    QVERIFY(QTest::qWaitFor([&] { return dialog.isVisible(); }, 20000));
    QVERIFY(dialog.findChild<QLabel*>()->text().contains(QStringLiteral("X 1.500")));
    QTest::keyClick(button(dialog, QStringLiteral("Done")), Qt::Key_Return);
    QVERIFY(answered());
    QVERIFY(m_asked.get().has_value());
    QVERIFY(QTest::qWaitFor([&] { return !dialog.isVisible(); }, 20000));
  }

  void theSwitchIsAskedForOnce() {
    OperatorDialog dialog(m_questions, nullptr);
    ask({});
    QVERIFY(QTest::qWaitFor([&] { return button(dialog, QStringLiteral("It is off")) != nullptr; }, 20000));
    button(dialog, QStringLiteral("It is off"))->click();
    QVERIFY(answered());
    QCOMPARE(m_asked.get()->compensation_on, std::optional(false));
    OperatorRequest on;
    on.act = OperatorAct::switch_compensation;
    on.compensation_on = true;
    ask(on);
    QVERIFY(QTest::qWaitFor([&] { return button(dialog, QStringLiteral("Done")) != nullptr; }, 20000));
    button(dialog, QStringLiteral("Done"))->click();
    QVERIFY(answered());
    ask({});
    QVERIFY2(answered(), "what was confirmed is known");
    QCOMPARE(m_asked.get()->compensation_on, std::optional(true));
  }

  void aCheckValueMustBeTyped() {
    OperatorDialog dialog(m_questions, nullptr);
    OperatorRequest request;
    request.act = OperatorAct::load_table;
    request.file = "table-1.json";
    ask(request);
    QVERIFY(QTest::qWaitFor([&] { return button(dialog, QStringLiteral("Done")) != nullptr; }, 20000));
    QVERIFY(!button(dialog, QStringLiteral("Done"))->isEnabled());
    QTest::keyClicks(dialog.findChild<QLineEdit*>(), QStringLiteral(" 1A2B3C4D "));
    button(dialog, QStringLiteral("Done"))->click();
    QVERIFY(answered());
    QCOMPARE(m_asked.get()->check, std::string("1a2b3c4d"));
  }

  void aStepThatIsStoppedWaitsForNobody() {
    OperatorDialog dialog(m_questions, nullptr);
    std::stop_source stop;
    ask({}, stop.get_token());
    QVERIFY(QTest::qWaitFor([&] { return dialog.isVisible(); }, 20000));
    stop.request_stop();
    QVERIFY(answered());
    QCOMPARE(m_asked.get().error().code, zerodrift::ErrorCode::cancelled);
    QVERIFY(QTest::qWaitFor([&] { return !dialog.isVisible(); }, 20000));
  }

  void whatCannotBeDoneEndsTheStep() {
    OperatorRequest request;
    request.act = OperatorAct::command;
    ask(request);
    QVERIFY(QTest::qWaitFor([&] { return m_questions->open().has_value(); }, 20000));
    m_questions->decline(QStringLiteral("the door is open"));
    QVERIFY(answered());
    QCOMPARE(m_asked.get().error().code, zerodrift::ErrorCode::operator_declined);
  }

  void aManualMachineIsConnected() {
    QTemporaryDir folder;
    QProcess machine;
    const QString profile = folder.filePath(QStringLiteral("profile.json"));
    machine.start(QStringLiteral(ZERODRIFT_BIN_DIR) + QStringLiteral("/zerodrift-machine"),
                  {QStringLiteral("--manual"), QStringLiteral("--camera-port"), QStringLiteral("0"),
                   QStringLiteral("--profile"), profile});
    QVERIFY(machine.waitForStarted());
    QVERIFY(QTest::qWaitFor([&] { return machine.bytesAvailable() > 0; }, 30000));  // its line "ready"
    Application application(m_theme);
    application.show();
    QVERIFY(application.bench().loadProfile(profile.toStdString()).has_value());
    application.bench().connectMachine();
    QVERIFY(QTest::qWaitFor([] { return open_dialog() != nullptr; }, 30000));
    if (const QByteArray pictures = qgetenv("ZERODRIFT_PICTURES"); !pictures.isEmpty()) {
      open_dialog()->grab().save(QString::fromUtf8(pictures) + QStringLiteral("/operator.png"));
    }
    button(*open_dialog(), QStringLiteral("It is off"))->click();
    QVERIFY(QTest::qWaitFor([&] { return application.bench().connected(); }, 30000));
    const auto& look = *application.bench().look();
    QCOMPARE(look.identity.sensors.size(), std::size_t(20));
    QVERIFY(!look.sample.compensation_on);
    QVERIFY(std::isfinite(look.sample.temperature_C.front()));
    QVERIFY(!look.devices.empty());
    machine.terminate();
    machine.waitForFinished();
  }
};

QTEST_MAIN(OperatorTest)
#include "operator_test.moc"
