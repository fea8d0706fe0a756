#include "core/vision/device_clock.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace zerodrift::vision {
namespace {

/// Pictures 25 times a second for so long by a device whose clock starts at another time and runs wrong by `ppm`; they
/// arrive after 8 ms and an exponential delay, every fiftieth 300 ms later. Largest error of the stamps, relative to an
/// arrival without jitter, after the first `settled_s`.
double largest_error_s(double ppm, double jitter_s, double length_s, double settled_s) {
  DeviceClock clock;
  std::mt19937 dice(7);
  std::exponential_distribution<double> jitter(1.0 / jitter_s);
  double largest_s = 0.0;
  for (int i = 0; i < static_cast<int>(25 * length_s); ++i) {
    const double exposed_s = 5000.0 + 0.04 * i;
    const double device_s = 1.7e9 + 0.04 * i * (1.0 + 1e-6 * ppm);
    const double arrived_s = exposed_s + 0.008 + jitter(dice) + (i % 50 == 49 ? 0.3 : 0.0);
    const double stamp_s = clock.to_host(Seconds(device_s), Seconds(arrived_s)).count();
    EXPECT_LE(stamp_s, arrived_s + 1e-9);
    if (0.04 * i >= settled_s) largest_s = std::max(largest_s, std::abs(stamp_s - exposed_s - 0.008));
  }
  return largest_s;
}

TEST(DeviceClock, TakesJitterOutAndFollowsAClockThatRunsWrong) {
  for (const double ppm : {0.0, 80.0, -80.0, 300.0}) {
    const double error_s = largest_error_s(ppm, 0.005, 300.0, 20.0);
    std::printf("%+.0f ppm: largest error of a stamp %.2f ms, of an arrival over 300 ms\n", ppm, 1000.0 * error_s);
    EXPECT_LT(error_s, 0.003) << ppm;
  }
}

TEST(DeviceClock, TheFirstPicturesAreStampedByTheirArrivalAtWorst) {
  EXPECT_LT(largest_error_s(50.0, 0.005, 4.0, 2.0), 0.01);
  DeviceClock clock;
  EXPECT_EQ(clock.to_host(Seconds(9.0), Seconds(100.0)).count(), 100.0);
}

TEST(DeviceClock, AClockThatIsSetAnewBeginsAnew) {
  DeviceClock clock;
  double host_s = 50.0;
  for (int i = 0; i < 100; ++i) clock.to_host(Seconds(1000.0 + 0.04 * i), Seconds(host_s += 0.04));
  // The camera was switched off and on: its clock begins at 0.
  EXPECT_EQ(clock.to_host(Seconds(0.1), Seconds(host_s + 3.0)).count(), host_s + 3.0);
  EXPECT_NEAR(clock.to_host(Seconds(0.14), Seconds(host_s + 3.09)).count(), host_s + 3.04, 1e-4);
  // It was set to the time of day, or counts something else than seconds.
  EXPECT_EQ(clock.to_host(Seconds(1.7e9), Seconds(host_s + 3.2)).count(), host_s + 3.2);
  EXPECT_EQ(clock.to_host(Seconds(1.8e9), Seconds(host_s + 3.3)).count(), host_s + 3.3);
  // It stands still.
  EXPECT_EQ(clock.to_host(Seconds(1.8e9), Seconds(host_s + 3.4)).count(), host_s + 3.4);
}

}  // namespace
}  // namespace zerodrift::vision
