// SPDX-License-Identifier: BSD-3-Clause
//
// The convex hull of any placed body, by what spans it.
#pragma once

#include <vericone/geometry/body.h>
#include <vericone/geometry/ellipsoid.h>
#include <span>
#include <vector>

namespace vericone {

/// In the world: of ellipsoids (of those with dents, what they are cut from), and of points with a radius.
/// Throws InputError naming "body" for more than a million points.
struct ConvexHullOf {
  std::vector<Ellipsoid> parts;
  std::vector<Eigen::Vector3d> points;
  double radius = 0;
  bool convex = false;  // the body is no less

  explicit ConvexHullOf(const Placed& placed);

 private:
  void add(const CombinedEllipsoid& body, const Pose& pose);
  void add(const std::vector<CombinedEllipsoid>& pieces, const Pose& pose);
  void add(const HullBody& hull, const Pose& pose);
  void add(const Assembly& body, const Pose& pose);
  void add(const Convex& body, const Pose& pose);
  void add_points(std::span<const Eigen::Vector3d> more, const Pose& pose);
};

}  // namespace vericone
