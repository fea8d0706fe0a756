#pragma once
// The strength over time of something that acts in one recording - heat in a part, a film, a sensor's error - cut into
// hat functions, and the efficient score of each, with all unknowns and the gains of the repeatable discrepancy
// re-optimised beside it.

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <functional>
#include <vector>

#include "core/diagnosis/inference/fit.h"
#include "core/physics/builder.h"

namespace zerodrift::diagnosis::search {

struct HatScores {
  std::vector<double> time_s;   // centres of the hats, evenly apart
  Eigen::VectorXd slope;        // g: of a unit strength in each hat
  Eigen::MatrixXd information;  // G
};

/// At most `most` hats, each of `rows_of_one` samples at least.
std::vector<double> hat_centres(const inference::Run& run, std::size_t most, std::size_t rows_of_one);
/// What acts, without parameters and law.
using MakeTerm = std::function<physics::Term(physics::NetworkBuilder&)>;
/// What the series of a run show of a unit strength in each hat: (series * rows + row) x hats.
inference::RowMatrix hat_responses(const inference::Fit& fit, std::size_t run, const std::vector<double>& centres,
                                   const MakeTerm& make_term);
/// What all scores of one fit share: its derivatives and what it leaves, whitened.
struct WhitenedFit {
  std::vector<std::vector<inference::RowMatrix>> columns;  // [run][series]
  std::vector<std::vector<Eigen::VectorXd>> left;          // [run][series]
  std::vector<Eigen::MatrixXd> bj;                         // of each group of gains: basis' columns
  std::vector<Eigen::VectorXd> br;
  Eigen::LLT<Eigen::MatrixXd> curvature;  // factors
  Eigen::VectorXd slope;
};
WhitenedFit whitened(const inference::Fit& fit);
HatScores hat_scores(const inference::Fit& fit, const WhitenedFit& white, std::size_t run, std::vector<double> centres,
                     const inference::RowMatrix& response);

}  // namespace zerodrift::diagnosis::search
