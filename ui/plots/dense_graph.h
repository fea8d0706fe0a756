#pragma once
// A graph that knows when its points are the lowest and highest value of a pixel column (Series::view): then it fills
// the area between them in one piece. Stroked as a line, the same area is painted column by column, three times as
// slow.

#include <vector>

#include "ui/plots/custom_plot.h"

namespace zerodrift::ui {

class DenseGraph : public QCPGraph {
 public:
  DenseGraph(QCPAxis* x, QCPAxis* y);
  /// The points come in pairs, both of one column; a pair that is not a number is a gap.
  void setDense(bool dense) { m_dense = dense; }

 protected:
  void draw(QCPPainter* painter) override;

 private:
  bool m_dense = false;
  std::vector<QPointF> m_high;
  std::vector<QPointF> m_low;
};

}  // namespace zerodrift::ui
