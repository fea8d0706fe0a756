#include "app/machine/camera/sensor_noise.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace zerodrift::machine {
namespace {

constexpr int table_bits = 12;
constexpr std::size_t table_size = std::size_t{1} << table_bits;
using QuantileTable = std::array<float, table_size>;

double normal_below(double z) {
  return 0.5 * std::erfc(-z / std::sqrt(2.0));
}

QuantileTable make_quantiles() {
  QuantileTable table{};
  double sum_of_squares = 0.0;
  for (std::size_t i = 0; i < table_size; ++i) {
    const double probability = (static_cast<double>(i) + 0.5) / static_cast<double>(table_size);
    double low = -8.0;
    double high = 8.0;
    for (int round = 0; round < 60; ++round) {
      const double middle = 0.5 * (low + high);
      (normal_below(middle) < probability ? low : high) = middle;
    }
    table[i] = static_cast<float>(low);
    sum_of_squares += low * low;
  }
  const double scale = std::sqrt(static_cast<double>(table_size) / sum_of_squares);
  for (float& quantile : table) quantile = static_cast<float>(quantile * scale);
  return table;
}

class SplitMix64 {
 public:
  explicit SplitMix64(std::uint64_t seed) : m_state(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (m_state += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }

 private:
  std::uint64_t m_state;
};

}  // namespace

void add_sensor_noise(std::span<float> levels, double read_noise_levels, double electrons_per_level,
                      std::uint64_t seed) {
  static const QuantileTable quantiles = make_quantiles();
  const auto read_variance = static_cast<float>(read_noise_levels * read_noise_levels);
  const auto shot_variance = static_cast<float>(1.0 / electrons_per_level);
  SplitMix64 random(SplitMix64(seed).next());  // neighbouring seeds must not give shifted copies of one sequence
  std::uint64_t bits = 0;
  int left = 0;
  for (float& level : levels) {
    if (left == 0) {
      bits = random.next();
      left = 64 / table_bits;
    }
    const float deviate = quantiles[bits & (table_size - 1)];
    bits >>= table_bits;
    --left;
    level += deviate * std::sqrt(read_variance + shot_variance * (level > 0.0F ? level : 0.0F));
  }
}

}  // namespace zerodrift::machine
