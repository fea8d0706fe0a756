#include "core/base/noise.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/base/hash.h"

namespace zerodrift {

TEST(Noise, SameSeedSameNumbersOnAnyCompiler) {
  Noise noise(1);
  // First outputs of std::mt19937_64(1), a sequence the standard fixes.
  EXPECT_DOUBLE_EQ(noise.uniform(), 0.13387664401253274);
}

TEST(Noise, NormalHasUnitVariance) {
  Noise noise(7);
  double sum = 0.0;
  double squares = 0.0;
  constexpr int count = 200000;
  for (int i = 0; i < count; ++i) {
    const double x = noise.normal();
    sum += x;
    squares += x * x;
  }
  EXPECT_NEAR(sum / count, 0.0, 0.01);
  EXPECT_NEAR(squares / count, 1.0, 0.02);
}

TEST(Hash, PublishedVectors) {
  EXPECT_EQ(sha256_hex("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");  // FIPS 180-4
  EXPECT_EQ(crc32_of("123456789"), 0xCBF43926U);  // the check value of CRC-32/ISO-HDLC
}

}  // namespace zerodrift
