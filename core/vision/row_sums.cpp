#include "core/vision/row_sums.h"

#include <algorithm>
#include <cstring>

namespace zerodrift::vision {
namespace {

// Eight numbers in one register or in two; the way GCC and Clang spell it.
typedef float Eight __attribute__((vector_size(32)));
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

ZERODRIFT_WIDE void byte_sums(const std::uint8_t* a, const std::uint8_t* b, int count, std::int32_t* sums) {
  std::int32_t product = 0, sum = 0, squares = 0;
  for (int k = 0; k < count; ++k) {
    product += a[k] * b[k];
    sum += a[k];
    squares += a[k] * a[k];
  }
  sums[0] = product, sums[1] = sum, sums[2] = squares;
}

}  // namespace zerodrift::vision
