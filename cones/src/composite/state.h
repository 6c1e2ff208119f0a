// SPDX-License-Identifier: BSD-3-Clause
//
// What a pair of composite bodies keeps, and the boxes that all its searches compare.
#pragma once

#include <vericone/internal/cones/composite/composite_pair.h>
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
  assembly::Frame zero;   // of the apex less the place: where differences of boxes meet directions
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
  bool within_range() const { return std::isfinite(zero.beyond_range()); }
  /// To be called when the place and the agent are known.
  void check_range();

  Box agent_bounds() const { return agent ? agent->bounds() : cells->box(composite::Cell{}); }
  /// A frame about a convex body of the agent, ready for any piece of the obstacle.
  assembly::Frame frame(const HullBody& body) const {
    assembly::Frame made(body, place);
    made.check_range(largest);
    return made;
  }
  assembly::Frame frame(const Convex& body) const {
    assembly::Frame made(body, place);
    made.check_range(largest);
    return made;
  }
  /// Whether the difference of two boxes, less the place, may hold 0. Boxes that are not numbers may.
  bool holds_apex(const Box& difference) const {
    const Eigen::Vector3d &apex = zero.origin(), low = difference.low - apex, high = difference.high - apex;
    return !((low.array() > apex_slack_).any() || (high.array() < -apex_slack_).any());
  }

 private:
  double apex_slack_ = 0;  // metres; 0 without a place: signs of differences are exact
};

namespace composite {

using State = CompositePair::State;

/// All y - x with x in `agent` and y in `obstacle`, each in its own frame; rounded, the signs exactly.
inline Box difference(const Box& agent, const Box& obstacle) {
  return {obstacle.low - agent.high, obstacle.high - agent.low};
}
inline double size(const Box& box) { return (box.high - box.low).sum(); }

/// The normal with which to begin the search for a plane between a core and a ray, or the apex.
inline Eigen::Vector3d first_normal(const assembly::Core& core, const assembly::Directions& directions) {
  Eigen::Vector3d away = core.center();
  if (directions.count > 0) away = assembly::RayResidual{directions.middle}(away);
  if (!away.isZero(0)) return away;
  return core.center().isZero(0) ? Eigen::Vector3d(Eigen::Vector3d::UnitX()) : core.center();
}

/// How the two lie; nothing where it is not decided.
std::optional<Relation> delimited_relation(const State& state);
std::optional<Relation> pieces_relation(const State& state);

/// v_a - v_b, or half of it where that is beyond the range of doubles. Directions have room for its rounding.
inline Eigen::Vector3d relative_velocity(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) {
  const Eigen::Vector3d w = v_a - v_b;
  return w.allFinite() ? w : Eigen::Vector3d(0.5 * v_a - 0.5 * v_b);
}

/// Velocities in the obstacle's frame, not equal, where the relation is disjoint or not known.
std::optional<Membership> delimited_membership(const State& state, const Eigen::Vector3d& v_a,
                                               const Eigen::Vector3d& v_b);
std::optional<Membership> pieces_membership(const State& state, const Eigen::Vector3d& v_a,
                                            const Eigen::Vector3d& v_b, Effort& effort);

/// On a stretch in the obstacle's frame, however they lie now.
std::optional<Membership> delimited_within(const State& state, const Stretch& stretch);
std::optional<Membership> pieces_within(const State& state, const Stretch& stretch);

}  // namespace composite
}  // namespace vericone
