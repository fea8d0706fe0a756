#pragma once
// Plain implementations of what is published for thermal errors: static regressions on temperatures. Their penalties
// are chosen by cross-validation blocked by cycle inside the training part, which is more care than usual.

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/analysis/model.h"
#include "core/analysis/training.h"

namespace zerodrift::bench {

enum class Peer {
  mlr,
  ridge,
  lasso,
  principal_components,
  published_pipeline,  // k-means++ to six clusters, sensitive points, multiple regression
};
std::string name_of(Peer peer);
std::vector<Peer> all_peers();

/// Fits on the samples `train` and predicts the samples `test`: one column an error.
Eigen::MatrixXd predict(Peer peer, const analysis::TrainingSet& set, const std::vector<int>& train,
                        const std::vector<int>& test);

/// The same fitted to all samples of one run, as a controller's table.
std::vector<analysis::TableTerms> table_of(Peer peer, const analysis::TrainingSet& set);

}  // namespace zerodrift::bench
