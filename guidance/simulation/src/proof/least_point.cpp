// SPDX-License-Identifier: BSD-3-Clause
#include "proof/least_point.h"

#include <vericone/internal/geometry/decompositions.h>
#include <algorithm>
#include <cmath>
#include <vector>

namespace vericone::simulation {
namespace {

using Eigen::Vector3d;

/// Points of the set whose hull holds the present point, and its weights.
struct Corral {
  std::vector<Vector3d> points, directions;
  std::vector<double> weights;

  Vector3d sum() const {
    Vector3d x = Vector3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i) x += weights[i] * points[i];
    return x;
  }

  /// Weights, of sum one, of the point of the affine hull that is nearest to the origin.
  std::vector<double> affine() const {
    const Eigen::Index n = static_cast<Eigen::Index>(points.size()) - 1;
    if (n == 0) return {1.0};
    Eigen::MatrixXd edges(3, n);
    for (Eigen::Index i = 0; i < n; ++i)
      edges.col(i) = points[static_cast<std::size_t>(i) + 1] - points.front();
    const Eigen::VectorXd w = least_squares(edges, -points.front());
    std::vector<double> all{1 - w.sum()};
    for (Eigen::Index i = 0; i < n; ++i) all.push_back(w(i));
    return all;
  }

  /// Goes towards the affine optimum; drops points where the hull ends.
  void descend() {
    while (true) {
      const std::vector<double> target = affine();
      double share = 1;
      for (std::size_t i = 0; i < target.size(); ++i)
        if (target[i] <= 1e-14) share = std::min(share, weights[i] / (weights[i] - target[i]));
      for (std::size_t i = 0; i < target.size(); ++i) weights[i] += share * (target[i] - weights[i]);
      if (share >= 1) return;
      std::size_t least = 0;
      for (std::size_t i = 0; i < weights.size(); ++i)
        if (weights[i] < weights[least]) least = i;
      if (points.size() == 1) return;
      points.erase(points.begin() + static_cast<std::ptrdiff_t>(least));
      directions.erase(directions.begin() + static_cast<std::ptrdiff_t>(least));
      weights.erase(weights.begin() + static_cast<std::ptrdiff_t>(least));
      double total = 0;
      for (double& w : weights) total += (w = std::max(w, 0.0));
      for (double& w : weights) w /= total;
    }
  }
};

}  // namespace

Vector3d least_point(const std::function<Vector3d(const Vector3d&)>& farthest, const Vector3d& start,
                     std::vector<MeanPart>* made_of) {
  constexpr int kMostSteps = 200;
  constexpr double kPrecision = 1e-10;
  Corral corral{{farthest(-start)}, {-start}, {1.0}};
  const auto told = [&](const Vector3d& x) {
    if (made_of) made_of->clear();
    for (std::size_t i = 0; made_of && i < corral.points.size(); ++i)
      made_of->push_back({corral.directions[i], corral.weights[i]});
    return x;
  };
  Vector3d x = corral.points.front();
  double size = x.norm();
  for (int step = 0; step < kMostSteps; ++step) {
    const double norm = x.norm();
    if (!(norm > 1e-13 * size)) return told(Vector3d::Zero());
    const Vector3d next = farthest(-x / norm);
    size = std::max(size, next.norm());
    if (norm - next.dot(x) / norm <= kPrecision * norm + 1e-15 * size) break;
    if (corral.points.size() == 4) return told(Vector3d::Zero());  // a simplex around the origin
    corral.points.push_back(next);
    corral.directions.emplace_back(-x / norm);
    corral.weights.push_back(0);
    corral.descend();
    const Vector3d moved = corral.sum();
    if (!(moved.norm() < norm)) break;
    x = moved;
  }
  return told(x);
}

}  // namespace vericone::simulation
