// SPDX-License-Identifier: BSD-3-Clause
#include "proof/ball_bound.h"

#include <vericone/internal/geometry/decompositions.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "infinity.h"

namespace vericone::fitting {
namespace {

/// Not below the largest eigenvalue of A, nor below 0. With B = V^T A V and V nearly orthonormal, x^T A x =
/// y^T B y for x = V y, |y|^2 <= |x|^2 / (1 - |V^T V - I|), and Gershgorin's discs bound B.
double bound_of_eigenvalues(const std::array<std::array<Interval, 3>, 3>& a, const Eigen::Matrix3d& v) {
  double largest = 0, defect = 0;
  for (int i = 0; i < 3; ++i) {
    Interval disc = 0, gram = 0;
    for (int j = 0; j < 3; ++j) {
      Interval b = 0, e = i == j ? -1 : 0;
      for (int k = 0; k < 3; ++k) {
        e = e + Interval(v(k, i)) * Interval(v(k, j));
        for (int l = 0; l < 3; ++l)
          b = b + Interval(v(k, i)) * Interval(v(l, j)) *
                      a[static_cast<std::size_t>(k)][static_cast<std::size_t>(l)];
      }
      disc = disc + (i == j ? b : Interval(b.magnitude()));
      gram = gram + Interval(e.magnitude());
    }
    largest = std::max(largest, disc.hi());
    defect = std::max(defect, gram.hi());
  }
  if (!(defect < 0.5)) return kInfinity;
  return (Interval(largest) / (Interval(1) - Interval(defect))).hi();
}

}  // namespace

BallBound::BallBound(const QuadraticForm& form) : a_(form.second()) {
  Eigen::Matrix3d a;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) a(i, j) = a_[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].mid();
  if (!a.allFinite()) {
    largest_ = kInfinity;
    return;
  }
  const auto solver = symmetric_eigen<3>(a);
  lambda_ = solver.values;
  vectors_ = solver.vectors;
  largest_ = bound_of_eigenvalues(a_, vectors_);
}

/// Near the t >= 0 with |(t I - A)^{-1} g| = radius, or the least t allowed where it is shorter there.
double BallBound::multiplier(const Eigen::Vector3d& g, double radius) const {
  // The length falls from t = largest to t = largest + |g| / radius, where it is at most the radius. The
  // inverse of the length is concave in t, so Newton's steps from the left never pass the solution.
  double low = largest_ + std::abs(g(2)) / radius;
  const double high = largest_ + g.norm() / radius;
  double t = std::max(low, std::nextafter(largest_, kInfinity));
  for (int step = 0; step < 50 && t < high; ++step) {
    double square = 0, slope = 0;
    for (int i = 0; i < 3; ++i) {
      const double y = g(i) / (t - lambda_(i));
      square += y * y;
      slope += y * y / (t - lambda_(i));
    }
    const double length = std::sqrt(square);
    if (!(length > radius * (1 + 1e-15))) break;
    const double next = std::min(high, t + (length / radius - 1) * square / slope);
    if (!(next > t)) break;
    t = next;
  }
  return t;
}

double BallBound::greatest_value(const QuadraticForm::At& x, double radius) const {
  if (!std::isfinite(largest_)) return kInfinity;
  const Eigen::Vector3d gradient(x.half_gradient[0].mid(), x.half_gradient[1].mid(),
                                 x.half_gradient[2].mid());
  if (!gradient.allFinite()) return kInfinity;
  const Eigen::Vector3d g = vectors_.transpose() * gradient;
  const double t = multiplier(g, radius);
  const Eigen::Vector3d w =
      vectors_ * (g.array() / (t - lambda_.array()).max(std::numeric_limits<double>::min())).matrix();

  Interval sum = x.value + Interval(t) * square(Interval(radius));
  Interval squares = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    Interval r = x.half_gradient[i] - Interval(t) * Interval(w(static_cast<int>(i)));
    for (std::size_t j = 0; j < 3; ++j) r = r + a_[i][j] * Interval(w(static_cast<int>(j)));
    sum = sum + Interval(w(static_cast<int>(i))) * (x.half_gradient[i] + r);
    squares = squares + square(r);
  }
  if (!(squares.hi() <= 0)) sum = sum + squares / (Interval(t) - Interval(largest_));
  return sum.finite() ? sum.hi() : kInfinity;
}

}  // namespace vericone::fitting
