#include "ui/plots/dense_graph.h"

#include <algorithm>
#include <cmath>

namespace zerodrift::ui {
namespace {

// The painter looks for its place in a row from the row's begin: short polygons are filled much sooner than a long one.
// They meet at whole pixels, where no edge is seen.
constexpr std::size_t piece = 24;

}  // namespace

DenseGraph::DenseGraph(QCPAxis* x, QCPAxis* y) : QCPGraph(x, y) {}

void DenseGraph::draw(QCPPainter* painter) {
  const QPen pen = mPen;
  // A dashed line keeps its dashes and discs stay discs: only a line becomes a band.
  if (!m_dense || pen.style() != Qt::SolidLine || !mScatterStyle.isNone()) return QCPGraph::draw(painter);
  applyDefaultAntialiasingHint(painter);
  painter->setPen(Qt::NoPen);
  painter->setBrush(pen.color());
  const QTransform onto = painter->combinedTransform();  // to the device's own pixels: the plot is half a pixel aside
  const double scale = onto.m11();
  const double shift = onto.dx();
  const double half_px = pen.widthF() / 2.0;
  const auto fill = [&] {
    if (m_high.size() == 1) {  // alone between two gaps: it is seen all the same
      m_high.push_back(m_high.front() + QPointF(1.0, 0.0));
      m_low.push_back(m_low.front() + QPointF(1.0, 0.0));
    }
    if (!m_high.empty()) {
      m_high.insert(m_high.end(), m_low.rbegin(), m_low.rend());
      painter->drawPolygon(m_high.data(), static_cast<int>(m_high.size()), Qt::WindingFill);
    }
    m_high.clear();
    m_low.clear();
  };
  for (auto at = mDataContainer->constBegin(); at != mDataContainer->constEnd(); ++at) {
    const auto first = at++;
    if (at == mDataContainer->constEnd()) break;
    if (std::isnan(first->value) || std::isnan(at->value)) {
      fill();
      continue;
    }
    const double x_px = mKeyAxis->coordToPixel(first->key);
    const auto [top_px, foot_px] =
        std::minmax({mValueAxis->coordToPixel(first->value), mValueAxis->coordToPixel(at->value)});
    const QPointF high(x_px, top_px - half_px);
    const QPointF low(x_px, foot_px + half_px);
    const double whole_px = (std::floor(scale * x_px + shift) - shift) / scale;
    if (m_high.size() >= piece && whole_px > m_high.back().x()) {
      const double part = (whole_px - m_high.back().x()) / (x_px - m_high.back().x());
      const QPointF seam_high = m_high.back() + part * (high - m_high.back());
      const QPointF seam_low = m_low.back() + part * (low - m_low.back());
      m_high.push_back(seam_high);
      m_low.push_back(seam_low);
      fill();
      m_high.push_back(seam_high);
      m_low.push_back(seam_low);
    }
    m_high.push_back(high);
    m_low.push_back(low);
  }
  fill();
}

}  // namespace zerodrift::ui
