// SPDX-License-Identifier: BSD-3-Clause
//
// A body that faces along its velocity, level: its azimuth and its elevation are those of the velocity v. On
// a piece of time h, with v's horizontal part no shorter than m, |v| <= s, |a| <= A and |da/dt| <= J (control
// points), c = m / s:
//
//   |azimuth'| <= A / m                     |azimuth''| <= J / m + 2 A^2 / m^2
//   |elevation'| <= A / (m c)               |elevation''| <= (J / m + 3 A^2 / m^2) / c + A^2 / (m^2 c^3)
//
// as u = v / |v| has |u'| <= A / |v| and |u''| <= J / |v| + 3 A^2 / |v|^2, and elevation = asin(u_z). The
// angular velocity Omega = azimuth' e_z + elevation' e, e level and turning with the azimuth, changes by no
// more than |azimuth''| + |elevation''| + |azimuth'| |elevation'|. The unit quaternion q has |q''| <=
// |Omega'| / 2 + |Omega|^2 / 4, the slerp between its ends no more than |Omega|^2 / 4, both the same ends: so
// they are h^2 / 8 of the sum apart at most, twice that as an angle of rotation.
#include <vericone/geometry/error.h>
#include <vericone/simulation/trajectory.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "foreign/bernstein.h"
#include "foreign/pieces.h"

namespace vericone::simulation {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLongestTurn = 0.5;  // rad, of a slerp
constexpr double kSlow = 1e-6;        // of the speed: too steep, or at rest
constexpr int kDeepest = 40;
constexpr double kMostJump = 1e-6;  // rad, between two pieces

/// Level: y horizontal, x along v.
Matrix3d facing(const Vector3d& v) {
  const Vector3d x = v.normalized(), y = Vector3d(-v.y(), v.x(), 0).normalized();
  Matrix3d r;
  r << x, y, x.cross(y);
  return r;
}

class Facing {
 public:
  Facing(const Piecewise& position, double within) : position_(position), within_(within) {
    for (std::size_t k = 0; k < position.points.size(); ++k) {
      const double from = position.times[k], h = position.times[k + 1] - from;
      ControlPoints v = derivative_of(position.points[k]);
      for (Vector3d& x : v) x /= h;
      note(from, v.front());
      divide(v, from, position.times[k + 1], 0);
    }
  }

  [[nodiscard]] const std::vector<double>& times() const { return times_; }
  [[nodiscard]] const std::vector<Matrix3d>& rotations() const { return rotations_; }
  [[nodiscard]] double error() const { return error_; }

 private:
  struct Bounds {
    double rate, change;  // of the angular velocity, rad/s and rad/s^2
  };
  /// Of the velocity's control points on a piece of `h` s; infinite where it may be vertical or zero.
  static Bounds bounds(const ControlPoints& v, double h) {
    constexpr double kUp = 1 + 1e-9;
    Vector3d mean = Vector3d::Zero();
    for (const Vector3d& x : v) mean += Vector3d(x.x(), x.y(), 0);
    double level = std::numeric_limits<double>::infinity(), speed = 0;
    for (const Vector3d& x : v) {
      level = std::min(level, x.dot(mean.normalized()));
      speed = std::max(speed, x.norm());
    }
    if (!(level > kSlow * speed)) return {HUGE_VAL, HUGE_VAL};
    const ControlPoints a = derivative_of(v);
    const double turn = most_of(a) / h / level, jerk = most_of(derivative_of(a)) / (h * h) / level,
                 c = level / speed;
    const double square = turn * turn;
    return {kUp * (turn + turn / c),
            kUp * (jerk + 2 * square + (jerk + 3 * square) / c + square / (c * c * c) + square / c)};
  }

  void divide(const ControlPoints& v, double from, double to, int depth) {
    checkpoint();
    const double h = to - from;
    const Bounds b = bounds(v, h);
    const double off = h * h / 8 * (b.change + b.rate * b.rate) * (1 + 1e-3);
    if (off <= within_ && h * b.rate <= kLongestTurn) {
      error_ = std::max(error_, off);
      times_.push_back(to);
      rotations_.push_back(facing(v.back()));
      return;
    }
    const double middle = 0.5 * (from + to);
    if (depth == kDeepest || !(from < middle && middle < to))
      throw InputError("position", "a velocity at rest or vertical about " + to_text(from) + " s",
                       "never, of a body that faces along its velocity");
    divide(part_of(v, 0, 0.5), from, middle, depth + 1);
    divide(part_of(v, 0.5, 1), middle, to, depth + 1);
  }

  /// The beginning of a piece: the first, or as the one before ended.
  void note(double t, const Vector3d& v) {
    if (!(v.head<2>().norm() > kSlow * v.norm()))
      throw InputError("position", "a velocity at rest or vertical at " + to_text(t) + " s",
                       "never, of a body that faces along its velocity");
    const Matrix3d r = facing(v);
    if (times_.empty()) {
      times_.push_back(t);
      rotations_.push_back(r);
      return;
    }
    const double jump = (r - rotations_.back()).norm();
    if (!(jump <= kMostJump))
      throw InputError("position", "a velocity that turns at once at " + to_text(t) + " s",
                       "one that does not, of a body that faces along it");
    jumps_ = std::max(jumps_, jump);
    error_ = std::max(error_, within_ + jumps_);
  }

  const Piecewise& position_;
  double within_;
  std::vector<double> times_;
  std::vector<Matrix3d> rotations_;
  double error_ = 0, jumps_ = 0;  // rad
};

}  // namespace

Trajectory turned_along(Trajectory trajectory, double within) {
  if (!(within > 0)) throw InputError("within", to_text(within), "positive (rad)");
  require_pieces(trajectory.position, "position", "position");
  const Facing facing(trajectory.position, within);
  Trajectory turned = turned_through(std::move(trajectory), facing.times(), facing.rotations());
  turned.turned->error += facing.error();
  return turned;
}

}  // namespace vericone::simulation
