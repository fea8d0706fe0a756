#pragma once
// Setting up a rig: its devices and cameras as a form, what is read from them as a table. Passive as a page is: it is
// given what there is and tells what the user does.

#include <QImage>
#include <QRectF>
#include <QString>
#include <QVector>
#include <QWidget>

#include "ui/widgets/item_form.h"
#include "ui/widgets/signal_table.h"

class QLabel;
class QPushButton;
class QStackedWidget;

namespace zerodrift::ui {

class CameraView;
class Card;
class DataTable;
class Histogram;
class ProblemBanner;
class ProgressStrip;
class ToggleSegment;

/// Something a search has found: columns as shown.
struct FoundThing {
  QString what{};    // "unit 3", "/dev/ttyUSB0"
  QString detail{};  // "4.1 ms"
};

struct RigSetupState {
  FormState form{};
  bool canRedo = false;
  QString file{};  // where it is saved; empty: nowhere yet
  bool changed = false;
  QString sentence{};  // what is wrong with the profile; empty: nothing
  QString remedy{};
  // Of the selected item.
  QStringList searches{};  // "ports", "units", "network", "cameras"
  bool canTest = false;
  bool canAddSensors = false;
  bool isCamera = false;
  QString busy{};  // what is searched or tested; empty: nothing
  double fraction = -1.0;
  QVector<FoundThing> found{};
  QString result{};  // of the last search or test, in words
  Judgement resultJudgement = Judgement::none;
  // Signals.
  QVector<SignalLine> lines{};
  QStringList devices{};
  bool live = false;
  bool canLive = false;
  bool preview = false;
};

class RigSetup : public QWidget {
  Q_OBJECT

 public:
  explicit RigSetup(QWidget* parent = nullptr);
  void setState(const RigSetupState& state);
  const RigSetupState& state() const { return m_state; }
  /// What changes while somebody types: the values, and how far a search is.
  void setLines(const QVector<SignalLine>& lines);
  void setProgress(const QString& busy, double fraction);
  /// The selected camera as it sees now; a null image: none.
  void setPicture(const QImage& picture, const QRectF& target, const QVector<int>& counts, const QString& note);
  /// 0 devices and cameras, 1 signals.
  void showView(int index);

 Q_SIGNALS:
  void selected(const QString& path);
  void edited(const QString& path, const QString& key, const QString& value);
  void addRequested(const QString& kind);
  void removeRequested(const QString& path);
  void undoRequested();
  void redoRequested();
  void findRequested(const QString& what);
  void testRequested();
  void cancelRequested();
  void foundChosen(int row);
  void sensorsOfDeviceRequested();
  void signalEdited(int row, int column, const QString& text);
  void sensorAdded();
  void sensorRemoved(int row);
  void liveToggled(bool on);
  void previewToggled(bool on);
  void regionDrawn(const QRectF& region);
  /// What it is given must be said again.
  void languageChanged();

 protected:
  void changeEvent(QEvent* event) override;

 private:
  void makeHead(class QVBoxLayout* into);
  QWidget* makeForm();
  void makeTools(class QVBoxLayout* into);
  QWidget* makeSignals();
  void render();
  void renderTools();
  void renderSignals();
  void retranslate();
  QPushButton* button(const char* name, class QBoxLayout* into);

  RigSetupState m_state;
  Card* m_card;
  ToggleSegment* m_view;
  QLabel* m_file;
  QPushButton* m_undo;
  QPushButton* m_redo;
  ProblemBanner* m_problem;
  QStackedWidget* m_views;
  ItemForm* m_form;
  QVector<QPushButton*> m_search;  // in the order of searchNames()
  QPushButton* m_test;
  QPushButton* m_addSensors;
  ProgressStrip* m_progress;
  DataTable* m_found;
  QLabel* m_result;
  QPushButton* m_preview;
  QWidget* m_cameraBox;
  CameraView* m_camera;
  Histogram* m_histogram;
  QLabel* m_cameraNote;
  SignalTable* m_signals;
  QPushButton* m_addSensor;
  QPushButton* m_removeSensor;
  QPushButton* m_live;
  QLabel* m_signalNote;
};

}  // namespace zerodrift::ui
