#include "core/report/promise.h"

#include <cmath>
#include <nlohmann/json.hpp>

#include "core/report/limits.h"
#include "core/report/source.h"

namespace zerodrift::report {
namespace {

double largest_of(const nlohmann::json& body, const char* key) {
  double largest = std::nan("");
  for (const auto& direction : directions_of(body, key)) {
    largest = std::fmax(largest, number_of(body, key, direction));
  }
  return largest;
}

}  // namespace

bool Promise::known() const {
  return std::isfinite(promised_um) && std::isfinite(left_um);
}

bool Promise::held() const {
  return !known() || left_um <= limits::promise_reach * promised_um;
}

Promise promise_of(const nlohmann::json& model, const nlohmann::json& verification) {
  Promise promise;
  for (const auto& figure : list_of(model, "figures")) {
    promise.promised_um = std::fmax(promise.promised_um, number_of(figure, "peak_held_out_um"));
  }
  promise.left_um = largest_of(verification, "peak_error_after_um");
  return promise;
}

double least_removed_percent(const nlohmann::json& verification) {
  const double largest_um = largest_of(verification, "peak_error_before_um");
  const double limit_um = number_of(verification, "limit_um");
  double least = std::nan("");
  for (const auto& direction : directions_of(verification, "removed_percent")) {
    const double before_um = number_of(verification, "peak_error_before_um", direction);
    const bool counts = before_um > limit_um || before_um >= largest_um;
    if (counts) least = std::fmin(least, std::floor(number_of(verification, "removed_percent", direction)));
  }
  return least;
}

}  // namespace zerodrift::report
