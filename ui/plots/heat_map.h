#pragma once
// A quantity over time and position along a component, for example missing heat in W: diverging colours with zero in
// the middle, sensors as ticks at the edge. Position runs upwards from the fixed end.

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
  void setData(const HeatMapData& data);
  void setSensors(const QVector<SensorTick>& sensors);
  /// Outlines a region, for example where and when a mismatch was located.
  void setRegion(double from_s, double to_s, double from_mm, double to_mm);
  void flush();

 public Q_SLOTS:
  void fit() override;

 protected:
  Near nearest(const QPointF& pixel) const override;
  QString csv() const override;
  void restyle() override;

 private:
  HeatMapData m_data;
  QVector<SensorTick> m_sensors;
  QCPColorMap* m_map;
  QCPColorScale* m_scale;
  QCPItemRect* m_region;
};

}  // namespace zerodrift::ui
