// The window over an empty workbench and over jobs that cannot be read: what is not there is said, nothing is invented.

#include <QApplication>
#include <QFile>
#include <QSettings>
#include <QTemporaryDir>
#include <QTest>

#include "app/desktop/application.h"
#include "app/desktop/physics_search.h"
#include "app/desktop/physics_view.h"
#include "ui/widgets/empty_state.h"

using zerodrift::desktop::Application;
using zerodrift::ui::EmptyState;
using zerodrift::ui::ProblemKind;

class DesktopTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() {
    QVERIFY(m_folder.isValid());
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, m_folder.path());
    QSettings::setDefaultFormat(QSettings::NativeFormat);
    m_theme = std::make_unique<zerodrift::ui::Theme>(*qApp);
  }

  /// Every page opens without a job, has its head, and the pages of later steps say what is needed first.
  void emptyWorkbench() {
    Application application(*m_theme);
    application.show();
    QCOMPARE(application.presenters().size(), std::size_t{10});
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
    Application application(*m_theme);
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
    Application application(*m_theme);
    application.show();
    application.openJob(path);
    const auto& problem = application.presenters().front()->page()->problem();
    QVERIFY(application.bench().job() == nullptr);
    QCOMPARE(problem.kind, ProblemKind::failure);
    QVERIFY2(problem.sentence.contains(QStringLiteral("damaged-")), qPrintable(problem.sentence));
    QVERIFY(!problem.remedy.isEmpty());
  }

  /// The banner of a failure goes when the next try succeeds.
  void bannerGoes() {
    Application application(*m_theme);
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

  QTemporaryDir m_folder;
  std::unique_ptr<zerodrift::ui::Theme> m_theme;
};

QTEST_MAIN(DesktopTest)
#include "desktop_test.moc"
