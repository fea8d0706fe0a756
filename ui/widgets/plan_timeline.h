#pragma once
// The warm-up plan as blocks over time: width is duration, height is spindle speed, a strip at the foot is coolant.
// Drag a block's right edge to change its duration, its top to change its speed.

#include <QRectF>
#include <QVector>
#include <QWidget>

namespace zerodrift::ui {

struct PlanStepRow {
  double duration_s = 3600.0;
  double speed_rpm = 3000.0;
  bool coolant = false;
  bool cycle = true;  // axes run the fixed path; else they stand

  bool operator==(const PlanStepRow& other) const = default;
};

class PlanTimeline : public QWidget {
  Q_OBJECT

 public:
  explicit PlanTimeline(QWidget* parent = nullptr);
  void setSteps(const QVector<PlanStepRow>& steps);
  const QVector<PlanStepRow>& steps() const { return m_steps; }
  void setFastest(double speed_rpm);
  /// Marks of the measurements along the foot.
  void setMeasurePeriod(double period_s);
  void setReadOnly(bool readOnly);
  /// Where the run is; negative: not running.
  void setNow(double time_s);
  int selectedStep() const { return m_selected; }
  void selectStep(int index);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 Q_SIGNALS:
  void edited();  // by dragging or keyboard
  void selectionChanged(int index);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mouseReleaseEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;

 private:
  enum class Grip {
    none,
    duration,
    speed,
  };
  double total() const;
  QRectF field() const;
  QRectF block(int index) const;
  Grip gripAt(const QPointF& at, int* index) const;
  void paintBlock(QPainter& painter, int index) const;
  void paintScale(QPainter& painter) const;

  QVector<PlanStepRow> m_steps;
  double m_fastest_rpm = 8000.0;
  double m_measurePeriod_s = 0.0;
  double m_now_s = -1.0;
  int m_selected = 0;
  bool m_readOnly = false;
  Grip m_grip = Grip::none;
  int m_gripped = -1;
  double m_gripScale_s_per_px = 1.0;
  QPointF m_gripStart;
  PlanStepRow m_gripStep;
};

}  // namespace zerodrift::ui
