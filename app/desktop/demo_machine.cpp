#include "app/desktop/demo_machine.h"

#include <QCoreApplication>
#include <QDir>

#include "app/desktop/child_process.h"

namespace zerodrift::desktop {

std::optional<int> virtual_seed_of(unsigned serial) {
  constexpr unsigned first_serial = 850000;
  constexpr unsigned seeds = 10000;
  if (serial < first_serial || serial >= first_serial + seeds) return std::nullopt;
  return static_cast<int>(serial - first_serial);
}

DemoMachine::DemoMachine(QObject* parent) : QObject(parent) {
  m_process.setProcessChannelMode(QProcess::MergedChannels);
  end_with_parent(m_process);
  connect(&m_process, &QProcess::readyReadStandardOutput, this, &DemoMachine::readLines);
  connect(&m_process, &QProcess::errorOccurred, this, [this](QProcess::ProcessError error) {
    if (error == QProcess::FailedToStart) Q_EMIT failed(m_process.errorString());
  });
  connect(&m_process, &QProcess::finished, this, [this] {
    readLines();
    if (!m_ready && !m_stopping)
      Q_EMIT failed(m_words.trimmed().isEmpty() ? tr("it ended at once") : m_words.trimmed());
    m_ready = false;
  });
}

DemoMachine::~DemoMachine() {
  disconnect(&m_process, nullptr, this, nullptr);
  stop();
}

void DemoMachine::start(const DemoOptions& options) {
  stop();
  m_options = options;
  m_stopping = false;
  m_words.clear();
  QStringList arguments = {QStringLiteral("--speedup"),
                           QString::number(options.speedup),
                           QStringLiteral("--paced"),
                           QStringLiteral("--seed"),
                           QString::number(options.seed),
                           QStringLiteral("--port"),
                           QStringLiteral("0"),
                           QStringLiteral("--camera-port"),
                           QStringLiteral("0"),
                           QStringLiteral("--profile"),
                           profilePath(),
                           QStringLiteral("--truth"),
                           truthPath()};
  if (!options.conceal.isEmpty()) arguments << QStringLiteral("--conceal") << options.conceal;
  for (const QString& fault : options.faults) arguments << QStringLiteral("--fault") << fault;
  const QString beside = QDir(QCoreApplication::applicationDirPath()).filePath(QStringLiteral("zerodrift-machine"));
  m_process.start(options.program.isEmpty() ? beside : options.program, arguments);
}

void DemoMachine::stop() {
  m_stopping = true;
  m_ready = false;
  if (m_process.state() == QProcess::NotRunning) return;
  m_process.terminate();
  if (!m_process.waitForFinished(5000)) {
    m_process.kill();
    m_process.waitForFinished(2000);
  }
}

QString DemoMachine::profilePath() const {
  return m_folder.filePath(QStringLiteral("profile.json"));
}

QString DemoMachine::truthPath() const {
  return m_folder.filePath(QStringLiteral("truth.csv"));
}

void DemoMachine::readLines() {
  const QString text = QString::fromUtf8(m_process.readAllStandardOutput());
  m_words += text;
  if (m_ready || !m_words.contains(QStringLiteral("ready modbus="))) return;
  m_ready = true;
  sendPace();
  Q_EMIT ready();
}

void DemoMachine::setWorking(bool working) {
  if (std::exchange(m_working, working) != working) sendPace();
}

void DemoMachine::sendPace() {
  if (!m_ready) return;
  m_process.write(QByteArray::number(static_cast<int>(pace())) + '\n');
  m_process.waitForBytesWritten(100);  // the work that it is for begins now
}

}  // namespace zerodrift::desktop
