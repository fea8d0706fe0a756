#pragma once
// Files that come from outside: dropped onto the window, named on the command line (double click), or the sample job.
// Each goes to the page it belongs to.

#include <QObject>
#include <QStringList>

#include "core/base/error.h"

namespace zerodrift::desktop {

class Application;

class FileOpener : public QObject {
  Q_OBJECT

 public:
  explicit FileOpener(Application& application);

  void open(const QStringList& paths);
  /// A fresh copy of the sample job in the folder of jobs: the sample itself cannot be spoiled.
  void openSample();
  /// Without questions, for tests: a recording is taken as if the person had agreed.
  void setAsking(bool asking) { m_asking = asking; }

 private:
  void openOne(const QString& path);
  void openProfile(const QString& path);
  void openPlan(const QString& path);
  void openRecording(const QString& path);
  /// On the page that is open.
  void say(const QString& sentence, const QString& remedy);
  void show(const Error& error);

  Application& m_application;
  bool m_asking = true;
};

}  // namespace zerodrift::desktop
