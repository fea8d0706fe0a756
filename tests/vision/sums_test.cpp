// The sums and the factors of the registration's solve against the plain formulas.

#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "core/base/noise.h"
#include "core/vision/banded_cholesky.h"
#include "core/vision/row_sums.h"

namespace zerodrift::vision {
namespace {

constexpr int pixels = 1237;  // no multiple of any register or block

struct SomeRows {
  Eigen::Matrix<float, row_length, Eigen::Dynamic> rows;
  Eigen::VectorXf weights;

  SomeRows() : rows(row_length, pixels), weights(pixels) {
    Noise noise(5);
    for (float& one : rows.reshaped()) one = static_cast<float>(noise.normal());
    for (float& one : weights) one = static_cast<float>(noise.uniform());
    rows.bottomRows(2).setZero();  // as the registration leaves them
  }
};

}  // namespace

TEST(RowSums, SquaresAndProductsAreThoseOfTheMatrices) {
  const SomeRows some;
  Eigen::Matrix<double, row_length, row_length> squares = Eigen::Matrix<double, row_length, row_length>::Zero();
  add_squares(some.rows.data(), some.weights.data(), pixels, squares.data());
  const Eigen::MatrixXd rows = some.rows.cast<double>();
  const Eigen::VectorXd weights = some.weights.cast<double>();
  EXPECT_LT((squares - rows * weights.asDiagonal() * rows.transpose()).cwiseAbs().maxCoeff(), 1e-3);
  Eigen::Matrix<double, row_length, 1> products = Eigen::Matrix<double, row_length, 1>::Zero();
  add_products(some.rows.data(), some.weights.data(), pixels, products.data());
  EXPECT_LT((products - rows * weights).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(RowSums, AModelIsTakenOffInPlace) {
  const SomeRows some;
  const Eigen::Matrix<float, row_length, 1> factors = some.rows.col(7);
  Eigen::VectorXf values = some.weights;
  subtract_model(some.rows.data(), factors.data(), pixels, values.data(), values.data());
  EXPECT_LT((values - (some.weights - some.rows.transpose() * factors)).cwiseAbs().maxCoeff(), 1e-4F);
}

TEST(RowSums, WeightsFallToNothingAtTheLimitAndBesideTheFrame) {
  const Eigen::Vector4f errors(0.0F, 1.0F, 2.5F, 0.0F);
  const Eigen::Vector4f roots = Eigen::Vector4f::Ones();
  const std::uint8_t unseen[] = {0, 0, 0, 1};
  Eigen::Vector4f weights;
  tukey_weights(errors.data(), roots.data(), 0.5F, unseen, 4, weights.data());
  EXPECT_FLOAT_EQ(weights(0), 1.0F);
  EXPECT_FLOAT_EQ(weights(1), 0.5625F);  // (1 - 1/4)^2
  EXPECT_FLOAT_EQ(weights(2), 0.0F);
  EXPECT_FLOAT_EQ(weights(3), 0.0F);
}

TEST(BandedCholesky, SolvesAsTheFullMatrixDoes) {
  constexpr int size = 60;
  constexpr int band = 9;
  Noise noise(11);
  Eigen::MatrixXd matrix = 12.0 * Eigen::MatrixXd::Identity(size, size);
  for (int i = 0; i < size; ++i) {
    for (int j = std::max(0, i - band); j < i; ++j) matrix(i, j) = matrix(j, i) = noise.uniform(-1.0, 1.0);
  }
  Eigen::MatrixXd right(size, 3);
  for (double& one : right.reshaped()) one = noise.normal();
  BandedCholesky factors;
  ASSERT_TRUE(factors.compute(matrix, band));
  Eigen::MatrixXd found = right;
  factors.solve_in_place(found);
  EXPECT_LT((matrix * found - right).cwiseAbs().maxCoeff(), 1e-10);
  matrix(30, 30) = -1.0;
  EXPECT_FALSE(factors.compute(matrix, band));
}

}  // namespace zerodrift::vision
