// SPDX-License-Identifier: BSD-3-Clause
//
// Two bodies of a swarm, and the planes between them.
#pragma once

#include <vericone/geometry/world_body.h>
#include <vericone/swarm/swarm.h>
#include <Eigen/Core>

namespace vericone::swarm {

/// What one body is as far as planes ask: ready to be used many times.
struct Prepared {
  explicit Prepared(const Solid& solid);
  Prepared() = default;

  Eigen::Matrix3d axes = Eigen::Matrix3d::Identity();   // columns: half axes, m
  Eigen::Matrix3d shape = Eigen::Matrix3d::Identity();  // axes axes^T, of an ellipsoid
  double reach = 1;                                     // m
  bool round = true, box = false;

  /// Half the width along n.
  [[nodiscard]] double width(const Eigen::Vector3d& n) const {
    if (round) return reach * n.norm();
    const Eigen::Vector3d u = axes.transpose() * n;
    return box ? u.lpNorm<1>() : u.norm();
  }
};

/// About the origin, not turned.
[[nodiscard]] WorldBody world_body(const Solid& solid);

/// The same body, turned by that rotation vector about its centre.
[[nodiscard]] Solid turned(const Solid& solid, const Eigen::Vector3d& by);

/// m/s: so far at least v is outside of the velocities that touch within `horizon`, by the plane with that
/// normal alone, of length 1; negative where it says nothing.
[[nodiscard]] inline double outside_by(const Prepared& a, const Prepared& b, const Eigen::Vector3d& c,
                                       const Eigen::Vector3d& v, double horizon, const Eigen::Vector3d& n) {
  const double ahead = n.dot(c) + a.width(n) + b.width(n);
  return ahead <= 0 ? n.dot(v) - ahead / horizon : -1;
}
/// The normal of ORCA's plane of the balls about both.
[[nodiscard]] Eigen::Vector3d normal_of_balls(const Prepared& a, const Prepared& b, const Eigen::Vector3d& c,
                                              const Eigen::Vector3d& v, double horizon);

/// In coordinates in which the sum of both shape matrices is 1, the sum of both bodies about their distance.
class Between {
 public:
  /// The first is an ellipsoid.
  Between(const Prepared& first, const Prepared& second);

  /// A unit normal with the largest gap n.c - width, nearly; c: second centre less first.
  [[nodiscard]] Eigen::Vector3d normal(const Eigen::Vector3d& c) const;
  [[nodiscard]] double gap(const Eigen::Vector3d& n, const Eigen::Vector3d& c) const {
    return n.dot(c) - first_.width(n) - second_.width(n);
  }
  [[nodiscard]] ReciprocalPlane plane(const Eigen::Vector3d& c, const Eigen::Vector3d& v, double horizon,
                                      Nearest nearest) const;
  [[nodiscard]] double most() const { return first_.reach + second_.reach; }

 private:
  /// What of the sum is farthest along a unit normal, and the radius of the ball that osculates there.
  struct Tip {
    Eigen::Vector3d point;
    double radius;
  };
  [[nodiscard]] Tip tip(const Eigen::Vector3d& n) const;
  [[nodiscard]] double width(const Eigen::Vector3d& n) const {  // in the map
    return std::sqrt(n.dot(a_ * n)) + std::sqrt(n.dot(b_ * n));
  }
  [[nodiscard]] Eigen::Vector3d side(const Eigen::Vector3d& y, const Eigen::Vector3d& n,
                                     const Eigen::Vector3d& w) const;
  [[nodiscard]] Eigen::Vector3d normal_to_box(const Eigen::Vector3d& c) const;
  [[nodiscard]] ReciprocalPlane box_plane(const Eigen::Vector3d& c, const Eigen::Vector3d& v,
                                          double horizon) const;

  const Prepared &first_, &second_;
  bool round_;
  Eigen::Matrix3d to_ = Eigen::Matrix3d::Identity(), from_ = Eigen::Matrix3d::Identity();  // the map
  Eigen::Matrix3d a_ = Eigen::Matrix3d::Identity(), b_ = Eigen::Matrix3d::Identity();      // shapes in it
};

}  // namespace vericone::swarm
