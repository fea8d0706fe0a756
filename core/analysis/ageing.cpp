#include "core/analysis/ageing.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/analysis/training.h"

namespace zerodrift::analysis {
namespace {

/// Corrects one regression by rows of the new run. With S the prior covariance of the coefficients, K that of the noise
/// and V = K + Z S Z', the gain is S Z' V^-1 and the intercept is free.
void correct(RidgeFit& fit, const Rows& rows, double aged_share) {
  const Eigen::MatrixXd z = (rows.x.rowwise() - fit.mean.transpose()) * fit.scale.cwiseInverse().asDiagonal();
  Eigen::MatrixXd prior = fit.covariance;
  prior.diagonal().array() += (aged_share * fit.beta.array() / fit.sigma_um).square();
  const Eigen::MatrixXd zs = z * prior;
  Eigen::MatrixXd v = zs * z.transpose();
  for (Eigen::Index i = 0; i < v.rows(); ++i) {
    for (Eigen::Index j = 0; j < v.cols(); ++j) {
      const double dt_s = std::abs(rows.time_s[static_cast<std::size_t>(i)] - rows.time_s[static_cast<std::size_t>(j)]);
      if (fit.noise.memory_s > 0.0) v(i, j) += std::exp(-dt_s / fit.noise.memory_s);
    }
    v(i, i) += fit.noise.memory_s > 0.0 ? fit.noise.nugget : 1.0;
  }
  const Eigen::LLT<Eigen::MatrixXd> llt(v);
  const Eigen::VectorXd residual = rows.y - fit.predict(rows.x);
  const Eigen::VectorXd ones = Eigen::VectorXd::Ones(rows.size());
  const Eigen::VectorXd weights = llt.solve(ones);
  const double shift = weights.dot(residual) / weights.sum();
  const Eigen::VectorXd solved = llt.solve(residual - shift * ones);
  fit.beta += zs.transpose() * solved;
  fit.intercept += shift;
  fit.covariance = prior - zs.transpose() * llt.solve(zs);
  fit.covariance = 0.5 * (fit.covariance + fit.covariance.transpose()).eval();
}

}  // namespace

Result<Model> update(const Model& old, const recording::Recording& run, double aged_share) {
  PrepareOptions options;
  options.sensors = old.sensors;
  for (const auto& e : old.errors) options.errors.push_back(e.error);
  ZD_TRY(const TrainingSet set, make_training({run}, options));
  ZD_TRY(const Eigen::MatrixXd x, design(set, old.features));
  Model model = old;
  model.recordings.push_back(run.name);
  for (const auto& group : error_groups(set)) {
    for (const Eigen::Index e : group.errors) {
      ErrorModel& error = model.errors[static_cast<std::size_t>(e)];
      const Rows rows = rows_of(set, x, group.samples, e);
      correct(error.regression, rows, aged_share);
      error.fit = residual_figures(rows.y, error.regression.predict(rows.x));
      error.remembered_um = 0.0;
      if (!model.is_static()) continue;
      TableTerms& table = model.table[static_cast<std::size_t>(e)];
      const Eigen::VectorXd coefficients = error.regression.raw_coefficients();
      for (std::size_t s = 0; s < table.terms.size(); ++s) {
        table.terms[s].um_per_K = coefficients(static_cast<Eigen::Index>(s));
      }
      // The offset stays: the new run counts from its own start, the table from the references of the first one.
      table.fit = error.fit;
    }
  }
  model.reason = old.reason + "; corrected by the run " + run.name;
  return model;
}

bool DriftDetector::add(double standardised) {
  if (!std::isfinite(standardised)) return m_alarm;
  m_high = std::max(0.0, m_high + standardised - m_slack);
  m_low = std::max(0.0, m_low - standardised - m_slack);
  m_alarm = m_alarm || m_high > m_limit || m_low > m_limit;
  return m_alarm;
}

std::vector<DriftCheck> check_drift(const Prediction& prediction, const recording::Recording& recording) {
  constexpr double every_s = 3600.0;
  constexpr double deviations_of_band = 1.645;
  std::vector<DriftCheck> out;
  for (const auto& e : prediction.errors) {
    const recording::Channel* measured = recording.find(e.error);
    if (measured == nullptr) continue;
    DriftCheck check{e.error};
    DriftDetector detector;
    double sum = 0.0;
    int count = 0;
    double until_s = prediction.time_s.front() + every_s;
    for (std::size_t i = 0; i < prediction.time_s.size(); ++i) {
      const double deviation_um = e.half_width_um[i] / deviations_of_band;
      if (std::isfinite(measured->values[i]) && deviation_um > 0.0) {
        sum += (measured->values[i] - e.value_um[i]) / deviation_um;
        ++count;
      }
      const bool last = i + 1 == prediction.time_s.size();
      if (!last && prediction.time_s[i + 1] < until_s) continue;
      until_s += every_s;
      if (count == 0) continue;
      ++check.checks;
      if (detector.add(sum / count) && !check.alarm) {
        check.alarm = true;
        check.at_s = prediction.time_s[i];
      }
      sum = 0.0;
      count = 0;
    }
    out.push_back(check);
  }
  return out;
}

void DriftDetector::reset() {
  m_high = m_low = 0.0;
  m_alarm = false;
}

}  // namespace zerodrift::analysis
