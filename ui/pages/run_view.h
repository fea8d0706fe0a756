#pragma once
// A run while it happens, for the warm-up and the verification: temperatures above, errors in the middle, inputs
// below on one time axis; channel tables as legends; the camera's picture with the drift trail.

#include <QHash>
#include <QImage>
#include <QStringList>
#include <QVector>
#include <QWidget>

#include "ui/plots/live_plot.h"
#include "ui/widgets/camera_view.h"
#include "ui/widgets/channel_table.h"

class QLabel;
class QVBoxLayout;

namespace zerodrift::ui {

class Card;
struct Figure;
class ProblemBanner;
class ToggleSegment;

struct RunChannel {
  QString id{};     // "T1_C", "dZ_um", "spindle_rpm"
  QString tag{};    // "T1"
  QString label{};  // "Spindle front bearing", for the tip
  QString unit{};
  int decimals = 2;
  QColor color{};       // invalid: by its place in the list
  bool dashed = false;  // for example predicted, not measured
};

struct RunValue {
  QString id{};
  double value = 0.0;  // NaN: no value
  QString state{};
  Judgement judgement = Judgement::none;
};

/// What is wrong with the run now, and what has been.
struct RunTrouble {
  QString now{};         // in a sentence, with what to do; empty: nothing
  QStringList so_far{};  // "controller busy, 12 times, asked again"
  bool ended = false;    // the run is over
};

class RunView : public QWidget {
  Q_OBJECT

 public:
  explicit RunView(QWidget* parent = nullptr);
  void setChannels(const QVector<RunChannel>& temperatures, const QVector<RunChannel>& errors,
                   const QVector<RunChannel>& inputs);
  /// Adds samples to whichever plot has the channel; NaN is a gap.
  void append(const QString& id, const QVector<double>& time_s, const QVector<double>& values);
  void setBand(const QString& id, const QVector<double>& time_s, const QVector<double>& low,
               const QVector<double>& high);
  void clear();
  void setValues(const QVector<RunValue>& values);
  void setRegimes(const QVector<Regime>& regimes, double fastest_rpm);
  void setMarks(const QVector<Mark>& marks);
  void setErrorLimits(const QVector<Limit>& limits);
  void setFrame(const QImage& image, const CameraMarks& marks);
  void setCameraShown(bool shown);
  void setTrouble(const RunTrouble& trouble);
  /// Above the tables.
  void setSide(QWidget* side);
  void retranslate();
  /// How many samples of a channel are drawn.
  qsizetype sampleCount(const QString& id) const;

  // What both pages say of a run whose controller is silent.
  static QString waitingSentence(const QString& since);
  static QString silentReason();
  /// A figure that stands where it was seen last.
  static void markStopped(Figure& figure);

 Q_SIGNALS:
  void noteRequested(double time_s);

 private:
  void makePlots();
  void makeTables();
  void showTrouble();
  void wire(LivePlot* plot, ChannelTable* table);
  static QVector<Curve> curvesOf(const QVector<RunChannel>& channels, bool steps);
  static QVector<ChannelRow> rowsOf(const QVector<RunChannel>& channels);

  ProblemBanner* m_banner;
  RunTrouble m_trouble;
  QStringList m_dismissed;  // kinds of trouble the user has taken note of
  QVBoxLayout* m_right;
  Card* m_plotCard;
  Card* m_cameraCard;
  Card* m_errorCard;
  Card* m_temperatureCard;
  ToggleSegment* m_span;
  LivePlot* m_temperatures;
  LivePlot* m_errors;
  LivePlot* m_inputs;
  QVector<QLabel*> m_headings;
  ChannelTable* m_temperatureTable;
  ChannelTable* m_errorTable;
  CameraView* m_camera;
  QStringList m_inputTags;  // of inputs that are no speed
  QHash<QString, LivePlot*> m_plotOf;
  QHash<QString, RunChannel> m_channels;
  QHash<QString, RunValue> m_values;  // the last of each channel
};

}  // namespace zerodrift::ui
