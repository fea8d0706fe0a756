#include "core/analysis/model.h"

namespace zerodrift::analysis {

std::string_view name_of(Method method) {
  switch (method) {
    case Method::automatic:
      return "auto";
    case Method::mlr:
      return "mlr";
    case Method::ridge:
      return "ridge";
    case Method::pcr:
      return "pcr";
    case Method::lasso:
      return "lasso";
    case Method::robust:
      return "robust";
    case Method::dynamic:
      return "dynamic";
    case Method::arx:
      return "arx";
    case Method::greybox:
      return "greybox";
    case Method::physics:
      return "physics";
  }
  return "";
}

Result<Method> method_from(const std::string& name) {
  for (const Method m : {Method::automatic, Method::mlr, Method::ridge, Method::pcr, Method::lasso, Method::robust,
                         Method::dynamic, Method::arx, Method::greybox, Method::physics}) {
    if (name == name_of(m)) return m;
  }
  return fail(ErrorCode::bad_argument,
              {{"what", "the method"},
               {"found", name},
               {"expected", "auto, mlr, ridge, pcr, lasso, robust, dynamic, arx, greybox or physics"}});
}

bool is_static(Method method) {
  switch (method) {
    case Method::mlr:
    case Method::ridge:
    case Method::pcr:
    case Method::lasso:
    case Method::robust:
      return true;
    default:
      return false;
  }
}

Eigen::VectorXd Model::half_width_um(const ErrorModel& error, const Eigen::MatrixXd& x,
                                     const Eigen::RowVectorXd* zero) const {
  const Eigen::Map<const Eigen::VectorXd> noise(noise_C.data(), static_cast<Eigen::Index>(noise_C.size()));
  const double reading_um = error.regression.raw_coefficients().cwiseProduct(noise).norm();
  RidgeFit regression = error.regression;
  // The factor of several cycles was found with deviations about the mean of training; only a prior speaks of any zero.
  if (zero != nullptr && error.band.by_prior()) regression.mean = zero->transpose();
  return error.band.factor * (regression.deviation(x).array().square() + reading_um * reading_um).sqrt();
}

const ErrorModel* Model::find(std::string_view error) const {
  for (const auto& e : errors) {
    if (e.error == error) return &e;
  }
  return nullptr;
}

const TableTerms* Model::table_terms(std::string_view error) const {
  for (const auto& t : table) {
    if (t.error == error) return &t;
  }
  return nullptr;
}

}  // namespace zerodrift::analysis
