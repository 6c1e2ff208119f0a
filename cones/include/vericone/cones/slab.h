// SPDX-License-Identifier: BSD-3-Clause
//
// A body and what lies behind a plane or between two: the ground, walls, layers of air.
#pragma once

#include <vericone/cones/pair.h>
#include <vericone/cones/penetration.h>
#include <vericone/geometry/body.h>
#include <vericone/geometry/hull_body.h>
#include <Eigen/Core>
#include <limits>
#include <memory>
#include <optional>

namespace vericone {

/// { x : low <= normal.x <= high }, metres in the world along a normal of length 1, else times its length. A
/// half-space where low is -infinity or high infinity. It has no bounds, no middle and no ellipsoid around
/// it, so it is no Body; clipped() gives one (docs/explanation/shapes.md).
struct Slab {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double low = -std::numeric_limits<double>::infinity(), high = 0;
};

/// The part of a slab that counts, a box, for whatever takes a body: what is within `extent` (m) of the
/// point of its plane below `about`, along the plane, of a half-space as deep. All of that part is in it: its
/// corners are moved outwards by roundings, none where the normal is an axis of length 1. So while all of an
/// agent stays within `extent` of that point, it meets the part exactly when it meets the slab (of normals
/// that are no axes up to that rounding, never later); of a half-space, an agent that starts in front of it.
/// Throws InputError as SlabPair does of a slab, and naming "extent" (not positive and finite, or below the
/// digits of the plane's place) or "about".
[[nodiscard]] HullBody clipped(const Slab& slab, const Eigen::Vector3d& about, double extent);

/// A body against a slab: what Pair answers, in closed form, and all of it exact. The directions of w that
/// lead to contact are an open half-space, { normal.w < 0 } of an agent above: moving along the plane never
/// meets it, so no verdict is `on`. A body of parts on both sides meets it either way.
///
/// Positions are not rounded, and products with velocities and times neither; a rotation rounds the body's
/// own numbers once, about its own origin. Immutable; copies share.
class SlabPair {
 public:
  /// Throws InputError naming "agent" for a body that hyperboloids delimit, "pose.position[i]" or
  /// "pose.rotation", "slab.normal" (not finite, or 0), "slab.low" or "slab.high" (not a number, low above
  /// high, or both infinite). Linear in the parts and points of the body; 1 us for a cylinder.
  SlabPair(const Placed& agent, const Slab& obstacle);

  [[nodiscard]] Relation relation() const;
  /// As Pair::verdict(). Throws InputError naming a velocity that is not finite.
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;
  /// From now until a time (s): `on` where they only touch at the very end. Throws InputError naming
  /// "horizon" for a time that is negative or none.
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b, double until) const;
  /// Nothing where verdict() is `out`. The bracket is as wide as rounding makes it.
  [[nodiscard]] std::optional<Contact> contact(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;
  /// The depth is that of penetration() where they overlap, else 0: a collision is avoided by any turn far
  /// enough, and by no displacement.
  [[nodiscard]] Miss miss(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;
  /// The shortest displacement of the agent out of the slab; nothing where they do not overlap.
  [[nodiscard]] std::optional<Penetration> penetration() const;
  /// Velocities with which an agent that is all on one side does not reach it; nothing of others.
  [[nodiscard]] std::optional<SafeHalfSpace> safe_half_space() const;

 private:
  struct Data;
  std::shared_ptr<const Data> data_;
};

}  // namespace vericone
