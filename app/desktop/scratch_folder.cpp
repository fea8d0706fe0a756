#include "app/desktop/scratch_folder.h"

#include <unistd.h>

#include <QDateTime>
#include <QDir>

namespace zerodrift::desktop {
namespace {

constexpr qint64 surely_old_s =
    qint64{24} * 3600;  // without a lock: of a version that had none, or of one just being made

QString lock_of(const QString& folder) {
  return folder + QStringLiteral("/owner.lock");
}

QString place(const QString& below) {
  return below.isEmpty() ? QDir::tempPath() : below;
}

}  // namespace

ScratchFolder::ScratchFolder(const QString& below)
    : m_folder(place(below) + QStringLiteral("/Zerodrift-XXXXXX")),
      m_lock(std::make_unique<QLockFile>(lock_of(m_folder.path()))) {
  m_lock->setStaleLockTime(0);  // stale when the process is gone, however long the program runs
  m_lock->tryLock(0);
}

int sweep_scratch_folders(const QString& below) {
  int swept = 0;
  const QDir parent(place(below));
  const auto folders =
      parent.entryInfoList({QStringLiteral("Zerodrift-??????")}, QDir::Dirs | QDir::NoDotAndDotDot | QDir::NoSymLinks);
  for (const QFileInfo& folder : folders) {
    if (folder.ownerId() != ::getuid()) continue;
    const QString path = folder.absoluteFilePath();
    if (QFileInfo::exists(lock_of(path))) {
      QLockFile lock(lock_of(path));
      lock.setStaleLockTime(0);
      if (!lock.tryLock(0)) continue;
      lock.unlock();
    } else if (folder.lastModified().secsTo(QDateTime::currentDateTime()) < surely_old_s) {
      continue;
    }
    if (QDir(path).removeRecursively()) ++swept;
  }
  return swept;
}

}  // namespace zerodrift::desktop
