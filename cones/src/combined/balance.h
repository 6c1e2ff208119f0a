// SPDX-License-Identifier: BSD-3-Clause
//
// Multipliers of inequalities that are nearly met with equality.
#pragma once

#include <vericone/internal/geometry/decompositions.h>
#include <Eigen/Core>
#include <algorithm>
#include <array>

namespace vericone {

/// Linear bounds base + slope.d with |slope| = 1: those with the largest bases, at most N + 1, and weights >=
/// 0 of sum 1 for which their slopes nearly cancel.
template <int N>
class Balance {
 public:
  using Vector = Eigen::Matrix<double, N, 1>;

  struct Bound {
    int index = 0;     // of the inequality
    double scale = 0;  // of its gradient to that of the slope
    double base = 0;
    Vector slope = Vector::Zero();
    double weight = 0;
  };

  void offer(const Bound& bound) {
    int at = count_;
    while (at > 0 && bounds_[at - 1].base < bound.base) --at;
    if (at == kMost) return;
    count_ = std::min(count_ + 1, kMost);
    for (int k = count_ - 1; k > at; --k) bounds_[k] = bounds_[k - 1];
    bounds_[at] = bound;
  }

  /// Finds the weights: a least combination whose negative ones are dropped, one after the other. False
  /// where nothing is left.
  bool solve() {
    for (; count_ > 0; drop()) {
      System system = System::Zero(count_ + 1, count_ + 1);
      for (int i = 0; i < count_; ++i) {
        for (int j = 0; j < count_; ++j) system(i, j) = bounds_[i].slope.dot(bounds_[j].slope);
        system(i, i) += 1e-14;
        system(i, count_) = system(count_, i) = 1;
      }
      Column weights = Column::Zero(count_ + 1);
      weights(count_) = 1;
      solve_square(system, weights);
      if (!weights.allFinite()) return false;
      base_ = 0;
      rest_.setZero();
      for (int i = 0; i < count_; ++i) {
        bounds_[i].weight = weights(i);
        base_ += weights(i) * bounds_[i].base;
        rest_ += weights(i) * bounds_[i].slope;
      }
      if (weights.head(count_).minCoeff() >= 0) return true;
    }
    return false;
  }

  int count() const { return count_; }
  const Bound& operator[](int i) const { return bounds_[i]; }
  double base() const { return base_; }
  const Vector& rest() const { return rest_; }  // what is left of the slopes

  /// The shortest step by which all bounds become base().
  Vector levelling_step() const {
    System system = System::Zero(count_, count_);
    Column by(count_);
    for (int i = 0; i < count_; ++i) {
      for (int j = 0; j < count_; ++j) system(i, j) = bounds_[i].slope.dot(bounds_[j].slope);
      system(i, i) += 1e-12;
      by(i) = base_ - bounds_[i].base;
    }
    solve_square(system, by);
    Vector step = Vector::Zero();
    for (int i = 0; i < count_; ++i) step += by(i) * bounds_[i].slope;
    return step;
  }

 private:
  static constexpr int kMost = N + 1;
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, kMost + 1, 1>;
  using System = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, kMost + 1, kMost + 1>;

  void drop() {
    int least = 0;
    for (int i = 1; i < count_; ++i)
      if (bounds_[i].weight < bounds_[least].weight) least = i;
    for (int i = least; i + 1 < count_; ++i) bounds_[i] = bounds_[i + 1];
    --count_;
  }

  std::array<Bound, kMost> bounds_;
  int count_ = 0;
  double base_ = 0;
  Vector rest_ = Vector::Zero();
};

}  // namespace vericone
