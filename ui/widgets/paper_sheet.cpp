#include "ui/widgets/paper_sheet.h"

#include <QPainter>

namespace zerodrift::ui {

void PaperSheet::setPicture(const QImage& picture, int width_px) {
  if (picture.cacheKey() == m_picture.cacheKey() && width_px == m_width) return;
  m_picture = picture;
  m_width = width_px;
  m_shown = QPixmap();
  setFixedHeight(picture.width() > 0 ? picture.height() * width_px / picture.width() : 0);
  update();
}

void PaperSheet::paintEvent(QPaintEvent*) {
  if (m_picture.isNull()) return;
  const double ratio = devicePixelRatioF();
  if (m_shown.isNull() || m_shown.devicePixelRatio() != ratio) {
    m_shown = QPixmap::fromImage(m_picture.scaledToWidth(static_cast<int>(m_width * ratio), Qt::SmoothTransformation));
    m_shown.setDevicePixelRatio(ratio);
  }
  QPainter painter(this);
  painter.drawPixmap((width() - m_width) / 2, 0, m_shown);
}

}  // namespace zerodrift::ui
