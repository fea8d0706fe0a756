#pragma once
// What the fit said a verification would leave at most, and what it left. Rail, page and report judge by this.

#include <limits>
#include <nlohmann/json_fwd.hpp>

namespace zerodrift::report {

struct Promise {
  double promised_um = std::numeric_limits<double>::quiet_NaN();  // largest error on stretches the fit had not seen
  double left_um = std::numeric_limits<double>::quiet_NaN();      // largest error of the verification

  bool known() const;  // both
  bool held() const;   // within limits::promise_reach; also where it is not known
};

/// From the bodies of the job's artefacts "model" and "verification"; null is allowed.
Promise promise_of(const nlohmann::json& model, const nlohmann::json& verification);

/// The least share of a direction's largest error that is gone, in whole percent downwards: of the direction with the
/// largest error and of those above the limit before; NaN without one. What was small before is not judged.
double least_removed_percent(const nlohmann::json& verification);

}  // namespace zerodrift::report
