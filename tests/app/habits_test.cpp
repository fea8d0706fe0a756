// Habits of a desktop program: files opened by double click or dropped, the sample job, what is remembered from one
// start to the next, undo, the list of keys, and nothing left behind.

#include <sys/wait.h>
#include <unistd.h>

#include <QApplication>
#include <QCryptographicHash>
#include <QProcess>
#include <QSettings>
#include <QShortcut>
#include <QTest>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "app/desktop/application.h"
#include "app/desktop/file_kind.h"
#include "app/desktop/file_opener.h"
#include "app/desktop/scratch_folder.h"
#include "app/desktop/steps/machine_presenter.h"
#include "core/base/resources.h"
#include "core/flow/flow.h"
#include "tests/app/test_home.h"
#include "ui/pages/fit_page.h"
#include "ui/pages/sensors_page.h"
#include "ui/pages/warmup_page.h"
#include "ui/shell/help_panel.h"
#include "ui/widgets/import_dialog.h"

using zerodrift::desktop::Application;
using zerodrift::desktop::FileKind;
using zerodrift::desktop::FileOpener;
using zerodrift::desktop::kind_of_file;

class HabitsTest : public QObject, private zerodrift::desktop::TestHome {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { qputenv("HOME", m_folder.path().toUtf8()); }  // jobs are made in the user's documents

  void fileKinds() {
    QCOMPARE(kind_of_file(write("a.zdj", "")), FileKind::job);
    QCOMPARE(kind_of_file(write("profile.json", R"({"name": "M", "controller": {}})")), FileKind::profile);
    QCOMPARE(kind_of_file(write("plan.json", R"({"name": "p", "steps": []})")), FileKind::plan);
    QCOMPARE(kind_of_file(write("other.json", "[1]")), FileKind::unknown);
    QCOMPARE(kind_of_file(write("torn.json", "{\"steps\"")), FileKind::unknown);
    QCOMPARE(kind_of_file(write("run.csv", "time_s,T1_C,dZ_um\n0,20,0\n")), FileKind::recording);
    QCOMPARE(kind_of_file(write("bom.csv", "\xEF\xBB\xBFtime_s;T1_C\r\n0;20\r\n")), FileKind::recording);
    QCOMPARE(kind_of_file(write("logger.txt", "Zeit [min];Lager [\xC2\xB0\x43]\n0,0;20,1\n0,5;20,2\n")),
             FileKind::recording);
    QCOMPARE(kind_of_file(write("machine.json", R"({"format": "zerodrift-machine/1"})")), FileKind::machine);
    QCOMPARE(kind_of_file(write("laser.csv", "position_mm,error_um\n0,0\n")), FileKind::laser);
    for (const char* name : {"x.rtl", "x.REN", "x.pos"}) QCOMPARE(kind_of_file(write(name, "")), FileKind::laser);
    QCOMPARE(kind_of_file(write("picture.png", "")), FileKind::unknown);
  }

  /// A finished job opens as a copy, every step of it is done, and its report can be written.
  void sampleJob() {
    const auto sample = zerodrift::find_resource("samples/sample.zdj");
    QVERIFY(sample.has_value());
    const auto hash = [&] {
      QFile file(QString::fromStdString(sample->string()));
      return file.open(QIODevice::ReadOnly) ? QCryptographicHash::hash(file.readAll(), QCryptographicHash::Sha256)
                                            : QByteArray();
    };
    const QByteArray before = hash();
    QString job;
    {
      Application application(m_theme);
      application.openSample();
      QVERIFY2(application.presenters().front()->page()->problem().sentence.isEmpty(),
               qPrintable(application.presenters().front()->page()->problem().sentence));
      QVERIFY(application.bench().job() != nullptr);
      job = QString::fromStdString(application.bench().job()->path().string());
      QVERIFY2(job.startsWith(m_folder.path()), qPrintable(job));
      QVERIFY(application.bench().job()->check().has_value());
      for (const char* step : {"machine", "calibrate", "warmup", "sensors", "fit", "physics", "upload", "verify"}) {
        const auto state = zerodrift::flow::status_of(*application.bench().job(), step).state;
        QVERIFY2(state == zerodrift::flow::StepState::current, step);
      }
      for (auto* presenter : application.presenters()) {
        application.openPage(presenter->id());
        QVERIFY2(presenter->page()->problem().sentence.isEmpty(), qPrintable(presenter->id()));
      }
      QTRY_VERIFY_WITH_TIMEOUT(!application.bench().tasks().running(), 60000);
      application.openSample();  // once more: another copy
      QVERIFY(job != QString::fromStdString(application.bench().job()->path().string()));
    }
    const QString report = m_folder.filePath(QStringLiteral("report.html"));
    QCOMPARE(
        QProcess::execute(QStringLiteral(ZERODRIFT_BIN_DIR "/zerodrift-cli"),
                          {QStringLiteral("report"), QStringLiteral("--job"), job, QStringLiteral("--out"), report}),
        0);
    QVERIFY(QFileInfo(report).size() > 50000);
    QCOMPARE(hash(), before);
  }

  /// A recording of another logger becomes the run of a new job; sensors and fit follow without any machine.
  void recordingIsDropped() {
    Application application(m_theme);
    application.findChild<FileOpener*>()->setAsking(false);
    application.openFiles({write("old run.csv", warm_up())});
    QVERIFY(application.bench().job() != nullptr);
    QVERIFY2(application.window().currentPage()->problem().sentence.isEmpty(),
             qPrintable(application.window().currentPage()->problem().sentence));
    QCOMPARE(application.window().currentPage()->id(), QStringLiteral("warmup"));
    const auto body = application.bench().body("warmup");
    QCOMPARE(body.value("source", ""), std::string("file"));
    QCOMPARE(body.at("plan").at("steps").size(), std::size_t{2});
    auto& tasks = application.bench().tasks();
    application.openPage(QStringLiteral("sensors"));
    QTRY_VERIFY_WITH_TIMEOUT(application.bench().has("sensors") && !tasks.running(), 60000);
    application.openPage(QStringLiteral("fit"));
    QTRY_VERIFY_WITH_TIMEOUT(application.bench().has("model") && !tasks.running(), 60000);
    undoes(application);
  }

  void whatCannotBeOpenedIsSaid() {
    Application application(m_theme);
    const auto said = [&] { return application.window().currentPage()->problem().sentence; };
    application.openFiles({write("picture.png", "")});
    QVERIFY2(said().contains(QStringLiteral("picture.png")), qPrintable(said()));
    application.openFiles({m_folder.filePath(QStringLiteral("missing.csv"))});
    QVERIFY2(said().contains(QStringLiteral("missing.csv")), qPrintable(said()));
    application.openFiles({write("cold.csv", "time_s,T1_C\n0,20\n10,20\n")});
    auto* dialog = application.window().findChild<zerodrift::ui::ImportDialog*>();
    QVERIFY(dialog != nullptr);
    QTRY_VERIFY(!dialog->state().reading);
    QVERIFY2(dialog->state().sentence.contains(QStringLiteral("cold.csv")), qPrintable(dialog->state().sentence));
    QVERIFY(!dialog->state().ready);
    dialog->reject();
    QVERIFY(application.bench().job() == nullptr);
    application.openFiles({write("torn.pos", "no laser\n")});
    QCOMPARE(application.window().currentPage()->id(), QStringLiteral("axis_errors"));
    QVERIFY(!said().isEmpty());
  }

  void windowIsAsItWasLeft() {
    const QSize left(1333, 777);
    {
      Application application(m_theme);
      application.show();
      application.window().resize(left);
      application.window().setLogVisible(true);
      QVERIFY(application.window().close());
    }
    Application again(m_theme);
    again.show();
    QCOMPARE(again.window().size(), left);
    QVERIFY(again.window().isLogVisible());
    QSettings().remove(QStringLiteral("window"));
  }

  void recentJobsAreRemembered() {
    const QString path = m_folder.filePath(QStringLiteral("remembered.zdj"));
    {
      Application application(m_theme);
      QVERIFY(zerodrift::commissioning::Job::create(path.toStdString()).has_value());
      application.openFiles({path});
    }
    QCOMPARE(zerodrift::desktop::MachinePresenter::recentJobs().value(0), path);
    QVERIFY(QFile::remove(path));
    QVERIFY(!zerodrift::desktop::MachinePresenter::recentJobs().contains(path));
  }

  /// Every key of the window stands in the list that Shift+F1 shows.
  void keysAreListed() {
    Application application(m_theme);
    application.show();
    application.window().openHelp(QStringLiteral("keys"));
    const QString text = application.window().findChild<zerodrift::ui::HelpPanel*>()->text();
    const auto keys = application.window().findChildren<QShortcut*>(QString(), Qt::FindDirectChildrenOnly);
    QVERIFY(keys.size() >= 9);
    for (const auto* one : keys) {
      const QString name = one->key().toString().replace(QStringLiteral("Return"), QStringLiteral("Enter"));
      QVERIFY2(text.contains(name), qPrintable(name));
    }
    application.window().openHelp(QStringLiteral("about"));
    QVERIFY(application.window().findChild<zerodrift::ui::HelpPanel*>()->text().contains(QStringLiteral("GPL-3.0")));
  }

  /// What a killed program left is swept; what lives, and what belongs to nobody known, stays.
  void leftoversAreSwept() {
    QTemporaryDir place;
    int ends[2];
    QCOMPARE(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {  // as if killed: no destructor runs
      const auto* left = new zerodrift::desktop::ScratchFolder(place.path());
      const QByteArray path = left->path().toUtf8();
      const auto written = write_all(ends[1], path);
      _exit(written ? 0 : 1);
    }
    int status = 1;
    QCOMPARE(waitpid(child, &status, 0), child);
    QCOMPARE(status, 0);
    char path[4096] = {};
    QVERIFY(read(ends[0], path, sizeof path - 1) > 0);
    QVERIFY(QFileInfo::exists(QString::fromUtf8(path)));
    const zerodrift::desktop::ScratchFolder living(place.path());
    QVERIFY(QDir(place.path()).mkdir(QStringLiteral("Zerodrift-abcdef")));  // just being made by another program
    QVERIFY(QDir(place.path()).mkdir(QStringLiteral("other")));
    QCOMPARE(zerodrift::desktop::sweep_scratch_folders(place.path()), 1);
    QVERIFY(!QFileInfo::exists(QString::fromUtf8(path)));
    QVERIFY(QFileInfo::exists(living.path()));
    QCOMPARE(zerodrift::desktop::sweep_scratch_folders(place.path()), 0);
    QCOMPARE(QDir(place.path()).entryList(QDir::Dirs | QDir::NoDotAndDotDot).size(), 3);
  }

 private:
  static bool write_all(int to, const QByteArray& bytes) {
    return ::write(to, bytes.constData(), static_cast<std::size_t>(bytes.size())) == bytes.size();
  }

  QString write(const char* name, const QByteArray& content) const {
    QFile out(m_folder.filePath(QString::fromLatin1(name)));
    if (out.open(QIODevice::WriteOnly)) out.write(content);
    return out.fileName();
  }

  /// Three hours at 3000 rpm and one at rest, six sensors.
  static QByteArray warm_up() {
    QByteArray text = "time_s,spindle_rpm,T1_C,T2_C,T3_C,T4_C,T5_C,T6_C,dX_um,dZ_um\n";
    double T[6] = {20, 20, 20, 20, 20, 20};
    for (int i = 0; i <= 240; ++i) {
      const double rpm = i < 180 ? 3000.0 : 0.0;
      text += QByteArray::number(60 * i) + "," + QByteArray::number(rpm);
      for (int s = 0; s < 6; ++s) {
        T[s] += ((rpm > 0 ? 34.0 - 2.0 * s : 20.0) - T[s]) / (20.0 + 12.0 * s);
        text += "," + QByteArray::number(T[s] + 0.03 * std::sin(1.7 * i * (s + 1)), 'f', 3);
      }
      text += "," + QByteArray::number(0.4 * (T[1] - 20) + 0.05 * std::cos(0.9 * i), 'f', 3);
      text += "," + QByteArray::number(2.5 * (T[0] - 20) + 1.1 * (T[3] - 20) + 0.05 * std::sin(1.1 * i), 'f', 3) + "\n";
    }
    return text;
  }

  /// Number of clusters, a sensor, a method: each is taken back.
  static void undoes(Application& application) {
    auto& tasks = application.bench().tasks();
    const auto chosen = [&] { return application.bench().body("sensors").at("chosen").get<std::set<std::string>>(); };
    const auto idle = [&] { QTRY_VERIFY_WITH_TIMEOUT(!tasks.running(), 60000); };
    auto* fit = qobject_cast<zerodrift::ui::FitPage*>(application.presenter(QStringLiteral("fit"))->page());
    const QString proposed = fit->state().method;
    Q_EMIT fit->methodChosen(QStringLiteral("mlr"));
    idle();
    QCOMPARE(fit->state().method, QStringLiteral("mlr"));
    Q_EMIT application.window().undoRequested();
    idle();
    QCOMPARE(fit->state().method, proposed);
    application.openPage(QStringLiteral("sensors"));
    auto* sensors = qobject_cast<zerodrift::ui::SensorsPage*>(application.presenter(QStringLiteral("sensors"))->page());
    const auto before = chosen();
    const auto clusters = application.bench().body("sensors").at("clusters").size();
    Q_EMIT sensors->clustersChosen(2);
    idle();
    QCOMPARE(application.bench().body("sensors").at("clusters").size(), std::size_t{2});
    Q_EMIT application.window().undoRequested();
    idle();
    QCOMPARE(application.bench().body("sensors").at("clusters").size(), clusters);
    const std::string one = before.count("T2_C") ? "T2_C" : "T6_C";
    Q_EMIT sensors->keptChanged(QString::fromStdString(one), before.count(one) == 0);
    idle();
    QVERIFY(chosen() != before);
    Q_EMIT application.window().undoRequested();
    idle();
    QCOMPARE(chosen(), before);
  }
};

QTEST_MAIN(HabitsTest)
#include "habits_test.moc"
