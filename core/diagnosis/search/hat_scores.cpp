#include "core/diagnosis/search/hat_scores.h"

#include <algorithm>
#include <cmath>

#include "core/diagnosis/inference/parallel.h"
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

WhitenedFit whitened(const Fit& fit) {
  const Evidence& evidence = fit.model().evidence();
  const auto n = static_cast<Index>(fit.model().unknowns());
  WhitenedFit out;
  out.columns.resize(evidence.runs().size());
  out.left.resize(evidence.runs().size());
  for (const auto& gains : evidence.gains()) {
    out.bj.emplace_back(MatrixXd::Zero(gains.count, n));
    out.br.emplace_back(VectorXd::Zero(gains.count));
  }
  for (std::size_t q = 0; q < evidence.runs().size(); ++q) {
    const auto rows = static_cast<Index>(evidence.runs()[q].rows());
    for (std::size_t c = 0; c < evidence.series(); ++c) {
      RowMatrix& j = out.columns[q].emplace_back();
      VectorXd& w = out.left[q].emplace_back();
      if (evidence.samples(c) == 0) continue;
      const auto& white = evidence.whitened(c, fit.sizes());
      j.resize(rows, n);
      white.whitener[q].apply(fit.columns(q).middleRows(static_cast<Index>(c) * rows, rows), j);
      const auto& measured = evidence.runs()[q].series[c].values;
      std::vector<double> left(measured.size());
      for (std::size_t k = 0; k < left.size(); ++k) left[k] = measured[k] - fit.predicted()[q][c][k];
      w.resize(rows);
      white.whitener[q].apply(left.data(), w.data());
      const auto [group, place] = evidence.gain_place(c);
      if (group < 0) continue;
      const auto g = static_cast<std::size_t>(group);
      const Index from = evidence.gains()[g].first[static_cast<std::size_t>(place)];
      const Index count = white.basis[q].cols();
      out.bj[g].middleRows(from, count).noalias() += white.basis[q].transpose() * j;
      out.br[g].segment(from, count).noalias() += white.basis[q].transpose() * w;
    }
  }
  const inference::Quadratic q = fit.quadratic();
  out.curvature.compute(q.curvature);
  out.slope = q.slope;
  return out;
}

HatScores hat_scores(const Fit& fit, const WhitenedFit& whole, std::size_t r, std::vector<double> centres,
                     const RowMatrix& response) {
  const Evidence& evidence = fit.model().evidence();
  const Index hats = response.cols();
  const auto n = static_cast<Index>(fit.model().unknowns());
  const auto rows = static_cast<Index>(evidence.runs()[r].rows());
  HatScores out{std::move(centres), VectorXd::Zero(hats), MatrixXd::Zero(hats, hats)};
  MatrixXd by_unknown = MatrixXd::Zero(n, hats);
  std::vector<MatrixXd> bh;
  for (const auto& gains : evidence.gains()) bh.emplace_back(MatrixXd::Zero(gains.count, hats));
  for (std::size_t c = 0; c < evidence.series(); ++c) {
    const auto own = response.middleRows(static_cast<Index>(c) * rows, rows);
    if (evidence.samples(c) == 0 || own.isZero(0.0)) continue;
    const auto& white = evidence.whitened(c, fit.sizes());
    RowMatrix h(rows, hats);
    white.whitener[r].apply(own, h);
    out.slope.noalias() += h.transpose() * whole.left[r][c];
    out.information.selfadjointView<Eigen::Lower>().rankUpdate(h.transpose());
    by_unknown.noalias() += whole.columns[r][c].transpose() * h;
    const auto [group, place] = evidence.gain_place(c);
    if (group < 0) continue;
    const auto g = static_cast<std::size_t>(group);
    const Index from = evidence.gains()[g].first[static_cast<std::size_t>(place)];
    bh[g].middleRows(from, white.basis[r].cols()).noalias() += white.basis[r].transpose() * h;
  }
  out.information.triangularView<Eigen::StrictlyUpper>() = out.information.transpose();
  for (std::size_t g = 0; g < evidence.gains().size(); ++g) {
    if (!inference::gains_act(evidence, g, fit.sizes())) continue;
    const auto factors = inference::gain_precision(evidence, g, fit.sizes());
    MatrixXd bj = whole.bj[g];
    VectorXd br = whole.br[g];
    factors.matrixL().solveInPlace(bh[g]);
    factors.matrixL().solveInPlace(bj);
    factors.matrixL().solveInPlace(br);
    out.slope.noalias() -= bh[g].transpose() * br;
    out.information.noalias() -= bh[g].transpose() * bh[g];
    by_unknown.noalias() -= bj.transpose() * bh[g];
  }
  const MatrixXd solved = whole.curvature.solve(by_unknown);
  out.slope.noalias() -= solved.transpose() * whole.slope;
  out.information.noalias() -= by_unknown.transpose() * solved;
  return out;
}

}  // namespace zerodrift::diagnosis::search
