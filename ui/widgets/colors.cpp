#include "ui/widgets/colors.h"

#include <array>
#include <cmath>
#include <numbers>

#include "ui/widgets/paper_colors.h"

namespace zerodrift::ui {
namespace {

Colors makeLight() {
  Colors c;
  c.window = "#F3F5F7";
  c.panel = "#FFFFFF";
  c.rail = "#1E2933";
  c.railText = "#E8EDF2";
  c.railMuted = "#8A9AA9";
  c.text = "#1C2530";
  c.muted = "#5F6E7C";
  c.line = "#D9DFE5";
  c.grid = "#EBEFF3";
  c.accent = "#0F6CBD";
  c.onAccent = "#FFFFFF";
  c.ok = "#2E8B57";
  c.warn = "#C77700";
  c.bad = "#C4314B";
  c.okText = "#1F7544";
  c.warnText = "#8F5400";
  c.badText = "#B3263F";
  return c;
}

Colors makeDark() {
  Colors c;
  c.dark = true;
  c.window = "#151B21";
  c.panel = "#1D252D";
  c.rail = "#0F1419";
  c.railText = "#DCE4EB";
  c.railMuted = "#76879A";
  c.text = "#E3E9EF";
  c.muted = "#93A2B1";
  c.line = "#303B46";
  c.grid = "#28323C";
  c.accent = "#4BA3F0";
  c.onAccent = "#0F1419";
  c.ok = "#45B37A";
  c.warn = "#E0A03A";
  c.bad = "#EE6A7C";
  c.okText = c.ok;
  c.warnText = c.warn;
  c.badText = c.bad;
  return c;
}

}  // namespace

QColor mix(const QColor& from, const QColor& to, double share) {
  const auto between = [share](float a, float b) { return a + static_cast<float>(share) * (b - a); };
  return QColor::fromRgbF(between(from.redF(), to.redF()), between(from.greenF(), to.greenF()),
                          between(from.blueF(), to.blueF()));
}

QColor Colors::fill(Judgement judgement) const {
  switch (judgement) {
    case Judgement::ok:
      return ok;
    case Judgement::warn:
      return warn;
    case Judgement::bad:
      return bad;
    case Judgement::none:
      break;
  }
  return muted;
}

QColor Colors::ink(Judgement judgement) const {
  switch (judgement) {
    case Judgement::ok:
      return okText;
    case Judgement::warn:
      return warnText;
    case Judgement::bad:
      return badText;
    case Judgement::none:
      break;
  }
  return muted;
}

QColor Colors::soft(const QColor& color) const {
  return mix(panel, color, dark ? 0.16 : 0.10);
}

const Colors& lightColors() {
  static const Colors c = makeLight();
  return c;
}

const Colors& darkColors() {
  static const Colors c = makeDark();
  return c;
}

const Colors& colors() {
  return QGuiApplication::palette().color(QPalette::Window).lightness() < 128 ? darkColors() : lightColors();
}

namespace {

QColor curveColorFor(int index, bool onDark) {
  // The prototype's hues, ordered so that neighbouring zones differ most.
  static constexpr std::array<int, 6> hues = {207, 28, 140, 345, 265, 50};
  static constexpr std::array<double, 4> light = {0.30, 0.41, 0.50, 0.62};
  static constexpr std::array<double, 4> dark = {0.46, 0.56, 0.66, 0.76};
  const int wrapped = ((index % 24) + 24) % 24;
  const int hue = hues[static_cast<size_t>(wrapped / 4)];
  const auto member = static_cast<size_t>(wrapped % 4);
  double lightness = onDark ? dark[member] : light[member];
  // Yellow looks lighter than blue at the same figure.
  if (hue == 50) lightness *= onDark ? 0.90 : 0.82;
  return QColor::fromHslF(static_cast<float>(hue) / 360.0F, onDark ? 0.62F : 0.66F, static_cast<float>(lightness));
}

int groupMember(int group) {
  static constexpr std::array<int, 8> order = {1, 5, 9, 13, 17, 21, 3, 11};
  return order[static_cast<size_t>(((group % 8) + 8) % 8)];
}

int axisMember(int axis) {
  static constexpr std::array<int, 3> order = {13, 9, 1};  // X red, Y green, Z blue, as on every drawing of a machine
  return order[static_cast<size_t>(((axis % 3) + 3) % 3)];
}

QColor divergingColorFor(double value, bool onDark) {
  // Anchors of about equal steps in CIELAB lightness on both sides of the neutral middle.
  static const std::array<QColor, 5> light = {QColor("#15508C"), QColor("#6FA6D6"), QColor("#F4F5F6"),
                                              QColor("#E58F77"), QColor("#9E1F2F")};
  static const std::array<QColor, 5> dark = {QColor("#7CC0FF"), QColor("#2F6CA3"), QColor("#222B34"), QColor("#A84A3A"),
                                             QColor("#FF9A85")};
  const auto& anchors = onDark ? dark : light;
  const double at = (std::clamp(std::isfinite(value) ? value : 0.0, -1.0, 1.0) + 1.0) * 2.0;
  const auto below = static_cast<size_t>(std::min(3.0, std::floor(at)));
  return mix(anchors[below], anchors[below + 1], at - static_cast<double>(below));
}

}  // namespace

QColor curveColor(int index) {
  return curveColorFor(index, colors().dark);
}

QColor groupColor(int group) {
  return curveColor(groupMember(group));
}

QColor axisColor(int axis) {
  return curveColor(axisMember(axis));
}

QColor divergingColor(double value) {
  return divergingColorFor(value, colors().dark);
}

QColor paperCurveColor(int index) {
  return curveColorFor(index, false);
}

QColor paperGroupColor(int group) {
  return curveColorFor(groupMember(group), false);
}

QColor paperAxisColor(int axis) {
  return curveColorFor(axisMember(axis), false);
}

QColor paperDivergingColor(double value) {
  return divergingColorFor(value, false);
}

QFont uiFont(int pixels, QFont::Weight weight) {
  QFont font;
  font.setFamilies({"Zerodrift Sans", "Inter", "Noto Sans", "Noto Sans CJK SC", "DejaVu Sans"});
  font.setPixelSize(pixels);
  font.setWeight(weight);
  font.setHintingPreference(QFont::PreferNoHinting);
  return font;
}

void drawJudgement(QPainter& painter, const QRectF& box, Judgement judgement) {
  const QColor fill = colors().fill(judgement);
  const QPointF centre = box.center();
  const double r = std::min(box.width(), box.height()) / 2.0;
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  painter.setPen(Qt::NoPen);
  painter.setBrush(fill);
  QPen mark(colors().dark ? colors().rail : QColor(Qt::white), r * 0.28, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin);
  const auto at = [&](double x, double y) { return centre + QPointF(x * r, y * r); };
  switch (judgement) {
    case Judgement::ok:
      painter.drawEllipse(centre, r, r);
      painter.setPen(mark);
      painter.setBrush(Qt::NoBrush);
      painter.drawPolyline(QPolygonF({at(-0.45, 0.03), at(-0.12, 0.38), at(0.48, -0.34)}));
      break;
    case Judgement::warn:
      painter.setPen(QPen(fill, r * 0.3, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
      painter.drawPolygon(QPolygonF({at(0, -0.82), at(0.88, 0.76), at(-0.88, 0.76)}));
      painter.setPen(mark);
      painter.drawLine(at(0, -0.28), at(0, 0.22));
      painter.drawPoint(at(0, 0.58));
      break;
    case Judgement::bad: {
      QPolygonF octagon;
      for (int i = 0; i < 8; ++i) {
        const double angle = (i + 0.5) * std::numbers::pi / 4.0;
        octagon << at(1.05 * std::cos(angle), 1.05 * std::sin(angle));
      }
      painter.drawPolygon(octagon);
      painter.setPen(mark);
      painter.drawLine(at(-0.36, -0.36), at(0.36, 0.36));
      painter.drawLine(at(-0.36, 0.36), at(0.36, -0.36));
      break;
    }
    case Judgement::none:
      painter.setBrush(Qt::NoBrush);
      painter.setPen(QPen(fill, r * 0.25));
      painter.drawEllipse(centre, r * 0.85, r * 0.85);
      break;
  }
  painter.restore();
}

}  // namespace zerodrift::ui
