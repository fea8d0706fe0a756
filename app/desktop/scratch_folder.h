#pragma once
// A temporary folder that is removed with its owner, also when that was killed: a lock file inside names the process,
// and the next program that starts removes the folders whose process is gone.

#include <QLockFile>
#include <QTemporaryDir>
#include <memory>

namespace zerodrift::desktop {

class ScratchFolder {
 public:
  explicit ScratchFolder(const QString& below = {});
  QString path() const { return m_folder.path(); }
  QString filePath(const QString& name) const { return m_folder.filePath(name); }

 private:
  QTemporaryDir m_folder;
  std::unique_ptr<QLockFile> m_lock;  // ends before the folder does
};

/// Removes what killed programs of this user left below this folder (empty: the system's temporary one); how many.
int sweep_scratch_folders(const QString& below = {});

}  // namespace zerodrift::desktop
