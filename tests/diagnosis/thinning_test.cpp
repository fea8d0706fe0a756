// Long recordings are averaged to a fitting length without moving what heats.
#include "core/diagnosis/input/thinning.h"

#include <gtest/gtest.h>

#include <cmath>

namespace zerodrift::diagnosis {
namespace {

recording::Recording long_run(std::size_t rows) {
  recording::Recording run;
  run.channels = {{"spindle_rpm", {}}, {"T1_C", {}}};
  for (std::size_t k = 0; k < rows; ++k) {
    run.time_s.push_back(2.0 * static_cast<double>(k));
    run.channels[0].values.push_back(k >= 4321 ? 3000.0 : 0.0);
    run.channels[1].values.push_back(20.0 + 1e-3 * static_cast<double>(k) + (k == 5000 ? 40.0 : 0.0));
  }
  return run;
}

}  // namespace

TEST(Thinning, ShortRecordingsStayAsTheyAre) {
  EXPECT_EQ(thinned(long_run(1500), 1500).rows(), 1500U);
}

TEST(Thinning, KeepsTheEdgesOfInputsAndLeavesSpikesOut) {
  const recording::Recording run = long_run(30000);
  const recording::Recording thin = thinned(run, 1500);
  EXPECT_LT(thin.rows(), 1700U);
  const auto& rpm = thin.find("spindle_rpm")->values;
  for (const double n : rpm) EXPECT_TRUE(n == 0.0 || n == 3000.0) << n;
  for (std::size_t k = 0; k < thin.rows(); ++k) {
    // The spike's moment counts in its bin's time but not in its mean: less than one sample's rise. Left in: 2 K.
    EXPECT_NEAR(thin.find("T1_C")->values[k], 20.0 + 0.5e-3 * thin.time_s[k], 1e-3) << thin.time_s[k];
    if (k > 0) {
      EXPECT_GT(thin.time_s[k], thin.time_s[k - 1]);
    }
  }
}

}  // namespace zerodrift::diagnosis
