#pragma once
// The sums of a least-squares solve over many pixels, each of which has a row of sixteen numbers (unused ones are
// zero). Three quarters of a registration's time goes into them, so they are compiled for wide registers as well, and
// the processor's own are chosen when the program starts. Plain arrays: Eigen's types differ between the two.

#include <cstddef>
#include <cstdint>

namespace zerodrift::vision {

inline constexpr std::ptrdiff_t row_length = 16;

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_ADDRESS__)
#define ZERODRIFT_WIDE __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define ZERODRIFT_WIDE
#endif

/// sums (16 x 16, symmetric) += weight * row * row'.
void add_squares(const float* rows, const float* weights, int count, double* sums);
/// sums (16) += value * row.
void add_products(const float* rows, const float* values, int count, double* sums);
/// values = from - row . factors; `from` may be `values`.
void subtract_model(const float* rows, const float* factors, int count, const float* from, float* values);
/// sums (4 x 16) += share * weight * row for each of four shares a pixel.
void add_shared(const float* rows, const float* weights, const float* shares, int count, float* sums);
/// row -= share * change for each of four shares a pixel and their changes (4 x 16).
void subtract_shared(float* rows, const float* shares, int count, const float* changes);
/// Tukey's biweight of error * root * inverse where `use` is zero, none elsewhere.
void tukey_weights(const float* errors, const float* roots, float inverse, const std::uint8_t* use, int count,
                   float* weights);

/// Sums over pixels, each of 1, x, y, x^2, x y and y^2 times: fx^2, fx fy, fy^2, and whether fx and fy are not zero.
struct GradientMoments {
  double xx[6] = {}, xy[6] = {}, yy[6] = {}, along_x[6] = {}, along_y[6] = {};
};
void add_moments(const float* x, const float* y, const float* fx, const float* fy, int count, GradientMoments& sums);

/// to = sum over taps k of weight * (ahead + behind), `ahead` k steps on from the middle and `behind` k steps back.
void blur_row(const float* middle, std::ptrdiff_t step, const float* weights, int taps, int count, float* to);

/// sums of a * b, a and a * a over one row of a picture: product, sum, squares.
void level_sums(const std::int16_t* a, const std::int16_t* b, int count, std::int32_t* sums);

/// For each of places_at_once places side by side, `picture` being the first: sums over a pattern's samples of
/// value * level, level and level^2.
struct PatternSample {
  std::int32_t offset;  // in the picture, from the place
  float value;
};
inline constexpr int places_at_once = 16;
void pattern_sums(const PatternSample* samples, int count, const float* picture, float* products, float* levels,
                  float* squares);

}  // namespace zerodrift::vision
