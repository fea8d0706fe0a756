#pragma once
// Line icons drawn for this program on a 24 x 24 grid; they take the text colour of the theme.

#include <QIcon>

class QPainter;
class QRectF;

namespace zerodrift::ui {

enum class Icon {
  cross,
  tick,
  plus,
  minus,
  moon,
  sun,
  globe,
  help,
  log,
  search,
  play,
  pause,
  stop,
  folder,
  file,
  machine,
  camera,
  plug,
  chart,
  clock,
  up,
  down,
  undo,
  trash,
  pencil,
};

void drawIcon(QPainter& painter, const QRectF& box, Icon icon, const QColor& color, double penWidth = 1.6);
/// Icon in the theme's text colour, drawn anew at each size, so it stays sharp at every scale.
QIcon lineIcon(Icon icon);
/// The same in a fixed colour, for the rail and filled buttons.
QIcon lineIcon(Icon icon, const QColor& color);

}  // namespace zerodrift::ui
