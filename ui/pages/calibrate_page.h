#pragma once
// Calibration of a camera against the machine's own axes (V1, V2): live image, plan of positions, residuals.

#include <QImage>
#include <limits>

#include "ui/pages/page.h"
#include "ui/widgets/camera_view.h"

class QCheckBox;
class QLabel;
class QMenu;
class QPushButton;
class QStackedWidget;

namespace zerodrift::ui {

class Card;
class LevelBar;
class ToggleSegment;
class XyPlot;

enum class PointState {
  planned,
  moving,  // the machine goes there or the picture is being taken
  measured,
  refused,
};

/// One position of the plan, in the two machine axes that this camera sees.
struct CalibrationPoint {
  double right_mm = 0.0;  // along the axis seen to the right
  double up_mm = 0.0;     // along the axis seen upwards
  PointState state = PointState::planned;
  double residualRight_um = 0.0;  // after the fit
  double residualUp_um = 0.0;
  QString reason{};  // why it was refused
};

/// What of the camera's own motion the fixed marks take off.
enum class MarksTakeOff {
  nothing,
  shift,
  shiftTurnScale,
};

struct CalibrateState {
  QString offline{};  // why nothing can be measured now; empty: it can
  QString blocked{};  // why the page cannot be used yet; empty: it can
  QStringList cameras{};
  int camera = 0;
  QString axisRight = "X";
  QString axisUp = "Z";
  bool templateTaken = false;
  int marks = 0;  // fixed ones beside the target
  MarksTakeOff takeOff = MarksTakeOff::nothing;
  double markDistance_mm = std::numeric_limits<double>::quiet_NaN();  // of the target from the middle of the marks
  bool running = false;
  bool waiting = false;  // running, and a person has to agree before the axes move again
  /// The moves that come next: which camera they are for, its place in the sequence, what moves and where it starts.
  QString moveCamera{};
  int moveNumber = 1;
  int moveOf = 1;
  QStringList moveAxes{};
  QString movePosition{};  // "X 0.0 mm, Y 0.0 mm, A 0.0°": these axes go there first
  bool solved = false;
  bool accepted = false;
  QVector<CalibrationPoint> points{};
  double fieldRight_mm = 0.0;  // size of the field of view
  double fieldUp_mm = 0.0;
  double driftRight_mm = 0.0;  // expected drift, half widths: the positions must enclose it
  double driftUp_mm = 0.0;
  double span_mm = 1.6;  // how far the axes move altogether

  double umPerPx = std::numeric_limits<double>::quiet_NaN();
  double umPerPxSigma = std::numeric_limits<double>::quiet_NaN();
  double rotation_deg = std::numeric_limits<double>::quiet_NaN();
  double rms_um = std::numeric_limits<double>::quiet_NaN();
  double rmsLimit_um = 1.0;
  double uncertainty_um = std::numeric_limits<double>::quiet_NaN();
  double uncertaintyLimit_um = 0.5;
  double timeLeft_s = std::numeric_limits<double>::quiet_NaN();
};

/// Help to set the lens and the lamp; NaN: unknown. Focus 0..1, 1 is as sharp as pixels allow; exposure: how bright the
/// bright parts of the target are, 1 is white.
struct ImageQuality {
  double focus = std::numeric_limits<double>::quiet_NaN();
  double exposure = std::numeric_limits<double>::quiet_NaN();
  double saturated_percent = 0.0;
};

class CalibratePage : public Page {
  Q_OBJECT

 public:
  explicit CalibratePage(QWidget* parent = nullptr);
  void setState(const CalibrateState& state);
  const CalibrateState& state() const { return m_state; }
  void setFrame(const QImage& image, const CameraMarks& marks);
  void setQuality(const ImageQuality& quality);
  /// Whether a person has agreed to the next sequence of moves. It serves one sequence: asking takes it back.
  bool takeConsent();

  QString title() const override;
  QString sentence() const override;
  /// Take the template, Measure positions, Accept.
  PageAction primary() const override;
  /// "repeat".
  QVector<PageAction> secondary() const override;
  const QWidget* keepInSight() const override;
  bool steersWork() const override { return m_state.waiting; }

 Q_SIGNALS:
  void cameraChosen(int index);
  void regionDrawn(const QRectF& region_px);
  void markDrawn(const QRectF& region_px);
  void markRemoved(int index);

 protected:
  void render() override;
  void hideEvent(QHideEvent* event) override;

 private:
  Card* makeImageCard();
  Card* makePlanCard();
  QWidget* makeMoves();
  void renderPlan();
  void renderResiduals();
  void renderQuality();
  void renderMoves();
  void renderMarks();
  void fillMarksMenu();
  void setDrawing(CameraView::Drawing drawing);
  QString ownDrift() const;
  QVector<Figure> figures() const;
  int measured() const;

  CalibrateState m_state;
  ImageQuality m_quality;
  Card* m_imageCard;
  Card* m_planCard;
  Card* m_moveCard;
  CameraView* m_view;
  ToggleSegment* m_camera;
  QPushButton* m_region;
  QPushButton* m_marks;
  QMenu* m_marksMenu;
  CameraView::Drawing m_drawing = CameraView::Drawing::none;
  LevelBar* m_focus;
  LevelBar* m_exposure;
  ToggleSegment* m_planView;
  QStackedWidget* m_plots;
  XyPlot* m_plan;
  XyPlot* m_residuals;
  QLabel* m_planNote;
  QCheckBox* m_clear;
  QLabel* m_moveNote;
};

}  // namespace zerodrift::ui
