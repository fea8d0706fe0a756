// The window over an empty workbench and over jobs that cannot be read: what is not there is said, nothing is invented.

#include <QApplication>
#include <QDir>
#include <QFile>
#include <QTest>

#include "app/desktop/application.h"
#include "app/desktop/company.h"
#include "app/desktop/map_editor.h"
#include "app/desktop/physics_search.h"
#include "app/desktop/physics_view.h"
#include "app/desktop/steps/axis_errors_presenter.h"
#include "app/desktop/table_export.h"
#include "app/desktop/upload_view.h"
#include "core/controller/table_words.h"
#include "tests/app/test_home.h"
#include "ui/pages/axis_page.h"
#include "ui/pages/fit_page.h"
#include "ui/pages/machine_page.h"
#include "ui/widgets/empty_state.h"

using zerodrift::desktop::Application;
using zerodrift::ui::EmptyState;
using zerodrift::ui::ProblemKind;
using zerodrift::ui::StepState;

class DesktopTest : public QObject, private zerodrift::desktop::TestHome {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() { qputenv("HOME", m_folder.path().toUtf8()); }  // jobs are made in the user's documents

  /// Every page opens without a job, has its head, and the pages of later steps say what is needed first.
  void emptyWorkbench() {
    Application application(m_theme);
    application.show();
    QCOMPARE(application.presenters().size(), std::size_t{11});
    for (auto* presenter : application.presenters()) {
      application.openPage(presenter->id());
      const auto* page = presenter->page();
      QVERIFY2(!page->title().isEmpty(), qPrintable(presenter->id()));
      QVERIFY2(!page->sentence().isEmpty(), qPrintable(presenter->id()));
      QVERIFY2(page->problem().sentence.isEmpty(), qPrintable(presenter->id() + ": " + page->problem().sentence));
      if (presenter->id() == QStringLiteral("machine")) continue;  // where everything begins
      const auto* empty = page->findChild<EmptyState*>();
      QVERIFY2(empty != nullptr && empty->isVisibleTo(page), qPrintable(presenter->id()));
      if (presenter->id() == QStringLiteral("axis_errors")) continue;  // begins with a file, not with a step
      const auto primary = page->primaryAction();
      QVERIFY2(!primary.enabled, qPrintable(presenter->id()));
      QVERIFY2(!primary.reason.isEmpty(), qPrintable(presenter->id()));
    }
  }

  /// A job without a single artefact: later pages are still empty, none fails.
  void newJob() {
    Application application(m_theme);
    const auto path = m_folder.filePath(QStringLiteral("new.zdj")).toStdString();
    QVERIFY(application.bench().createJob(path).has_value());
    for (auto* presenter : application.presenters()) {
      application.openPage(presenter->id());
      QVERIFY2(presenter->page()->problem().sentence.isEmpty(), qPrintable(presenter->id()));
    }
  }

  /// The name stays under its seal until the answer is given; then the promise can be checked.
  void blindTrial() {
    using namespace zerodrift::desktop;
    const QString program = QStringLiteral(ZERODRIFT_BIN_DIR) + QStringLiteral("/zerodrift-machine");
    const auto trial = make_trial(program, 5, {});
    QVERIFY(trial.has_value());
    QCOMPARE(trial->seal.size(), std::size_t{64});
    QCOMPARE(trial->simulated.rows(), trial->recorded.rows());
    QVERIFY(!trial_curves(trial->recorded, trial->simulated, {}).isEmpty());
    const auto answer = answer_trial(*trial, {});
    QVERIFY(answer.has_value());
    QVERIFY(!answer->effects.empty());
    const auto opened = open_trial(*trial);
    QVERIFY(opened.has_value());
    QVERIFY(opened->kept);
    QVERIFY(!opened->hidden.empty());
    TrialCase forged = *trial;
    forged.seal[0] = forged.seal[0] == '0' ? '1' : '0';
    QVERIFY(!open_trial(forged)->kept);
    QVERIFY(!make_trial(QStringLiteral("/no/such/program"), 5, {}).has_value());
  }

  /// A list of registers becomes the draft, is edited, saved, and then is what the profile uses.
  void registerMap() {
    using namespace zerodrift;
    Application application(m_theme);
    const auto file = [&](const char* name, const QByteArray& content) {
      QFile out(m_folder.filePath(QString::fromLatin1(name)));
      if (out.open(QIODevice::WriteOnly)) out.write(content);
      return out.fileName();
    };
    const QString profile = file("profile.json", R"({"format": "zerodrift-profile/1", "name": "M", "controller":
      {"kind": "modbus-tcp", "host": "127.0.0.1", "port": 1}})");
    QVERIFY(application.bench().loadProfile(profile.toStdString()).has_value());
    auto* page = qobject_cast<ui::MachinePage*>(application.presenters().front()->page());
    QVERIFY(page->state().registers.size() > 40);  // the shipped map
    QVERIFY(!page->state().mapChanged);
    auto* editor = page->findChild<desktop::MapEditor*>();
    QVERIFY(editor != nullptr);
    const QString list = file("plc.csv", "name,address,type,scale\ntemperature_C[1],40011,INT,0.1\nM7,40004,WORD,\n");
    QVERIFY(editor->import(list).has_value());
    QCOMPARE(page->state().registers.size(), 2);
    QVERIFY(page->state().mapChanged);
    QVERIFY(page->state().mapNotes.contains(QStringLiteral("table")));
    Q_EMIT page->registerEdited(0, ui::RegisterTable::name, QStringLiteral("ambient_C"));  // M7, at address 3
    Q_EMIT page->registerEdited(1, ui::RegisterTable::scale, QStringLiteral("-0.25"));
    Q_EMIT page->registerEdited(1, ui::RegisterTable::order, QStringLiteral("CDAB"));
    Q_EMIT page->registerEdited(1, ui::RegisterTable::address, QStringLiteral("far"));  // refused, and says so
    QVERIFY(!page->problem().sentence.isEmpty());
    QCoreApplication::processEvents();
    const QString saved = m_folder.filePath(QStringLiteral("own.json"));
    QVERIFY(editor->save(saved).has_value());
    QVERIFY(!page->state().mapChanged);
    QCOMPARE(application.bench().profile()->controller.register_map, saved.toStdString());
    const auto map = controller::load_register_map(saved.toStdString());
    QVERIFY(map.has_value());
    QCOMPARE(map->registers.at("temperature_C").address, 10);
    QCOMPARE(map->registers.at("temperature_C").sign, -1);
    QCOMPARE(map->registers.at("temperature_C").scale, 0.25);
    QVERIFY(!map->registers.at("temperature_C").high_word_first);
    QCOMPARE(map->registers.at("ambient_C").address, 3);
  }

  /// A list of kinds that a person can read, and files beside the job.
  void filesAreOfferedByNameBesideTheJob() {
    using namespace zerodrift;
    Application application(m_theme);
    QCOMPARE(application.bench().folder(), QDir::homePath());
    const QDir folder(m_folder.path());
    QVERIFY(folder.mkpath(QStringLiteral("jobs")));
    const QString path = folder.filePath(QStringLiteral("jobs/one.zdj"));
    QVERIFY(application.bench().createJob(path.toStdString()).has_value());
    QCOMPARE(application.bench().folder(), folder.filePath(QStringLiteral("jobs")));
    for (const auto& format : controller::export_formats()) {
      const QString name = desktop::name_of_format(format);
      const QString maker = name.section(QLatin1Char(':'), 0, 0);
      QVERIFY2(name.contains(QStringLiteral("compensation")), qPrintable(name));
      QVERIFY2(QByteArray(format.id.data(), static_cast<int>(format.id.size())).startsWith(maker.toLower().toUtf8()),
               qPrintable(name));
    }
  }

  /// Logo and address are kept on this computer, large pictures as small as a logo need be.
  void theCompanyIsKept() {
    using namespace zerodrift;
    QImage large(3000, 900, QImage::Format_RGB32);
    large.fill(Qt::darkBlue);
    const QString file = m_folder.filePath(QStringLiteral("logo.png"));
    QVERIFY(large.save(file));
    ui::CompanyDialog dialog({QStringLiteral("Keller\n1 Mill Lane"), {}});
    QVERIFY(!dialog.takeLogo(m_folder.filePath(QStringLiteral("none.png"))));
    QVERIFY(dialog.takeLogo(file));
    QVERIFY(dialog.company().logo.width() <= 800);
    const QString folder = qEnvironmentVariable("ZERODRIFT_PICTURES");
    if (!folder.isEmpty()) dialog.grab().save(folder + QStringLiteral("/company.png"));
    desktop::keepCompany(dialog.company());
    report::Report report;
    desktop::signWith(desktop::keptCompany(), report);
    QCOMPARE(report.company, (std::vector<std::string>{"Keller", "1 Mill Lane"}));
    QVERIFY(report.logo_png.size() > 50);
    desktop::keepCompany({});
  }

  /// Two axes in one file, another maker's names: read, shown, and the second axis on request.
  void laserTable() {
    using namespace zerodrift;
    Application application(m_theme);
    auto* presenter = qobject_cast<desktop::AxisErrorsPresenter*>(application.presenter(QStringLiteral("axis_errors")));
    presenter->setAsking(false);
    const auto write = [&](const char* name, const QByteArray& content) {
      QFile out(m_folder.filePath(QString::fromLatin1(name)));
      if (out.open(QIODevice::WriteOnly)) out.write(content);
      return out.fileName();
    };
    QVERIFY(
        presenter->load(write("two.csv", "axis,position_mm,error_um\nX,0,1\nX,10,2\nX,20,2\nY,0,3\nY,10,9\nY,20,4\n")));
    auto* page = qobject_cast<ui::AxisPage*>(presenter->page());
    QCOMPARE(page->state().axes, (QStringList{QStringLiteral("X"), QStringLiteral("Y")}));
    QCOMPARE(page->state().mean_um, (QVector<double>{1, 2, 2}));
    Q_EMIT page->axisChosen(1);
    QCOMPARE(page->state().axis, QStringLiteral("Y"));
    QCOMPARE(page->state().mean_um, (QVector<double>{3, 9, 4}));
    QVERIFY(!page->state().optimal.isEmpty());
    QVERIFY(presenter->load(
        write("other.txt", "Pos (mm)\tForward error (mm)\tReverse error (mm)\n0\t0.001\t0.003\n10\t0.002\t0.004\n")));
    QCOMPARE(page->state().mean_um, (QVector<double>{2, 3}));
    QCOMPARE(page->state().runs.size(), 2);
    // The file does not say whose table it is: a person does.
    QCOMPARE(page->state().axes, (QStringList{QStringLiteral("X"), QStringLiteral("Y"), QStringLiteral("Z")}));
    QCOMPARE(page->state().axis, QStringLiteral("X"));
    Q_EMIT page->axisChosen(2);
    QCOMPARE(page->state().axis, QStringLiteral("Z"));
    QCOMPARE(page->state().chosenAxis, 2);
    QVERIFY(!presenter->load(write("bare.txt", "a\tb\n0\t1\n1\t2\n")));  // it cannot be told, and nobody is asked here
    QVERIFY(!page->problem().sentence.isEmpty());
  }

  /// Everything that was active, newest first, the active one marked; what cannot be brought back says why.
  void tableHistory() {
    using namespace zerodrift;
    controller::Profile profile;
    const auto entry = [](const char* id, int version, int content, controller::TableOrigin origin, const char* who) {
      controller::TableEntry one;
      one.id = id;
      one.time = "2026-11-20T08:00:00.000Z";
      one.who = who;
      one.origin = origin;
      one.version = version;
      one.words = std::vector<std::uint16_t>{1, 0, static_cast<std::uint16_t>(content)};
      one.crc = controller::crc_of_words(*one.words);
      return one;
    };
    controller::TableLog log;
    log.entries = {entry("a", 1, 7, controller::TableOrigin::upload, "anna"),
                   entry("b", 2, 8, controller::TableOrigin::correction, "ben"),
                   entry("c", 3, 9, controller::TableOrigin::upload, "ben"),
                   entry("d", 4, 8, controller::TableOrigin::rollback, "anna")};
    log.entries[3].of = "b";
    const auto rows = desktop::history_of(log, controller::ActiveTable{{1, 0, 8}, 4, 0}, profile);
    QCOMPARE(rows.size(), 4);
    QVERIFY(rows[0].active && rows[0].who == QStringLiteral("anna") && !rows[0].blocked.isEmpty());
    QVERIFY(rows[0].how.contains(QLatin1Char('2')));
    QVERIFY(rows[1].blocked.isEmpty() && !rows[1].proposed);
    QVERIFY(!rows[2].blocked.isEmpty());                     // the same table as the active one
    QVERIFY(rows[3].proposed && rows[3].blocked.isEmpty());  // what was active before the table that is
    QVERIFY(!rows[3].when.isEmpty());
    const auto foreign = desktop::history_of(log, controller::ActiveTable{{1, 0, 5}, 9, 0}, profile);
    QCOMPARE(foreign.size(), 5);
    QVERIFY(foreign[0].active && foreign[0].who.isEmpty());
    for (const auto& row : foreign) QVERIFY(!row.proposed);
    QVERIFY(foreign[1].blocked.isEmpty());
    const auto unknown = desktop::history_of(log, std::nullopt, profile);
    QCOMPARE(unknown.size(), 4);
    QVERIFY(!unknown[0].active);
  }

  void damagedJob_data() {
    QTest::addColumn<QByteArray>("content");
    QTest::newRow("text") << QByteArray("this is no job\n");
    QTest::newRow("empty") << QByteArray();
    QTest::newRow("torn") << tornJob();
  }

  void damagedJob() {
    QFETCH(const QByteArray, content);
    const QString path =
        m_folder.filePath(QStringLiteral("damaged-%1.zdj").arg(QLatin1String(QTest::currentDataTag())));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(content);
    file.close();
    Application application(m_theme);
    application.show();
    application.openJob(path);
    const auto& problem = application.presenters().front()->page()->problem();
    QVERIFY(application.bench().job() == nullptr);
    QCOMPARE(problem.kind, ProblemKind::failure);
    QVERIFY2(problem.sentence.contains(QStringLiteral("damaged-")), qPrintable(problem.sentence));
    QVERIFY(!problem.remedy.isEmpty());
  }

  /// A job whose first pages are whole opens; that the rest is not is said all the same.
  void jobDamagedInTheMiddleIsSaid() {
    QFile sample(QStringLiteral(ZERODRIFT_SOURCE_DIR "/resources/samples/sample.zdj"));
    QVERIFY(sample.open(QIODevice::ReadOnly));
    QByteArray bytes = sample.readAll();
    const qsizetype middle = bytes.size() / 2;
    for (qsizetype i = middle; i < middle + 20000; ++i) bytes[i] = static_cast<char>(bytes[i] ^ 0x5a);
    const QString path = m_folder.filePath(QStringLiteral("middle.zdj"));
    QFile file(path);
    QVERIFY(file.open(QIODevice::WriteOnly));
    file.write(bytes);
    file.close();
    Application application(m_theme);
    application.openJob(path);
    const auto& problem = application.presenters().front()->page()->problem();
    QTRY_VERIFY2(problem.sentence.contains(QStringLiteral("middle.zdj")), qPrintable(problem.sentence));
    QCOMPARE(problem.kind, ProblemKind::failure);
    const auto steps = application.window().rail()->steps();
    for (const auto* step : steps) QVERIFY2(step->state() != StepState::current, qPrintable(step->id()));
    QCOMPARE(application.window().rail()->step(QStringLiteral("fit"))->state(), StepState::failed);
    // And a whole one opened after it is done again.
    application.openSample();
    QCOMPARE(application.window().rail()->step(QStringLiteral("fit"))->state(), StepState::current);
  }

  /// The rail says which step is at work, wherever the window is meanwhile.
  void railSaysWhatRuns() {
    Application application(m_theme);
    application.openSample();
    const auto* fit = application.window().rail()->step(QStringLiteral("fit"));
    QCOMPARE(fit->state(), StepState::current);
    bool ended = false;
    QObject::connect(&application.bench().tasks(), &zerodrift::TaskRunner::finished, [&ended] { ended = true; });
    auto* page = qobject_cast<zerodrift::ui::FitPage*>(application.presenter(QStringLiteral("fit"))->page());
    Q_EMIT page->methodChosen(QStringLiteral("mlr"));
    QCOMPARE(fit->state(), StepState::running);
    QCOMPARE(fit->words(), QStringLiteral("Running"));
    QTRY_VERIFY_WITH_TIMEOUT(ended, 60000);
    QTRY_VERIFY(fit->state() != StepState::running);
  }

  /// The banner of a failure goes when the next try succeeds.
  void bannerGoes() {
    Application application(m_theme);
    application.openJob(m_folder.filePath(QStringLiteral("missing.zdj")));
    const auto* page = application.presenters().front()->page();
    QVERIFY(!page->problem().sentence.isEmpty());
    const auto path = m_folder.filePath(QStringLiteral("good.zdj"));
    QVERIFY(zerodrift::commissioning::Job::create(path.toStdString()).has_value());
    application.openJob(path);
    QVERIFY(application.bench().job() != nullptr);
    QVERIFY2(page->problem().sentence.isEmpty(), qPrintable(page->problem().sentence));
  }

 private:
  /// A real job file whose middle was overwritten.
  QByteArray tornJob() const {
    const QString path = m_folder.filePath(QStringLiteral("whole.zdj"));
    if (!zerodrift::commissioning::Job::create(path.toStdString())) return "could not be made";
    QFile file(path);
    if (!file.open(QIODevice::ReadOnly)) return "could not be read";
    QByteArray bytes = file.readAll();
    for (qsizetype i = 100; i < bytes.size(); ++i) bytes[i] = static_cast<char>(i * 37);
    return bytes;
  }
};

QTEST_MAIN(DesktopTest)
#include "desktop_test.moc"
