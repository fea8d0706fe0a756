#pragma once
// A machine component drawn along x, fixed end at the left: heat sources, sensors, recommended region, where heat is
// missing. Stands above the map of missing heat, whose position axis it shares.

#include <QString>
#include <QVector>
#include <QWidget>
#include <functional>

#include "ui/widgets/colors.h"

namespace zerodrift::ui {

struct DrawnSource {
  QString label{};
  double from_mm = 0.0;
  double to_mm = 0.0;
};

struct DrawnSensor {
  QString tag{};
  double position_mm = 0.0;
  Judgement judgement = Judgement::none;  // how well the simulation agrees there
};

struct DrawnComponent {
  QString name{};
  double length_mm = 1.0;
  double diameter_mm = 60.0;
  QVector<DrawnSource> sources{};
  QVector<DrawnSensor> sensors{};
  double regionFrom_mm = 0.0;  // recommended sensor region; equal ends: none
  double regionTo_mm = 0.0;
  double mismatchFrom_mm = 0.0;  // where heat is missing; equal ends: none
  double mismatchTo_mm = 0.0;
};

class ComponentDrawing : public QWidget {
  Q_OBJECT

 public:
  explicit ComponentDrawing(QWidget* parent = nullptr);
  void setComponent(const DrawnComponent& component);
  /// Aligns with a plot below: where a position stands, in this widget's px.
  void setScale(std::function<double(double position_mm)> toPixel);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 protected:
  void paintEvent(QPaintEvent* event) override;

 private:
  double px(double position_mm) const;
  void paintBody(QPainter& painter, const QRectF& body) const;
  void paintSensors(QPainter& painter, const QRectF& body) const;

  DrawnComponent m_component;
  std::function<double(double)> m_toPixel;
};

}  // namespace zerodrift::ui
