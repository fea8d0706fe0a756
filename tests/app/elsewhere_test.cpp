// A job from elsewhere is data: opening it and looking at every page reaches nobody, and whatever its artefacts hold is
// an error on a page and not the end of the program. And the lock: without the PIN nothing is written.

#include <arpa/inet.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <QFile>
#include <QSettings>
#include <QSignalSpy>
#include <QTemporaryDir>
#include <QTest>
#include <QTimer>

#include "app/desktop/application.h"
#include "app/desktop/stall_watch.h"
#include "core/controller/modbus_machine.h"
#include "ui/shell/theme.h"

namespace {

using nlohmann::json;
using zerodrift::access::Permit;
using zerodrift::desktop::Application;

/// Listens, and knows whether anybody came.
class Door {
 public:
  Door() : m_handle(::socket(AF_INET, SOCK_STREAM, 0)) {
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof address;
    auto* generic = reinterpret_cast<sockaddr*>(&address);
    m_good = ::bind(m_handle, generic, size) == 0 && ::listen(m_handle, 8) == 0 &&
             ::getsockname(m_handle, generic, &size) == 0;
    m_port = ntohs(address.sin_port);
  }
  ~Door() { ::close(m_handle); }
  int port() const { return m_good ? m_port : -1; }
  bool knocked() const {
    pollfd wait{m_handle, POLLIN, 0};
    return ::poll(&wait, 1, 0) > 0;
  }

 private:
  int m_handle;
  int m_port = 0;
  bool m_good = false;
};

json profile(int port, const std::string& path) {
  return {{"format", "zerodrift-profile/1"},
          {"name", "elsewhere"},
          {"controller", {{"kind", "modbus-tcp"}, {"host", "127.0.0.1"}, {"port", port}}},
          {"cameras",
           {{{"id", "a"},
             {"url", "http://127.0.0.1:" + std::to_string(port) + path},
             {"axes", {"X", "Z"}},
             {"target_roi_px", {1, 2, 30, 40}}}}}};
}

}  // namespace

class ElsewhereTest : public QObject {
  Q_OBJECT

 private Q_SLOTS:
  void initTestCase() {
    QVERIFY(m_folder.isValid());
    qputenv("XDG_CONFIG_HOME", m_folder.path().toUtf8());
    QSettings::setPath(QSettings::NativeFormat, QSettings::UserScope, m_folder.path());
    m_theme = std::make_unique<zerodrift::ui::Theme>(*qApp);
  }

  void openingReachesNobody() {
    const Door door;
    QVERIFY(door.port() > 0);
    const QString file = jobWith({{"machine", {{"profile", profile(door.port(), "/cam")}}}});
    Application application(*m_theme);
    application.show();
    application.openJob(file);
    QVERIFY(application.bench().job() != nullptr);
    QVERIFY(application.bench().profile().has_value());
    visitEveryPage(application);
    QTest::qWait(1500);
    QVERIFY(!door.knocked());
    // What a person asks for does go out.
    application.bench().connectMachine();
    QTRY_VERIFY_WITH_TIMEOUT(door.knocked(), 60000);
  }

  void whateverAnArtefactHoldsIsNoCrash_data() {
    QTest::addColumn<QString>("body");
    for (const char* body : {"{}", "[]", "null", "\"x\"", "7", "{\"profile\":{}}", "{\"profile\":7}", "{\"series\":99}",
                             "{\"series\":\"x\"}", "{\"record\":{},\"table\":{},\"version\":\"x\",\"states\":7}",
                             "{\"cameras\":[{}],\"source\":\"camera\"}", "{\"chosen\":[1,2],\"clusters\":{}}"}) {
      QTest::newRow(body) << QString::fromLatin1(body);
    }
  }
  void whateverAnArtefactHoldsIsNoCrash() {
    QFETCH(const QString, body);
    std::vector<std::pair<std::string, json>> artefacts;
    for (const char* kind : {"machine", "calibration", "warmup", "sensors", "model", "physics", "upload",
                             "verification", "axis_table", "report"}) {
      artefacts.emplace_back(kind, json::parse(body.toStdString()));
    }
    const QString file = jobWith(artefacts);
    Application application(*m_theme);
    application.show();
    QTimer::singleShot(0, &application, [&] { application.openJob(file); });
    QTest::qWait(50);
    visitEveryPage(application);
    QTRY_VERIFY_WITH_TIMEOUT(!application.bench().tasks().running(), 20000);
  }

  void withoutThePinNothingIsWritten() {
    const Door door;
    Application application(*m_theme);
    auto access = std::make_unique<zerodrift::access::Access>(m_folder.filePath("access.json").toStdString());
    QVERIFY(access->set_pin("", "2718281").has_value());
    access->lock();
    application.bench().useAccess(std::move(access));
    auto& bench = application.bench();
    QVERIFY(!bench.access().permit("writing").has_value());
    const auto document = profile(door.port(), "/cam");
    const auto read = zerodrift::controller::profile_from_json(document, "profile.json");
    QVERIFY(read.has_value());
    auto machine = zerodrift::controller::ModbusMachine::open(*read, Permit::read_only());
    QVERIFY(machine.has_value());
    const auto refused = (*machine)->switch_compensation(true);
    QVERIFY(!refused.has_value());
    QCOMPARE(refused.error().code == zerodrift::ErrorCode::access_locked, true);
    QVERIFY(!door.knocked());
    QVERIFY(bench.access().unlock("2718281").has_value());
    QVERIFY(bench.access().permit("writing").has_value());
  }

 private:
  QString jobWith(const std::vector<std::pair<std::string, json>>& artefacts) {
    const QString file = m_folder.filePath(QStringLiteral("job-%1.zdj").arg(++m_jobs));
    auto job = zerodrift::commissioning::Job::create(file.toStdString());
    if (!job) return {};
    for (const auto& [kind, body] : artefacts) {
      if (!job->put(zerodrift::commissioning::NewArtefact::of(kind, body))) return {};
    }
    return file;
  }

  /// As a person does, by events: what throws there meets the application's net.
  static void visitEveryPage(Application& application) {
    for (const auto* presenter : application.presenters()) {
      QTimer::singleShot(0, &application, [&application, id = presenter->id()] { application.openPage(id); });
      QTest::qWait(60);
    }
  }

  QTemporaryDir m_folder;
  int m_jobs = 0;
  std::unique_ptr<zerodrift::ui::Theme> m_theme;
};

int main(int argc, char** argv) {
  zerodrift::desktop::WatchedApplication application(argc, argv);
  application.onException = [](const QString& what) { qInfo("met: %s", qPrintable(what)); };
  ElsewhereTest test;
  return QTest::qExec(&test, argc, argv);
}

#include "elsewhere_test.moc"
