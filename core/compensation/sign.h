#pragma once
// The sign convention of the product, stated once:
//   error        = actual - commanded   (the axis went too far: positive)
//   compensation = -error               (what is added to the command to take the error out)
// Tables, models, recordings and reports hold errors. Only what is sent to a machine is a compensation, and every
// export says which of the two its format wants.

namespace zerodrift::compensation {

constexpr double error_from_positions_um(double actual_mm, double commanded_mm) {
  return 1000.0 * (actual_mm - commanded_mm);
}
constexpr double compensation_from_error_um(double error_um) {
  return 0.0 - error_um;  // not -0 for 0
}
constexpr double error_from_compensation_um(double compensation_um) {
  return -compensation_um;
}

}  // namespace zerodrift::compensation
