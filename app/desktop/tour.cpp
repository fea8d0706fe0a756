#include "app/desktop/tour.h"

#include <QApplication>
#include <QDir>
#include <QPixmap>
#include <cstdio>

#include "app/desktop/stall_watch.h"

namespace zerodrift::desktop {
namespace {

constexpr int settle_ms = 1800;  // plots redraw, pictures arrive, the lamps have looked at the machine again
constexpr int live_picture_ms = 30000;

}  // namespace

Tour::Tour(Application& application, QString folder, const QString& size, DemoOptions demo)
    : m_application(application), m_folder(std::move(folder)), m_demo(std::move(demo)) {
  // It drives the machine that it starts itself, and nobody is there to type a PIN.
  m_application.bench().useAccess(std::make_unique<access::Access>());
  const QStringList sides = size.split(QLatin1Char('x'));
  m_application.window().resize(sides.value(0).toInt(), sides.value(1).toInt());
  m_halfway.setInterval(live_picture_ms);
  m_halfway.setSingleShot(true);
  connect(&m_application.demo(), &DemoMachine::failed, this, [this](const QString& why) { end(1, why); });
  connect(&m_halfway, &QTimer::timeout, this,
          [this] { takePicture(m_application.presenters()[m_step]->id() + QStringLiteral("-live")); });
}

void Tour::start() {
  if (!QDir().mkpath(m_folder)) {
    end(1, tr("The folder %1 cannot be made.").arg(m_folder));
    return;
  }
  m_application.show();
  QTimer::singleShot(settle_ms, this, &Tour::begin);
}

void Tour::begin() {
  takePicture(QStringLiteral("start"));
  const QString job = QDir(m_folder).filePath(QStringLiteral("tour.zdj"));
  for (const char* ending : {"", "-wal", "-shm", "-lock"}) QFile::remove(job + QString::fromLatin1(ending));
  m_application.startDemo(m_demo, job);
  nextStep();
}

void Tour::openStep() {
  if (m_step >= m_application.presenters().size()) {
    end(0, tr("The tour is complete."));
    return;
  }
  auto* presenter = m_application.presenters()[m_step];
  std::printf("%02zu %s\n", m_step + 1, qPrintable(presenter->id()));
  std::fflush(stdout);
  m_application.openPage(presenter->id());
  m_halfway.start();
  whenIdle([this, presenter] {
    presenter->tour([this](bool good) {
      m_halfway.stop();
      QTimer::singleShot(settle_ms, this, [this, good] { stepDone(good); });
    });
  });
}

void Tour::whenIdle(const std::function<void()>& then) {
  auto& tasks = m_application.bench().tasks();
  if (!tasks.running()) {
    then();
    return;
  }
  // Some pages begin their work when they are opened.
  connect(
      &tasks, &TaskRunner::finished, this, [this, then] { whenIdle(then); },
      static_cast<Qt::ConnectionType>(Qt::QueuedConnection | Qt::SingleShotConnection));
}

void Tour::stepDone(bool good) {
  const QString id = m_application.presenters()[m_step]->id();
  takePicture(QStringLiteral("%1-%2").arg(m_step + 1, 2, 10, QLatin1Char('0')).arg(id));
  if (!good) {
    const auto& problem = m_application.presenters()[m_step]->page()->problem();
    end(1, QStringLiteral("%1: %2 %3").arg(id, problem.sentence, problem.remedy));
    return;
  }
  ++m_step;
  nextStep();
}

/// In an event of its own: the one that took a picture is not counted, and to open a page is the window's work.
void Tour::nextStep() {
  QTimer::singleShot(0, this, &Tour::openStep);
}

void Tour::takePicture(const QString& name) {
  // What it costs to draw a picture for the folder is not the window's time.
  if (auto* watch = dynamic_cast<WatchedApplication*>(qApp)) watch->count(false);
  m_application.window().grab().save(QDir(m_folder).filePath(name + QStringLiteral(".png")));
}

void Tour::tellStalls() const {
  const auto* watch = dynamic_cast<const WatchedApplication*>(qApp);
  if (watch == nullptr) return;
  const Stall& longest = watch->longest();
  std::printf("window: the longest event took %.1f ms of work, %.1f ms on the wall (%s)\n", longest.work_ms,
              longest.wall_ms, qPrintable(longest.what));
  for (const Stall& stall : watch->stalls()) {
    std::printf("window: stood still %.1f ms, %.1f ms of it work (%s)\n", stall.wall_ms, stall.work_ms,
                qPrintable(stall.what));
  }
}

void Tour::end(int code, const QString& words) {
  tellStalls();
  std::fprintf(code == 0 ? stdout : stderr, "%s\n", qPrintable(words));
  m_application.demo().stop();
  QApplication::exit(code);
}

}  // namespace zerodrift::desktop
