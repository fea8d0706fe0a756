#include "ui/widgets/sparkline.h"

#include <cmath>

#include "ui/widgets/colors.h"

namespace zerodrift::ui {

Sparkline::Sparkline(QWidget* parent) : QWidget(parent) {
  setSizePolicy(QSizePolicy::Expanding, QSizePolicy::Fixed);
}

void Sparkline::setCurves(const QVector<QVector<double>>& curves, const QVector<QColor>& colors) {
  m_curves = curves;
  m_colors = colors;
  update();
}

void Sparkline::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.setRenderHint(QPainter::Antialiasing);
  double largest = 1e-9;
  for (const auto& curve : m_curves) {
    for (const double v : curve) {
      if (std::isfinite(v)) largest = std::max(largest, std::abs(v));
    }
  }
  painter.setPen(QPen(colors().line, 1));
  painter.drawLine(QPointF(0, height() / 2.0), QPointF(width(), height() / 2.0));
  for (int k = 0; k < m_curves.size(); ++k) {
    QPolygonF line;
    const auto n = m_curves[k].size();
    for (int i = 0; i < n; ++i) {
      if (!std::isfinite(m_curves[k][i])) continue;
      line << QPointF(width() * (i + 0.5) / static_cast<double>(n),
                      height() / 2.0 - 0.46 * height() * m_curves[k][i] / largest);
    }
    painter.setPen(QPen(m_colors.value(k, colors().text), 1.4));
    painter.drawPolyline(line);
  }
}

}  // namespace zerodrift::ui
