#include "core/vision/spline_image.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "core/vision/opencv_image.h"
#include "core/vision/row_sums.h"

namespace zerodrift::vision {
namespace {

constexpr double least_line_variance = 1e-6;
constexpr int largest_lattice_steps = 32;

// Poles of the quintic B-spline's inverse filter.
constexpr double poles[] = {-0.43057534709997430, -0.043096288203264443};

// In-place inverse filter down some columns with mirrored ends; a row of `strip` numbers each, in the inner loops. All
// of it stays near the processor: the whole width at once would pass by it eight times.
constexpr int strip = 32;
template <int width>
__attribute__((always_inline)) inline void prefilter_strip(float* values, std::ptrdiff_t stride, int height) {
  for (const double pole : poles) {
    const float z = static_cast<float>(pole);
    const float gain = static_cast<float>((1.0 - pole) * (1.0 - 1.0 / pole));
    const int reach = std::min(height, 24);  // pole^24 is below the precision of a float
    float before[width];
    for (int x = 0; x < width; ++x) before[x] = values[x];
    float power = z;
    for (int y = 1; y < reach; ++y, power *= z) {
      const float* now = values + y * stride;
      for (int x = 0; x < width; ++x) before[x] += power * now[x];
    }
    for (int x = 0; x < width; ++x) values[x] = before[x] = gain * before[x];
    for (int y = 1; y < height; ++y) {
      float* now = values + y * stride;
      for (int x = 0; x < width; ++x) now[x] = before[x] = gain * now[x] + z * before[x];
    }
    const float end_gain = static_cast<float>(pole / (pole * pole - 1.0));
    float* last = values + (height - 1) * stride;
    const float* beside = last - stride;
    for (int x = 0; x < width; ++x) last[x] = before[x] = end_gain * (last[x] + z * beside[x]);
    for (int y = height - 2; y >= 0; --y) {
      float* now = values + y * stride;
      for (int x = 0; x < width; ++x) now[x] = before[x] = z * (before[x] - now[x]);
    }
  }
}

ZERODRIFT_WIDE void prefilter_columns(float* values, int width, int height) {
  int x = 0;
  for (; x + strip <= width; x += strip) prefilter_strip<strip>(values + x, width, height);
  for (; x + 4 <= width; x += 4) prefilter_strip<4>(values + x, width, height);
  for (; x < width; ++x) prefilter_strip<1>(values + x, width, height);
}

FloatImage transposed(const FloatImage& image) {
  FloatImage out(image.height, image.width);
  constexpr int block = 16;
  for (int y0 = 0; y0 < image.height; y0 += block) {
    for (int x0 = 0; x0 < image.width; x0 += block) {
      for (int y = y0; y < std::min(y0 + block, image.height); ++y) {
        for (int x = x0; x < std::min(x0 + block, image.width); ++x) out.row(x)[y] = image.row(y)[x];
      }
    }
  }
  return out;
}

// b5(x - k) at k = -2 .. 3 for x in [0, 1).
inline void quintic_weights(float t, float* w) {
  const float s = 1.0f - t;
  const auto inner = [](float x) {
    const float x2 = x * x;
    return 0.55f + x2 * (-0.5f + x2 * (0.25f - x * (1.0f / 12.0f)));
  };
  const auto middle = [](float x) {
    return 0.425f + x * (0.625f + x * (-1.75f + x * (1.25f + x * (-0.375f + x * (1.0f / 24.0f)))));
  };
  const float t2 = t * t;
  const float s2 = s * s;
  w[0] = s2 * s2 * s * (1.0f / 120.0f);
  w[1] = middle(1.0f + t);
  w[2] = inner(t);
  w[3] = inner(s);
  w[4] = middle(1.0f + s);
  w[5] = t2 * t2 * t * (1.0f / 120.0f);
}

// The weights at steps of 1/256, between which they are interpolated linearly, to 2e-6.
constexpr int weight_steps = 256;
struct WeightTable {
  alignas(32) float at[weight_steps + 2][8] = {};
  WeightTable() {
    for (int k = 0; k <= weight_steps; ++k) quintic_weights(static_cast<float>(k) / weight_steps, at[k]);
    std::copy(at[weight_steps], at[weight_steps] + 8, at[weight_steps + 1]);
  }
};

// Eight numbers in one register or in two; the way GCC and Clang spell it.
typedef float EightWeights __attribute__((vector_size(32)));
typedef float EightSamples __attribute__((vector_size(32), aligned(4), may_alias));

ZERODRIFT_WIDE void sample_spline(const float* coefficients, int width, const float (*table)[8], const int* places,
                                  const float* fractions_x, const float* fractions_y, int count, float* values) {
  const auto weights = [table](float fraction, EightWeights& out) {
    const float step = fraction * weight_steps;
    const int whole = static_cast<int>(step);
    const EightWeights& here = *reinterpret_cast<const EightWeights*>(table[whole]);
    const EightWeights& next = *reinterpret_cast<const EightWeights*>(table[whole + 1]);
    out = here + (step - static_cast<float>(whole)) * (next - here);
  };
  const std::ptrdiff_t stride = width;
  for (int k = 0; k < count; ++k) {
    EightWeights wx, wy;
    weights(fractions_x[k], wx);
    weights(fractions_y[k], wy);
    const float* first = coefficients + places[k] - 2 * stride - 2;
    EightWeights sum = wy[0] * *reinterpret_cast<const EightSamples*>(first);
    for (int row = 1; row < 6; ++row) sum += wy[row] * *reinterpret_cast<const EightSamples*>(first + row * stride);
    sum *= wx;
    values[k] = ((sum[0] + sum[4]) + (sum[1] + sum[5])) + (sum[2] + sum[3]);
  }
}

// b5 and its first two derivatives at the integers, from its middle on; the first derivative changes its sign there.
constexpr float b5[] = {66.0f / 120.0f, 26.0f / 120.0f, 1.0f / 120.0f};
constexpr float b5_slope[] = {0.0f, 10.0f / 24.0f, 1.0f / 24.0f};
constexpr float b5_bend[] = {-1.0f, 1.0f / 3.0f, 1.0f / 6.0f};

// Sums of five rows of coefficients by all three; `rows` are those from two above to two below.
ZERODRIFT_WIDE void across_rows(const float* const* rows, int width, float* __restrict plain, float* __restrict slope,
                                float* __restrict bend) {
  const float *r0 = rows[0], *r1 = rows[1], *r2 = rows[2], *r3 = rows[3], *r4 = rows[4];
  for (int x = 0; x < width; ++x) {
    const float near = r1[x] + r3[x];
    const float far = r0[x] + r4[x];
    plain[x] = b5[0] * r2[x] + b5[1] * near + b5[2] * far;
    slope[x] = b5_slope[1] * (r3[x] - r1[x]) + b5_slope[2] * (r4[x] - r0[x]);
    bend[x] = b5_bend[0] * r2[x] + b5_bend[1] * near + b5_bend[2] * far;
  }
}

// The same along a row, of which two numbers beyond both ends are known.
ZERODRIFT_WIDE void along_row(const float* __restrict plain, const float* __restrict slope,
                              const float* __restrict bend, int width, float* __restrict x_out, float* __restrict y_out,
                              float* __restrict xx_out, float* __restrict xy_out, float* __restrict yy_out) {
  for (int x = 0; x < width; ++x) {
    const float *p = plain + x, *s = slope + x, *b = bend + x;
    const float near = p[-1] + p[1];
    const float far = p[-2] + p[2];
    x_out[x] = b5_slope[1] * (p[1] - p[-1]) + b5_slope[2] * (p[2] - p[-2]);
    xx_out[x] = b5_bend[0] * p[0] + b5_bend[1] * near + b5_bend[2] * far;
    y_out[x] = b5[0] * s[0] + b5[1] * (s[-1] + s[1]) + b5[2] * (s[-2] + s[2]);
    xy_out[x] = b5_slope[1] * (s[1] - s[-1]) + b5_slope[2] * (s[2] - s[-2]);
    yy_out[x] = b5[0] * b[0] + b5[1] * (b[-1] + b[1]) + b5[2] * (b[-2] + b[2]);
  }
}

cv::Mat gaussian_1d(double variance_px2) {
  const int reach = static_cast<int>(std::ceil(4.0 * std::sqrt(variance_px2))) + 1;
  cv::Mat kernel(1, 2 * reach + 1, CV_32F);
  double sum = 0.0;
  for (int k = -reach; k <= reach; ++k) sum += std::exp(-0.5 * k * k / variance_px2);
  for (int k = -reach; k <= reach; ++k) {
    kernel.at<float>(k + reach) = static_cast<float>(std::exp(-0.5 * k * k / variance_px2) / sum);
  }
  return kernel;
}

// A direction from pixel to pixel, and the variance of a blur along it in its own steps.
struct LatticeLine {
  int x, y;
  double variance;
};

// An oblique blur as three along lines of pixels, which is as exact and takes a tenth of the time of its kernel:
// covariance = sum of variance v v^T. Selling's decomposition (J. reine angew. Math. 77 (1874) 143) finds the three
// directions v for which none of the variances is negative.
std::array<LatticeLine, 3> lattice_lines(const Eigen::Matrix2d& covariance) {
  std::array<Eigen::Vector2d, 3> base{Eigen::Vector2d(1, 0), Eigen::Vector2d(0, 1), Eigen::Vector2d(-1, -1)};
  const auto product = [&](int k) { return base[(k + 1) % 3].dot(covariance * base[(k + 2) % 3]); };
  for (int step = 0; step < largest_lattice_steps; ++step) {
    int acute = 0;
    while (acute < 3 && product(acute) <= 0.0) ++acute;
    if (acute == 3) break;
    const Eigen::Vector2d one = base[(acute + 1) % 3];
    const Eigen::Vector2d other = base[(acute + 2) % 3];
    base = {Eigen::Vector2d(-one), other, Eigen::Vector2d(one - other)};
  }
  std::array<LatticeLine, 3> out;
  for (int k = 0; k < 3; ++k) {
    out[k] = {-static_cast<int>(base[k].y()), static_cast<int>(base[k].x()), std::max(0.0, -product(k))};
  }
  return out;
}

FloatImage blurred_along(const FloatImage& image, const LatticeLine& line) {
  const std::vector<float> weights = gaussian_weights(line.variance);
  const int reach = static_cast<int>(weights.size()) - 1;
  const int pad_x = reach * std::abs(line.x);
  const int pad_y = reach * std::abs(line.y);
  cv::Mat padded;
  cv::copyMakeBorder(mat_view(image), padded, pad_y, pad_y, pad_x, pad_x, cv::BORDER_REPLICATE);
  FloatImage out(image.width, image.height);
  const std::ptrdiff_t step = line.y * static_cast<std::ptrdiff_t>(padded.step1()) + line.x;
  for (int y = 0; y < image.height; ++y) {
    blur_row(padded.ptr<float>(y + pad_y) + pad_x, step, weights.data(), reach + 1, image.width, out.row(y));
  }
  return out;
}

bool along_the_axes(const Eigen::Matrix2d& covariance) {
  return std::abs(covariance(0, 1)) < 1e-6 * (covariance(0, 0) + covariance(1, 1));
}

}  // namespace

std::vector<float> gaussian_weights(double variance) {
  std::vector<float> out;
  for (int n = 0; n < 64; ++n) {
    const double weight = std::exp(-variance) * std::cyl_bessel_i(static_cast<double>(n), variance);
    out.push_back(static_cast<float>(weight));
    if (weight < 1e-5) break;
  }
  return out;
}

FloatImage crop(const GrayImage& image, const Region& region) {
  FloatImage out(region.width, region.height);
  for (int y = 0; y < region.height; ++y) {
    const int from_y = std::clamp(region.y + y, 0, image.height - 1);
    float* row = out.row(y);
    for (int x = 0; x < region.width; ++x) row[x] = image.at(std::clamp(region.x + x, 0, image.width - 1), from_y);
  }
  return out;
}

FloatImage blur_kernel(const Eigen::Matrix2d& covariance_px2) {
  const Eigen::Matrix2d precision = covariance_px2.inverse();
  const double widest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d>(covariance_px2).eigenvalues()(1);
  const int reach = static_cast<int>(std::ceil(4.0 * std::sqrt(widest))) + 1;
  FloatImage kernel(2 * reach + 1, 2 * reach + 1);
  double sum = 0.0;
  for (int y = -reach; y <= reach; ++y) {
    for (int x = -reach; x <= reach; ++x) {
      const Eigen::Vector2d at(x, y);
      const double value = std::exp(-0.5 * at.dot(precision * at));
      kernel.row(y + reach)[x + reach] = static_cast<float>(value);
      sum += value;
    }
  }
  for (float& value : kernel.values) value = static_cast<float>(value / sum);
  return kernel;
}

double blur_power(const Eigen::Matrix2d& covariance_px2) {
  double power = 0.0;
  for (const float value : blur_kernel(covariance_px2).values) power += double{value} * value;
  return power;
}

FloatImage blurred(const FloatImage& image, const Eigen::Matrix2d& covariance_px2) {
  FloatImage out(image.width, image.height);
  cv::Mat target = mat_view(out);
  if (along_the_axes(covariance_px2)) {
    cv::sepFilter2D(mat_view(image), target, CV_32F, gaussian_1d(covariance_px2(0, 0)),
                    gaussian_1d(covariance_px2(1, 1)), {-1, -1}, 0.0, cv::BORDER_REPLICATE);
    return out;
  }
  out = image;
  for (const LatticeLine& line : lattice_lines(covariance_px2)) {
    if (line.variance > least_line_variance) out = blurred_along(out, line);
  }
  return out;
}

SplineImage::SplineImage(FloatImage samples) : m_coefficients(std::move(samples)) {
  prefilter_columns(m_coefficients.values.data(), m_coefficients.width, m_coefficients.height);
  m_coefficients = transposed(m_coefficients);
  prefilter_columns(m_coefficients.values.data(), m_coefficients.width, m_coefficients.height);
  m_coefficients = transposed(m_coefficients);
}

void SplineImage::sample(const int* places, const float* fractions_x, const float* fractions_y, int count,
                         float* values) const {
  static const WeightTable table;
  sample_spline(m_coefficients.values.data(), m_coefficients.width, table.at, places, fractions_x, fractions_y, count,
                values);
}

// Beyond the border the coefficients are mirrored, as the prefilter takes them.
SplineDerivatives SplineImage::derivatives() const {
  const int w = width();
  const int h = height();
  SplineDerivatives out{{w, h}, {w, h}, {w, h}, {w, h}, {w, h}};
  const std::size_t padded = static_cast<std::size_t>(w) + 4;
  std::vector<float> sums(3 * padded);
  float* const kinds[] = {sums.data() + 2, sums.data() + padded + 2, sums.data() + 2 * padded + 2};
  const auto mirrored = [h](int y) { return y < 0 ? -y : y >= h ? 2 * (h - 1) - y : y; };
  for (int y = 0; y < h; ++y) {
    const float* rows[5];
    for (int k = 0; k < 5; ++k) rows[k] = m_coefficients.row(mirrored(y + k - 2));
    across_rows(rows, w, kinds[0], kinds[1], kinds[2]);
    for (float* kind : kinds) {
      kind[-1] = kind[1], kind[-2] = kind[2];
      kind[w] = kind[w - 2], kind[w + 1] = kind[w - 3];
    }
    along_row(kinds[0], kinds[1], kinds[2], w, out.x.row(y), out.y.row(y), out.xx.row(y), out.xy.row(y), out.yy.row(y));
  }
  return out;
}

}  // namespace zerodrift::vision
