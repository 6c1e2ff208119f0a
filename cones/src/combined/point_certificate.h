// SPDX-License-Identifier: BSD-3-Clause
//
// What one point says of a list of quadratic inequalities: near a tangency most lists are decided from there.
#pragma once

#include <vericone/geometry/decompositions.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "combined/quadratic_search.h"

namespace vericone {

/// At a tangency some multipliers lambda >= 0 make the gradients cancel. A moment before, the combination
/// sum lambda_i q_i is positive there, and where it is convex it is positive everywhere: `empty`, from one
/// point instead of many boxes. A moment after, a step that makes all of them alike leads inside: `found`,
/// and `z` is such a point. Otherwise nothing is said. Both answers are certain. Cost: about 1 us, no
/// allocation.
template <int N>
class PointCertificate {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  SearchOutcome decide(const std::vector<QuadraticConstraint<N>>& list, const SearchBox<N>& box, Vector& z) {
    if (!inside(box, z) || !look(list, z) || !balance()) return SearchOutcome::undecided;
    if (height_ > 0) return convex(list, box, z) ? SearchOutcome::empty : SearchOutcome::undecided;
    return step(list, box, z) ? SearchOutcome::found : SearchOutcome::undecided;
  }

 private:
  static constexpr int kMost = N + 1;
  /// In units of the bodies: what is farther away plays no part in a tangency.
  static constexpr double kNear = 1e-3;
  using Weights = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMost + 1, 1>;
  using System =
      Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMost + 1, kMost + 1>;

  struct Met {
    const QuadraticConstraint<N>* q = nullptr;
    double distance = 0, norm = 0;  // value / |gradient|
    Vector normal = Vector::Zero();
    double weight = 0;
  };

  static bool inside(const SearchBox<N>& box, const Vector& z) {
    return ((z - box.middle).cwiseAbs() - box.half).maxCoeff() <= 0;
  }

  /// The inequalities that are nearly met with equality, those nearest first.
  bool look(const std::vector<QuadraticConstraint<N>>& list, const Vector& z) {
    count_ = 0;
    for (const QuadraticConstraint<N>& q : list) {
      Met met;
      const double value = q.evaluate(z, met.normal);
      met.norm = met.normal.norm();
      if (!(met.norm > 0)) continue;
      met.distance = value / met.norm;
      if (met.distance < -kNear) continue;
      met.normal /= met.norm;
      met.q = &q;
      int at = count_;
      while (at > 0 && met_[at - 1].distance < met.distance) --at;
      if (at == kMost) continue;
      count_ = std::min(count_ + 1, kMost);
      for (int k = count_ - 1; k > at; --k) met_[k] = met_[k - 1];
      met_[at] = met;
    }
    return count_ > 0;
  }

  /// Weights >= 0 of sum 1 for which the normals nearly cancel; the height is that of the combination.
  bool balance() {
    for (;;) {
      System system = System::Zero(count_ + 1, count_ + 1);
      for (int i = 0; i < count_; ++i) {
        for (int j = 0; j < count_; ++j) system(i, j) = met_[i].normal.dot(met_[j].normal);
        system(i, i) += 1e-14;
        system(i, count_) = system(count_, i) = 1;
      }
      Weights right = Weights::Zero(count_ + 1);
      right(count_) = 1;
      const Weights weights = system.partialPivLu().solve(right);
      if (!weights.allFinite()) return false;
      int least = 0;
      for (int i = 0; i < count_; ++i) {
        met_[i].weight = weights(i);
        if (weights(i) < weights(least)) least = i;
      }
      if (weights(least) >= 0) break;
      for (int i = least; i + 1 < count_; ++i) met_[i] = met_[i + 1];
      --count_;
    }
    height_ = 0;
    rest_.setZero();
    for (int i = 0; i < count_; ++i) {
      height_ += met_[i].weight * met_[i].distance;
      rest_ += met_[i].weight * met_[i].normal;
    }
    return true;
  }

  /// The combination is at least height + rest.d + d^T H d at z + d.
  bool convex(const std::vector<QuadraticConstraint<N>>&, const SearchBox<N>& box, const Vector& z) const {
    Eigen::Matrix<double, N, N> h = Eigen::Matrix<double, N, N>::Zero();
    double slack = 0, size = 0;
    for (int i = 0; i < count_; ++i) {
      const double weight = met_[i].weight / met_[i].norm;
      h += weight * met_[i].q->h;
      slack += weight * met_[i].q->slack;
      size += met_[i].weight * std::abs(met_[i].distance) + weight * met_[i].q->h.norm();
    }
    const Vector reach = box.half + (z - box.middle).cwiseAbs();
    const double room = height_ - slack - rest_.cwiseAbs().dot(reach) - 1e-14 * (size + reach.sum());
    if (!(room > 0)) return false;
    // A curvature of -room / |d|^2 at most; what Cholesky's method may round is far below 1e-14 |H|.
    h.diagonal().array() += 0.99 * room / reach.squaredNorm() - 1e-14 * size;
    return cholesky<N>(h).positive;
  }

  /// To where all are violated alike, which is by the height: not at all where that is negative.
  bool step(const std::vector<QuadraticConstraint<N>>& list, const SearchBox<N>& box, Vector& z) const {
    System system = System::Zero(count_, count_);
    Weights right(count_);
    for (int i = 0; i < count_; ++i) {
      for (int j = 0; j < count_; ++j) system(i, j) = met_[i].normal.dot(met_[j].normal);
      system(i, i) += 1e-12;
      right(i) = height_ - met_[i].distance;
    }
    const Weights by = system.partialPivLu().solve(right);
    Vector x = z;
    for (int i = 0; i < count_; ++i) x += by(i) * met_[i].normal;
    if (!x.allFinite() || !inside(box, x)) return false;
    for (const QuadraticConstraint<N>& q : list) {
      Vector gradient;
      if (!(q.evaluate(x, gradient) + q.slack <= 0)) return false;
    }
    z = x;
    return true;
  }

  int count_ = 0;
  std::array<Met, kMost> met_;
  double height_ = 0;
  Vector rest_ = Vector::Zero();
};

}  // namespace vericone
