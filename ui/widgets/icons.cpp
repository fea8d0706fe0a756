#include "ui/widgets/icons.h"

#include <cmath>
#include <optional>

#include "ui/widgets/colors.h"

namespace zerodrift::ui {
namespace {

QPainterPath polyline(std::initializer_list<QPointF> points) {
  QPainterPath path;
  bool first = true;
  for (const QPointF& p : points) {
    if (first) {
      path.moveTo(p);
    } else {
      path.lineTo(p);
    }
    first = false;
  }
  return path;
}

/// Joins strokes as they are; QPainterPath's own operator+ unites areas and would eat open lines.
QPainterPath strokes(std::initializer_list<QPainterPath> parts) {
  QPainterPath path;
  for (const QPainterPath& part : parts) path.addPath(part);
  return path;
}

QPainterPath symbols(Icon icon) {
  switch (icon) {
    case Icon::cross:
      return strokes({polyline({{6, 6}, {18, 18}}), polyline({{6, 18}, {18, 6}})});
    case Icon::tick:
      return polyline({{5, 12.5}, {10, 17.5}, {19, 7}});
    case Icon::plus:
      return strokes({polyline({{12, 5}, {12, 19}}), polyline({{5, 12}, {19, 12}})});
    case Icon::minus:
      return polyline({{5, 12}, {19, 12}});
    case Icon::up:
      return polyline({{6, 14}, {12, 8}, {18, 14}});
    case Icon::down:
      return polyline({{6, 10}, {12, 16}, {18, 10}});
    case Icon::play:
      return polyline({{7, 5}, {19, 12}, {7, 19}, {7, 5}});
    case Icon::pause:
      return strokes({polyline({{8, 6}, {8, 18}}), polyline({{16, 6}, {16, 18}})});
    case Icon::log:
      return strokes({polyline({{4, 6}, {20, 6}}), polyline({{4, 12}, {20, 12}}), polyline({{4, 18}, {14, 18}})});
    case Icon::folder:
      return polyline({{3, 19}, {3, 5}, {9, 5}, {11, 8}, {21, 8}, {21, 19}, {3, 19}});
    case Icon::file:
      return strokes(
          {polyline({{6, 3}, {14, 3}, {19, 8}, {19, 21}, {6, 21}, {6, 3}}), polyline({{14, 3}, {14, 8}, {19, 8}})});
    case Icon::chart:
      return strokes({polyline({{4, 4}, {4, 20}, {20, 20}}), polyline({{7, 16}, {11, 10}, {14, 13}, {20, 6}})});
    case Icon::plug:
      return strokes({polyline({{9, 3}, {9, 8}}), polyline({{15, 3}, {15, 8}}),
                      polyline({{6, 8}, {18, 8}, {18, 12}, {14, 16}, {10, 16}, {6, 12}, {6, 8}}),
                      polyline({{12, 16}, {12, 21}})});
    case Icon::trash:
      return strokes({polyline({{4, 7}, {20, 7}}), polyline({{9, 7}, {9, 4}, {15, 4}, {15, 7}}),
                      polyline({{6, 7}, {7, 20}, {17, 20}, {18, 7}})});
    case Icon::pencil:
      return polyline({{4, 20}, {5, 15}, {16, 4}, {20, 8}, {9, 19}, {4, 20}});
    case Icon::machine:
      return strokes({polyline({{4, 21}, {4, 3}, {14, 3}, {14, 12}}), polyline({{4, 21}, {21, 21}}),
                      polyline({{10, 12}, {18, 12}}), polyline({{12, 12}, {12, 15}, {14, 17}, {16, 15}, {16, 12}}),
                      polyline({{9, 21}, {9, 19}, {19, 19}, {19, 21}})});
    default:
      break;
  }
  return {};
}

QPainterPath roundSymbols(Icon icon) {
  QPainterPath path;
  switch (icon) {
    case Icon::moon:
      path.moveTo(19.5, 14.2);
      path.arcTo(QRectF(4, 4, 16, 16), -16, -254);
      path.cubicTo(7.5, 10.5, 13, 16.5, 19.5, 14.2);
      break;
    case Icon::sun:
      path.addEllipse(QPointF(12, 12), 4, 4);
      for (int i = 0; i < 8; ++i) {
        const QPointF way(std::cos(i * M_PI_4), std::sin(i * M_PI_4));
        path.moveTo(QPointF(12, 12) + 7 * way);
        path.lineTo(QPointF(12, 12) + 9.2 * way);
      }
      break;
    case Icon::globe:
      path.addEllipse(QPointF(12, 12), 9, 9);
      path.addEllipse(QPointF(12, 12), 4, 9);
      path.moveTo(3, 12);
      path.lineTo(21, 12);
      break;
    case Icon::help:
      path.addEllipse(QPointF(12, 12), 9, 9);
      path.moveTo(9.4, 9.6);
      path.cubicTo(9.4, 6.4, 14.8, 6.6, 14.8, 9.8);
      path.cubicTo(14.8, 11.8, 12, 11.8, 12, 14);
      path.addEllipse(QPointF(12, 17), 0.3, 0.3);
      break;
    case Icon::search:
      path.addEllipse(QPointF(10.5, 10.5), 6, 6);
      path.moveTo(15, 15);
      path.lineTo(20, 20);
      break;
    case Icon::stop:
      path.addRoundedRect(QRectF(6, 6, 12, 12), 1.5, 1.5);
      break;
    case Icon::camera:
      path.addRoundedRect(QRectF(3, 7, 18, 13), 2, 2);
      path.addEllipse(QPointF(12, 13.5), 3.8, 3.8);
      path.addPath(polyline({{8, 7}, {9.5, 4}, {14.5, 4}, {16, 7}}));
      break;
    case Icon::clock:
      path.addEllipse(QPointF(12, 12), 9, 9);
      path.addPath(polyline({{12, 6.5}, {12, 12}, {16, 14}}));
      break;
    case Icon::undo:
      path = polyline({{9, 5}, {4, 10}, {9, 15}});
      path.moveTo(4, 10);
      path.lineTo(14, 10);
      path.cubicTo(22, 10, 22, 19, 14, 19);
      break;
    default:
      break;
  }
  return path;
}

class LineIconEngine : public QIconEngine {
 public:
  LineIconEngine(Icon icon, std::optional<QColor> color) : m_icon(icon), m_color(color) {}

  void paint(QPainter* painter, const QRect& rect, QIcon::Mode mode, QIcon::State) override {
    const QColor normal = m_color.value_or(colors().text);
    drawIcon(*painter, rect, m_icon, mode == QIcon::Disabled ? mix(normal, colors().panel, 0.55) : normal);
  }
  QPixmap pixmap(const QSize& size, QIcon::Mode mode, QIcon::State state) override {
    QPixmap pixmap(size);
    pixmap.fill(Qt::transparent);
    QPainter painter(&pixmap);
    paint(&painter, QRect(QPoint(), size), mode, state);
    return pixmap;
  }
  QIconEngine* clone() const override { return new LineIconEngine(m_icon, m_color); }

 private:
  Icon m_icon;
  std::optional<QColor> m_color;
};

}  // namespace

void drawIcon(QPainter& painter, const QRectF& box, Icon icon, const QColor& color, double penWidth) {
  painter.save();
  painter.setRenderHint(QPainter::Antialiasing);
  const double scale = std::min(box.width(), box.height()) / 24.0;
  painter.translate(box.center());
  painter.scale(scale, scale);
  painter.translate(-12, -12);
  QPen pen(color, penWidth / std::max(scale, 0.4), Qt::SolidLine, Qt::RoundCap, Qt::RoundJoin);
  painter.setPen(pen);
  painter.setBrush(Qt::NoBrush);
  QPainterPath path = symbols(icon);
  if (path.isEmpty()) path = roundSymbols(icon);
  painter.drawPath(path);
  painter.restore();
}

QIcon lineIcon(Icon icon) {
  return QIcon(new LineIconEngine(icon, std::nullopt));
}

QIcon lineIcon(Icon icon, const QColor& color) {
  return QIcon(new LineIconEngine(icon, color));
}

}  // namespace zerodrift::ui
