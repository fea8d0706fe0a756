#include "ui/widgets/histogram.h"

#include <QPainter>
#include <algorithm>
#include <cmath>

#include "ui/widgets/colors.h"

namespace zerodrift::ui {

Histogram::Histogram(QWidget* parent) : QWidget(parent) {
  setObjectName("histogram");
}

void Histogram::setCounts(const QVector<int>& counts) {
  m_counts = counts;
  update();
}

void Histogram::paintEvent(QPaintEvent*) {
  QPainter painter(this);
  painter.fillRect(rect(), colors().window);
  if (m_counts.isEmpty()) return;
  // By the root, so that few bright pixels are seen beside many dark ones.
  const double most = std::sqrt(std::max(1, *std::max_element(m_counts.begin(), m_counts.end())));
  const double step = width() / static_cast<double>(m_counts.size());
  painter.setPen(Qt::NoPen);
  for (int i = 0; i < m_counts.size(); ++i) {
    const bool saturated = i + 1 == m_counts.size();
    painter.setBrush(saturated ? colors().bad : colors().accent);
    const double high = (height() - 2) * std::sqrt(m_counts[i]) / most;
    const double wide = saturated ? std::max(3.0, step) : std::max(1.0, step);
    painter.drawRect(QRectF(std::min(i * step, width() - wide), height() - high, wide, high));
  }
}

}  // namespace zerodrift::ui
