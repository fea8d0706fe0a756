// Presenters over a job whose run is made up here: what was tried stays, what was judged is the job's.

#include <QApplication>
#include <QTest>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/desktop/application.h"
#include "app/desktop/steps/fit_presenter.h"
#include "core/base/json.h"
#include "core/base/resources.h"
#include "core/flow/steps/inputs.h"
#include "core/flow/steps/sensors_step.h"
#include "core/flow/steps/verify_step.h"
#include "core/recording/csv.h"
#include "tests/app/test_home.h"
#include "ui/pages/calibrate_page.h"
#include "ui/pages/fit_page.h"
#include "ui/pages/verify_page.h"

using zerodrift::commissioning::Job;
using zerodrift::commissioning::NewArtefact;
using zerodrift::commissioning::SeriesId;
using zerodrift::desktop::Application;

namespace {

constexpr double kelvin[] = {14.0, 9.0, 6.0, 4.0, 2.0};                   // rises of the sensors
constexpr double minutes[] = {25.0, 40.0, 60.0, 90.0, 150.0};             // their time constants
constexpr double um_per_K[3][2] = {{0.3, 0.2}, {-0.2, 0.1}, {2.5, 1.2}};  // X, Y, Z from T1 and T3

/// A warm-up by first-order rises; `left` is the share of the errors that is there.
SeriesId record(Job& job, const char* name, int rows, double left) {
  const auto series =
      job.start_series(name, {"spindle_rpm", "T1_C", "T2_C", "T3_C", "T4_C", "T5_C", "dX_um", "dY_um", "dZ_um"});
  for (int i = 0; i < rows; ++i) {
    std::vector<double> row = {3000.0};
    for (int s = 0; s < 5; ++s) {
      // A little of its own for each sensor, the same at each call.
      const double own = 0.05 * std::sin(0.7 * i * (s + 1));
      row.push_back(20.0 + kelvin[s] * (1.0 - std::exp(-i / minutes[s])) + own);
    }
    for (int axis = 0; axis < 3; ++axis) {
      const double error =
          um_per_K[axis][0] * (row[1] - 20.0) + um_per_K[axis][1] * (row[3] - 20.0) + 0.1 * std::cos(1.3 * i + axis);
      row.push_back(i % 2 == 0 ? left * error : std::nan(""));
    }
    if (!job.append(*series, 60.0 * i, row)) return 0;
  }
  return job.flush() && job.finish_series(*series) ? *series : 0;
}

}  // namespace

class StepsTest : public QObject, private zerodrift::desktop::TestHome {
  Q_OBJECT

 private Q_SLOTS:
  void triedMethodsStay() {
    Application application(m_theme);
    QVERIFY(recorded(application));
    application.openPage(QStringLiteral("fit"));
    auto* page = qobject_cast<zerodrift::ui::FitPage*>(application.presenter(QStringLiteral("fit"))->page());
    auto& tasks = application.bench().tasks();
    QTRY_VERIFY_WITH_TIMEOUT(application.bench().has("model") && !tasks.running(), 60000);
    const auto ids = [page] {
      QStringList all;
      for (const auto& row : page->state().methods) all << row.id;
      all.sort();
      return all;
    };
    const QStringList offered = ids();
    QVERIFY2(offered.contains(QStringLiteral("ridge")) && offered.contains(QStringLiteral("mlr")),
             qPrintable(offered.join(QLatin1Char(' '))));
    const QString proposed = page->state().proposed;
    for (const char* method : {"mlr", "ridge", "mlr"}) {
      Q_EMIT page->methodChosen(QString::fromLatin1(method));
      QTRY_VERIFY_WITH_TIMEOUT(!tasks.running(), 60000);
      QCOMPARE(page->state().method, QString::fromLatin1(method));
      QCOMPARE(ids(), offered);
      QCOMPARE(page->state().proposed, proposed);
    }
  }

  /// After a fit that failed the page offers to fit, and methods to choose from.
  void aFitThatFailedLeavesAWayOn() {
    Application application(m_theme);
    QVERIFY(recorded(application));
    auto& bench = application.bench();
    QVERIFY(keeps(bench, NewArtefact::of("sensors", {{"chosen", {"T99_C"}}}, {(*bench.job()->latest("warmup"))->id})));
    application.openPage(QStringLiteral("fit"));
    auto* page = qobject_cast<zerodrift::ui::FitPage*>(application.presenter(QStringLiteral("fit"))->page());
    auto& tasks = bench.tasks();
    QTRY_VERIFY_WITH_TIMEOUT(!tasks.running(), 60000);
    QVERIFY(!page->problem().sentence.isEmpty());
    QVERIFY(!bench.has("model"));
    QVERIFY2(page->primaryAction().enabled, qPrintable(page->primaryAction().reason));
    QVERIFY(page->primaryAction().text.startsWith(QStringLiteral("Fit")));
    QVERIFY(page->state().methods.size() >= 2);
    Q_EMIT page->methodChosen(page->state().methods.front().id);
    QTRY_VERIFY_WITH_TIMEOUT(!tasks.running(), 60000);
    const auto sensors = zerodrift::flow::choose_sensors(*bench.job(), {}, {});
    QVERIFY(sensors && keeps(bench, *sensors));
    Q_EMIT page->primaryTriggered();
    QTRY_VERIFY_WITH_TIMEOUT(bench.has("model") && !tasks.running(), 60000);
    QCOMPARE(page->state().standing, zerodrift::ui::FitStanding::current);
  }

  /// A model that was fitted from other sensors says so and is fitted again as it was asked for; undo begins at the
  /// method of the job.
  void aModelThatIsOutOfDateIsFittedAgain() {
    QString path;
    {
      Application application(m_theme);
      QVERIFY(recorded(application));
      auto& bench = application.bench();
      path = QString::fromStdString(bench.job()->path().string());
      application.openPage(QStringLiteral("fit"));
      auto* page = qobject_cast<zerodrift::ui::FitPage*>(application.presenter(QStringLiteral("fit"))->page());
      QTRY_VERIFY_WITH_TIMEOUT(bench.has("model") && !bench.tasks().running(), 60000);
      Q_EMIT page->methodChosen(QStringLiteral("mlr"));
      QTRY_VERIFY_WITH_TIMEOUT(!bench.tasks().running(), 60000);
      QCOMPARE(page->state().standing, zerodrift::ui::FitStanding::current);
      zerodrift::flow::SensorsOptions by_hand;
      by_hand.chosen = {"T1_C", "T4_C"};
      const auto sensors = zerodrift::flow::choose_sensors(*bench.job(), by_hand, {});
      QVERIFY(sensors && keeps(bench, *sensors));
      application.openPage(QStringLiteral("fit"));
      QCOMPARE(page->state().standing, zerodrift::ui::FitStanding::stale);
      QVERIFY(!page->state().changed.isEmpty());
      Q_EMIT page->primaryTriggered();
      QTRY_VERIFY_WITH_TIMEOUT(!bench.tasks().running(), 60000);
      QCOMPARE(page->state().standing, zerodrift::ui::FitStanding::current);
      QCOMPARE(page->state().method, QStringLiteral("mlr"));
    }
    Application application(m_theme);
    QVERIFY(application.bench().openJob(path.toStdString()).has_value());
    application.openPage(QStringLiteral("fit"));
    auto* presenter = application.presenter(QStringLiteral("fit"));
    auto* page = qobject_cast<zerodrift::ui::FitPage*>(presenter->page());
    auto& tasks = application.bench().tasks();
    Q_EMIT page->methodChosen(QStringLiteral("ridge"));
    QTRY_VERIFY_WITH_TIMEOUT(!tasks.running(), 60000);
    QCOMPARE(page->state().method, QStringLiteral("ridge"));
    presenter->undo();
    QTRY_VERIFY_WITH_TIMEOUT(!tasks.running(), 60000);
    QCOMPARE(page->state().method, QStringLiteral("mlr"));
  }

  void aNewerRunCorrectsTheModel() {
    Application application(m_theme);
    QVERIFY(recorded(application));
    application.openPage(QStringLiteral("fit"));
    auto* presenter = qobject_cast<zerodrift::desktop::FitPresenter*>(application.presenter(QStringLiteral("fit")));
    auto* page = qobject_cast<zerodrift::ui::FitPage*>(presenter->page());
    auto& tasks = application.bench().tasks();
    QTRY_VERIFY_WITH_TIMEOUT(application.bench().has("model") && !tasks.running(), 60000);
    QVERIFY(page->state().updatedBy.isEmpty());
    auto& job = *application.bench().job();
    const auto warmup = job.latest("warmup");
    const auto run = zerodrift::flow::run_of(job, {(*warmup)->id, application.bench().body("warmup")});
    QVERIFY(run.has_value());
    const auto file = std::filesystem::path(m_folder.path().toStdString()) / "newer.csv";
    QVERIFY(zerodrift::recording::write_recording(file, *run).has_value());
    const auto before = job.history("model")->size();
    presenter->update(file.string(), {});
    QTRY_VERIFY_WITH_TIMEOUT(!tasks.running(), 60000);
    QCOMPARE(job.history("model")->size(), before + 1);
    QVERIFY2(page->state().updatedBy.contains(QStringLiteral("newer")), qPrintable(page->state().updatedBy));
    QVERIFY(!application.bench().body("model").value("table", nlohmann::json::array()).empty());
  }

  /// Page, job and report name the same coefficient, also after the threshold was changed by hand.
  void oneCorrectionForPageAndReport() {
    Application application(m_theme);
    QVERIFY(recorded(application));
    auto& job = *application.bench().job();
    QVERIFY(put(job, "upload", {{"table", tableOf()}, {"sign_check", {{"passed", true}}}}, {}));
    const SeriesId series = record(job, "verification", 180, 0.12);
    QVERIFY(series != 0);
    const auto upload = job.latest("upload");
    const auto warmup = job.latest("warmup");
    QVERIFY(put(job, "verification", {{"series", series}, {"limit_um", 5.0}, {"problems", nlohmann::json::array()}},
                {(*warmup)->id, (*upload)->id}));
    const auto judged = zerodrift::flow::judge_again(job, 2.0);
    QVERIFY2(judged.has_value(), judged ? "" : describe(judged.error()).c_str());
    QVERIFY(keeps(application.bench(), *judged));

    application.openPage(QStringLiteral("verify"));
    auto* page = qobject_cast<zerodrift::ui::VerifyPage*>(application.presenter(QStringLiteral("verify"))->page());
    const auto agrees = [&] {
      const auto body = application.bench().body("verification");
      for (const auto& row : page->state().corrections) {
        if (std::abs(row.kappa - body["kappa"][row.axis.toStdString()].get<double>()) > 1e-12) return false;
      }
      return !page->state().corrections.isEmpty();
    };
    QVERIFY(agrees());
    QVERIFY(page->state().correctionProposed);
    Q_EMIT page->thresholdChanged(50.0);
    QTRY_COMPARE(application.bench().body("verification").value("threshold_um", 0.0), 50.0);
    QTRY_VERIFY(!application.bench().tasks().running());
    QVERIFY(agrees());
    QVERIFY(!page->state().correctionProposed);

    // Both runs over the same minutes.
    const auto& results = page->state().results;
    QCOMPARE(results.size(), 3);
    QVERIFY(!results[2].worse());
    QCOMPARE(page->state().beforeAxis, QStringLiteral("Z"));
    QVERIFY(std::abs(page->state().compared_s - 179 * 60.0) < 1.0);
  }

  /// The fit's word is part of the result: a step that left more is done, with a mark that says so.
  void aPromiseThatWasNotKeptIsMarkedInTheRail() {
    Application application(m_theme);
    QVERIFY(recorded(application));
    auto& job = *application.bench().job();
    QVERIFY(put(job, "model", {{"figures", {{{"channel", "dZ_um"}, {"peak_held_out_um", 1.0}}}}}, {}));
    QVERIFY(put(job, "calibration", {{"source", "probes"}}, {}));
    QVERIFY(put(job, "upload", {{"table", tableOf()}, {"sign_check", {{"passed", true}}}}, {}));
    const SeriesId series = record(job, "verification", 180, 0.12);
    const auto upload = job.latest("upload");
    const auto warmup = job.latest("warmup");
    const auto calibration = job.latest("calibration");
    const auto verified = [&](double left_um, double removed_percent) {
      const nlohmann::json body = {{"series", series},
                                   {"limit_um", 5.0},
                                   {"verdict", left_um <= 5.0 ? "passed" : "failed"},
                                   {"peak_error_before_um", {{"Z", 40.0}}},
                                   {"peak_error_after_um", {{"Z", left_um}}},
                                   {"removed_percent", {{"Z", removed_percent}}}};
      const auto made = NewArtefact::of("verification", body, {(*warmup)->id, (*calibration)->id, (*upload)->id});
      return keeps(application.bench(), made);
    };
    const auto standing = [&] { return application.presenter(QStringLiteral("verify"))->standing(); };
    QVERIFY(verified(1.2, 97.0));
    QVERIFY2(standing().words.isEmpty(), qPrintable(standing().words));
    QVERIFY(verified(1.4, 96.5));
    QVERIFY2(standing().words.contains(QStringLiteral("Promise")), qPrintable(standing().words));
    QCOMPARE(standing().state, zerodrift::ui::StepState::stale);
    QVERIFY(verified(1.2, 84.6));
    QVERIFY2(standing().words.contains(QStringLiteral("85")), qPrintable(standing().words));
    QVERIFY(verified(5.5, 86.0));
    QVERIFY2(standing().words.contains(QStringLiteral("limit")), qPrintable(standing().words));
    QCOMPARE(standing().state, zerodrift::ui::StepState::ready);
  }

  /// The profile's marks stand until a person draws others; each change can be taken back.
  void marksAreAddedRemovedAndTakenBack() {
    Application application(m_theme);
    QVERIFY(recorded(application));
    QVERIFY(application.bench().loadProfile(*zerodrift::find_resource("profiles/virtual-five-axis.json")).has_value());
    auto* presenter = application.presenter(QStringLiteral("calibrate"));
    auto* page = qobject_cast<zerodrift::ui::CalibratePage*>(presenter->page());
    using zerodrift::ui::MarksTakeOff;
    presenter->refresh();
    QCOMPARE(page->state().marks, 2);
    QCOMPARE(page->state().takeOff, MarksTakeOff::shiftTurnScale);
    Q_EMIT page->markRemoved(0);
    QCOMPARE(page->state().marks, 1);
    QCOMPARE(page->state().takeOff, MarksTakeOff::shift);
    QVERIFY(std::abs(page->state().markDistance_mm - 3.0) < 0.1);
    Q_EMIT page->markRemoved(0);
    QCOMPARE(page->state().takeOff, MarksTakeOff::nothing);
    Q_EMIT page->markDrawn(QRectF(30, 20, 80, 70));
    QCOMPARE(page->state().marks, 1);
    Q_EMIT page->markDrawn(QRectF(300, 200, 60, 60));  // in the target
    QCOMPARE(page->state().marks, 1);
    QVERIFY(!page->problem().sentence.isEmpty());
    Q_EMIT page->markDrawn(QRectF(120, 20, 60, 60));  // too near for the turn
    QCOMPARE(page->state().marks, 2);
    QCOMPARE(page->state().takeOff, MarksTakeOff::shift);
    for (int marks : {1, 0, 1, 2}) {
      presenter->undo();
      QCOMPARE(page->state().marks, marks);
    }
    presenter->undo();
    QCOMPARE(page->state().marks, 2);
    // The other camera keeps its own.
    Q_EMIT page->markRemoved(1);
    Q_EMIT page->cameraChosen(1);
    QCOMPARE(page->state().marks, 2);
  }

  /// What failed is kept as code and facts, once, and said on the page.
  void aCorrectionThatCannotBeMadeIsSaid() {
    Application application(m_theme);
    QVERIFY(recorded(application));
    auto& job = *application.bench().job();
    const auto table = tableOf("T99_C");  // of a sensor that the run does not have
    QVERIFY(put(job, "upload", {{"table", table}, {"sign_check", {{"passed", true}}}}, {}));
    const SeriesId series = record(job, "verification", 180, 0.12);
    QVERIFY(series != 0);
    const auto upload = job.latest("upload");
    const auto warmup = job.latest("warmup");
    QVERIFY(put(job, "verification", {{"series", series}, {"limit_um", 5.0}, {"problems", nlohmann::json::array()}},
                {(*warmup)->id, (*upload)->id}));
    for (int time = 0; time < 2; ++time) {
      const auto judged = zerodrift::flow::judge_again(job, 2.0);
      QVERIFY2(judged.has_value(), judged ? "" : describe(judged.error()).c_str());
      QVERIFY(keeps(application.bench(), *judged));
    }
    const auto problems = application.bench().body("verification").at("problems");
    QCOMPARE(problems.size(), std::size_t{1});
    QCOMPARE(problems[0].value("said", ""), std::string("no_correction"));
    QCOMPARE(problems[0].value("code", ""), std::string("channel_missing"));
    application.openPage(QStringLiteral("verify"));
    auto* page = qobject_cast<zerodrift::ui::VerifyPage*>(application.presenter(QStringLiteral("verify"))->page());
    QVERIFY2(page->state().noCorrection.contains(QStringLiteral("T99")), qPrintable(page->state().noCorrection));
  }

 private:
  static bool put(Job& job, const char* kind, const nlohmann::json& body,
                  const std::vector<zerodrift::commissioning::ArtefactId>& inputs) {
    return job.put(NewArtefact::of(kind, body, inputs)).has_value();
  }

  static nlohmann::json tableOf(const char* second = "T3_C") {
    zerodrift::compensation::Table table;
    for (int axis = 0; axis < 3; ++axis) {
      auto& record = table.axes[std::string(1, "XYZ"[axis])];
      record.terms = {{"T1_C", um_per_K[axis][0], 20.0}, {second, um_per_K[axis][1], 20.0}};
    }
    return zerodrift::compensation::to_json(table);
  }

  /// A job up to the sensors.
  bool recorded(Application& application) {
    const auto path = m_folder.filePath(QStringLiteral("job-%1.zdj").arg(++m_jobs)).toStdString();
    if (!application.bench().createJob(path)) return false;
    auto& job = *application.bench().job();
    const auto file = zerodrift::find_resource("profiles/virtual-five-axis.json");
    const auto profile = file ? zerodrift::read_json_file(*file) : zerodrift::Result<nlohmann::json>(nullptr);
    if (!profile || profile->is_null()) return false;
    const SeriesId series = record(job, "warm-up", 240, 1.0);
    if (series == 0 || !put(job, "machine", {{"profile", *profile}, {"identity", {{"accepts_table", true}}}}, {}) ||
        !put(job, "warmup", {{"series", series}, {"rows", 240}, {"lost_samples", 0}}, {})) {
      return false;
    }
    const auto sensors = zerodrift::flow::choose_sensors(job, {}, {});
    return sensors && keeps(application.bench(), *sensors);
  }

  int m_jobs = 0;
};

QTEST_MAIN(StepsTest)
#include "steps_test.moc"
