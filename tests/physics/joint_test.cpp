// What sensors beside an imperfect joint read on the grid of a diagnosis, against a grid twenty times as fine.
#include "core/physics/joint.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "core/physics/builder.h"
#include "core/physics/prediction.h"
#include "tests/physics/machines.h"

namespace zerodrift::physics {
namespace {

constexpr double place_mm = 223.0;

Machine with_joint(double half_width_mm) {
  auto json = test::spindle_json();
  json["effects"].push_back("contact_resistance");
  json["effect_parameters"]["contact_resistance"] = {{"component", "spindle"},
                                                     {"resistance_m2K_W", 2e-3},
                                                     {"position_mm", place_mm},
                                                     {"half_width_mm", half_width_mm}};
  json["sensors"] = nlohmann::json::array();
  for (const double beside_mm : {-25.0, -9.0, -4.0, -1.0, 1.0, 4.0, 9.0, 25.0}) {
    json["sensors"].push_back({{"channel", "T" + std::to_string(json["sensors"].size() + 1) + "_C"},
                               {"component", "spindle"},
                               {"position_mm", place_mm + beside_mm}});
  }
  return *machine_from_json(json, "joint.json");
}

Prediction on_grid(const Machine& machine, int cells) {
  const auto run = test::stepped_run(2.0, 60.0);
  const Network network = build_network(machine, run, {cells});
  return predict(network, make_inputs(network, run), network.start_values());
}

double largest_step_K(const Prediction& fine) {
  double largest = 0.0;
  for (std::size_t k = 0; k < fine.rows; ++k) {
    largest = std::max(largest, std::abs(fine.channels[1].values[k] - fine.channels[6].values[k]));
  }
  return largest;
}

}  // namespace

TEST(Joint, SensorsBesideItReadTheirOwnSide) {
  // Read by a line between the cells' middles they are off by 0.28 of the step across a narrow joint and by 0.12.
  for (const auto& [half_width_mm, share] : {std::pair{2.0, 0.15}, {6.0, 0.06}, {12.0, 0.04}}) {
    SCOPED_TRACE(half_width_mm);
    const Machine machine = with_joint(half_width_mm);
    const Prediction coarse = on_grid(machine, 40), fine = on_grid(machine, 800);
    const double step_K = largest_step_K(fine);
    ASSERT_GT(step_K, 1.0);
    double worst_K = 0.0;
    for (std::size_t c = 0; c < fine.channels.size(); ++c) {
      for (std::size_t k = 0; fine.channels[c].temperature && k < fine.rows; ++k) {
        worst_K = std::max(worst_K, std::abs(coarse.channels[c].values[k] - fine.channels[c].values[k]));
      }
    }
    EXPECT_LT(worst_K, share * step_K);
  }
}

TEST(Joint, AllOfItLiesBetweenItsEnds) {
  EXPECT_EQ(share_before(-1.0, 0.5).value, 0.0);
  EXPECT_EQ(share_before(1.0, 0.5).value, 1.0);
  EXPECT_NEAR(share_before(0.0, 0.5).value, 0.5, 1e-15);
  // What lies between two cells' middles is the difference of the cells' means.
  for (const double place : {-1.3, -0.4, 0.0, 0.2, 0.9}) {
    for (const double half : {0.1, 0.6, 1.7}) {
      const double between = mean_share_before(0.5 - place, half).value - mean_share_before(-0.5 - place, half).value;
      EXPECT_NEAR(share_of_face(place, half).value, between, 1e-12) << place << " " << half;
    }
  }
}

}  // namespace zerodrift::physics
