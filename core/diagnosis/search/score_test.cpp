#include "core/diagnosis/search/score_test.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/inference/parallel.h"

namespace zerodrift::diagnosis::search {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using inference::Fit;
using inference::JointModel;
using inference::RowMatrix;

constexpr double forbidden = -1e300;

/// Derivatives of what the series show by the candidates' amplitudes, at the fitted point.
struct Columns {
  std::vector<RowMatrix> of_run;                      // series * rows + row, amplitude
  std::vector<std::pair<Index, Index>> of_candidate;  // first column, count
  std::vector<bool> only_positive;                    // of each candidate's first amplitude
  std::vector<double> usual;                          // its prior standard deviation, in its own unit
};

/// Of candidates that may be in one simulation together.
void add_columns(const Fit& fit, const std::vector<Candidate>& candidates, const std::vector<std::size_t>& group,
                 Columns& columns) {
  if (group.empty()) return;
  inference::Hypothesis wide = fit.model().hypothesis();
  const std::size_t before = wide.effects.size();
  for (const std::size_t i : group) wide.effects.push_back(candidates[i].effect);
  const auto model = std::make_shared<JointModel>(std::move(wide), fit.model().shared_evidence());
  Fit there(model, fit.sizes());
  there.start_from(fit, false);
  VectorXd z = there.z();
  std::vector<int> wanted;
  for (std::size_t g = 0; g < group.size(); ++g) {
    const auto effect = static_cast<int>(before + g);
    const auto first = static_cast<Index>(wanted.size());
    for (std::size_t u = 0; u < model->unknowns(); ++u) {
      if (model->unknown(u).effect != effect || !model->unknown(u).parameter.amplitude) continue;
      if (static_cast<Index>(wanted.size()) == first) {
        columns.only_positive[group[g]] = model->unknown(u).parameter.low >= 0.0;
        columns.usual[group[g]] = model->unknown(u).parameter.sigma;
      }
      z[static_cast<Index>(u)] = model->unknown(u).parameter.z_of(0.0);
      wanted.push_back(static_cast<int>(u));
    }
    columns.of_candidate[group[g]] = {first, static_cast<Index>(wanted.size()) - first};
  }
  const Index offset = columns.of_run.front().cols();
  for (const std::size_t i : group) columns.of_candidate[i].first += offset;
  for (std::size_t r = 0; r < columns.of_run.size(); ++r) {
    RowMatrix all(columns.of_run[r].rows(), static_cast<Index>(model->unknowns()));
    const auto shown = model->predict(r, z, wanted, &all);
    RowMatrix joined(all.rows(), offset + static_cast<Index>(wanted.size()));
    joined.leftCols(offset) = columns.of_run[r];
    for (std::size_t w = 0; w < wanted.size(); ++w) joined.col(offset + static_cast<Index>(w)) = all.col(wanted[w]);
    // A derivative that says little of a usual size is replaced by the chord to it.
    for (std::size_t g = 0; g < group.size(); ++g) {
      const double share = physics::find_effect(candidates[group[g]].effect.spec.id)->traits.chord_share_of_run;
      const auto [first, count] = columns.of_candidate[group[g]];
      if (share <= 0.0 || count != 1) continue;
      const auto unknown = wanted[static_cast<std::size_t>(first - offset)];
      const physics::Parameter& parameter = model->unknown(static_cast<std::size_t>(unknown)).parameter;
      const auto& time_s = fit.model().evidence().runs()[r].recording.time_s;
      const double usual = std::min(parameter.sigma, share * (time_s.back() - time_s.front()));
      VectorXd moved = z;
      moved[unknown] = parameter.z_of(usual);
      const auto with = model->predict(r, moved, {}, nullptr);
      for (std::size_t c = 0; c < with.size(); ++c) {
        for (std::size_t k = 0; k < with[c].size(); ++k) {
          joined(static_cast<Index>(c * with[c].size() + k), first) = (with[c][k] - shown[c][k]) / moved[unknown];
        }
      }
    }
    columns.of_run[r] = std::move(joined);
  }
}

/// Sums over all series: candidates with themselves, with the hypothesis' unknowns, with the residual, with the gains.
struct Sums {
  MatrixXd cj;                   // candidate amplitudes x unknowns
  VectorXd cr;                   // x residual
  std::vector<MatrixXd> own;     // of each candidate
  std::vector<MatrixXd> bc, bj;  // of each group of gains
  std::vector<VectorXd> br;
};

Sums sums_of(const Fit& fit, const Columns& columns, std::size_t first_series, std::size_t last_series) {
  const inference::Evidence& evidence = fit.model().evidence();
  const auto n = static_cast<Index>(fit.model().unknowns());
  const Index m = columns.of_run.front().cols();
  Sums sums{MatrixXd::Zero(m, n), VectorXd::Zero(m), {}, {}, {}, {}};
  for (const auto& [first, count] : columns.of_candidate) sums.own.emplace_back(MatrixXd::Zero(count, count));
  for (const auto& gains : evidence.gains()) {
    sums.bc.emplace_back(MatrixXd::Zero(gains.count, m));
    sums.bj.emplace_back(MatrixXd::Zero(gains.count, n));
    sums.br.emplace_back(VectorXd::Zero(gains.count));
  }
  for (std::size_t c = first_series; c < last_series; ++c) {
    if (evidence.samples(c) == 0) continue;
    const auto& white = evidence.whitened(c, fit.sizes());
    const auto [group, place] = evidence.gain_place(c);
    for (std::size_t r = 0; r < evidence.runs().size(); ++r) {
      const auto rows = static_cast<Index>(evidence.runs()[r].rows());
      const auto at = static_cast<Index>(c) * rows;
      RowMatrix s(rows, m), j(rows, n);
      white.whitener[r].apply(columns.of_run[r].middleRows(at, rows), s);
      white.whitener[r].apply(fit.columns(r).middleRows(at, rows), j);
      const auto& measured = evidence.runs()[r].series[c].values;
      std::vector<double> left(measured.size());
      for (std::size_t k = 0; k < left.size(); ++k) left[k] = measured[k] - fit.predicted()[r][c][k];
      VectorXd w(rows);
      white.whitener[r].apply(left.data(), w.data());
      sums.cj.noalias() += s.transpose() * j;
      sums.cr.noalias() += s.transpose() * w;
      for (std::size_t i = 0; i < columns.of_candidate.size(); ++i) {
        const auto [first, count] = columns.of_candidate[i];
        if (count == 0) continue;
        const auto block = s.middleCols(first, count);
        sums.own[i].noalias() += block.transpose() * block;
      }
      if (group < 0) continue;
      const auto g = static_cast<std::size_t>(group);
      const Index from = evidence.gains()[g].first[static_cast<std::size_t>(place)];
      const Index count = white.basis[r].cols();
      sums.bc[g].middleRows(from, count).noalias() += white.basis[r].transpose() * s;
      sums.bj[g].middleRows(from, count).noalias() += white.basis[r].transpose() * j;
      sums.br[g].segment(from, count).noalias() += white.basis[r].transpose() * w;
    }
  }
  return sums;
}

void add(Sums& to, const Sums& from) {
  to.cj += from.cj;
  to.cr += from.cr;
  for (std::size_t i = 0; i < to.own.size(); ++i) to.own[i] += from.own[i];
  for (std::size_t g = 0; g < to.bc.size(); ++g) {
    to.bc[g] += from.bc[g];
    to.bj[g] += from.bj[g];
    to.br[g] += from.br[g];
  }
}

}  // namespace

std::vector<Score> score_test(const Fit& fit, const std::vector<Candidate>& candidates) {
  const inference::Evidence& evidence = fit.model().evidence();
  std::vector<Score> scores(candidates.size());
  Columns columns;
  columns.of_candidate.assign(candidates.size(), {0, 0});
  columns.only_positive.assign(candidates.size(), true);
  columns.usual.assign(candidates.size(), 0.0);
  for (const auto& run : evidence.runs())
    columns.of_run.emplace_back(static_cast<Index>(run.rows() * evidence.series()), 0);
  std::vector<std::size_t> together;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    if (physics::find_effect(candidates[i].effect.spec.id)->traits.alone) {
      add_columns(fit, candidates, {i}, columns);
    } else {
      together.push_back(i);
    }
  }
  add_columns(fit, candidates, together, columns);
  Sums sums = sums_of(fit, columns, 0, 0);
  std::vector<Sums> parts(evidence.series());
  in_parallel(parts.size(), [&](std::size_t c) { parts[c] = sums_of(fit, columns, c, c + 1); });
  for (const Sums& part : parts) add(sums, part);

  const inference::Quadratic q = fit.quadratic();
  std::vector<MatrixXd> gained;  // what the gains take of the candidates' information
  for (std::size_t g = 0; g < evidence.gains().size(); ++g) {
    if (!inference::gains_act(evidence, g, fit.sizes())) {
      gained.emplace_back();
      continue;
    }
    const auto factors = inference::gain_precision(evidence, g, fit.sizes());
    factors.matrixL().solveInPlace(sums.bc[g]);
    factors.matrixL().solveInPlace(sums.bj[g]);
    factors.matrixL().solveInPlace(sums.br[g]);
    sums.cj.noalias() -= sums.bc[g].transpose() * sums.bj[g];
    sums.cr.noalias() -= sums.bc[g].transpose() * sums.br[g];
  }
  const Eigen::LLT<MatrixXd> factors(q.curvature);
  const MatrixXd solved = factors.solve(sums.cj.transpose());
  const VectorXd slope = sums.cr - solved.transpose() * q.slope;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const auto [first, count] = columns.of_candidate[i];
    scores[i].log_odds = forbidden;
    if (count == 0) continue;
    MatrixXd information = sums.own[i] + MatrixXd::Identity(count, count) -
                           sums.cj.middleRows(first, count) * solved.middleCols(first, count);
    for (std::size_t g = 0; g < evidence.gains().size(); ++g) {
      if (!inference::gains_act(evidence, g, fit.sizes())) continue;
      const auto by_gain = sums.bc[g].middleCols(first, count);
      information.noalias() -= by_gain.transpose() * by_gain;
    }
    const Eigen::LDLT<MatrixXd> own(information);
    const VectorXd step = own.solve(slope.segment(first, count));
    scores[i].step.assign(step.data(), step.data() + count);
    scores[i].usual = columns.usual[i];
    scores[i].sigma = 1.0 / std::sqrt(std::max(1e-12, information(0, 0)));
    if (columns.only_positive[i] && step[0] <= 0.0) continue;
    scores[i].log_odds = 0.5 * step.dot(slope.segment(first, count)) -
                         0.5 * own.vectorD().array().max(1e-300).log().sum() + candidates[i].log_prior;
  }
  return scores;
}

}  // namespace zerodrift::diagnosis::search
