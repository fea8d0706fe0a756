#pragma once
// The look's colours, type and state shapes, the one place where they are written down.
// Painted widgets ask colors() whenever they paint, so a change of theme needs no bookkeeping.

#include <QColor>
#include <QFont>
#include <QString>

class QPainter;
class QRectF;

namespace zerodrift::ui {

/// How a figure stands against its limit. Always shown with a word and a shape, never with colour alone.
enum class Judgement {
  none,
  ok,
  warn,
  bad,
};

struct Colors {
  bool dark = false;
  QColor window, panel, rail, railText, railMuted, text, muted, line, grid, accent, onAccent;
  QColor ok, warn, bad;              // fills, shapes and lines
  QColor okText, warnText, badText;  // the same for text: at least 4.5:1 on panel and window

  QColor fill(Judgement judgement) const;
  QColor ink(Judgement judgement) const;
  QColor soft(const QColor& color) const;  // a tint of the panel, for banners and selected rows
};

const Colors& lightColors();
const Colors& darkColors();
/// Those of the theme in use, told by the application's palette.
const Colors& colors();

/// 24 curve colours: 6 hues, one for each zone, times 4 lightnesses; index 4 * zone + member. Wraps round.
QColor curveColor(int index);
/// One clearly different colour for each group (cluster, axis, method); wraps round.
QColor groupColor(int group);
/// X, Y, Z keep their colours on every page.
QColor axisColor(int axis);
/// Perceptually even diverging colours, blue - neutral - red; value in -1 .. 1, 0 is the neutral middle.
QColor divergingColor(double value);

QColor mix(const QColor& from, const QColor& to, double share);

/// Interface font of this size in px; digits have one width.
QFont uiFont(int pixels, QFont::Weight weight = QFont::Normal);

/// Tick in a disc, triangle, octagon with a cross, or a hollow ring: the shape beside each state word.
void drawJudgement(QPainter& painter, const QRectF& box, Judgement judgement);

}  // namespace zerodrift::ui
