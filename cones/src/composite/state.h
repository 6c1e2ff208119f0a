// SPDX-License-Identifier: BSD-3-Clause
//
// What a pair of composite bodies keeps, and the boxes that all its searches compare.
#pragma once

#include <vericone/cones/composite/composite_pair.h>
#include <optional>
#include <vector>

#include "assembly/core.h"
#include "assembly/frame.h"
#include "assembly/gap.h"
#include "assembly/scene.h"
#include "composite/cells.h"

namespace vericone {

struct CompositePair::State {
  State(const Assembly& body, const Pose& place);

  Assembly obstacle;
  Pose pose;              // of the obstacle
  bool upright = true;    // the pose is not turned
  assembly::Place place;  // of the agent, beside the obstacle
  assembly::Frame zero;   // of the origin: where differences of boxes are compared with directions
  std::optional<Relation> relation;

  // One of the two, along the obstacle's axes.
  std::optional<Assembly> agent;
  std::optional<composite::CellTree> cells;

  std::vector<assembly::Frame> frames;           // of the agent's pieces by slot, where they are hulls
  std::optional<AssemblyOracle> around, within;  // ellipsoids that hold the cells' body, or that it holds
  double largest = 1;                            // of all coordinates, at most

  Eigen::Vector3d to_obstacle(const Eigen::Vector3d& direction) const {
    return upright ? direction : Eigen::Vector3d(pose.rotation.transpose() * direction);
  }
  Eigen::Vector3d to_world(const Eigen::Vector3d& direction) const {
    return upright ? direction : Eigen::Vector3d(pose.rotation * direction);
  }
  Eigen::Vector3d point_to_world(const Eigen::Vector3d& x) const {
    return upright ? Eigen::Vector3d(x + pose.position) : pose.to_world(x);
  }

  /// Whether doubles can prove anything: squares of lengths are doubles.
  bool within_range() const { return zero.beyond_range() == 0; }
  /// To be called when the place and the agent are known.
  void check_range();

  Box agent_bounds() const { return agent ? agent->bounds() : cells->box(composite::Cell{}); }
  /// A frame about a convex body of the agent, ready for any piece of the obstacle.
  assembly::Frame frame(const HullBody& body) const {
    assembly::Frame made(body, place);
    made.check_range(largest);
    return made;
  }
  /// All y - x with x in a box `own` of the agent and y in a box `other` of the obstacle; rounded outwards,
  /// or to nearest, the signs exactly, where nothing is added to them.
  Box difference(const Box& own, const Box& other) const {
    Box both{other.low - own.high, other.high - own.low};
    if (!beside_) return both;
    const Eigen::Vector3d size = own.low.cwiseAbs().cwiseMax(own.high.cwiseAbs()) +
                                 other.low.cwiseAbs().cwiseMax(other.high.cwiseAbs()) +
                                 place.agent.cwiseAbs() + place.obstacle.cwiseAbs();
    const Eigen::Vector3d shift = place.obstacle - place.agent, slack = 4 * assembly::kUlp * size;
    both.low += shift - slack;
    both.high += shift + slack;
    return both;
  }

 private:
  bool beside_ = false;  // the place is not 0
};

namespace composite {

using State = CompositePair::State;

/// Boxes that are not numbers may hold it.
inline bool holds_origin(const Box& box) {
  return !((box.low.array() > 0).any() || (box.high.array() < 0).any());
}
inline double size(const Box& box) { return (box.high - box.low).sum(); }

/// The normal with which to begin the search for a plane between a core and a ray, or the apex.
inline Eigen::Vector3d first_normal(const assembly::Core& core, const assembly::Directions& directions) {
  Eigen::Vector3d away = core.center();
  if (directions.count > 0) away = assembly::RayResidual{directions.middle}(away);
  if (!away.isZero(0)) return away;
  return core.center().isZero(0) ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : core.center();
}

/// How far a core stays from the apex along n and from all that is asked about, at least; not positive where
/// the plane tells nothing. `room`: by how much the agent's part is farther away than the core knows.
inline double beyond_plane(const assembly::Core& core, const assembly::Directions& directions,
                           const Eigen::Vector3d& n, double room) {
  Eigen::Vector3d on_piece;
  const double reach = core.reach(), slack = 64 * assembly::kUlp * (reach + room);
  return n.dot(core.support(n, on_piece)) + room -
         (core.error() + slack + directions.slant(n) * reach + core.outer_rounding());
}

/// How the two lie (delimited bodies: nothing where it is not decided).
std::optional<Relation> delimited_relation(const State& state);
Relation pieces_relation(const State& state);

/// v_a - v_b, or half of it where that is beyond the range of doubles. Directions have room for its rounding.
inline Eigen::Vector3d relative_velocity(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) {
  const Eigen::Vector3d w = v_a - v_b;
  return w.allFinite() ? w : Eigen::Vector3d(0.5 * v_a - 0.5 * v_b);
}

/// Velocities in the obstacle's frame, not equal, where the relation is disjoint or not known.
std::optional<Membership> delimited_membership(const State& state, const Eigen::Vector3d& v_a,
                                               const Eigen::Vector3d& v_b);
Membership pieces_membership(const State& state, const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b);

}  // namespace composite
}  // namespace vericone
