// SPDX-License-Identifier: BSD-3-Clause
//
// Where a body is at a time, and by how much doubles may have it elsewhere.
#pragma once

#include <vericone/cones/motion.h>
#include <vericone/geometry/body.h>
#include <Eigen/Core>
#include <string>
#include <vector>

namespace vericone::motion {

/// Of what turns a body: its center and how that goes on, until its motion changes.
struct Course {
  Eigen::Vector3d center, velocity, acceleration;
};

/// Exp(w), each entry right to a few roundings of 1 and of the angle.
Eigen::Matrix3d turn(const Eigen::Vector3d& w);

class Path {
 public:
  /// `name` is before the fields of errors.
  Path(const Placed& body, const BodyMotion& motion, const std::string& name);

  /// When a body that brakes stands; infinite for others. s
  [[nodiscard]] double stop() const { return stop_; }
  /// At t and, until stop(), after it.
  [[nodiscard]] Course course(double t) const;
  /// The body's parts at t, in the world: the pieces of a union of quadrics, else the body.
  [[nodiscard]] std::vector<Placed> parts(double t) const;
  /// The body at t, about its center.
  [[nodiscard]] Placed about_center(double t) const;

  /// No point of the body is farther from its center, m.
  [[nodiscard]] double reach() const { return reach_; }
  /// Radians a second; of what is round about its axis of spin, 0.
  [[nodiscard]] double rate() const { return rate_; }
  [[nodiscard]] const Eigen::Vector3d& spin() const { return spin_; }

  /// The true body, at any time until t, and that of parts() are within this of each other, m: both in the
  /// other and a ball of that radius.
  [[nodiscard]] double rounding(double t) const;

 private:
  [[nodiscard]] Eigen::Vector3d shift(double t) const;  // of the center since t = 0
  [[nodiscard]] Pose pose(double t, const Eigen::Vector3d& center) const;

  std::vector<Body> bodies_;
  Body whole_;
  Pose start_;
  Eigen::Matrix3d rotation_;  // of start_, made orthonormal
  Eigen::Vector3d center_, velocity_, acceleration_, spin_;
  double stop_, rate_ = 0, reach_ = 0;
  double rounded_once_ = 0;  // what that and turned delimiters are off, m
};

}  // namespace vericone::motion
