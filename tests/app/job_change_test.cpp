// A job that is left, opened or made: every page shows what the open job holds and nothing else, and work that runs
// keeps its job. ZERODRIFT_ORDERS=200 goes through as many random orders of New, Open, Other job, Close and Disconnect,
// drawn with ZERODRIFT_SEED.

#include <QApplication>
#include <QFile>
#include <QMessageBox>
#include <QProcess>
#include <QPushButton>
#include <QRandomGenerator>
#include <QTest>
#include <QTimer>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "app/desktop/application.h"
#include "app/desktop/child_process.h"
#include "app/desktop/file_opener.h"
#include "app/desktop/run_presenter.h"
#include "core/acquisition/plan.h"
#include "core/base/json.h"
#include "core/recording/recording.h"
#include "tests/app/test_home.h"
#include "ui/pages/fit_page.h"
#include "ui/pages/machine_page.h"
#include "ui/pages/physics_page.h"
#include "ui/pages/report_page.h"
#include "ui/pages/sensors_page.h"
#include "ui/pages/upload_page.h"
#include "ui/pages/verify_page.h"
#include "ui/pages/warmup_page.h"

using zerodrift::commissioning::Job;
using zerodrift::commissioning::NewArtefact;
using zerodrift::desktop::Application;
using zerodrift::desktop::keeps;

namespace {

constexpr int sample_seed = 3;  // of the machine that the sample job was made on

/// Another warm-up than the sample's: three hours, four sensors.
QByteArray other_run() {
  QByteArray csv = "time_s,spindle_rpm,T1_C,T2_C,T3_C,T4_C,dX_um,dZ_um\n";
  for (int i = 0; i < 180; ++i) {
    csv += QByteArray::number(60 * i) + "," + (i < 120 ? "2000" : "0");
    double t1 = 0.0;
    for (int s = 1; s <= 4; ++s) {
      const double rise = (2.0 + s) * (1.0 - std::exp(-i / (15.0 * s))) + 0.02 * std::sin(1.1 * i * s);
      if (s == 1) t1 = rise;
      csv += "," + QByteArray::number(20.0 + rise, 'f', 3);
    }
    csv += "," + QByteArray::number(0.4 * t1, 'f', 2) + "," + QByteArray::number(3.0 * t1, 'f', 2) + "\n";
  }
  return csv;
}

}  // namespace

class JobChangeTest : public QObject, private zerodrift::desktop::TestHome {
  Q_OBJECT

 public:
  /// Before the application is made: many orders take longer than Qt gives a test function.
  static void initMain() {
    if (qEnvironmentVariableIsSet("ZERODRIFT_ORDERS") && !qEnvironmentVariableIsSet("QTEST_FUNCTION_TIMEOUT")) {
      qputenv("QTEST_FUNCTION_TIMEOUT", "7200000");
    }
  }

 private Q_SLOTS:
  void initTestCase() {
    qputenv("HOME", m_folder.path().toUtf8());
    qputenv("ZERODRIFT_STATE_DIR", m_folder.filePath(QStringLiteral("state")).toUtf8());
  }
  void cleanupTestCase() { stopMachine(); }

  void everyPageShowsTheOpenJob_data() {
    QTest::addColumn<QString>("next");
    QTest::newRow("a new job") << QStringLiteral("new");
    QTest::newRow("a job from a file") << QStringLiteral("other");
    QTest::newRow("no job") << QString();
  }

  /// What is seen after a change is, to the pixel, what a window shows that has never seen the job before.
  void everyPageShowsTheOpenJob() {
    QFETCH(const QString, next);
    const auto turn_to_next = [&](Application& application) {
      if (next == QStringLiteral("new")) {
        const QString path = m_folder.filePath(QStringLiteral("new-job.zdj"));
        QVERIFY(QFile::exists(path) ? application.bench().openJob(path.toStdString()).has_value()
                                    : application.bench().createJob(path.toStdString()).has_value());
      } else if (next == QStringLiteral("other")) {
        QVERIFY(application.bench().openJob(otherJob().toStdString()).has_value());
      }
    };
    Application changed(m_theme);
    show(changed);
    QVERIFY(changed.bench().openJob(sampleJob().toStdString()).has_value());
    QVERIFY(changed.bench().profile().has_value());
    const auto full = visited(changed);
    QVERIFY(changed.bench().closeJob().has_value());
    turn_to_next(changed);
    const auto after = visited(changed);
    if (!next.isEmpty()) QVERIFY(changed.bench().closeJob().has_value());  // a job is open in one window at a time

    Application fresh(m_theme);
    show(fresh);
    if (fresh.bench().profile().has_value() != changed.bench().profile().has_value()) {
      // The connection profile stays with the window: it is the machine's, not the job's.
      const QString file = m_folder.filePath(QStringLiteral("profile.json"));
      QVERIFY(zerodrift::write_json_file(file.toStdString(), changed.bench().profileDocument()).has_value());
      QVERIFY(fresh.bench().loadProfile(file.toStdString()).has_value());
    }
    turn_to_next(fresh);
    const auto wanted = visited(fresh);
    QCOMPARE(after.size(), wanted.size());
    for (const QString& id : wanted.keys()) {
      if (after[id] == wanted[id]) continue;
      const QString folder = qEnvironmentVariable("ZERODRIFT_PICTURES", m_folder.path());
      after[id].save(folder + QStringLiteral("/%1-%2-after.png").arg(id, next));
      wanted[id].save(folder + QStringLiteral("/%1-%2-wanted.png").arg(id, next));
      QFAIL(qPrintable(QStringLiteral("%1 still shows something of the job before").arg(id)));
    }
    if (next.isEmpty()) return;
    QVERIFY(full[QStringLiteral("warmup")] != after[QStringLiteral("warmup")]);
  }

  void aRunKeepsItsJob() {
    Application application(m_theme);
    show(application);
    QVERIFY(connected(application));
    auto& bench = application.bench();
    application.openPage(QStringLiteral("warmup"));
    QVERIFY(startRun(application));
    const auto path = bench.job()->path();
    auto* machine = application.presenter(QStringLiteral("machine"))->page();
    application.openPage(QStringLiteral("machine"));
    for (const char* action : {"job", "disconnect"}) {
      const auto cancel = answers(false);  // it is asked whether the run is to end
      Q_EMIT machine->secondaryTriggered(QString::fromLatin1(action));
      QVERIFY(bench.job() != nullptr && bench.job()->path() == path);
      QVERIFY(bench.tasks().running());
    }
    QVERIFY(!bench.closeJob().has_value());
    QVERIFY(!bench.openJob(otherJob().toStdString()).has_value());
    QVERIFY(!bench.createJob(m_folder.filePath(QStringLiteral("refused.zdj")).toStdString()).has_value());
    QVERIFY(!QFile::exists(m_folder.filePath(QStringLiteral("refused.zdj"))));
    QVERIFY(!bench.loadProfile(m_folder.filePath(QStringLiteral("profile.json")).toStdString()).has_value());
    QVERIFY(bench.tasks().running());
    auto* page = qobject_cast<zerodrift::ui::WarmupPage*>(application.presenter(QStringLiteral("warmup"))->page());
    const auto rows = page->state().samples;
    QTRY_VERIFY_WITH_TIMEOUT(page->state().samples > rows, 20000);
    // The window closes in the middle of it: what was recorded is in the job, and the run can be gone on with.
  }

  void aRunThatWasBrokenOffIsSeen() {
    const auto path = m_runJob;
    QVERIFY(!path.empty());
    Application application(m_theme);
    show(application);
    QVERIFY(application.bench().openJob(path).has_value());
    application.openPage(QStringLiteral("warmup"));
    auto* page = qobject_cast<zerodrift::ui::WarmupPage*>(application.presenter(QStringLiteral("warmup"))->page());
    QCOMPARE(page->state().phase, zerodrift::ui::RunPhase::interrupted);
    QVERIFY(page->state().samples > 0);
    QVERIFY(page->state().elapsed_s > 0.0);
    QVERIFY(!page->state().largestErrorAxis.isEmpty());
    QVERIFY(!page->state().plan.isEmpty());
    // Another run instead: the plan is there to be chosen.
    Q_EMIT page->secondaryTriggered(QStringLiteral("again"));
    QCOMPARE(page->state().phase, zerodrift::ui::RunPhase::planning);
  }

  /// The machine goes away for good in the middle: the page says since when, and Finish ends the run with what there
  /// is.
  void finishEndsARunWhoseControllerIsAway() {
    Application application(m_theme);
    show(application);
    QVERIFY(connected(application));
    auto& bench = application.bench();
    QVERIFY(startRun(application));
    auto* page = qobject_cast<zerodrift::ui::WarmupPage*>(application.presenter(QStringLiteral("warmup"))->page());
    QTRY_VERIFY_WITH_TIMEOUT(page->state().samples > 5, 30000);
    application.openPage(QStringLiteral("warmup"));
    stopMachine();
    QTRY_VERIFY_WITH_TIMEOUT(bench.lost(), 30000);
    QTRY_VERIFY_WITH_TIMEOUT(!page->state().silentSince.isEmpty(), 30000);
    const auto guard = answers(true);
    Q_EMIT page->secondaryTriggered(QStringLiteral("finish"));
    QTRY_VERIFY_WITH_TIMEOUT(!bench.tasks().running(), 60000);
    QVERIFY2(bench.has("warmup"), qPrintable(page->problem().sentence));
    QCOMPARE(page->state().phase, zerodrift::ui::RunPhase::finished);
    QVERIFY(bench.body("warmup").at("rows").get<int>() > 5);
  }

  void physicsWithoutADescriptionAsksForOneAndThrowsNothing() {
    Application application(m_theme);
    show(application);
    QVERIFY(application.bench().openJob(otherJob().toStdString()).has_value());
    application.openPage(QStringLiteral("physics"));  // what throws here ends this test
    auto* page = qobject_cast<zerodrift::ui::PhysicsPage*>(application.presenter(QStringLiteral("physics"))->page());
    QVERIFY(page->state().undescribed);
    page->experimentRequested();
    Q_EMIT page->secondaryTriggered(QStringLiteral("region"));
    QTRY_VERIFY_WITH_TIMEOUT(!application.bench().tasks().running(), 20000);
  }

  void ordersWhileWorkRuns() {
    const int orders = qEnvironmentVariableIntValue("ZERODRIFT_ORDERS");
    const int seed = qEnvironmentVariableIntValue("ZERODRIFT_SEED");
    QRandomGenerator random(seed > 0 ? static_cast<quint32>(seed) : 20261129);
    for (int order = 0; order < std::max(8, orders); ++order) {
      orderOfWork(random, order);
      if (QTest::currentTestFailed()) {
        qWarning("in order %d", order);
        return;
      }
    }
  }

 private:
  static void show(Application& application) {
    application.window().resize(1280, 800);
    application.window().show();
  }

  /// A picture of every page, opened one after the other, when what it began by itself is done.
  static QHash<QString, QImage> visited(Application& application) {
    QHash<QString, QImage> pictures;
    for (auto* presenter : application.presenters()) {
      application.openPage(presenter->id());
      [[maybe_unused]] const bool idle =
          QTest::qWaitFor([&] { return !application.bench().tasks().running(); }, 120000);
      if (presenter->id() == QStringLiteral("report")) {  // its preview is drawn when it rests
        auto* page = qobject_cast<zerodrift::ui::ReportPage*>(presenter->page());
        const bool drawn =
            QTest::qWaitFor([&] { return !page->state().blocked.isEmpty() || !page->state().pages.isEmpty(); }, 60000);
        if (!drawn) qWarning("no preview");
      }
      presenter->page()->clearProblem();
      QTest::qWait(300);  // plots are drawn when they rest
      QImage picture = presenter->page()->grab().toImage();
      pictures[presenter->id()] = picture;
    }
    return pictures;
  }

  QString sampleJob() {
    const QString path = m_folder.filePath(QStringLiteral("sample-%1.zdj").arg(++m_jobs));
    QFile::copy(QStringLiteral(ZERODRIFT_SOURCE_DIR "/resources/samples/sample.zdj"), path);
    QFile::setPermissions(path, QFile::ReadOwner | QFile::WriteOwner);
    return path;
  }

  /// A job from a file only, up to its model.
  QString otherJob() {
    if (!m_otherJob.isEmpty()) return m_otherJob;
    const QString run = m_folder.filePath(QStringLiteral("other-run.csv"));
    QFile file(run);
    if (!file.open(QIODevice::WriteOnly) || file.write(other_run()) < 0) return {};
    file.close();
    Application application(m_theme);
    const QString path = m_folder.filePath(QStringLiteral("other.zdj"));
    if (!application.bench().createJob(path.toStdString())) return {};
    application.findChild<zerodrift::desktop::FileOpener*>()->setAsking(false);
    application.openFiles({run});
    for (const char* page : {"sensors", "fit"}) {
      application.openPage(QString::fromLatin1(page));
      if (!QTest::qWaitFor([&] { return !application.bench().tasks().running(); }, 120000)) return {};
    }
    m_otherJob = path;
    return path;
  }

  bool startMachine() {
    if (m_machine != nullptr && m_machine->state() == QProcess::Running) return true;
    m_machine = std::make_unique<QProcess>();
    zerodrift::desktop::end_with_parent(*m_machine);
    m_profile = m_folder.filePath(QStringLiteral("machine-%1.json").arg(++m_jobs));
    m_machine->start(QStringLiteral(ZERODRIFT_BIN_DIR "/zerodrift-machine"),
                     {QStringLiteral("--speedup"), QStringLiteral("240"), QStringLiteral("--seed"),
                      QString::number(sample_seed), QStringLiteral("--port"), QStringLiteral("0"),
                      QStringLiteral("--camera-port"), QStringLiteral("0"), QStringLiteral("--profile"), m_profile});
    return QTest::qWaitFor([this] { return m_machine->readAllStandardOutput().contains("ready "); }, 30000);
  }

  void stopMachine() {
    if (m_machine == nullptr) return;
    m_machine->kill();
    m_machine->waitForFinished(5000);
    m_machine.reset();
  }

  /// A new job on the virtual machine, tested and calibrated as if by probes would be too short: by its cameras.
  bool connected(Application& application) {
    auto& bench = application.bench();
    if (!startMachine()) return false;
    const QString path = m_folder.filePath(QStringLiteral("run-%1.zdj").arg(++m_jobs));
    if (!bench.loadProfile(m_profile.toStdString()) || !bench.createJob(path.toStdString())) return false;
    m_runJob = path.toStdString();
    bench.connectMachine();
    return toured(application, "machine") && toured(application, "calibrate");
  }

  bool startRun(Application& application) {
    auto* presenter = application.presenter(QStringLiteral("warmup"));
    application.openPage(QStringLiteral("warmup"));
    const auto guard = answers(true);
    Q_EMIT presenter->page()->primaryTriggered();
    auto* page = qobject_cast<zerodrift::ui::WarmupPage*>(presenter->page());
    return QTest::qWaitFor([&] { return application.bench().tasks().running() && page->state().samples > 0; }, 60000);
  }

  static bool toured(Application& application, const char* page) {
    bool good = false;
    bool ended = false;
    application.presenter(QString::fromLatin1(page))->tour([&](bool how) {
      good = how;
      ended = true;
    });
    return QTest::qWaitFor([&] { return ended; }, 90000) && good;
  }

  /// Answers every question as long as what is returned lives.
  std::unique_ptr<QTimer> answers(std::function<bool()> yes) {
    auto timer = std::make_unique<QTimer>();
    connect(timer.get(), &QTimer::timeout, this, [yes = std::move(yes)] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      if (box == nullptr) return;
      const bool agree = yes();
      for (auto* button : box->buttons()) {
        if ((box->buttonRole(button) == QMessageBox::AcceptRole) == agree) return button->click();
      }
    });
    timer->start(20);
    return timer;
  }
  std::unique_ptr<QTimer> answers(bool yes) {
    return answers([yes] { return yes; });
  }

  /// Every page shows the job that is open, or that there is none.
  void showsItsOwnJob(Application& application) {
    auto& bench = application.bench();
    const auto page = [&]<class Page>(const char* id, Page*) {
      auto* presenter = application.presenter(QString::fromLatin1(id));
      application.openPage(presenter->id());
      return qobject_cast<Page*>(presenter->page());
    };
    const bool warmup = bench.has("warmup");
    const auto& run = page("warmup", static_cast<zerodrift::ui::WarmupPage*>(nullptr))->state();
    if (!warmup && run.phase == zerodrift::ui::RunPhase::finished) QFAIL("a run of another job");
    if (warmup && run.phase == zerodrift::ui::RunPhase::finished) {
      QCOMPARE(run.samples, bench.body("warmup").value("rows", qint64{-1}));
    }
    const auto& sensors = page("sensors", static_cast<zerodrift::ui::SensorsPage*>(nullptr))->state();
    QCOMPARE(sensors.blocked.isEmpty(), warmup);
    if (!bench.has("sensors")) QVERIFY(sensors.sensors.isEmpty());
    const auto& fit = page("fit", static_cast<zerodrift::ui::FitPage*>(nullptr))->state();
    QCOMPARE(fit.blocked.isEmpty(), bench.has("sensors"));
    QCOMPARE(fit.standing != zerodrift::ui::FitStanding::none, bench.has("model"));
    if (!bench.has("model")) QVERIFY(fit.series.isEmpty());
    const auto& physics = page("physics", static_cast<zerodrift::ui::PhysicsPage*>(nullptr))->state();
    if (!bench.has("physics")) QCOMPARE(physics.verdict, zerodrift::ui::PhysicsVerdict::none);
    if (!warmup) QVERIFY(physics.channels.isEmpty());
    const auto& upload = page("upload", static_cast<zerodrift::ui::UploadPage*>(nullptr))->state();
    QCOMPARE(upload.blocked.isEmpty(), bench.has("model"));
    const auto& verify = page("verify", static_cast<zerodrift::ui::VerifyPage*>(nullptr))->state();
    if (!bench.has("verification")) QVERIFY(verify.results.isEmpty());
    const auto& report = page("report", static_cast<zerodrift::ui::ReportPage*>(nullptr))->state();
    QCOMPARE(report.blocked.isEmpty(), warmup);
  }

  struct Seen {
    QHash<QString, qint64> rows;  // by job file: rows of its last run that the window has shown
  };

  void orderOfWork(QRandomGenerator& random, int order) {
    QVERIFY(startMachine());
    const auto any = [&random](int below) { return random.bounded(below); };
    // Warm-ups, verifications and tables: of this order's own jobs, so that no order depends on the one before.
    QStringList jobs = {sampleJob(), sampleJob(), m_folder.filePath(QStringLiteral("empty-%1.zdj").arg(order))};
    auto application = std::make_unique<Application>(m_theme);
    show(*application);
    auto& first = application->bench();
    QVERIFY(first.loadProfile(m_profile.toStdString()).has_value());
    QVERIFY(first.openJob(jobs.first().toStdString()).has_value());
    first.connectMachine();
    QTRY_VERIFY_WITH_TIMEOUT(application->bench().connected(), 20000);
    const auto guard = answers([&random] { return random.bounded(8) != 0; });
    QHash<QString, qint64> seen;
    for (int deed = 0; deed < 6; ++deed) {
      auto& bench = application->bench();
      if (!bench.tasks().running()) beginWork(*application, any(15));
      QTest::qWait(any(4) == 0 ? any(900) : any(150));
      note(*application, seen);
      auto* machine = application->presenter(QStringLiteral("machine"));
      switch (any(6)) {
        case 0: {  // New
          const QString path = m_folder.filePath(QStringLiteral("new-%1-%2.zdj").arg(order).arg(deed));
          if (bench.createJob(path.toStdString())) jobs << path;
          break;
        }
        case 1:  // Open
          application->openFiles({jobs[any(2)]});
          break;
        case 2:  // Other job
          Q_EMIT machine->page()->secondaryTriggered(QStringLiteral("job"));
          break;
        case 3:  // Disconnect, and again
          Q_EMIT machine->page()->secondaryTriggered(QStringLiteral("disconnect"));
          bench.connectMachine();
          break;
        case 4:
          bench.tasks().cancel();
          break;
        default:  // Close the window, in the middle of whatever runs
          if (any(2) == 0) break;
          application.reset();
          application = std::make_unique<Application>(m_theme);
          show(*application);
          QVERIFY(application->bench().loadProfile(m_profile.toStdString()).has_value());
          QVERIFY(application->bench().openJob(jobs[any(2)].toStdString()).has_value());
          application->bench().connectMachine();
      }
      QTest::qWait(any(60));
      application->openPage(application->presenters()[static_cast<std::size_t>(any(11))]->id());
    }
    endWork(*application);
    showsItsOwnJob(*application);
    note(*application, seen);
    application.reset();
    for (const QString& path : jobs) {
      if (!QFile::exists(path)) continue;
      const auto job = Job::open(path.toStdString());
      QVERIFY2(job.has_value(), job ? "" : describe(job.error()).c_str());
      const auto checked = job->check();
      QVERIFY(checked.has_value());
      QVERIFY2(checked->ok(), checked->ok() ? "" : describe(checked->problems.front()).c_str());
      if (!seen.contains(path)) continue;
      std::int64_t longest = 0;
      const auto all = job->series();
      QVERIFY(all.has_value());
      for (const auto& series : *all) {
        longest = std::max<std::int64_t>(longest, static_cast<std::int64_t>(job->read_series(series.id)->rows()));
      }
      QVERIFY2(longest >= seen[path], qPrintable(QStringLiteral("%1 of %2 rows").arg(longest).arg(seen[path])));
    }
  }

  void note(Application& application, QHash<QString, qint64>& seen) {
    const auto job = application.bench().job();
    if (job == nullptr) return;
    auto* page = qobject_cast<zerodrift::ui::WarmupPage*>(application.presenter(QStringLiteral("warmup"))->page());
    if (page->state().phase != zerodrift::ui::RunPhase::running) return;
    auto& rows = seen[QString::fromStdString(job->path().string())];
    rows = std::max(rows, page->state().samples);
  }

  /// Asks for one of everything that runs in the window; what the job does not allow is refused by its page.
  void beginWork(Application& application, int which) {
    static constexpr struct {
      const char* page;
      const char* action;  // "": the filled button
    } works[] = {{"machine", "start"}, {"calibrate", "tour"}, {"warmup", "again"},  {"sensors", "any"},
                 {"fit", "again"},     {"physics", "find"},   {"physics", "trial"}, {"upload", "dryRun"},
                 {"upload", "sign"},   {"upload", "tour"},    {"verify", "tour"},   {"compensator", ""},
                 {"report", "tour"},   {"warmup", ""},        {"verify", ""}};
    const auto& work = works[which];
    auto* presenter = application.presenter(QString::fromLatin1(work.page));
    application.openPage(presenter->id());
    if (application.bench().tasks().running() || application.bench().job() == nullptr) return;
    const QString action = QString::fromLatin1(work.action);
    if (action == QStringLiteral("tour")) {
      presenter->tour([](bool) {});
    } else if (presenter->id() == QStringLiteral("fit")) {
      auto* page = qobject_cast<zerodrift::ui::FitPage*>(presenter->page());
      if (page->state().blocked.isEmpty()) Q_EMIT page->methodChosen(QStringLiteral("ridge"));
    } else if (action.isEmpty()) {
      if (presenter->page()->primaryAction().enabled) Q_EMIT presenter->page()->primaryTriggered();
    } else if (presenter->page()->primaryAction().text.isEmpty() || !presenter->page()->secondaryActions().isEmpty()) {
      Q_EMIT presenter->page()->secondaryTriggered(action);
      if (presenter->id() == QStringLiteral("warmup")) Q_EMIT presenter->page()->primaryTriggered();
    }
  }

  static void endWork(Application& application) {
    auto& tasks = application.bench().tasks();
    for (int i = 0; i < 5; ++i) {
      tasks.cancel();
      if (QTest::qWaitFor([&] { return !tasks.running(); }, 60000)) QTest::qWait(50);
    }
  }

  std::unique_ptr<QProcess> m_machine;
  QString m_profile;
  QString m_otherJob;
  std::filesystem::path m_runJob;
  int m_jobs = 0;
};

QTEST_MAIN(JobChangeTest)
#include "job_change_test.moc"
