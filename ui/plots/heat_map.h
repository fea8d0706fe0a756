#pragma once
// A quantity over time and position along a component, for example missing heat in W: diverging colours with zero in
// the middle, sensors as ticks at the edge. Time runs to the right and position upwards from the fixed end, or position
// to the right (under a drawing of the component) and time upwards.

#include "ui/plots/plot_widget.h"

class QCPColorMap;
class QCPColorScale;

namespace zerodrift::ui {

struct HeatMapData {
  double from_s = 0.0, to_s = 1.0;
  double from_mm = 0.0, to_mm = 1.0;
  int columns = 0;           // over time
  int rows = 0;              // over position, first row at from_mm
  QVector<double> values{};  // row by row
  QString unit{};            // "W"
};

struct SensorTick {
  QString tag{};
  double position_mm = 0.0;
};

class HeatMap : public PlotWidget {
  Q_OBJECT

 public:
  explicit HeatMap(QWidget* parent = nullptr);
  void setPositionAcross(bool across);
  void setData(const HeatMapData& data);
  /// The shown positions, when the component is longer than the map.
  void setPositionRange(double from_mm, double to_mm);
  /// Abscissa of a position in this widget's px; only with the position across.
  double positionToPixel(double position_mm) const;
  void setSensors(const QVector<SensorTick>& sensors);
  /// Outlines a region, for example where and when a mismatch was located.
  void setRegion(double from_s, double to_s, double from_mm, double to_mm);
  void flush();

 public Q_SLOTS:
  void fit() override;

 Q_SIGNALS:
  void layoutChanged();  // a drawing that shares the position axis must follow

 protected:
  Near nearest(const QPointF& pixel) const override;
  QString csv() const override;
  void restyle() override;

 private:
  QCPAxis* positionAxis() const;
  QCPAxis* timeAxis() const;

  HeatMapData m_data;
  bool m_across = false;
  QVector<SensorTick> m_sensors;
  QCPColorMap* m_map;
  QCPColorScale* m_scale;
  QCPItemRect* m_region;
};

}  // namespace zerodrift::ui
