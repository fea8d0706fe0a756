#include "core/diagnosis/search/hat_scores.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "core/diagnosis/parallel.h"
#include "core/physics/hat.h"

namespace zerodrift::diagnosis::search {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using inference::Evidence;
using inference::Fit;
using inference::RowMatrix;

std::vector<double> hat_centres(const inference::Run& run, std::size_t most, std::size_t rows_of_one) {
  const auto& time_s = run.recording.time_s;
  const auto count = static_cast<int>(std::min(most, run.rows() / rows_of_one));
  std::vector<double> centres;
  for (int i = 0; i < count; ++i) {
    centres.push_back(time_s.front() + (time_s.back() - time_s.front()) * i / std::max(1, count - 1));
  }
  return centres;
}

static physics::Law one_hat(double centre_s, double apart_s) {
  return [=](const physics::LawPoint& at) {
    physics::Strength s;
    s.by_parameter[0] = physics::hat((at.time_s - centre_s) / apart_s);
    s.value = at.values[0] * s.by_parameter[0];
    return s;
  };
}

RowMatrix hat_responses(const Fit& fit, std::size_t r, const std::vector<double>& centres, const MakeTerm& make_term) {
  const inference::JointModel& model = fit.model();
  const recording::Recording& recording = model.evidence().runs()[r].recording;
  const physics::Machine machine = model.hypothesis().machine_in(static_cast<int>(r));
  physics::NetworkBuilder builder(machine, recording, {});
  builder.build();
  std::vector<double> values = model.values(r, fit.z());
  const double apart_s = centres[1] - centres[0];
  std::vector<int> wanted;
  for (const double centre_s : centres) {
    physics::Parameter strength;
    wanted.push_back(builder.add_parameter(strength));
    physics::Term term = make_term(builder);
    term.law_kind = physics::LawKind::time;
    term.parameters = {wanted.back()};
    term.law = one_hat(centre_s, apart_s);
    builder.add(std::move(term));
  }
  const std::vector<double> start = builder.network().start_values();
  values.insert(values.end(), start.begin() + static_cast<std::ptrdiff_t>(values.size()), start.end());
  const physics::InputSet inputs = physics::make_inputs(builder.network(), recording);
  const physics::Prediction by = predicted(builder.network(), inputs, values, wanted);
  RowMatrix out(static_cast<Index>(by.rows * by.channels.size()), static_cast<Index>(wanted.size()));
  for (std::size_t c = 0; c < by.channels.size(); ++c) {
    for (std::size_t k = 0; k < by.rows; ++k) {
      const double* from = by.channels[c].derivatives.data() + k * wanted.size();
      std::copy(from, from + wanted.size(), out.row(static_cast<Index>(c * by.rows + k)).data());
    }
  }
  return out;
}

HatScores hat_scores(const Fit& fit, std::size_t r, std::vector<double> centres, const RowMatrix& response) {
  const Evidence& evidence = fit.model().evidence();
  const Index hats = response.cols();
  const auto n = static_cast<Index>(fit.model().unknowns());
  const auto rows = static_cast<Index>(evidence.runs()[r].rows());
  HatScores out{std::move(centres), VectorXd::Zero(hats), MatrixXd::Zero(hats, hats)};
  MatrixXd by_unknown = MatrixXd::Zero(n, hats);
  std::vector<MatrixXd> bh, bj;
  std::vector<VectorXd> br;
  for (const auto& gains : evidence.gains()) {
    bh.emplace_back(MatrixXd::Zero(gains.count, hats));
    bj.emplace_back(MatrixXd::Zero(gains.count, n));
    br.emplace_back(VectorXd::Zero(gains.count));
  }
  for (std::size_t c = 0; c < evidence.series(); ++c) {
    if (evidence.samples(c) == 0) continue;
    const auto& white = evidence.whitened(c, fit.sizes());
    const auto [group, place] = evidence.gain_place(c);
    for (std::size_t q = 0; q < evidence.runs().size(); ++q) {
      const auto own = static_cast<Index>(evidence.runs()[q].rows());
      const bool here = q == r;
      if (!here && group < 0) continue;
      RowMatrix j(own, n);
      white.whitener[q].apply(fit.columns(q).middleRows(static_cast<Index>(c) * own, own), j);
      const auto& measured = evidence.runs()[q].series[c].values;
      std::vector<double> left(measured.size());
      for (std::size_t k = 0; k < left.size(); ++k) left[k] = measured[k] - fit.predicted()[q][c][k];
      VectorXd w(own);
      white.whitener[q].apply(left.data(), w.data());
      RowMatrix h;
      if (here) {
        h.resize(rows, hats);
        white.whitener[q].apply(response.middleRows(static_cast<Index>(c) * rows, rows), h);
        out.slope.noalias() += h.transpose() * w;
        out.information.noalias() += h.transpose() * h;
        by_unknown.noalias() += j.transpose() * h;
      }
      if (group < 0) continue;
      const auto g = static_cast<std::size_t>(group);
      const Index from = evidence.gains()[g].first[static_cast<std::size_t>(place)];
      const Index count = white.basis[q].cols();
      if (here) bh[g].middleRows(from, count).noalias() += white.basis[q].transpose() * h;
      bj[g].middleRows(from, count).noalias() += white.basis[q].transpose() * j;
      br[g].segment(from, count).noalias() += white.basis[q].transpose() * w;
    }
  }
  for (std::size_t g = 0; g < evidence.gains().size(); ++g) {
    if (!inference::gains_act(evidence, g, fit.sizes())) continue;
    const auto factors = inference::gain_precision(evidence, g, fit.sizes());
    factors.matrixL().solveInPlace(bh[g]);
    factors.matrixL().solveInPlace(bj[g]);
    factors.matrixL().solveInPlace(br[g]);
    out.slope.noalias() -= bh[g].transpose() * br[g];
    out.information.noalias() -= bh[g].transpose() * bh[g];
    by_unknown.noalias() -= bj[g].transpose() * bh[g];
  }
  const inference::Quadratic q = fit.quadratic();
  const Eigen::LLT<MatrixXd> factors(q.curvature);
  const MatrixXd solved = factors.solve(by_unknown);
  out.slope.noalias() -= solved.transpose() * q.slope;
  out.information.noalias() -= by_unknown.transpose() * solved;
  return out;
}

}  // namespace zerodrift::diagnosis::search
