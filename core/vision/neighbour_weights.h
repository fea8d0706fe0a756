#pragma once
// Weights by what a pixel's neighbours say. Where an opaque chip happens to be as bright as the target, or where what
// stands behind an edge has changed by less than the noise, the single pixel looks right and is not: among outliers it
// is distrusted, and so is a patch whose mean error is beyond what its noise allows.

#include <Eigen/Core>
#include <vector>

#include "core/vision/template_model.h"

namespace zerodrift::vision {

class NeighbourWeights {
 public:
  /// `correlated` pixels carry the noise of one: what the blur on both images does to it.
  NeighbourWeights(const TemplateModel& model, double correlated);

  /// Weights 0 .. 1 from the errors over their standard deviation and the weights that each pixel has by itself.
  void judge(const Eigen::VectorXf& standard_errors, const Eigen::VectorXf& own_weights, Eigen::VectorXf& out);

 private:
  void prepare();

  const TemplateModel& m_model;
  float m_correlated;
  int m_stride;              // of a row of the maps, with a border of zeros on both sides
  std::vector<int> m_place;  // in the maps, of the model's pixels
  std::vector<float> m_known, m_kept, m_sum, m_squares, m_scratch;
};

}  // namespace zerodrift::vision
