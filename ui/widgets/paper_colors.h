#pragma once
// The colours of curves, axes and maps as in the window (ui/widgets/colors.h), for paper: light whatever the theme is.

#include <QColor>

namespace zerodrift::ui {

QColor paperCurveColor(int index);
QColor paperGroupColor(int group);
QColor paperAxisColor(int axis);
QColor paperDivergingColor(double value);

}  // namespace zerodrift::ui
