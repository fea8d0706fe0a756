#pragma once
// Files that come from outside: dropped onto the window, named on the command line (double click), or the sample job.
// Each goes to the page it belongs to.

#include <QObject>
#include <QStringList>
#include <nlohmann/json_fwd.hpp>

#include "app/desktop/recording_import.h"
#include "core/base/error.h"

namespace zerodrift::recording {
struct Recording;
}

namespace zerodrift::desktop {

class Application;

class FileOpener : public QObject {
  Q_OBJECT

 public:
  explicit FileOpener(Application& application);

  void open(const QStringList& paths);
  /// A fresh copy of the sample job in the folder of jobs: the sample itself cannot be spoiled.
  void openSample();
  /// Lets the user choose a logger's file, for the open job or for a new one from files only.
  void chooseRecording();
  /// Without questions, for tests: a recording is taken as if the person had agreed.
  void setAsking(bool asking) { m_asking = asking; }

 private:
  void openOne(const QString& path);
  void openProfile(const QString& path);
  void openPlan(const QString& path);
  void openMachine(const QString& path);
  void openTable(const QString& path);
  void openRecording(const QString& path);
  void take(const recording::Recording& run, const QString& name, const nlohmann::json& how);
  QVector<RecordingImport::Place> places() const;
  void takeAt(int place, const recording::Recording& run, const QString& name, const nlohmann::json& how);
  /// On the page that is open.
  void say(const QString& sentence, const QString& remedy);
  void show(const Error& error);

  Application& m_application;
  RecordingImport* m_import = nullptr;
  bool m_asking = true;
};

}  // namespace zerodrift::desktop
