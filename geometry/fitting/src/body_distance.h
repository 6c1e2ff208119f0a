// SPDX-License-Identifier: BSD-3-Clause
//
// Signed distances from many points to one body.
#pragma once

#include <vericone/geometry/combined.h>
#include <optional>
#include <vector>

#include "quadric_foot.h"

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

  /// Where two surfaces cross, as directions from the centre: v(a) = pole + cos(a) first + sin(a) second and
  /// -v(a), in coordinates in which the ellipsoid is the unit ball. Samples begin and end at the same angle;
  /// neighbours are near each other, and where a third surface begins or ends to cut there is one.
  struct Rim {
    Eigen::Vector3d pole, first, second;
    std::size_t one = 0, other = 0;
    std::vector<double> angles;
    std::vector<Eigen::Vector3d> points;
  };

  void add_rims();
  void add_rim(std::size_t one, std::size_t other);
  Eigen::Vector3d rim_direction(const Rim& rim, double angle) const;
  Eigen::Vector3d rim_point(const Rim& rim, double angle) const;
  std::size_t rim_form(const Rim& rim, double angle) const;
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
