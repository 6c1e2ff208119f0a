// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/simulation/curve.h>

#include <vericone/geometry/error.h>
#include <vericone/geometry/pose.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

namespace vericone::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

Quintic derivative(const Quintic& p) {
  Quintic d{};
  for (std::size_t i = 0; i + 1 < p.size(); ++i) d[i] = double(i + 1) * p[i + 1];
  d.back().setZero();
  return d;
}

Vector3d value(const Quintic& p, double t) {
  Vector3d sum = p.back();
  for (std::size_t i = p.size() - 1; i-- > 0;) sum = sum * t + p[i];
  return sum;
}

/// Bernstein coefficients of degree 5 over [0, duration]: b_j = sum over i <= j of C(j, i) / C(5, i) times
/// the coefficient of t^i and duration^i.
Quintic bernstein(const Quintic& p, double duration) {
  constexpr std::array<double, 6> kOfFive{1, 5, 10, 10, 5, 1};
  Quintic scaled, b;
  double power = 1;
  for (std::size_t i = 0; i < p.size(); ++i, power *= duration) scaled[i] = power / kOfFive[i] * p[i];
  for (std::size_t j = 0; j < p.size(); ++j) {
    b[j].setZero();
    double choose = 1;
    for (std::size_t i = 0; i <= j; ++i) {
      b[j] += choose * scaled[i];
      choose = choose * double(j - i) / double(i + 1);
    }
  }
  return b;
}

/// Not below |p| over [0, duration], with what some dozens of operations round.
double most(const Quintic& p, double duration) {
  double most = 0, size = 0, power = 1;
  for (const Vector3d& b : bernstein(p, duration)) most = std::max(most, b.norm());
  for (std::size_t i = 0; i < p.size(); ++i, power *= duration) size += p[i].norm() * power;
  return most + 64 * std::numeric_limits<double>::epsilon() * size;
}

bool one_direction(const Quintic& p) {
  Vector3d along = Vector3d::Zero();
  for (const Vector3d& c : p) {
    if (along.isZero(0)) along = c;
    if (!along.cross(c).isZero(0)) return false;
  }
  return true;
}

Matrix3d rotation_by(const Vector3d& turned) {
  const double angle = turned.norm();
  if (angle == 0) return Matrix3d::Identity();
  return Eigen::AngleAxisd(angle, turned / angle).toRotationMatrix();
}

/// J rate, for Exp(turned): along the axis as it is, across it by sin(x) / x and (1 - cos x) / x.
Vector3d angular_velocity(const Vector3d& turned, const Vector3d& rate) {
  const double angle = turned.norm();
  if (angle == 0) return rate;
  const Vector3d axis = turned / angle;
  const Vector3d along = axis * axis.dot(rate), across = rate - along;
  const double half = std::sin(angle / 2);
  return along + std::sin(angle) / angle * across + 2 * half * half / angle * axis.cross(across);
}

bool finite(const Quintic& p) {
  return std::all_of(p.begin(), p.end(), [](const Vector3d& c) { return c.allFinite(); });
}

}  // namespace

Quintic quintic(const Jet& from, const Jet& to, double duration) {
  // What a parabola from the start misses at the end: value, first and second derivative, per unit of time.
  const double h = duration;
  const Vector3d value = to.value - from.value - h * (from.first + 0.5 * h * from.second);
  const Vector3d first = h * (to.first - from.first - h * from.second);
  const Vector3d second = h * h * (to.second - from.second);
  const double h3 = h * h * h;
  return {from.value,
          from.first,
          0.5 * from.second,
          (10 * value - 4 * first + 0.5 * second) / h3,
          (-15 * value + 7 * first - second) / (h3 * h),
          (6 * value - 3 * first + 0.5 * second) / (h3 * h * h)};
}

Curve::Curve(const Quintic& position, const Quintic& turned, const Matrix3d& rotation, double from, double to)
    : Leg(from, to), position_(position), turned_(turned), rotation_(rotation) {
  if (!(to > from) || !std::isfinite(to))
    throw InputError("to", to_text(to), "a time after " + to_text(from) + " s");
  if (!finite(position) || !finite(turned) || !rotation.allFinite())
    throw InputError("curve", "a number that is not finite", "finite coefficients");
  start_ = at(from);
  end_ = at(to);
  bound();
}

Curve Curve::steady(const Motion& start, const Vector3d& spin, double from, double to) {
  Quintic position{}, turned{};
  position.fill(Vector3d::Zero());
  turned.fill(Vector3d::Zero());
  position[0] = start.position;
  position[1] = start.velocity;
  turned[1] = spin;
  return {position, turned, start.rotation, from, to};
}

Motion Curve::at(double t) const {
  const double since = std::clamp(t, from_, to_) - from_;
  Motion m;
  m.position = value(position_, since);
  m.velocity = value(derivative(position_), since);
  const Vector3d turned = value(turned_, since);
  m.rotation = turned.isZero(0) ? rotation_ : orthonormal<3>(Matrix3d(rotation_by(turned) * rotation_));
  return m;
}

Vector3d Curve::acceleration(double t) const {
  return value(derivative(derivative(position_)), std::clamp(t, from_, to_) - from_);
}

Vector3d Curve::turn(double t) const {
  const double since = std::clamp(t, from_, to_) - from_;
  return angular_velocity(value(turned_, since), value(derivative(turned_), since));
}

void Curve::bound() {
  constexpr double kUp = 1 + 1e-12;
  const double h = to_ - from_;
  const Quintic rate = derivative(turned_);
  most_acceleration_ = most(derivative(derivative(position_)), h) * kUp;
  most_turn_rate_ = most(rate, h) * kUp;
  const double squared = most_turn_rate_ * most_turn_rate_;
  most_turn_acceleration_ =
      (squared + most(derivative(rate), h) + (one_direction(turned_) ? 0 : 0.5 * squared)) * kUp;
  first_turn_ = turn(from_);
  last_turn_ = turn(to_);
}

}  // namespace vericone::simulation
