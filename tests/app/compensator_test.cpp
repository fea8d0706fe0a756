// The host compensator's page at work beside the virtual machine: what it writes arrives, what is left is measured.

#include <QApplication>
#include <QMessageBox>
#include <QPushButton>
#include <QTest>
#include <QTimer>
#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "app/desktop/application.h"
#include "core/analysis/fit.h"
#include "core/recording/recording.h"
#include "tests/app/test_home.h"
#include "ui/pages/compensator_page.h"

using zerodrift::desktop::Application;
using zerodrift::desktop::DemoOptions;
using zerodrift::ui::CompensatorPage;
using zerodrift::ui::CompensatorPhase;

namespace {

/// dZ = 2 um/K (T1 - 15 C): some 12 um at the machine's start, which then does not err at all.
zerodrift::Result<zerodrift::analysis::Model> model() {
  zerodrift::recording::Recording run;
  std::vector<double> t1_C;
  std::vector<double> z_um;
  for (int i = 0; i < 300; ++i) {
    run.time_s.push_back(30.0 * i);
    t1_C.push_back(i < 200 ? 12.0 + 0.1 * i : 32.0 - 0.1 * (i - 200));
    z_um.push_back(2.0 * (t1_C.back() - 15.0));
  }
  run.ensure("T1_C").values = t1_C;
  run.ensure("dZ_um").values = z_um;
  zerodrift::analysis::FitOptions options;
  options.method = zerodrift::analysis::Method::mlr;
  options.sensors = {"T1_C"};
  return zerodrift::analysis::fit({run}, options);
}

}  // namespace

class CompensatorTest : public QObject, private zerodrift::desktop::TestHome {
  Q_OBJECT

 private Q_SLOTS:
  void compensatesAndMeasuresWhatIsLeft() {
    Application application(m_theme);
    application.show();
    DemoOptions demo;
    demo.program = QStringLiteral(ZERODRIFT_BIN_DIR "/zerodrift-machine");
    application.startDemo(demo, m_folder.filePath(QStringLiteral("host.zdj")));
    auto& bench = application.bench();
    QVERIFY(toured(application, "machine"));
    auto* presenter = application.presenter(QStringLiteral("compensator"));
    auto* page = qobject_cast<CompensatorPage*>(presenter->page());
    application.openPage(QStringLiteral("compensator"));
    QVERIFY2(!page->primaryAction().enabled, "there is no model yet");

    QVERIFY(toured(application, "calibrate"));
    const auto fitted = model();
    QVERIFY(fitted.has_value());
    using zerodrift::commissioning::NewArtefact;
    QVERIFY(keeps(bench, NewArtefact::of("warmup", {{"zero_um", {0.0, 0.0, 0.0}}}, {})));
    QVERIFY(keeps(bench, NewArtefact::of("model", {{"model", zerodrift::analysis::to_json(*fitted)}}, {})));
    const nlohmann::json seen = {{"sign_check", nlohmann::json::object()}};
    QVERIFY(keeps(bench, NewArtefact::of("upload", seen, {})));
    QTRY_VERIFY_WITH_TIMEOUT(bench.connected() && !bench.tasks().running(), 20000);
    presenter->refresh();
    QVERIFY2(page->primaryAction().enabled, qPrintable(page->primaryAction().reason));

    refuse();
    Q_EMIT page->primaryTriggered();
    QVERIFY2(!bench.tasks().running(), "nothing goes out without a yes");
    QVERIFY(!bench.compensationOn());

    agree();
    Q_EMIT page->primaryTriggered();
    QTRY_COMPARE(page->state().phase, CompensatorPhase::running);
    QTRY_VERIFY_WITH_TIMEOUT(page->state().turns > 5, 20000);
    QVERIFY(bench.compensationOn());
    const auto& z = page->state().axes[2];
    QTRY_VERIFY_WITH_TIMEOUT(z.applied_um < -5.0, 20000);
    QTRY_VERIFY_WITH_TIMEOUT(std::abs(z.applied_um + z.predicted_um) < 1.0, 20000);
    // The machine does not err at rest: what is left is what was written.
    const bool measured = QTest::qWaitFor([&] { return std::abs(z.left_um - z.applied_um) < 1.5; }, 30000);
    QVERIFY2(
        measured,
        qPrintable(
            QStringLiteral("left %1, applied %2: %3").arg(z.left_um).arg(z.applied_um).arg(page->state().notMeasured)));

    Q_EMIT page->primaryTriggered();
    QTRY_COMPARE_WITH_TIMEOUT(page->state().phase, CompensatorPhase::ready, 60000);
    QVERIFY2(page->problem().sentence.isEmpty(), qPrintable(page->problem().sentence));
    QVERIFY(!page->state().summary.isEmpty());
    QTRY_VERIFY_WITH_TIMEOUT(bench.connected() && !bench.compensationOn(), 20000);
    const auto trail = bench.job()->audit_trail();
    QVERIFY(trail.has_value());
    QVERIFY(std::any_of(trail->begin(), trail->end(),
                        [](const auto& entry) { return entry.action == "compensate from this computer"; }));
  }

 private:
  static bool toured(Application& application, const char* page) {
    bool good = false;
    bool ended = false;
    application.presenter(QString::fromLatin1(page))->tour([&](bool how) {
      good = how;
      ended = true;
    });
    return QTest::qWaitFor([&] { return ended; }, 90000) && good;
  }

  void agree() { answer(true); }
  void refuse() { answer(false); }
  /// Presses a button of the question that comes next.
  void answer(bool yes) {
    auto* timer = new QTimer(this);
    connect(timer, &QTimer::timeout, this, [timer, yes] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (box == nullptr) return;
      timer->deleteLater();
      for (auto* button : box->buttons()) {
        if ((box->buttonRole(button) == QMessageBox::AcceptRole) == yes) return button->click();
      }
    });
    timer->start(50);
  }
};

QTEST_MAIN(CompensatorTest)
#include "compensator_test.moc"
