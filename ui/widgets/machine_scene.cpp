#include "ui/widgets/machine_scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ui/widgets/colors.h"

namespace zerodrift::ui {
namespace {

struct Box {
  Point3 low, high;
};

/// Shades of the faces: a grey that stays quiet behind the sensors in both themes.
struct Shades {
  QColor top, front, side, edge;
};

Shades shades(double strength, double tone) {
  const Colors& c = colors();
  const QColor base = mix(c.panel, c.muted, (c.dark ? 0.36 : 0.26) * strength * tone);
  Shades s;
  s.top = mix(base, c.panel, c.dark ? 0.0 : 0.55);
  s.front = base;
  s.side = mix(base, c.dark ? QColor(Qt::black) : c.muted, 0.18);
  if (c.dark) s.top = mix(base, QColor(Qt::white), 0.08);
  s.edge = mix(c.panel, c.muted, 0.7 * strength);
  return s;
}

QPolygonF face(std::initializer_list<Point3> corners) {
  QPolygonF polygon;
  for (const Point3& corner : corners) polygon << project(corner);
  return polygon;
}

void paintBox(QPainter& painter, const Box& box, const Shades& s) {
  const auto& [a, b] = box;
  painter.setPen(QPen(s.edge, 2.2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setBrush(s.top);
  painter.drawPolygon(face({{a.x, a.d, b.z}, {b.x, a.d, b.z}, {b.x, b.d, b.z}, {a.x, b.d, b.z}}));
  painter.setBrush(s.side);
  painter.drawPolygon(face({{b.x, a.d, a.z}, {b.x, b.d, a.z}, {b.x, b.d, b.z}, {b.x, a.d, b.z}}));
  painter.setBrush(s.front);
  painter.drawPolygon(face({{a.x, b.d, a.z}, {b.x, b.d, a.z}, {b.x, b.d, b.z}, {a.x, b.d, b.z}}));
}

QPolygonF ring(const Point3& centre, double radius) {
  QPolygonF polygon;
  for (int i = 0; i < 48; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 48.0;
    polygon << project({centre.x + radius * std::cos(angle), centre.d + radius * std::sin(angle), centre.z});
  }
  return polygon;
}

/// Upright cylinder or cone frustum between two heights.
void paintRound(QPainter& painter, const Point3& foot, double top, double footRadius, double topRadius,
                const Shades& s) {
  const QPolygonF low = ring(foot, footRadius);
  const QPolygonF high = ring({foot.x, foot.d, top}, topRadius);
  QPolygonF hull = low + high;
  // The silhouette of both rings: their convex hull, by Andrew's chain.
  std::sort(hull.begin(), hull.end(),
            [](const QPointF& p, const QPointF& q) { return p.x() < q.x() || (p.x() == q.x() && p.y() < q.y()); });
  const auto chain = [](auto from, auto to) {
    QPolygonF half;
    for (auto it = from; it != to; ++it) {
      while (half.size() >= 2) {
        const QPointF u = half.back() - half[half.size() - 2];
        const QPointF v = *it - half.back();
        if (u.x() * v.y() - u.y() * v.x() > 0.0) break;
        half.pop_back();
      }
      half << *it;
    }
    return half;
  };
  painter.setPen(QPen(s.edge, 2.2, Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin));
  painter.setBrush(s.front);
  painter.drawPolygon(chain(hull.begin(), hull.end()) + chain(hull.rbegin(), hull.rend()));
  painter.setBrush(s.top);
  painter.drawPolygon(high);
}

void paintRod(QPainter& painter, const Point3& from, const Point3& to, double width, const Shades& s) {
  painter.setPen(QPen(s.edge, width + 4.0, Qt::SolidLine, Qt::FlatCap));
  painter.drawLine(project(from), project(to));
  painter.setPen(QPen(s.side, width, Qt::SolidLine, Qt::FlatCap));
  painter.drawLine(project(from), project(to));
}

void paintColumn(QPainter& painter, const Shades& heavy, const Shades& light) {
  paintBox(painter, {{-280, -420, 180}, {280, -170, 1180}}, heavy);
  paintBox(painter, {{-330, -170, 760}, {330, -150, 800}}, light);
  paintBox(painter, {{-330, -170, 1040}, {330, -150, 1080}}, light);
  paintRod(painter, {-330, -150, 930}, {330, -150, 930}, 12, light);
  paintBox(painter, {{300, -180, 890}, {340, -140, 970}}, heavy);
}

void paintHead(QPainter& painter, const Shades& heavy, const Shades& light) {
  paintBox(painter, {{-140, -150, 700}, {140, -90, 1140}}, heavy);
  paintRod(painter, {0, -70, 1140}, {0, -70, 1290}, 12, light);
  paintBox(painter, {{-40, -110, 1270}, {40, -40, 1320}}, heavy);
  paintRound(painter, {0, 30, 640}, 600, 62, 62, light);
  // Nose and tool holder below the head, then the head over them, then the motor on top.
  paintRound(painter, {0, 30, 500}, 530, 34, 52, light);
  paintRound(painter, {0, 30, 530}, 640, 58, 58, light);
  paintBox(painter, {{-110, -90, 640}, {110, 120, 1060}}, light);
  paintRound(painter, {0, 20, 1060}, 1200, 78, 78, heavy);
}

void paintTable(QPainter& painter, const Shades& heavy, const Shades& light) {
  paintRod(painter, {-210, -150, 190}, {-210, 470, 190}, 22, light);
  paintRod(painter, {210, -150, 190}, {210, 470, 190}, 22, light);
  paintRod(painter, {0, -150, 190}, {0, 480, 190}, 12, light);
  paintBox(painter, {{-360, -20, 200}, {360, 400, 240}}, heavy);
  paintBox(painter, {{-360, 110, 240}, {-270, 270, 460}}, heavy);
  paintBox(painter, {{-270, 100, 300}, {270, 280, 345}}, light);
  paintRound(painter, {0, 190, 345}, 362, 100, 100, heavy);
  paintRound(painter, {0, 190, 362}, 385, 160, 160, light);
  paintBox(painter, {{270, 110, 240}, {360, 270, 460}}, heavy);
}

}  // namespace

QPointF project(const Point3& p) {
  return {0.90 * p.x - 0.36 * p.d, 0.20 * p.x + 0.34 * p.d - 0.92 * p.z};
}

QRectF machineBounds() {
  return {-620, -1310, 1240, 1600};
}

void paintMachine(QPainter& painter, double strength) {
  const Shades heavy = shades(strength, 1.25);
  const Shades light = shades(strength, 0.7);
  paintBox(painter, {{-440, -420, 0}, {440, 500, 180}}, heavy);
  paintColumn(painter, heavy, light);
  paintHead(painter, heavy, light);
  paintTable(painter, heavy, light);
  // Coolant tank beside the bed.
  paintBox(painter, {{520, 60, 0}, {680, 380, 150}}, light);
  // The camera on its stand, looking at the target on the nose.
  painter.setPen(QPen(mix(colors().panel, colors().accent, 0.8 * strength), 2.5, Qt::DashLine));
  painter.drawLine(project({-330, 440, 560}), project({-10, 60, 520}));
  paintRod(painter, {-400, 470, 180}, {-400, 470, 560}, 10, light);
  paintBox(painter, {{-440, 440, 540}, {-350, 500, 600}}, shades(strength, 1.8));
}

Stretch stretchOf(const QString& place) {
  static const QHash<QString, Stretch> known = {
      // The spindle is fixed at its rear end, in the head's top, and free at the nose.
      {"spindle", {{60, 120, 1010}, {60, 90, 560}}},
      {"headstock", {{-80, 120, 960}, {-80, 120, 700}}},
      {"column_front", {{-235, -170, 1130}, {-235, -170, 620}}},
      {"column_rear", {{150, -400, 1180}, {230, -400, 1180}}},
      {"column", {{-235, -170, 1100}, {-235, -170, 500}}},
      {"screw_x", {{330, -140, 930}, {190, -140, 930}}},
      {"screw_y", {{0, 500, 190}, {0, 400, 215}}},
      {"screw_z", {{0, -40, 1310}, {0, -70, 1225}}},
      {"guide_x", {{-300, -150, 780}, {-190, -150, 780}}},
      {"guide_y", {{-210, 470, 190}, {-210, 440, 190}}},
      {"guide_z", {{-120, -90, 1120}, {-120, -90, 900}}},
      {"trunnion", {{-315, 270, 380}, {-315, 270, 300}}},
      {"table_drive", {{90, 280, 318}, {180, 280, 318}}},
      {"table", {{-70, 250, 385}, {70, 250, 385}}},
      {"bed", {{-200, 500, 90}, {250, 500, 90}}},
      {"coolant", {{600, 380, 80}, {640, 380, 80}}},
      {"ambient", {{560, -300, 900}, {560, -300, 800}}},
  };
  const auto found = known.constFind(place);
  if (found != known.constEnd()) return found.value();
  return {{-560, -100, 1150}, {-560, -100, 250}, false};
}

}  // namespace zerodrift::ui
