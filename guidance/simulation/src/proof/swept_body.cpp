// SPDX-License-Identifier: BSD-3-Clause
#include "proof/swept_body.h"

#include <vericone/internal/geometry/decompositions.h>
#include <vericone/internal/geometry/requires.h>
#include <vericone/internal/simulation/shape_in_time.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace vericone::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// What a support function can round, relative: sums of a dozen products, and for delimited bodies the
// solution of a system whose eigenvalues are at least kLeastPivot of their mean.
constexpr double kRoundingPlain = 1e-14;
constexpr double kRoundingDelimited = 1e-8;
constexpr double kLeastPivot = 1e-6;

/// The body in space whose section by z = 0 is the planar one; as thick as the planar one is narrow.
CombinedEllipsoid in_space(const CombinedEllipse& body) {
  const Eigen::Matrix2d& f = body.ellipsoid().factor();
  const Eigen::Vector2d axes = f.colwise().norm().transpose();
  Matrix3d rotation = Matrix3d::Identity();
  rotation.topLeftCorner<2, 2>() = f * axes.cwiseInverse().asDiagonal();
  const auto ellipsoid = Ellipsoid::from_axes({body.center().x(), body.center().y(), 0},
                                              {axes(0), axes(1), axes.minCoeff()}, rotation);
  if (body.is_ellipsoid()) return ellipsoid;
  std::vector<Delimiter<3>> delimiters;
  for (const Delimiter<2>& d : body.delimiters()) {
    Matrix3d m = Matrix3d::Zero();
    m.topLeftCorner<2, 2>() = d.matrix;
    delimiters.push_back({m, d.level});
  }
  return CombinedEllipsoid::trusted(ellipsoid, std::move(delimiters));
}

/// Where a function with one minimum is least.
template <typename F>
double golden_minimum(const F& f, double lo, double hi, int steps) {
  constexpr double kGolden = 0.6180339887498949;
  double x = hi - kGolden * (hi - lo), y = lo + kGolden * (hi - lo), fx = f(x), fy = f(y);
  for (int step = 0; step < steps; ++step) {
    if (fx <= fy) {
      hi = y, y = x, fy = fx;
      x = hi - kGolden * (hi - lo), fx = f(x);
    } else {
      lo = x, x = y, fx = fy;
      y = lo + kGolden * (hi - lo), fy = f(y);
    }
  }
  return lo;
}

}  // namespace

SweptBody::SweptBody(const ShapeInTime& shape, double reach, double from, double to, const Matrix3d& rotation,
                     double angle)
    : reach_(reach), angle_(angle) {
  const WorldBody posed = shape_over(shape, from, to, Vector3d::Zero(), rotation);
  VERICONE_REQUIRES(!posed.placed());
  if (posed.hull())
    hull_ = *posed.hull();
  else
    body_ = posed.planar() ? in_space(*posed.flat()) : *posed.quadric();
  const Matrix3d& f = body_.ellipsoid().factor();
  for (const Delimiter<3>& d : body_.delimiters()) {
    const Matrix3d a = f.transpose() * d.matrix * f;
    const auto solver = symmetric_eigen<3>(0.5 * (a + a.transpose()));
    seen_.push_back({0.5 * (a + a.transpose()), solver.vectors, solver.values, d.level});
  }
}

double SweptBody::sway() const {
  return angle_ < std::numbers::pi ? 2 * reach_ * std::sin(0.5 * angle_) : 2 * reach_;
}

double SweptBody::extent() const {
  // All shapes of the piece together may reach farther than any one of them.
  return hull() || body_.is_ellipsoid() ? reach_ : body_.ellipsoid().factor().norm() * (1 + kRoundingPlain);
}

SweptBody::Multipliers SweptBody::multipliers(const Vector3d& n) const {
  const Vector3d m = body_.ellipsoid().factor().transpose() * n;
  return seen_.size() == 1 ? of_one(m) : of_several(m);
}

SweptBody::Multipliers SweptBody::of_one(const Vector3d& m) const {
  const Seen& seen = seen_.front();
  const Vector3d squares = (seen.directions.transpose() * m).cwiseAbs2();
  const auto pivots = [&](double lambda) { return Vector3d(Vector3d::Ones() + lambda * seen.values); };
  const auto value = [&](double lambda) {
    return (1 + lambda * seen.level) * squares.cwiseQuotient(pivots(lambda)).sum();
  };
  // As far as all eigenvalues 1 + lambda alpha stay kLeastPivot of their mean.
  double most = 1e6;
  const double mean = seen.values.mean(), steepest = kLeastPivot * mean - seen.values.minCoeff();
  if (steepest > 0) most = std::min(most, (1 - kLeastPivot) / steepest);
  const double end = most / (1 + most);
  const double x = golden_minimum([&](double at) { return value(at / (1 - at)); }, 0, end, 40);
  double lambda = x / (1 - x);
  for (const double other : {0.0, most})
    if (value(other) < value(lambda)) lambda = other;
  return {seen.directions * pivots(lambda).cwiseInverse().asDiagonal() * seen.directions.transpose(),
          1 + lambda * seen.level};
}

// Any multipliers give a bound; they are improved one after the other.
SweptBody::Multipliers SweptBody::of_several(const Vector3d& m) const {
  const auto shifted = [](const Matrix3d& a) {
    return cholesky<3>(a - kLeastPivot / 3 * a.trace() * Matrix3d::Identity());
  };
  const auto value = [&](const Matrix3d& a, double bound) {
    // The shift keeps away from singular matrices and changes the value less than matters here.
    const Cholesky<3> llt = shifted(a);
    if (!(a.trace() > 0) || !llt.positive) return std::numeric_limits<double>::infinity();
    return bound * m.dot(llt.solve(m));
  };
  Matrix3d sum = Matrix3d::Identity();
  double level = 1;
  std::vector<double> lambda(seen_.size(), 0.0);
  for (int round = 0; round < 3; ++round)
    for (std::size_t i = 0; i < seen_.size(); ++i) {
      const Matrix3d rest = sum - lambda[i] * seen_[i].matrix;
      const double rest_level = level - lambda[i] * seen_[i].level;
      const auto at = [&](double x) {
        const double l = x / (1 - x);
        return value(rest + l * seen_[i].matrix, rest_level + l * seen_[i].level);
      };
      const double x = golden_minimum(at, 0, 1 - 1e-6, 40);
      if (!(at(x) < value(sum, level))) continue;
      lambda[i] = x / (1 - x);
      sum = rest + lambda[i] * seen_[i].matrix;
      level = rest_level + lambda[i] * seen_[i].level;
    }
  const Matrix3d inverse = cholesky<3>(sum).inverse();
  return {0.5 * (inverse + inverse.transpose()), level};
}

// Over all normals within `angle` of n, rho^2 = n'^T S n' is at most
//   cos^2 n^T S n + 2 sin cos |S n - n (n^T S n)| + sin^2 (largest eigenvalue of S),
// which grows with the angle up to a quarter of a right angle and beyond.
double SweptBody::turned(double squared, double across, double largest) const {
  if (!(angle_ < std::numbers::pi / 4)) return reach_;
  const double c = std::cos(angle_), s = std::sin(angle_);
  return std::min(reach_,
                  std::sqrt(c * c * squared + 2 * s * c * across + s * s * std::max(largest, squared)));
}

double SweptBody::support(const Vector3d& n) const {
  if (hull()) {
    // A point at the angle phi from n comes nearer by at most `angle`.
    const double c = std::cos(angle_), s = std::sin(angle_);
    double most = -std::numeric_limits<double>::infinity();
    if (!(angle_ < std::numbers::pi / 2)) return reach_;
    for (const Vector3d& x : hull_->points()) {
      const double along = n.dot(x);
      if (angle_ == 0) {
        most = std::max(most, along);
        continue;
      }
      const double length = x.norm(), across = (x - along * n).norm();
      most = std::max(most, along > c * length ? length : c * along + s * across);
    }
    return std::min(most + kRoundingPlain * reach_, reach_);
  }
  const Matrix3d& f = body_.ellipsoid().factor();
  const Vector3d m = f.transpose() * n;
  if (body_.is_ellipsoid()) {
    if (angle_ == 0) return m.norm() * (1 + kRoundingPlain);
    const Vector3d image = f * m;
    const double squared = m.squaredNorm();
    return turned(squared, (image - squared * n).norm(), reach_ * reach_) * (1 + kRoundingPlain);
  }
  const Multipliers multipliers = this->multipliers(n);
  const Vector3d inside = multipliers.inverse * m;
  const double squared = multipliers.level * m.dot(inside);
  if (angle_ == 0) return std::sqrt(squared) * (1 + kRoundingDelimited);
  const Vector3d image = multipliers.level * (f * inside);
  const double trace = multipliers.level * (f * multipliers.inverse * f.transpose()).trace();
  return turned(squared, (image - squared * n).norm(), trace) * (1 + kRoundingDelimited);
}

Vector3d SweptBody::support_point(const Vector3d& n) const {
  if (hull()) {
    const auto& points = hull_->points();
    return *std::max_element(points.begin(), points.end(),
                             [&](const Vector3d& x, const Vector3d& y) { return n.dot(x) < n.dot(y); });
  }
  return around(n).support_point(n);
}

Ellipsoid SweptBody::around(const Vector3d& n) const {
  if (body_.is_ellipsoid()) return body_.ellipsoid();
  const Multipliers multipliers = this->multipliers(n);
  const Matrix3d root = cholesky<3>(multipliers.inverse).lower;
  const Matrix3d factor = std::sqrt(multipliers.level) * (body_.ellipsoid().factor() * root);
  const LeftSingular<3> svd = left_singular<3>(factor);
  Matrix3d directions = svd.u;
  if (directions.determinant() < 0) directions.col(0) = -directions.col(0);
  return Ellipsoid::from_axes(Vector3d::Zero(), svd.values, directions);
}

}  // namespace vericone::simulation
