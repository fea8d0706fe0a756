#pragma once
// Images as quintic B-splines: f(x, y) = sum c_ij b5(x - j) b5(y - i), exact at the pixels. The quintic's interpolation
// bias stays below 1e-4 px on the sharpest targets a camera can image, where the cubic's is of the size of the noise.
// Prefilter: Unser, Aldroubi and Eden, IEEE Trans. Signal Process. 41 (1993) 834.

#include <Eigen/Core>
#include <vector>

#include "core/vision/image.h"

namespace zerodrift::vision {

struct FloatImage {
  int width = 0;
  int height = 0;
  std::vector<float> values;

  FloatImage() = default;
  FloatImage(int w, int h) : width(w), height(h), values(static_cast<std::size_t>(w) * h) {}
  float* row(int y) { return values.data() + static_cast<std::size_t>(y) * width; }
  const float* row(int y) const { return values.data() + static_cast<std::size_t>(y) * width; }
};

/// The part of the image under the region, which may reach beyond it: the border pixels are repeated there.
FloatImage crop(const GrayImage& image, const Region& region);

/// Gaussian blur with this covariance in px^2 (symmetric, positive); the border is repeated.
FloatImage blurred(const FloatImage& image, const Eigen::Matrix2d& covariance_px2);
/// One side of the discrete Gaussian, the middle first: exp(-t) I_n(t) has exactly the variance t, however small
/// (Lindeberg, IEEE PAMI 12 (1990) 234).
std::vector<float> gaussian_weights(double variance);
/// The kernel of that blur as an image of odd size; its sum is 1.
FloatImage blur_kernel(const Eigen::Matrix2d& covariance_px2);
/// Share of independent noise's variance that the blur lets through.
double blur_power(const Eigen::Matrix2d& covariance_px2);

/// At the pixels.
struct SplineDerivatives {
  FloatImage x, y, xx, xy, yy;
};

class SplineImage {
 public:
  explicit SplineImage(FloatImage samples);

  int width() const { return m_coefficients.width; }
  int height() const { return m_coefficients.height; }
  /// Values at (column + fraction_x, row + fraction_y), fractions in [0, 1], place = row * width + column; what the
  /// support of the spline reaches must be inside: 2 <= column <= width - reach_after, the same for rows.
  static constexpr int reach_after = 6;  // eight columns are read at once
  static constexpr int first_place(int width) { return 2 * width + 2; }
  void sample(const int* places, const float* fractions_x, const float* fractions_y, int count, float* values) const;
  SplineDerivatives derivatives() const;

 private:
  FloatImage m_coefficients;
};

}  // namespace zerodrift::vision
