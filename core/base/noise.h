#pragma once
// Random numbers that are the same on every compiler: std::mt19937_64 is specified bit by bit, the distributions of the
// standard library are not, so ours are written out. Used wherever a seed must reproduce a result.

#include <cstdint>
#include <random>

namespace zerodrift {

class Noise {
 public:
  explicit Noise(std::uint64_t seed) : m_engine(seed) {}
  /// Uniform in [0, 1).
  double uniform();
  /// Uniform in [low, high).
  double uniform(double low, double high);
  /// Normal with mean 0 and standard deviation 1 (Box and Muller 1958).
  double normal();
  /// Uniform integer in [0, count).
  std::uint64_t index(std::uint64_t count);

 private:
  std::mt19937_64 m_engine;
  double m_spare = 0.0;
  bool m_has_spare = false;
};

}  // namespace zerodrift
