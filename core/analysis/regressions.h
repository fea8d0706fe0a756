#pragma once
// Regressions beside ridge, each in the clothes of RidgeFit so that prediction, band and files treat them alike.
// What has to be chosen (components, penalty) is chosen by leaving out contiguous blocks of the rows given, never
// single rows: neighbours in time know each other.

#include <vector>

#include "core/analysis/linear.h"

namespace zerodrift::analysis {

/// Textbook multiple linear regression.
RidgeFit fit_multiple(const Eigen::MatrixXd& x, const Eigen::VectorXd& y);
/// Regression on the leading principal components of the standardised features (Massy 1965).
RidgeFit fit_components(const Eigen::MatrixXd& x, const Eigen::VectorXd& y);
/// Least absolute shrinkage and selection (Tibshirani 1996) by coordinate descent (Friedman and others 2007).
RidgeFit fit_lasso(const Eigen::MatrixXd& x, const Eigen::VectorXd& y);
/// Ridge on residuals pulled in to Huber's limit, until they rest (Huber 1981, modified residuals): single wild
/// measurements lose their pull, on the penalty as well.
RidgeFit fit_robust(const Rows& rows);
/// Ridge on one group of columns; of the groups the one of the largest likelihood, for each error its own. The groups
/// are the features of one set of time constants: a first-order ARX model, or a state-space model, whose poles are
/// taken from a list of stable ones.
std::vector<RidgeFit> fit_poles(const Rows& rows, const Eigen::MatrixXd& errors_um,
                                const std::vector<std::vector<int>>& groups, double duration_s);

/// Members fitted on the first columns of the same rows (each a list by error) as one fit of all columns: the mean of
/// their coefficients, and how far they are apart in its uncertainty.
std::vector<RidgeFit> mean_of(const std::vector<std::vector<RidgeFit>>& members, Eigen::Index columns);

}  // namespace zerodrift::analysis
