// SPDX-License-Identifier: BSD-3-Clause
//
// Bodies that change their shape: what they are at a time, how fast they change, and what holds all that they
// are during an interval.
#pragma once

#include <vericone/geometry/world_body.h>
#include <optional>
#include <utility>

namespace vericone::simulation {

/// k(t) = offset + amplitude sin(rate t + phase), or its absolute value; t in seconds of the scenario.
struct Oscillation {
  double offset = 0, amplitude = 0;
  double rate = 0, phase = 0;  // rad/s, rad
  bool absolute = false;

  [[nodiscard]] double at(double t) const;
  [[nodiscard]] double rate_at(double t) const;  // 1/s; at a corner of |...| that of the side after t
  /// Bounds of k over [from, to], widened by a few roundings.
  struct Range {
    double low, high;  // in the unit of what oscillates
  };
  [[nodiscard]] Range range(double from, double to) const;
};

/// About the origin of the body's own frame, its x axis ahead. Hulls and placed bodies: the origin is the
/// reference point.
struct RigidShape {
  WorldBody shape;
};

/// The source's conic (5.5) with the dents ahead and behind, k(t) in [0, 1].
struct DentedConic {
  double a_c = 1, b_c = 1;
  Oscillation k;
};

/// Its counterpart in space, (x/a)^2 + |(y/b)^2 + (z/c)^2 - k| <= 1: the ellipsoid (a, b, c) sqrt(1 + k)
/// delimited by the two-sheeted hyperboloid (a, b, c) sqrt(1 - k). k = 0: the ellipsoid (a, b, c).
struct DentedQuadric {
  Eigen::Vector3d semi_axes = Eigen::Vector3d::Ones();  // m
  Oscillation k;
};

/// One of these.
class ShapeInTime {
 public:
  ShapeInTime(RigidShape rigid = {}) : rigid_(std::move(rigid.shape)) {}  // NOLINT: each of these is one
  ShapeInTime(const DentedConic& conic)                                   // NOLINT
      : semi_axes_(conic.a_c, conic.b_c, 0), flat_(true), k_(conic.k) {}
  ShapeInTime(const DentedQuadric& quadric) : semi_axes_(quadric.semi_axes), k_(quadric.k) {}  // NOLINT

  /// The body where it stays as it is; null where its dents change.
  [[nodiscard]] const WorldBody* rigid() const { return rigid_ ? &*rigid_ : nullptr; }
  /// Of one with dents: how deep they are, otherwise null.
  [[nodiscard]] const Oscillation* k() const { return rigid_ ? nullptr : &k_; }
  /// Metres. Of one with dents, for k = 0: a_c, b_c and 0 in the plane.
  [[nodiscard]] const Eigen::Vector3d& semi_axes() const { return semi_axes_; }

 private:
  friend bool planar(const ShapeInTime& shape);

  std::optional<WorldBody> rigid_;
  Eigen::Vector3d semi_axes_ = Eigen::Vector3d::Zero();
  bool flat_ = false;
  Oscillation k_;
};

/// Throws InputError: "center", "a_c", "b_c", "semi_axes[i]" or "k" (values outside [0, 1] at some time).
void check(const ShapeInTime& shape);

[[nodiscard]] bool planar(const ShapeInTime& shape);

/// The largest distance (m) of a point of the body from its reference point, at any time; rounded up.
[[nodiscard]] double reach(const ShapeInTime& shape);

}  // namespace vericone::simulation
