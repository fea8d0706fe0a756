#pragma once
// From the recorder's thread to the page: updates are collected behind a lock and drained 15 times a second, one redraw
// for all of them. Also the picture of the first camera with the drift trail.

#include <QDateTime>
#include <QObject>
#include <QTimer>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <vector>

#include "app/desktop/workbench.h"
#include "core/acquisition/recorder.h"
#include "core/recording/recording.h"
#include "core/vision/camera_error_source.h"
#include "ui/plots/plot_widget.h"

namespace zerodrift::ui {
class RunView;
}

namespace zerodrift::desktop {

class RunFeed : public QObject {
  Q_OBJECT

 public:
  RunFeed(Workbench& bench, ui::RunView* view, QObject* parent);

  /// Nothing is shown and nothing known any more.
  void forget();
  /// Channels of the profile's machine, and an empty run.
  void begin();
  /// The same, for a run that is gone on with: drawn from its beginning.
  void goOn(const recording::Recording& run, const std::vector<commissioning::Event>& events);
  /// A compensated run: beside what is left, what is applied and what there would be without it.
  void setCompensated(bool compensated) { m_compensated = compensated; }
  /// The kept run that is shown comes from a file: it has other channels than the machine.
  void setImported(bool imported) { m_imported = imported; }
  /// A run that is in the job already.
  void showRecording(const recording::Recording& run, const std::vector<commissioning::Event>& events);
  /// What went wrong in a run that is over: of so many measurements so many with a direction missing.
  void showHappened(const std::vector<acquisition::Happening>& happened, int measurements, int refused);
  void stop();

  // For the step's options; they may be called from the worker thread.
  std::function<void(const acquisition::RunUpdate&)> observer();
  std::function<void(acquisition::RunControl*)> control();
  std::function<void(vision::CameraErrorSource*)> cameras();

  /// Names and colours of the channels, in the language and theme of now.
  void nameChannels();
  bool named() const { return m_named; }

  // What a person asks; nothing when no run is on.
  void pause();
  void resume();
  void finish();
  void abort();
  /// A note of this moment of the run; false: there is no run any more.
  bool note(const QString& text, double time_s);
  bool paused() const;

  /// The newest update, with the fields a page shows; rows are emptied already.
  const acquisition::RunUpdate& now() const { return m_now; }
  double largestError_um() const { return m_largest_um; }
  /// When an error was last measured, in the run's time; negative before the first.
  double measuredAt_s() const { return m_measuredAt_s; }
  QString largestErrorAxis() const { return m_largestAxis; }
  /// Longest machine time between two rows.
  double longestHole_s() const { return m_longestHole_s; }
  bool receiving() const { return m_received; }
  /// Since when the controller of the running run has been silent; not valid: it answers.
  const QDateTime& silentSince() const { return m_silentSince; }

 Q_SIGNALS:
  void updated();

 private:
  struct Shared {
    std::mutex mutex;
    std::vector<acquisition::RunUpdate> updates;
    acquisition::RunControl* control = nullptr;
    vision::CameraErrorSource* cameras = nullptr;
    std::vector<vision::ViewState> states;
  };

  void drain();
  void appendRows(const std::vector<acquisition::RunUpdate>& updates);
  void showPicture();
  void showTrouble();
  QStringList inWords(const std::vector<acquisition::Happening>& happened, int measurements, int refused) const;
  void noteSensors(const std::vector<Error>& problems);
  void noteRow(double time_s);
  void noteErrors(const std::string& channel, double value);
  void appendCompensation(const std::vector<std::string>& names, const QVector<double>& times,
                          const std::vector<QVector<double>>& values);
  void nameImported();
  void showRegimes(const recording::Recording& run);
  void showMarks(const std::vector<commissioning::Event>& events);
  void mark(double at_s, const QString& text);
  void markPause(double at_s);
  void beginPause(double at_s, const std::vector<std::string>& channels);

  Workbench& m_bench;
  ui::RunView* m_view;
  QTimer m_timer;
  std::shared_ptr<Shared> m_shared = std::make_shared<Shared>();
  acquisition::RunUpdate m_now;
  recording::Recording m_speeds;  // time, speed, coolant: for the bands
  double m_largest_um = 0.0;
  double m_measuredAt_s = -1.0;
  double m_longestHole_s = 0.0;
  double m_lastRow_s = -1.0;
  QString m_largestAxis;
  QVector<ui::Mark> m_marks;  // notes and pauses, by time
  QVector<double> m_pauses;
  bool m_pausing = false;
  bool m_received = false;
  QDateTime m_silentSince;
  bool m_named = false;
  bool m_compensated = false;
  bool m_imported = false;
  std::vector<std::string> m_importedNames;     // channels of the imported run that hold anything
  std::map<std::string, QString> m_badSensors;  // now: channel -> what is wrong with it
};

}  // namespace zerodrift::desktop
