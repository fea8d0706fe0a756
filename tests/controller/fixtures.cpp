#include "fixtures.h"

#include <gtest/gtest.h>

#include "fake_controller.h"

namespace zerodrift::controller {

std::unique_ptr<ModbusMachine> open(const Profile& profile) {
  auto machine = ModbusMachine::open(profile, engineer());
  EXPECT_TRUE(machine) << describe(machine.error());
  return std::move(*machine);
}

std::string text_of(const Status& status) {
  return status ? "done" : describe(status.error());
}

compensation::Table sample_table(double coefficient) {
  compensation::Table table;
  compensation::AxisTable& z = table.axes["Z"];
  z.offset_um = -3.0;
  z.terms = {{"T1_C", coefficient, 20.0, 0.5}, {"ambient_C", -1.0, 20.0, 0.0}};
  for (int i = 0; i < 20; ++i) z.points.push_back({10.0 * i, 0.5 * i, 0.5 * i + 1.0, 0.25});
  table.axes["X"].offset_um = 4.0;
  return table;
}

}  // namespace zerodrift::controller
