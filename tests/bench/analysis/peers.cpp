#include "tests/bench/analysis/peers.h"

#include <Eigen/Cholesky>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>

#include "core/analysis/kmeans.h"
#include "core/analysis/linear.h"
#include "core/analysis/statistics.h"

namespace zerodrift::bench {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Standardised by the training rows.
struct Standard {
  Eigen::RowVectorXd mean;
  Eigen::RowVectorXd scale;

  explicit Standard(const MatrixXd& x) : mean(x.colwise().mean()), scale(x.cols()) {
    const MatrixXd z = x.rowwise() - mean;
    scale = (z.colwise().squaredNorm() / static_cast<double>(x.rows())).cwiseSqrt().cwiseMax(1e-9);
  }
  MatrixXd operator()(const MatrixXd& x) const { return (x.rowwise() - mean) * scale.cwiseInverse().asDiagonal(); }
};

VectorXd ridge(const MatrixXd& z, const VectorXd& y, double penalty) {
  MatrixXd a = z.transpose() * z;
  a.diagonal().array() += penalty;
  return a.llt().solve(z.transpose() * y);
}

/// Coordinate descent (Friedman, Hastie and Tibshirani 2010).
VectorXd lasso(const MatrixXd& z, const VectorXd& y, double penalty) {
  VectorXd beta = VectorXd::Zero(z.cols());
  VectorXd residual = y;
  const VectorXd squares = z.colwise().squaredNorm().transpose();
  for (int sweep = 0; sweep < 400; ++sweep) {
    double moved = 0.0;
    for (Eigen::Index j = 0; j < z.cols(); ++j) {
      const double rho = z.col(j).dot(residual) + squares(j) * beta(j);
      const double next = std::copysign(std::max(std::abs(rho) - penalty, 0.0), rho) / squares(j);
      residual += z.col(j) * (beta(j) - next);
      moved = std::max(moved, std::abs(next - beta(j)));
      beta(j) = next;
    }
    if (moved < 1e-6) break;
  }
  return beta;
}

VectorXd components(const MatrixXd& z, const VectorXd& y, double count) {
  const Eigen::JacobiSVD<MatrixXd> svd(z, Eigen::ComputeThinU | Eigen::ComputeThinV);
  const auto k = std::min<Eigen::Index>(static_cast<Eigen::Index>(count), svd.singularValues().size());
  const VectorXd scores = svd.matrixU().leftCols(k).transpose() * y;
  return svd.matrixV().leftCols(k) * scores.cwiseQuotient(svd.singularValues().head(k));
}

VectorXd solve(Peer peer, const MatrixXd& z, const VectorXd& y, double setting) {
  switch (peer) {
    case Peer::ridge:
      return ridge(z, y, setting);
    case Peer::lasso:
      return lasso(z, y, setting * static_cast<double>(z.rows()));
    case Peer::principal_components:
      return components(z, y, setting);
    case Peer::mlr:
    case Peer::published_pipeline:
      break;
  }
  return analysis::least_squares(z, y).coefficient;
}

std::vector<double> settings_of(Peer peer) {
  if (peer == Peer::ridge) return {1e-2, 1e-1, 1.0, 10.0, 100.0, 1000.0};
  if (peer == Peer::lasso) return {1e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0};
  if (peer == Peer::principal_components) return {1, 2, 3, 4, 5, 6, 8, 10};
  return {0.0};
}

MatrixXd rows(const MatrixXd& m, const std::vector<int>& which) {
  MatrixXd out(static_cast<Eigen::Index>(which.size()), m.cols());
  for (std::size_t i = 0; i < which.size(); ++i) out.row(static_cast<Eigen::Index>(i)) = m.row(which[i]);
  return out;
}

VectorXd predict_one(Peer peer, const MatrixXd& x, const VectorXd& y, const MatrixXd& x_test, double setting) {
  const Standard standard(x);
  const double mean = y.mean();
  const VectorXd beta = solve(peer, standard(x), y.array() - mean, setting);
  return (standard(x_test) * beta).array() + mean;
}

double best_setting(Peer peer, const analysis::TrainingSet& set, const MatrixXd& x, const VectorXd& y,
                    const std::vector<int>& train) {
  const std::vector<double> settings = settings_of(peer);
  if (settings.size() == 1) return settings.front();
  std::set<int> folds;
  for (const int s : train) folds.insert(set.folds.fold_of[static_cast<std::size_t>(s)]);
  double best = std::numeric_limits<double>::infinity();
  double chosen = settings.front();
  for (const double setting : settings) {
    double squares = 0.0;
    for (const int fold : folds) {
      std::vector<int> in;
      std::vector<int> out;
      for (const int s : train) (set.folds.fold_of[static_cast<std::size_t>(s)] == fold ? out : in).push_back(s);
      if (in.empty()) continue;
      const VectorXd p = predict_one(peer, rows(x, in), rows(y, in), rows(x, out), setting);
      squares += (p - rows(y, out)).squaredNorm();
    }
    if (squares < best) {
      best = squares;
      chosen = setting;
    }
  }
  return chosen;
}

/// The sensitive points of six clusters, as published: signed correlation sum, raw Euclidean distance.
std::vector<int> pipeline_sensors(const MatrixXd& x, const MatrixXd& y) {
  VectorXd sum = VectorXd::Zero(x.cols());
  for (Eigen::Index s = 0; s < x.cols(); ++s) {
    for (Eigen::Index e = 0; e < y.cols(); ++e) sum(s) += std::abs(analysis::pearson(x.col(s), y.col(e)));
  }
  Eigen::Index first = 0;
  sum.maxCoeff(&first);
  const auto clusters = analysis::kmeans_plus_plus(x.transpose(), 6, static_cast<int>(first), 1);
  std::vector<int> chosen;
  for (int k = 0; k < clusters.centres.rows(); ++k) {
    int best = -1;
    for (int s = 0; s < x.cols(); ++s) {
      if (clusters.cluster_of[static_cast<std::size_t>(s)] == k && (best < 0 || sum(s) > sum(best))) best = s;
    }
    if (best >= 0) chosen.push_back(best);
  }
  return chosen;
}

}  // namespace

std::string name_of(Peer peer) {
  switch (peer) {
    case Peer::mlr:
      return "MLR, all temperatures";
    case Peer::ridge:
      return "ridge, all temperatures";
    case Peer::lasso:
      return "lasso, all temperatures";
    case Peer::principal_components:
      return "principal components";
    case Peer::published_pipeline:
      return "published pipeline, 6 clusters";
  }
  return "";
}

std::vector<Peer> all_peers() {
  return {Peer::mlr, Peer::ridge, Peer::lasso, Peer::principal_components, Peer::published_pipeline};
}

MatrixXd predict(Peer peer, const analysis::TrainingSet& set, const std::vector<int>& train,
                 const std::vector<int>& test) {
  MatrixXd x = set.samples.front().temperature_C;
  const MatrixXd y_train = rows(set.error_um, train);
  if (peer == Peer::published_pipeline) {
    const std::vector<int> sensors = pipeline_sensors(rows(x, train), y_train);
    MatrixXd kept(x.rows(), static_cast<Eigen::Index>(sensors.size()));
    for (std::size_t k = 0; k < sensors.size(); ++k) kept.col(static_cast<Eigen::Index>(k)) = x.col(sensors[k]);
    x = kept;
  }
  MatrixXd out(static_cast<Eigen::Index>(test.size()), set.error_um.cols());
  for (Eigen::Index e = 0; e < set.error_um.cols(); ++e) {
    const double setting = best_setting(peer, set, x, set.error_um.col(e), train);
    out.col(e) = predict_one(peer, rows(x, train), y_train.col(e), rows(x, test), setting);
  }
  return out;
}

std::vector<analysis::TableTerms> table_of(Peer peer, const analysis::TrainingSet& set) {
  const MatrixXd& all = set.samples.front().temperature_C;
  std::vector<int> sensors;
  for (int c = 0; c < static_cast<int>(set.sensors.size()); ++c)
    sensors.push_back(set.runs.front().sensor(set.sensors[static_cast<std::size_t>(c)]));
  MatrixXd x = all(Eigen::all, sensors);
  if (peer == Peer::published_pipeline) {
    const std::vector<int> kept = pipeline_sensors(x, set.error_um);
    x = MatrixXd(x(Eigen::all, kept));
    std::vector<int> names;
    for (const int k : kept) names.push_back(sensors[static_cast<std::size_t>(k)]);
    sensors = names;
  }
  std::vector<int> rows_taken(static_cast<std::size_t>(x.rows()));
  std::iota(rows_taken.begin(), rows_taken.end(), 0);
  const Standard standard(x);
  std::vector<analysis::TableTerms> out;
  for (Eigen::Index e = 0; e < set.error_um.cols(); ++e) {
    const VectorXd y = set.error_um.col(e);
    const double setting = best_setting(peer, set, x, y, rows_taken);
    const VectorXd beta = solve(peer, standard(x), y.array() - y.mean(), setting);
    analysis::TableTerms terms;
    terms.error = set.errors[static_cast<std::size_t>(e)];
    terms.offset_um = y.mean();
    for (Eigen::Index c = 0; c < x.cols(); ++c) {
      terms.terms.push_back({set.runs.front().sensors[static_cast<std::size_t>(sensors[static_cast<std::size_t>(c)])],
                             beta(c) / standard.scale(c), standard.mean(c)});
    }
    out.push_back(std::move(terms));
  }
  return out;
}

}  // namespace zerodrift::bench
