// The factored matrix of a network, against Eigen's dense solution.
#include "core/physics/skyline.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "core/physics/assembly.h"

namespace zerodrift::physics {
namespace {

/// Chains of some cells, joined at random cells.
Network joined_chains(const std::vector<int>& lengths, int joints, std::mt19937& random) {
  Network network;
  Term links;
  links.kind = TermKind::link;
  int first = 0;
  for (const int length : lengths) {
    for (int i = 1; i < length; ++i) links.links.push_back({first + i - 1, first + i, 1.0 + i});
    first += length;
  }
  std::uniform_int_distribution<int> node(0, first - 1);
  for (int i = 0; i < joints; ++i) {
    const int one = node(random), other = node(random);
    if (one != other) links.links.push_back({one, other, 0.5});
  }
  links.law_kind = LawKind::constant;
  links.law = [](const LawPoint&) {
    Strength s;
    s.value = 1.0;
    return s;
  };
  network.terms.push_back(std::move(links));
  network.volume.assign(static_cast<std::size_t>(first), 1.0);
  network.capacity_parameter.assign(network.volume.size(), -1);
  network.initial_C.assign(network.volume.size(), 20.0);
  return network;
}

Eigen::MatrixXd dense(const Network& network, double alpha) {
  const auto n = static_cast<Eigen::Index>(network.nodes());
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Identity(n, n);
  for (const Link& link : network.terms.front().links) {
    matrix(link.first, link.first) += alpha * link.weight;
    matrix(link.second, link.second) += alpha * link.weight;
    matrix(link.first, link.second) -= alpha * link.weight;
    matrix(link.second, link.first) -= alpha * link.weight;
  }
  return matrix;
}

InputSet two_rows() {
  InputSet inputs;
  inputs.time_s = {0.0, 1.0};
  inputs.held = inputs.linear = inputs.signals = {{}, {}};
  inputs.settled = {false, false};
  return inputs;
}

}  // namespace

TEST(Skyline, SolvesJoinedChainsLikeADenseMatrix) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  const std::vector<std::vector<int>> machines = {{1}, {2}, {9}, {30}, {12, 12}, {20, 1, 15, 1, 7}, {25, 25, 25, 3}};
  for (const auto& lengths : machines) {
    for (const int joints : {0, 1, 3, 9}) {
      const Network network = joined_chains(lengths, joints, random);
      const InputSet inputs = two_rows();
      const std::vector<double> values;
      const std::vector<int> columns;
      Assembly assembly(network, inputs, values, columns);
      const std::size_t n = network.nodes();
      const std::vector<double> state(n, 20.0);
      constexpr double alpha = 0.7;
      assembly.evaluate(0, 0.5, 0.5, {state.data(), state.data(), 0.0});
      assembly.assemble(alpha);
      const Eigen::LLT<Eigen::MatrixXd> right(dense(network, alpha));
      Eigen::MatrixXd b(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(Skyline::lanes));
      for (double& one : b.reshaped()) one = normal(random);
      std::vector<double> lanes(n * Skyline::lanes), single(n);
      for (std::size_t i = 0; i < n; ++i) {
        single[i] = b(static_cast<Eigen::Index>(i), 0);
        for (std::size_t lane = 0; lane < Skyline::lanes; ++lane)
          lanes[i * Skyline::lanes + lane] = b(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(lane));
      }
      assembly.matrix().solve(single.data());
      assembly.matrix().solve_lanes(lanes.data());
      const Eigen::MatrixXd x = right.solve(b);
      for (std::size_t i = 0; i < n; ++i) {
        EXPECT_NEAR(single[i], x(static_cast<Eigen::Index>(i), 0), 1e-10) << n << " nodes, " << joints << " joints";
        for (std::size_t lane = 0; lane < Skyline::lanes; ++lane)
          EXPECT_NEAR(lanes[i * Skyline::lanes + lane],
                      x(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(lane)), 1e-10);
      }
    }
  }
}

}  // namespace zerodrift::physics
