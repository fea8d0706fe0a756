#pragma once
// The parts of a machine as they are described: rods along x with their fixed end at the left, lumps as boxes, heat
// sources, sensors, couplings. Lengths of rods are to one scale.

#include <QString>
#include <QVector>
#include <QWidget>

namespace zerodrift::ui {

struct SketchMark {
  QString label{};
  double from_mm = 0.0;
  double to_mm = 0.0;  // of a sensor the same
};

struct SketchPart {
  QString name{};
  bool lump = false;
  double length_mm = 0.0;
  double outer_mm = 0.0;
  QVector<SketchMark> sources{};
  QVector<SketchMark> sensors{};
};

struct SketchCoupling {
  int first = 0;  // part
  double first_mm = 0.0;
  int second = 0;
  double second_mm = 0.0;
  QString label{};
};

struct Sketch {
  QVector<SketchPart> parts{};
  QVector<SketchCoupling> couplings{};
  int current = -1;  // the part that is being edited
};

class MachineSketch : public QWidget {
  Q_OBJECT

 public:
  explicit MachineSketch(QWidget* parent = nullptr);
  void setSketch(const Sketch& sketch);
  QSize sizeHint() const override;

 Q_SIGNALS:
  void partClicked(int part);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;

 private:
  QRectF bodyOf(int part) const;
  double px(int part, double position_mm) const;
  void paintPart(QPainter& painter, int number) const;
  void paintCoupling(QPainter& painter, const SketchCoupling& coupling) const;

  Sketch m_sketch;
};

}  // namespace zerodrift::ui
