// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <vericone/internal/geometry/decompositions.h>
#include <vericone/internal/geometry/lengths.h>

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <limits>

#include "support/allocations.h"
#include "support/random.h"

namespace vericone::decompositions_test {
namespace {

using Eigen::Matrix3d, Eigen::MatrixXd, Eigen::Vector3d, Eigen::VectorXd;
using testing::Random;

MatrixXd matrix(Random& random, int rows, int cols) {
  MatrixXd m(rows, cols);
  for (double& x : m.reshaped()) x = random.normal();
  return m;
}

#if defined(__ARM_FEATURE_FMA) || defined(__s390x__)
constexpr bool kFused = true;
#else
constexpr bool kFused = false;
#endif

TEST(Decompositions, CholeskysFactorsAndSolutionsAreEigens) {
  Random random(1);
  int refused = 0;
  for (int i = 0; i < 20'000; ++i) {
    Matrix3d half = matrix(random, 3, 3);
    for (int k = 0; k < 3; ++k) half.row(k) *= std::exp(random.uniform(-9, 9));
    Matrix3d a = half * half.transpose();
    if (i % 8 == 0) a(2, 2) *= 0.5;
    const Eigen::LLT<Matrix3d> eigens(a);
    const Cholesky<3> ours = cholesky<3>(a);
    ASSERT_EQ(ours.positive, eigens.info() == Eigen::Success) << random.trace();
    if (!ours.positive) {
      ++refused;
      continue;
    }
    const Matrix3d lower = eigens.matrixL();
    ASSERT_EQ(ours.lower, lower) << random.trace();
    const Vector3d x = random.vector<3>();
    ASSERT_EQ(ours.solve(x), Vector3d(eigens.solve(x))) << random.trace();
    const Matrix3d inverse = lower.triangularView<Eigen::Lower>().solve(Matrix3d::Identity());
    ASSERT_EQ(ours.lower_inverse(), inverse) << random.trace();
  }
  EXPECT_GT(refused, 100);
}

TEST(Decompositions, SystemsAreSolvedAsByEigen) {
  if (kFused) GTEST_SKIP() << "Eigen has fused products and sums here: its bits depend on how it is inlined";
  Random random(2);
  for (int i = 0; i < 20'000; ++i) {
    const int n = random.integer(1, 16);
    MatrixXd a = matrix(random, n, n);
    for (double& x : a.reshaped())
      if (random.integer(0, 4) == 0) x = 0;
    VectorXd b = matrix(random, n, 1);
    const VectorXd expected = a.partialPivLu().solve(b);
    const std::size_t before = testing::allocations();
    solve_square(a, b);
    ASSERT_EQ(testing::allocations(), before);
    for (int k = 0; k < n; ++k)  // not finite where a is singular
      ASSERT_TRUE(b(k) == expected(k) || (!std::isfinite(b(k)) && !std::isfinite(expected(k))))
          << random.trace();
  }
}

TEST(Decompositions, LeastSquaresAreEigensOfEveryRank) {
  if (kFused) GTEST_SKIP() << "Eigen has fused products and sums here: its bits depend on how it is inlined";
  Random random(3);
  for (int i = 0; i < 2'000; ++i) {
    const int rows = random.integer(1, 60), cols = random.integer(1, 60);
    const int rank = random.integer(1, std::min(rows, cols));
    const MatrixXd a = matrix(random, rows, rank) * matrix(random, rank, cols);
    const VectorXd b = matrix(random, rows, 1);
    ASSERT_EQ(shortest_least_squares(a, b), VectorXd(a.completeOrthogonalDecomposition().solve(b)))
        << random.trace();
    ASSERT_EQ(least_squares(a, b), VectorXd(a.colPivHouseholderQr().solve(b))) << random.trace();
  }
  EXPECT_EQ(shortest_least_squares(MatrixXd::Zero(3, 2), VectorXd::Ones(3)), VectorXd::Zero(2));
}

TEST(Decompositions, OfNothing) {
  EXPECT_EQ(least_squares(MatrixXd(0, 0), VectorXd(0)).size(), 0);
  EXPECT_EQ(shortest_least_squares(MatrixXd(3, 0), VectorXd::Ones(3)).size(), 0);
  EXPECT_EQ(least_squares(MatrixXd(0, 2), VectorXd(0)), VectorXd::Zero(2));
}

TEST(Length, IsTheSameWhereverTheVectorLies) {
  Random random(5);
  alignas(64) double room[8];
  int differ = 0;
  for (int k = 0; k < 10'000; ++k) {
    const Vector3d v(random.normal(), random.normal(), random.normal());
    Eigen::Map<Vector3d> even(room), odd(room + 1);
    even = v;
    const double here = detail::length(even), stable = even.stableNorm();
    odd = v;
    ASSERT_EQ(detail::length(odd), here);
    ASSERT_NEAR(here, v.norm(), 4e-16 * here);
    differ += odd.stableNorm() != stable;
  }
  EXPECT_GT(differ, 0) << "Eigen's own is now the same too: length() is not needed any more";
}

TEST(Length, NeitherOverflowsNorUnderflows) {
  for (const double scale : {1e-320, 1e-300, 1e-160, 1.0, 1e160, 1e300}) {
    EXPECT_NEAR(detail::length(Vector3d(3 * scale, 4 * scale, 0)) / scale, 5, 5e-4) << scale;
    if (scale > 1e-307) {
      EXPECT_NEAR(detail::length(Vector3d(3 * scale, 4 * scale, 0)) / scale, 5, 1e-14) << scale;
    }
  }
  constexpr double kInfinite = std::numeric_limits<double>::infinity(),
                   kNoNumber = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(detail::length(Vector3d(0, 0, 0)), 0);
  EXPECT_EQ(detail::length(Vector3d(1, -kInfinite, 0)), kInfinite);
  EXPECT_TRUE(std::isnan(detail::length(Vector3d(1, kNoNumber, 0))));
  EXPECT_TRUE(std::isnan(detail::length(Vector3d(kNoNumber, kNoNumber, kNoNumber))));
}

}  // namespace
}  // namespace vericone::decompositions_test
