#pragma once
// The solid bodies of the drawn machine, and where on them the sensors of each component sit.

#include <QPointF>
#include <QRectF>
#include <QString>

class QPainter;

namespace zerodrift::ui {

/// Machine coordinates of the drawing: x right, d towards the viewer, z up; about mm.
struct Point3 {
  double x = 0.0, d = 0.0, z = 0.0;
};

QPointF project(const Point3& p);
QRectF machineBounds();
void paintMachine(QPainter& painter, double strength);

/// A component's stretch from its fixed end to its free end. Unknown components stand in a column at the left.
struct Stretch {
  Point3 fixed, free;
  bool known = true;
};
Stretch stretchOf(const QString& place);

}  // namespace zerodrift::ui
