// SPDX-License-Identifier: BSD-3-Clause
//
// The smallest ball (D = 3) or circle (D = 2) around points.
#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <vector>

namespace vericone::fitting {

template <int D>
struct Ball {
  Eigen::Matrix<double, D, 1> center = Eigen::Matrix<double, D, 1>::Zero();
  double radius = 0;
};

/// Points at most D + 1, all of them on it; a negative radius where they are dependent.
template <int D>
Ball<D> ball_through(const std::vector<Eigen::Matrix<double, D, 1>>& points) {
  constexpr double kDependent = 1e-14;
  Ball<D> ball{points.front(), 0};
  const auto n = static_cast<Eigen::Index>(points.size()) - 1;
  if (n == 0) return ball;
  Eigen::Matrix<double, D, Eigen::Dynamic> way(D, n);
  for (Eigen::Index i = 0; i < n; ++i) way.col(i) = points[std::size_t(i) + 1] - points[0];
  const Eigen::MatrixXd gram = way.transpose() * way;
  const Eigen::VectorXd half = 0.5 * gram.diagonal();
  const Eigen::LDLT<Eigen::MatrixXd> solver(gram);
  if (!(solver.vectorD().minCoeff() > kDependent * gram.diagonal().maxCoeff())) return {points.front(), -1};
  const Eigen::Matrix<double, D, 1> from_first = way * solver.solve(half);
  return {points.front() + from_first, from_first.norm()};
}

/// Its supporting points are exchanged for farther ones, which makes it larger each time, so this ends: with
/// the least ball, to rounding. Of no point a radius of 0 about the origin. Some passes over the points.
template <int D>
Ball<D> smallest_ball(const std::vector<Eigen::Matrix<double, D, 1>>& points) {
  using Vector = Eigen::Matrix<double, D, 1>;
  constexpr double kRounding = 1e-12;
  constexpr int kMostExchanges = 500;
  if (points.empty()) return {};
  std::vector<Vector> support{points.front()};
  Ball<D> ball{points.front(), 0};
  for (int exchange = 0; exchange < kMostExchanges; ++exchange) {
    const Vector* farthest = &points.front();
    for (const Vector& x : points)
      if ((x - ball.center).squaredNorm() > (*farthest - ball.center).squaredNorm()) farthest = &x;
    if ((*farthest - ball.center).norm() <= ball.radius * (1 + kRounding)) break;
    support.push_back(*farthest);
    // The least ball around support: through the new one and some of the others.
    Ball<D> best{Vector::Zero(), -1};
    std::vector<Vector> kept;
    for (unsigned chosen = 0; chosen < 1U << (support.size() - 1); ++chosen) {
      std::vector<Vector> on{support.back()};
      for (std::size_t i = 0; i + 1 < support.size(); ++i)
        if (chosen >> i & 1) on.push_back(support[i]);
      if (on.size() > D + 1) continue;
      const Ball<D> tried = ball_through<D>(on);
      if (tried.radius < 0 || (best.radius >= 0 && tried.radius >= best.radius)) continue;
      bool around = true;
      for (const Vector& x : support)
        around = around && (x - tried.center).norm() <= tried.radius * (1 + kRounding);
      if (!around) continue;
      best = tried;
      kept = std::move(on);
    }
    if (!(best.radius > ball.radius)) break;  // rounding
    ball = best;
    support = std::move(kept);
  }
  return ball;
}

}  // namespace vericone::fitting
