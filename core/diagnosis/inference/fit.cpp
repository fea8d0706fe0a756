#include "core/diagnosis/inference/fit.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/analysis/nonlinear.h"

namespace zerodrift::diagnosis::inference {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

namespace {

double log_determinant(const Eigen::LLT<MatrixXd>& factors) {
  return 2.0 * factors.matrixLLT().diagonal().array().max(1e-150).log().sum();
}

}  // namespace

bool gains_act(const Evidence& evidence, std::size_t group, const Sizes& sizes) {
  return evidence.gains()[group].count > 0 &&
         evidence.settings().repeatable_sizes[static_cast<std::size_t>(sizes.repeatable[group])].size > 0.0;
}

Eigen::LLT<MatrixXd> gain_precision(const Evidence& evidence, std::size_t group, const Sizes& sizes) {
  const GainGroup& gains = evidence.gains()[group];
  const double size = evidence.settings().repeatable_sizes[static_cast<std::size_t>(sizes.repeatable[group])].size;
  MatrixXd precision = gains.prior_precision / (size * size);
  for (std::size_t i = 0; i < gains.series.size(); ++i) {
    const MatrixXd& gram = evidence.whitened(gains.series[i], sizes).basis_gram;
    precision.block(gains.first[i], gains.first[i], gram.rows(), gram.cols()) += gram;
  }
  return Eigen::LLT<MatrixXd>(precision);
}

Fit::Fit(std::shared_ptr<const JointModel> model, Sizes sizes)
    : m_model(std::move(model)), m_sizes(std::move(sizes)), m_z(m_model->start()) {}

std::vector<int> Fit::all_unknowns() const {
  std::vector<int> list(m_model->unknowns());
  for (std::size_t i = 0; i < list.size(); ++i) list[i] = static_cast<int>(i);
  return list;
}

void Fit::set_z(std::size_t i, double z) {
  const auto at = static_cast<Index>(i);
  m_z[at] = std::clamp(z, m_model->low()[at], m_model->high()[at]);
  m_predicted.clear();
  m_statistics.clear();
}

void Fit::reset_description() {
  for (std::size_t i = 0; i < m_model->unknowns(); ++i) {
    const auto at = static_cast<Index>(i);
    if (m_model->unknown(i).effect < 0) m_z[at] = m_model->start()[at];
  }
  refresh(all_unknowns());
}

void Fit::set_sizes(Sizes sizes) {
  m_sizes = std::move(sizes);
  if (!m_predicted.empty()) m_cost = cost_of(m_predicted, m_z);
}

void Fit::start_from(const Fit& other, bool columns) {
  m_predicted.clear();
  m_statistics.clear();
  std::vector<std::pair<Index, Index>> taken;
  for (std::size_t i = 0; i < m_model->unknowns(); ++i) {
    const int at = other.m_model->find(m_model->unknown(i).identity);
    if (at < 0) continue;
    const auto mine = static_cast<Index>(i);
    m_z[mine] = std::clamp(other.m_z[at], m_model->low()[mine], m_model->high()[mine]);
    taken.emplace_back(mine, at);
  }
  m_have_columns = columns && other.m_have_columns;
  m_stale = true;
  if (!m_have_columns) return;
  m_columns.clear();
  for (const RowMatrix& from : other.m_columns) {
    RowMatrix to = RowMatrix::Zero(from.rows(), static_cast<Index>(m_model->unknowns()));
    for (const auto& [mine, theirs] : taken) to.col(mine) = from.col(theirs);
    m_columns.push_back(std::move(to));
  }
}

Fit::Predicted Fit::simulate(const VectorXd& z, const std::vector<int>& unknowns,
                             std::vector<RowMatrix>* columns) const {
  Predicted predicted;
  for (std::size_t r = 0; r < m_model->evidence().runs().size(); ++r) {
    predicted.push_back(m_model->predict(r, z, unknowns, columns == nullptr ? nullptr : &(*columns)[r]));
  }
  return predicted;
}

void Fit::refresh(const std::vector<int>& unknowns) {
  if (m_columns.empty()) {
    for (const Run& run : m_model->evidence().runs()) {
      m_columns.push_back(RowMatrix::Zero(static_cast<Index>(run.rows() * m_model->evidence().series()),
                                          static_cast<Index>(m_model->unknowns())));
    }
  }
  m_predicted = simulate(m_z, unknowns, &m_columns);
  m_cost = cost_of(m_predicted, m_z);
  m_have_columns = true;
  m_stale = unknowns.size() < m_model->unknowns();
  m_statistics.clear();
}

std::vector<double> Fit::residual(const Predicted& predicted, std::size_t run, std::size_t series) const {
  const MeasuredSeries& measured = m_model->evidence().runs()[run].series[series];
  std::vector<double> out(measured.values.size());
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = measured.values[k] - predicted[run][series][k];
  return out;
}

double Fit::cost_of(const Predicted& predicted, const VectorXd& z) const {
  const Evidence& evidence = m_model->evidence();
  double cost = z.squaredNorm();
  std::vector<VectorXd> by_basis;
  for (const GainGroup& group : evidence.gains()) by_basis.emplace_back(VectorXd::Zero(group.count));
  for (std::size_t c = 0; c < evidence.series(); ++c) {
    if (evidence.samples(c) == 0) continue;
    const WhitenedSeries& white = evidence.whitened(c, m_sizes);
    const auto [group, place] = evidence.gain_place(c);
    for (std::size_t r = 0; r < evidence.runs().size(); ++r) {
      const std::vector<double> left = residual(predicted, r, c);
      VectorXd w(static_cast<Index>(left.size()));
      white.whitener[r].apply(left.data(), w.data());
      cost += w.squaredNorm();
      if (group < 0) continue;
      const Index first = evidence.gains()[static_cast<std::size_t>(group)].first[static_cast<std::size_t>(place)];
      by_basis[static_cast<std::size_t>(group)].segment(first, white.basis[r].cols()) += white.basis[r].transpose() * w;
    }
  }
  for (std::size_t g = 0; g < by_basis.size(); ++g) {
    if (gains_act(evidence, g, m_sizes))
      cost -= by_basis[g].dot(gain_precision(evidence, g, m_sizes).solve(by_basis[g]));
  }
  return cost;
}

SeriesStatistics statistics_of(const Evidence& evidence, std::size_t series, const Sizes& sizes,
                               const std::vector<std::vector<double>>& shown, const std::vector<RowMatrix>& columns) {
  SeriesStatistics s;
  const Index n = columns.front().cols();
  const WhitenedSeries& white = evidence.whitened(series, sizes);
  s.jj.setZero(n, n);
  s.jr.setZero(n);
  s.bj.setZero(white.basis_gram.rows(), n);
  s.br.setZero(white.basis_gram.rows());
  for (std::size_t r = 0; r < evidence.runs().size(); ++r) {
    const auto rows = static_cast<Index>(evidence.runs()[r].rows());
    const MeasuredSeries& measured = evidence.runs()[r].series[series];
    std::vector<double> left(measured.values.size());
    for (std::size_t k = 0; k < left.size(); ++k) left[k] = measured.values[k] - shown[r][k];
    VectorXd w(rows);
    white.whitener[r].apply(left.data(), w.data());
    RowMatrix j(rows, n);
    white.whitener[r].apply(columns[r], j);
    s.jj.selfadjointView<Eigen::Lower>().rankUpdate(j.transpose());
    s.jr.noalias() += j.transpose() * w;
    s.rr += w.squaredNorm();
    if (white.basis[r].cols() == 0) continue;
    s.bj.noalias() += white.basis[r].transpose() * j;
    s.br.noalias() += white.basis[r].transpose() * w;
  }
  s.jj.triangularView<Eigen::StrictlyUpper>() = s.jj.transpose();
  return s;
}

const SeriesStatistics& Fit::statistics(std::size_t series, const Sizes& sizes) const {
  const std::lock_guard lock(m_guard.mutex);
  const auto [at, is_new] =
      m_statistics.try_emplace({static_cast<int>(series), sizes.slow[series], sizes.time[series]});
  if (!is_new) return at->second;
  const Evidence& evidence = m_model->evidence();
  std::vector<std::vector<double>> shown;
  std::vector<RowMatrix> columns;
  for (std::size_t r = 0; r < evidence.runs().size(); ++r) {
    const auto rows = static_cast<Index>(evidence.runs()[r].rows());
    shown.push_back(m_predicted[r][series]);
    columns.emplace_back(m_columns[r].middleRows(static_cast<Index>(series) * rows, rows));
  }
  return at->second = statistics_of(evidence, series, sizes, shown, columns);
}

Quadratic quadratic_of(const Evidence& evidence, const Sizes& sizes, const VectorXd& z,
                       const std::vector<const SeriesStatistics*>& statistics) {
  const Index n = z.size();
  Quadratic q;
  q.curvature.setIdentity(n, n);
  q.slope = -z;
  q.cost = z.squaredNorm();
  for (std::size_t c = 0; c < evidence.series(); ++c) {
    if (evidence.samples(c) == 0) continue;
    q.curvature += statistics[c]->jj;
    q.slope += statistics[c]->jr;
    q.cost += statistics[c]->rr;
    q.log_determinant += evidence.whitened(c, sizes).log_determinant;
  }
  for (std::size_t g = 0; g < evidence.gains().size(); ++g) {
    if (!gains_act(evidence, g, sizes)) continue;
    const GainGroup& gains = evidence.gains()[g];
    const Eigen::LLT<MatrixXd> precision = gain_precision(evidence, g, sizes);
    const double size = evidence.settings().repeatable_sizes[static_cast<std::size_t>(sizes.repeatable[g])].size;
    MatrixXd bj(gains.count, n);
    VectorXd br(gains.count);
    for (std::size_t i = 0; i < gains.series.size(); ++i) {
      const SeriesStatistics& s = *statistics[gains.series[i]];
      bj.middleRows(gains.first[i], s.bj.rows()) = s.bj;
      br.segment(gains.first[i], s.br.size()) = s.br;
    }
    precision.matrixL().solveInPlace(bj);
    precision.matrixL().solveInPlace(br);
    q.curvature.noalias() -= bj.transpose() * bj;
    q.slope.noalias() -= bj.transpose() * br;
    q.cost -= br.squaredNorm();
    q.log_determinant += log_determinant(precision) + gains.prior_log_determinant +
                         2.0 * static_cast<double>(gains.count) * std::log(size);
  }
  return q;
}

double log_evidence_of(const Quadratic& q, const VectorXd& z, const VectorXd& low, const VectorXd& high) {
  const VectorXd step = analysis::damped_step(q.curvature, q.slope, VectorXd::Zero(z.size()), z, low, high);
  const double cost = q.cost - 2.0 * step.dot(q.slope) + step.dot(q.curvature * step);
  const Eigen::LLT<MatrixXd> factors(q.curvature);
  return -0.5 * cost - 0.5 * log_determinant(factors) - 0.5 * q.log_determinant;
}

Quadratic Fit::quadratic_at(const Sizes& sizes) const {
  const Evidence& evidence = m_model->evidence();
  std::vector<const SeriesStatistics*> all(evidence.series(), nullptr);
  for (std::size_t c = 0; c < all.size(); ++c) {
    if (evidence.samples(c) > 0) all[c] = &statistics(c, sizes);
  }
  return quadratic_of(evidence, sizes, m_z, all);
}

void Fit::fit(const FitOptions& options) {
  const Evidence& evidence = m_model->evidence();
  const std::vector<int> all = all_unknowns();
  const std::vector<int> effects = m_model->effect_unknowns();
  const double tolerance = evidence.settings().tolerance;
  constexpr double longest_step = 4.0;  // standard deviations
  // Of the cost: far enough that the base's columns have changed too.
  constexpr double worth_all = 30.0, worth_all_share = 0.05;
  if (m_predicted.empty()) refresh(m_have_columns ? effects : all);
  int old = m_stale ? 1 : 0;  // steps since all columns were fresh
  analysis::Damping damping;
  for (int iteration = 0; iteration < options.iterations && !evidence.stopped(); ++iteration) {
    const Quadratic q = quadratic_at(m_sizes);
    bool better = false, promising = true;
    double gained = 0.0;
    for (int attempt = 0; attempt < 5 && !better && promising; ++attempt) {
      const VectorXd step = analysis::damped_step(q.curvature, q.slope, damping.value() * q.curvature.diagonal(), m_z,
                                                  m_model->low(), m_model->high());
      const VectorXd z = (m_z + step.cwiseMax(-longest_step).cwiseMin(longest_step))
                             .cwiseMax(m_model->low())
                             .cwiseMin(m_model->high());
      promising = 2.0 * step.dot(q.slope) - step.dot(q.curvature * step) > 0.1 * tolerance;
      if (!promising) break;
      Predicted trial = simulate(z, {}, nullptr);
      const double cost = cost_of(trial, z);
      if (cost < m_cost) {
        gained = m_cost - cost;
        m_z = z;
        m_predicted = std::move(trial);
        m_cost = cost;
        m_statistics.clear();
        m_stale = true;
        damping.helped();
        better = true;
      } else {
        damping.failed();
      }
    }
    if (!better && old == 0) break;
    if (better && gained < tolerance && old <= 1) break;
    if (!better || gained > std::max(worth_all, worth_all_share * m_cost) || old >= 3 || effects.empty()) {
      refresh(all);
      old = 0;
      if (!better) damping.restart();
    } else {
      refresh(effects);
      ++old;
    }
  }
  if (options.finish && m_stale && !evidence.stopped()) refresh(all);
}

double Fit::log_evidence_at(const Sizes& sizes) const {
  return log_evidence_of(quadratic_at(sizes), m_z, m_model->low(), m_model->high()) +
         m_model->evidence().log_prior(sizes);
}

bool Fit::choose_sizes() {
  const Evidence& evidence = m_model->evidence();
  const int slow_sizes = static_cast<int>(evidence.settings().slow_sizes.size());
  const int repeatable_sizes = static_cast<int>(evidence.settings().repeatable_sizes.size());
  const int slow_times = static_cast<int>(evidence.settings().slow_times_s.size());
  Sizes best = m_sizes;
  double highest = log_evidence_at(best);
  const auto try_this = [&](const Sizes& sizes) {
    const double value = log_evidence_at(sizes);
    if (value <= highest + 1e-9) return false;
    highest = value;
    best = sizes;
    return true;
  };
  for (int sweep = 0; sweep < 3; ++sweep) {
    const Sizes before = best;
    for (std::size_t g = 0; g < evidence.gains().size(); ++g) {
      if (evidence.gains()[g].count == 0) continue;
      const Sizes from = best;
      for (int s = 0; s < repeatable_sizes; ++s) {
        Sizes sizes = from;
        sizes.repeatable[g] = s;
        if (s != from.repeatable[g]) try_this(sizes);
      }
    }
    for (std::size_t c = 0; c < evidence.series(); ++c) {
      if (evidence.samples(c) == 0) continue;
      for (const int way : {-1, 1}) {
        while (true) {
          Sizes sizes = best;
          sizes.slow[c] += way;
          if (sizes.slow[c] < 0 || sizes.slow[c] >= slow_sizes || !try_this(sizes)) break;
        }
      }
      for (int t = 0; t < slow_times; ++t) {
        Sizes sizes = best;
        sizes.time[c] = t;
        if (t != best.time[c]) try_this(sizes);
      }
    }
    if (best == before) break;
  }
  const bool changed = !(best == m_sizes);
  if (changed) set_sizes(std::move(best));
  return changed;
}

void Fit::settle(int rounds) {
  fit({m_model->evidence().settings().iterations, true});
  for (int round = 0; round < rounds && choose_sizes(); ++round) fit({6, true});
}

double Fit::log_evidence() const {
  const Quadratic q = quadratic_at(m_sizes);
  const Eigen::LLT<MatrixXd> factors(q.curvature);
  return -0.5 * q.cost - 0.5 * log_determinant(factors) - 0.5 * q.log_determinant +
         m_model->evidence().log_prior(m_sizes);
}

double Fit::sigma(std::size_t i) const {
  const Quadratic q = quadratic_at(m_sizes);
  const auto at = static_cast<Index>(i);
  const VectorXd unit = VectorXd::Unit(m_z.size(), at);
  const double variance = q.curvature.ldlt().solve(unit)[at];
  return std::sqrt(std::max(0.0, variance)) * std::abs(m_model->unknown(i).parameter.slope_at(value(i)));
}

VectorXd Fit::gains(std::size_t group) const {
  const Evidence& evidence = m_model->evidence();
  const GainGroup& gains = evidence.gains()[group];
  if (!gains_act(evidence, group, m_sizes)) return VectorXd::Zero(gains.count);
  VectorXd br(gains.count);
  for (std::size_t i = 0; i < gains.series.size(); ++i) {
    const SeriesStatistics& s = statistics(gains.series[i], m_sizes);
    br.segment(gains.first[i], s.br.size()) = s.br;
  }
  return gain_precision(evidence, group, m_sizes).solve(br);
}

std::vector<double> Fit::repeatable(std::size_t run, std::size_t series) const {
  const Evidence& evidence = m_model->evidence();
  std::vector<double> out(evidence.runs()[run].rows(), 0.0);
  const auto [group, place] = evidence.gain_place(series);
  if (group < 0) return out;
  const GainGroup& all = evidence.gains()[static_cast<std::size_t>(group)];
  const RowMatrix& basis = all.basis[static_cast<std::size_t>(place)][run];
  const VectorXd sum =
      basis * gains(static_cast<std::size_t>(group)).segment(all.first[static_cast<std::size_t>(place)], basis.cols());
  std::copy(sum.data(), sum.data() + sum.size(), out.begin());
  return out;
}

std::vector<double> Fit::innovations(std::size_t run, std::size_t series) const {
  const Evidence& evidence = m_model->evidence();
  std::vector<double> left = residual(m_predicted, run, series);
  const std::vector<double> comes_back = repeatable(run, series);
  for (std::size_t k = 0; k < left.size(); ++k) left[k] -= comes_back[k];
  std::vector<double> out(left.size());
  evidence.whitened(series, m_sizes).whitener[run].apply(left.data(), out.data());
  return out;
}

}  // namespace zerodrift::diagnosis::inference
