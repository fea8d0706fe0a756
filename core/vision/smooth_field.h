#pragma once
// A smooth additive field over the region - the halo of a glare, a moving shade, what stands behind the target - as
// cubic B-splines on a coarse grid, solved together with the motion. Only its coefficients know it; it has no meaning
// of its own.

#include <Eigen/Core>
#include <vector>

#include "core/vision/row_sums.h"
#include "core/vision/template_model.h"

namespace zerodrift::vision {

class SmoothField {
 public:
  SmoothField(const TemplateModel& model, int width, int height, double spacing_px);

  int size() const { return m_columns * m_rows; }
  /// Coefficients further apart than this have no product.
  int band() const { return 3 * m_columns + 3; }
  /// error -= field, for the first `count` pixels.
  void subtract_from(Eigen::VectorXf& error, int count, const Eigen::VectorXf& coefficients) const;
  /// Sum of weight * basis * value.
  Eigen::VectorXf project(const Eigen::VectorXf& weighted_values, int count) const;
  /// Sum of weight * basis * basis; the lower half.
  Eigen::MatrixXf normal(const Eigen::VectorXf& weights, int count) const;
  using Rows = Eigen::Matrix<float, row_length, Eigen::Dynamic>;  // a column each
  /// Sum of weight * basis * row; size() x row_length.
  Eigen::MatrixXf cross(const Rows& rows, const Eigen::VectorXf& weights, int count) const;
  /// row -= share' * basis for each of the first `count` rows; share is size() x at most row_length.
  void take_off(Rows& rows, int count, const Eigen::MatrixXf& share) const;

 private:
  // Pixels that follow each other in one row of the image and one interval of the grid: they share 4 x 4 coefficients
  // and the weights along y, which makes every sum over them separable.
  struct Segment {
    int begin;
    int end;
    int first;  // index of the first of the 4 x 4 coefficients
    float wy[4];
  };
  struct Along {
    float wx[4];
  };
  int m_columns;
  int m_rows;
  std::vector<Segment> m_segments;
  std::vector<Along> m_along;  // one a pixel
};

}  // namespace zerodrift::vision
