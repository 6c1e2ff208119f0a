// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/uncertain/robust.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/error.h>
#include <cmath>
#include <string>

namespace vericone {

using Eigen::Matrix3d, Eigen::Vector3d;

ErrorSet ErrorSet::ball(double radius) {
  if (!(radius >= 0 && std::isfinite(radius)))
    throw InputError("ball", to_text(radius), "a finite radius, 0 or more");
  ErrorSet set;
  set.radius_ = radius;
  return set;
}

ErrorSet ErrorSet::ellipsoid(const Vector3d& semi_axes, const Matrix3d& rotation) {
  for (int i = 0; i < 3; ++i)
    if (!(semi_axes(i) > 0 && std::isfinite(semi_axes(i))))
      throw InputError("semi_axes[" + std::to_string(i) + "]", to_text(semi_axes(i)),
                       "a positive finite number; of flat errors a box");
  ErrorSet set;
  set.factors_.push_back(Ellipsoid::from_axes(Vector3d::Zero(), semi_axes, rotation).factor());
  return set;
}

ErrorSet ErrorSet::box(const Vector3d& half) {
  ErrorSet set;
  for (int i = 0; i < 3; ++i) {
    if (!(half(i) >= 0 && std::isfinite(half(i))))
      throw InputError("box[" + std::to_string(i) + "]", to_text(half(i)), "a finite number, 0 or more");
    if (half(i) > 0) set.segments_.emplace_back(half(i) * Vector3d::Unit(i));
  }
  return set;
}

ErrorSet ErrorSet::zonotope(std::span<const Vector3d> generators) {
  ErrorSet set;
  for (std::size_t i = 0; i < generators.size(); ++i) {
    if (!generators[i].allFinite())
      throw InputError("zonotope[" + std::to_string(i) + "]", to_text(generators[i].sum()),
                       "three finite numbers");
    if (!generators[i].isZero(0)) set.segments_.push_back(generators[i]);
  }
  return set;
}

ErrorSet ErrorSet::sum(double radius, std::vector<Eigen::Matrix3d> factors,
                       std::vector<Eigen::Vector3d> segments) {
  ErrorSet set = ball(radius);
  for (std::size_t i = 0; i < factors.size(); ++i)
    if (!factors[i].allFinite())
      throw InputError("factors[" + std::to_string(i) + "]", "a number that is not finite",
                       "finite (m or m/s)");
  set.segments_ = zonotope(segments).segments_;
  set.factors_ = std::move(factors);
  return set;
}

ErrorSet operator+(ErrorSet x, const ErrorSet& y) {
  x.radius_ += y.radius_;
  x.factors_.insert(x.factors_.end(), y.factors_.begin(), y.factors_.end());
  x.segments_.insert(x.segments_.end(), y.segments_.begin(), y.segments_.end());
  return x;
}

double ErrorSet::support(const Vector3d& n) const {
  double h = radius_ > 0 ? radius_ * n.norm() : 0;
  for (const Matrix3d& f : factors_) h += (f.transpose() * n).norm();
  for (const Vector3d& g : segments_) h += std::abs(g.dot(n));
  return h;
}

Vector3d ErrorSet::support_point(const Vector3d& n) const {
  Vector3d e = Vector3d::Zero();
  if (radius_ > 0) e += n * (radius_ / n.norm());
  for (const Matrix3d& f : factors_) {
    const Vector3d u = f.transpose() * n;
    e += f * (u / u.norm());
  }
  for (const Vector3d& g : segments_) e += g.dot(n) < 0 ? Vector3d(-g) : g;
  return e;
}

double ErrorSet::reach() const {
  double most = radius_;
  for (const Matrix3d& f : factors_) most += f.norm();
  for (const Vector3d& g : segments_) most += g.norm();
  return most;
}

}  // namespace vericone
