// SPDX-License-Identifier: BSD-3-Clause
//
// The cone of any pair: all relative velocities w = v_agent - v_obstacle that bring them together, between
// one that is surely too small and one that is surely too large.
#pragma once

#include <vericone/cones/cone_geometry.h>
#include <vericone/cones/map/cone_map.h>
#include <vericone/geometry/interval.h>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace vericone {

class Pair;

struct ConeOptions {
  /// Inner and outer cone are refined until their solid angles differ by this part of the outer one, or until
  /// that would take seconds; the result says what was reached. Between 1e-9 and 1.
  double tolerance = 0.01;
  /// Of cones that are drawn as a map of the sphere (assemblies, unions): radians, as in ConeMapOptions.
  double resolution = 0.01;
  int threads = 1;  // of a map; 0: as many as the machine has
  /// Told the share done of a map, 0 to 1; returns false to stop. The cone is then not complete.
  std::function<bool(double)> progress = {};
};

/// A closed polygon of unit directions, its cone to the left: counter-clockwise around it, clockwise around a
/// hole.
using DirectionLoop = std::vector<Eigen::Vector3d>;

/// inner <= true cone <= outer, both proved. Only the direction of a velocity counts.
struct Cone {
  /// Nothing where it is not decided. There are loops for disjoint bodies only: others meet at every
  /// velocity.
  std::optional<Relation> relation;
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  // unit, from the agent towards the obstacle

  std::vector<DirectionLoop> inner, outer;  // unit vectors
  Interval solid_angle;                     // steradian; contains the true one
  /// Area of the section by the plane at distance 1 along the axis; contains the true one. Nothing where the
  /// outer cone reaches 90 degrees from the axis, and of maps.
  std::optional<Interval> section;

  /// How: "silhouette samples", "certified search", "half-planes of a convex cone", "cone map".
  const char* method = "";
  bool complete = true;  // false: stopped by `progress`

  /// Without the pair. `in`: w is in the inner cone. `out`: it is outside the outer one, or zero. `undecided`
  /// in between, within 1e-12 rad of either, and where the relation is. Of bodies that are not apart: `in`
  /// for w != 0. Cost: linear in the corners (1 us for 100), of a map in its cells. Throws InputError naming
  /// "w" where it is not finite.
  [[nodiscard]] Certified contains(const Eigen::Vector3d& w) const;

  /// What `contains` asks: the polygons, star-shaped about the axis (inner and outer cone), or the map.
  PolyhedralCone star_inner, star_outer;
  std::shared_ptr<const ConeMap> map;
};

/// The directions in which an agent meets any of several obstacles, as a map. All pairs have the same agent;
/// obstacles all move by the same velocity.
[[nodiscard]] ConeMap cone_map(std::span<const Pair> pairs, const ConeMapOptions& options = {});
/// Of one obstacle.
[[nodiscard]] ConeMap cone_map(const Pair& pair, const ConeMapOptions& options = {});

}  // namespace vericone
