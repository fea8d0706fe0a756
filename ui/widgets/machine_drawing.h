#pragma once
// A five-axis machine with dual rotary table, drawn with its sensors where they sit. A click selects.

#include <QHash>
#include <QPointF>
#include <QString>
#include <QVector>
#include <QWidget>

#include "ui/widgets/colors.h"

namespace zerodrift::ui {

struct SensorSpot {
  QString id{};
  QString tag{};    // short, stands in the disc: "7"
  QString label{};  // "X screw nut"
  QString place{};  // component: spindle, headstock, column_front, screw_x, guide_x, trunnion, table, bed, coolant...
  double along = -1.0;  // 0 fixed end .. 1 free end of the component; negative: anywhere on it
  QString value{};      // with unit
  Judgement judgement = Judgement::none;
  double warmth = -1.0;  // 0 cold .. 1 warmest of all, fills the disc; negative: unknown
};

class MachineDrawing : public QWidget {
  Q_OBJECT

 public:
  explicit MachineDrawing(QWidget* parent = nullptr);
  void setSensors(const QVector<SensorSpot>& sensors);
  void select(const QString& id);
  /// Paler while nothing is connected.
  void setConnected(bool connected);
  QSize sizeHint() const override;
  QSize minimumSizeHint() const override;

 Q_SIGNALS:
  void selected(const QString& id);
  void hovered(const QString& id);

 protected:
  void paintEvent(QPaintEvent* event) override;
  void mouseMoveEvent(QMouseEvent* event) override;
  void mousePressEvent(QMouseEvent* event) override;
  void keyPressEvent(QKeyEvent* event) override;
  void leaveEvent(QEvent* event) override;
  void changeEvent(QEvent* event) override;

 private:
  void place();
  int spotAt(const QPointF& at) const;
  QTransform toScreen() const;
  void paintSpot(QPainter& painter, int index, const QPointF& at, bool marked) const;

  QVector<SensorSpot> m_sensors;
  QVector<QPointF> m_places;  // drawing coordinates of each sensor
  QString m_selected;
  int m_hovered = -1;
  bool m_connected = true;
};

}  // namespace zerodrift::ui
