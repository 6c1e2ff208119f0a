// SPDX-License-Identifier: BSD-3-Clause
//
// A body and the rim of an opening, both in the opening's own frame: the rim lies in the plane z = 0.
#pragma once

#include <vericone/cones/opening/opening.h>
#include <vericone/geometry/world_body.h>
#include <limits>
#include <optional>

#include "proof/convex.h"

namespace vericone::simulation {

/// The convex hull of two convex bodies: all straight ways from one to the other.
struct Chords {
  const Convex &from, &to;
  [[nodiscard]] double support(const Eigen::Vector3d& n) const;
  [[nodiscard]] Eigen::Vector3d support_point(const Eigen::Vector3d& n) const;
  [[nodiscard]] Eigen::Vector3d middle() const { return 0.5 * (from.center + to.center); }
};

struct RimDistance {
  double least = 0;                                       // a lower bound, proved but for rounding, metres
  double most = std::numeric_limits<double>::infinity();  // about an upper one
  Eigen::Vector3d nearest = Eigen::Vector3d::Zero();      // about, on the rim
};

/// How far the rim is from the body: branch and bound over its parts, each held off by a plane. Ends as soon
/// as `least` exceeds `enough`, `most` falls to `hopeless`, or both are within 1 %. A least of 0 or less:
/// they meet, or are nearer than rounding tells.
[[nodiscard]] RimDistance rim_distance(const Chords& body, const Opening& opening, double enough,
                                       double hopeless);

/// A point that the body has in common with the rim or, where `wall`, with the plane outside of the opening,
/// by more than `slack` metres: nothing where there is none or none was found.
[[nodiscard]] std::optional<Eigen::Vector2d> common_point(const WorldBody& body, const Opening& opening,
                                                          bool wall, double slack);

}  // namespace vericone::simulation
