// SPDX-License-Identifier: BSD-3-Clause
//
// Signed distances from many points to one body.
#pragma once

#include <vericone/geometry/combined.h>
#include <optional>
#include <vector>

#include "distance/quadric_foot.h"

namespace vericone::fitting {

/// What measure.h's signed_distance computes, prepared once a body: about a microsecond a point inside or
/// where the nearest point is on one surface, some ten for points whose nearest one is on a rim.
class BodyDistance {
 public:
  /// Finding the rims takes some ten microseconds.
  enum class Rims { at_once, when_needed };

  explicit BodyDistance(const CombinedEllipsoid& body, Rims rims = Rims::at_once);

  double operator()(const Eigen::Vector3d& point) const;

  /// The nearest point of the body's boundary along the ray from the centre through `point`.
  Eigen::Vector3d on_boundary(const Eigen::Vector3d& point) const;

 private:
  /// A surface's form where the ellipsoid is the unit ball: the region v^T matrix v <= level.
  struct Form {
    Eigen::Matrix3d matrix;
    double level;
  };

  /// Part of a rim on which the same surfaces bound the body, short; where a third one cuts off the rim, of
  /// that one instead.
  struct Arc {
    double from = 0, to = 0;  // angles
    Eigen::Vector3d start, end, start_tangent, end_tangent;
  };

  /// Where two surfaces cross, as directions from the centre: v(a) = pole + cos(a) first + sin(a) second and
  /// -v(a), in coordinates in which the ellipsoid is the unit ball.
  struct Rim {
    Eigen::Vector3d pole, first, second;
    std::size_t one = 0, other = 0;
    std::vector<Arc> arcs;
  };

  void add_rims();
  void add_rim(std::size_t one, std::size_t other);
  void add_arcs(Rim& rim, double from, double to) const;
  Eigen::Vector3d rim_direction(const Rim& rim, double angle) const;
  Eigen::Vector3d rim_point(const Rim& rim, double angle) const;
  /// Angles at which a third surface begins or ends to cut off the rim, in [0, 2 pi].
  std::vector<double> rim_corners(const Rim& rim) const;
  Eigen::Vector3d clamped(const Eigen::Vector3d& y) const;
  double nearest_on_rim(const Rim& rim, const Eigen::Vector3d& x, double best) const;
  double outside(const Eigen::Vector3d& x, double bound) const;

  Eigen::Vector3d center_;
  double unit_;  // metres; everything below is in this unit, about the centre
  double reach_;
  Eigen::Matrix3d factor_, inverse_;
  std::vector<CenteredQuadric> surfaces_;
  std::vector<Form> forms_;
  bool has_rims_ = false;
  std::vector<Rim> rims_;
};

}  // namespace vericone::fitting
