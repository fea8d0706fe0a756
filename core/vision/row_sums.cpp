#include "core/vision/row_sums.h"

#include <algorithm>
#include <cstring>

namespace zerodrift::vision {
namespace {

// Eight numbers in one register or in two; the way GCC and Clang spell it.
typedef float Eight __attribute__((vector_size(32)));
typedef double FourDoubles __attribute__((vector_size(32)));
typedef float EightAnywhere __attribute__((vector_size(32), aligned(4), may_alias));

constexpr int pixels_a_block = 512;  // pixels summed in single precision before they are added in double

inline void add_to(double* sums, const Eight& part) {
  for (int i = 0; i < 8; ++i) sums[i] += static_cast<double>(part[i]);
}

}  // namespace

ZERODRIFT_WIDE void add_squares(const float* rows, const float* weights, int count, double* sums) {
  for (int begin = 0; begin < count; begin += pixels_a_block) {
    const int end = std::min(begin + pixels_a_block, count);
    // Upper left, then upper right and lower right: so many sums as fit into registers.
    Eight first[8] = {};
    for (int k = begin; k < end; ++k) {
      const float* row = rows + static_cast<std::ptrdiff_t>(k) * row_length;
      const Eight low = weights[k] * *reinterpret_cast<const EightAnywhere*>(row);
      for (int i = 0; i < 8; ++i) first[i] += row[i] * low;
    }
    for (int i = 0; i < 8; ++i) add_to(sums + i * row_length, first[i]);
    Eight right[8] = {};
    Eight last[6] = {};
    for (int k = begin; k < end; ++k) {
      const float* row = rows + static_cast<std::ptrdiff_t>(k) * row_length;
      const Eight high = weights[k] * *reinterpret_cast<const EightAnywhere*>(row + 8);
      for (int i = 0; i < 8; ++i) right[i] += row[i] * high;
      for (int i = 0; i < 6; ++i) last[i] += row[8 + i] * high;
    }
    for (int i = 0; i < 8; ++i) {
      add_to(sums + i * row_length + 8, right[i]);
      for (int j = 0; j < 8; ++j) sums[(8 + j) * row_length + i] += static_cast<double>(right[i][j]);
    }
    for (int i = 0; i < 6; ++i) add_to(sums + (8 + i) * row_length + 8, last[i]);
  }
}

ZERODRIFT_WIDE void add_products(const float* rows, const float* values, int count, double* sums) {
  for (int begin = 0; begin < count; begin += pixels_a_block) {
    const int end = std::min(begin + pixels_a_block, count);
    Eight low[2] = {};
    Eight high[2] = {};
    for (int k = begin; k < end; ++k) {
      const float* row = rows + static_cast<std::ptrdiff_t>(k) * row_length;
      low[k & 1] += values[k] * *reinterpret_cast<const EightAnywhere*>(row);
      high[k & 1] += values[k] * *reinterpret_cast<const EightAnywhere*>(row + 8);
    }
    add_to(sums, low[0] + low[1]);
    add_to(sums + 8, high[0] + high[1]);
  }
}

ZERODRIFT_WIDE void subtract_model(const float* rows, const float* factors, int count, const float* from,
                                   float* values) {
  const Eight low = *reinterpret_cast<const EightAnywhere*>(factors);
  const Eight high = *reinterpret_cast<const EightAnywhere*>(factors + 8);
  for (int k = 0; k < count; ++k) {
    const float* row = rows + static_cast<std::ptrdiff_t>(k) * row_length;
    const Eight sum =
        low * *reinterpret_cast<const EightAnywhere*>(row) + high * *reinterpret_cast<const EightAnywhere*>(row + 8);
    values[k] = from[k] - (((sum[0] + sum[4]) + (sum[1] + sum[5])) + ((sum[2] + sum[6]) + (sum[3] + sum[7])));
  }
}

ZERODRIFT_WIDE void add_shared(const float* rows, const float* weights, const float* shares, int count, float* sums) {
  Eight low[4];
  Eight high[4];
  for (int i = 0; i < 4; ++i) {
    low[i] = *reinterpret_cast<const EightAnywhere*>(sums + i * row_length);
    high[i] = *reinterpret_cast<const EightAnywhere*>(sums + i * row_length + 8);
  }
  for (int k = 0; k < count; ++k) {
    const float* row = rows + static_cast<std::ptrdiff_t>(k) * row_length;
    const Eight row_low = weights[k] * *reinterpret_cast<const EightAnywhere*>(row);
    const Eight row_high = weights[k] * *reinterpret_cast<const EightAnywhere*>(row + 8);
    for (int i = 0; i < 4; ++i) {
      low[i] += shares[4 * k + i] * row_low;
      high[i] += shares[4 * k + i] * row_high;
    }
  }
  for (int i = 0; i < 4; ++i) {
    *reinterpret_cast<EightAnywhere*>(sums + i * row_length) = low[i];
    *reinterpret_cast<EightAnywhere*>(sums + i * row_length + 8) = high[i];
  }
}

ZERODRIFT_WIDE void subtract_shared(float* rows, const float* shares, int count, const float* changes) {
  for (int k = 0; k < count; ++k) {
    float* row = rows + static_cast<std::ptrdiff_t>(k) * row_length;
    Eight low = *reinterpret_cast<const EightAnywhere*>(row);
    Eight high = *reinterpret_cast<const EightAnywhere*>(row + 8);
    for (int i = 0; i < 4; ++i) {
      low -= shares[4 * k + i] * *reinterpret_cast<const EightAnywhere*>(changes + i * row_length);
      high -= shares[4 * k + i] * *reinterpret_cast<const EightAnywhere*>(changes + i * row_length + 8);
    }
    *reinterpret_cast<EightAnywhere*>(row) = low;
    *reinterpret_cast<EightAnywhere*>(row + 8) = high;
  }
}

ZERODRIFT_WIDE void tukey_weights(const float* __restrict errors, const float* __restrict roots, float inverse,
                                  const std::uint8_t* __restrict use, int count, float* __restrict weights) {
  for (int k = 0; k < count; ++k) {
    const float u = errors[k] * roots[k] * inverse;
    const float left = std::max(0.0f, 1.0f - u * u);
    weights[k] = use[k] == 0 ? left * left : 0.0f;
  }
}

ZERODRIFT_WIDE void add_moments(const float* x, const float* y, const float* fx, const float* fy, int count,
                                GradientMoments& sums) {
  double* const to[] = {sums.xx, sums.xy, sums.yy, sums.along_x, sums.along_y};
  FourDoubles moment[5][6] = {};
  for (int k = 0; k < count; k += 4) {
    FourDoubles px = {}, py = {}, gx = {}, gy = {}, with_x = {}, with_y = {};  // what is beyond the end counts nothing
    for (int i = 0; i < std::min(4, count - k); ++i) {
      px[i] = x[k + i], py[i] = y[k + i], gx[i] = fx[k + i], gy[i] = fy[k + i];
      with_x[i] = fx[k + i] != 0.0f, with_y[i] = fy[k + i] != 0.0f;
    }
    const FourDoubles of_place[] = {px, py, px * px, px * py, py * py};
    const FourDoubles of_gradient[] = {gx * gx, gx * gy, gy * gy, with_x, with_y};
    for (int g = 0; g < 5; ++g) {
      moment[g][0] += of_gradient[g];
      for (int p = 0; p < 5; ++p) moment[g][p + 1] += of_gradient[g] * of_place[p];
    }
  }
  for (int g = 0; g < 5; ++g) {
    for (int p = 0; p < 6; ++p) {
      const FourDoubles& m = moment[g][p];
      to[g][p] += (m[0] + m[2]) + (m[1] + m[3]);
    }
  }
}

ZERODRIFT_WIDE void blur_row(const float* middle, std::ptrdiff_t step, const float* weights, int taps, int count,
                             float* to) {
  constexpr int at_once = 32;
  const auto eight = [](const float* from) -> const EightAnywhere& {
    return *reinterpret_cast<const EightAnywhere*>(from);
  };
  int x = 0;
  for (; x + at_once <= count; x += at_once) {
    Eight sum[4];
    for (int i = 0; i < 4; ++i) sum[i] = weights[0] * eight(middle + x + 8 * i);
    for (int k = 1; k < taps; ++k) {
      const float* ahead = middle + x + k * step;
      const float* behind = middle + x - k * step;
      for (int i = 0; i < 4; ++i) sum[i] += weights[k] * (eight(ahead + 8 * i) + eight(behind + 8 * i));
    }
    for (int i = 0; i < 4; ++i) *reinterpret_cast<EightAnywhere*>(to + x + 8 * i) = sum[i];
  }
  for (; x < count; ++x) {
    float sum = weights[0] * middle[x];
    for (int k = 1; k < taps; ++k) sum += weights[k] * (middle[x + k * step] + middle[x - k * step]);
    to[x] = sum;
  }
}

ZERODRIFT_WIDE void level_sums(const std::int16_t* a, const std::int16_t* b, int count, std::int32_t* sums) {
  std::int32_t product = 0, sum = 0, squares = 0;
  for (int k = 0; k < count; ++k) {
    product += a[k] * b[k];
    sum += a[k];
    squares += a[k] * a[k];
  }
  sums[0] = product, sums[1] = sum, sums[2] = squares;
}

ZERODRIFT_WIDE void pattern_sums(const PatternSample* samples, int count, const float* picture, float* products,
                                 float* levels, float* squares) {
  constexpr int registers = places_at_once / 8;
  Eight product[registers] = {}, level[registers] = {}, square[registers] = {};
  for (int k = 0; k < count; ++k) {
    const float* at = picture + samples[k].offset;
    for (int i = 0; i < registers; ++i) {
      const Eight here = *reinterpret_cast<const EightAnywhere*>(at + 8 * i);
      product[i] += samples[k].value * here;
      level[i] += here;
      square[i] += here * here;
    }
  }
  for (int i = 0; i < registers; ++i) {
    *reinterpret_cast<EightAnywhere*>(products + 8 * i) = product[i];
    *reinterpret_cast<EightAnywhere*>(levels + 8 * i) = level[i];
    *reinterpret_cast<EightAnywhere*>(squares + 8 * i) = square[i];
  }
}

}  // namespace zerodrift::vision
