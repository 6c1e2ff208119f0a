// SPDX-License-Identifier: BSD-3-Clause
//
// The true collision cone of an ellipsoid or a convex polyhedron and an assembly of very many convex pieces
// (assembly.h): meshes, clouds, maps. With A the agent and P the pieces, the cone is the union over the
// pieces of the cones of P + (-A), neither convex nor star-shaped, with holes where there are windows.
//
// Every question descends the body's hierarchy of boxes; a box, and in the end a piece, is left out when a
// plane through the apex is proved to separate it, widened by the agent, from the directions asked about
// (docs/explanation/theory.md, 8). What doubles cannot prove of a single piece is decided by that piece's
// exact predicate (predicates.h, hull_oracle.h).
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/assembly.h>
#include <vericone/geometry/interval.h>
#include <vericone/geometry/pose.h>
#include <vericone/internal/cones/direction_cell.h>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

namespace vericone {

struct NearestPlane;

/// How much was looked at: the same on every machine.
struct Effort {
  std::uint64_t nodes = 0;   // boxes of the hierarchy compared with the question
  std::uint64_t pieces = 0;  // pieces compared with it
  std::uint64_t exact = 0;   // pieces that needed their exact predicate
};

/// The first contact of a moving agent with an assembly.
struct AssemblyContact {
  /// Seconds. Nothing is touched before `earliest`; at `latest` the agent touches or overlaps the body,
  /// proved both. Infinite where an agent or a piece that is round grazes closer than rounding tells.
  double earliest = 0, latest = 0;
  /// The best estimate, earliest <= time <= latest; nothing is known of it, nor of the point, beyond these:
  /// they are far apart where a piece is 1e8 times as large as the agent.
  double time = 0;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();   // m, of the body touched first, at that time
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // unit, from the agent towards the body
  std::uint32_t piece = 0;                           // its index in the order the pieces were given
};

/// The least distance between the agent and the body from now on.
struct AssemblyMiss {
  double least = 0, most = 0;  // metres; the true distance lies between, least = 0 where they meet
  Eigen::Vector3d point = Eigen::Vector3d::Zero();  // m, of the body, where they pass nearest
  /// Unit, from the agent towards the body where they are nearest or first touch; zero where they meet now.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double time = 0;  // when, seconds >= 0
  std::uint32_t piece = 0;
};

/// The largest angle from an axis on a half-plane at which the agent collides.
struct ExtremeDirection {
  /// Whether some direction of the half-plane is proved to collide.
  bool any = false;
  /// Radians from the axis: at `low` it is proved to collide, beyond `high` proved not to. Where `any` is
  /// false, low = 0 and nothing beyond `high` collides: high > 0 only where pieces graze within rounding.
  double low = 0, high = 0;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // unit, at `low`
  std::uint32_t piece = 0;                              // met at `low`
};

/// An agent and an assembly prepared for many velocities. Immutable apart from counting; may be used by
/// several threads at once. Holds a share of the assembly.
class AssemblyOracle : public DirectionClassifier {
 public:
  /// `pose`: of the obstacle; `agent_at`: where the agent's own origin stands, metres. Neither is rounded
  /// where the pose does not turn (but the sum of `agent_at` and an ellipsoid's centre against a cloud, see
  /// Pair); otherwise the agent is taken into the obstacle's frame, its numbers rounded, and answers hold for
  /// the rounded agent. Throws InputError naming "agent" for a body whose matrix cannot be inverted in
  /// doubles (axis ratio beyond 1e12).
  AssemblyOracle(const Ellipsoid& agent, const Assembly& obstacle, const Pose& pose = {},
                 const Eigen::Vector3d& agent_at = Eigen::Vector3d::Zero());
  AssemblyOracle(const HullBody& agent, const Assembly& obstacle, const Pose& pose = {},
                 const Eigen::Vector3d& agent_at = Eigen::Vector3d::Zero());
  AssemblyOracle(const Convex& agent, const Assembly& obstacle, const Pose& pose = {},
                 const Eigen::Vector3d& agent_at = Eigen::Vector3d::Zero());
  ~AssemblyOracle() override;
  AssemblyOracle(AssemblyOracle&&) noexcept;
  AssemblyOracle& operator=(AssemblyOracle&&) noexcept;

  [[nodiscard]] const Assembly& obstacle() const;

  /// Exact: disjoint, touching (no piece is overlapped, some are touched), overlapping: a piece is, or the
  /// agent has no interior and the pieces touched leave it no small shift to get apart
  /// (docs/explanation/predicates/composite.md, Seams).
  [[nodiscard]] Relation relation() const;
  /// Whether the relation is known. Where it is not, bodies with round parts are within rounding of touching,
  /// relation() says so, and verdict() is `undecided`.
  [[nodiscard]] bool decided() const;

  /// Exact. `w` = v_agent - v_obstacle. `in`: the agent will overlap a piece, or has no interior and enters
  /// where pieces join; `on`: it will only touch some; `out`. For bodies that are not disjoint every w != 0
  /// is `in`, see verdict(). No allocation unless an exact predicate is asked. Throws InputError naming
  /// "agent_velocity[i]" where w is not finite.
  [[nodiscard]] Membership membership(const Eigen::Vector3d& w, Effort* effort = nullptr) const;
  /// The same for the difference without rounding (without a rotated pose).
  [[nodiscard]] Membership membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                      Effort* effort = nullptr) const;
  /// Relation and membership in one.
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;
  /// The same of contacts within a horizon alone, as Pair::verdict().
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                const Horizon& horizon, Effort* effort = nullptr) const;

  /// Of an obstacle of one piece: where the two are nearest on a straight way of the agent, as it measures;
  /// rounded, nothing where they meet (cones/src/answers/stretch.h).
  [[nodiscard]] std::optional<NearestPlane> nearest_plane(const Eigen::Vector3d& start,
                                                          const Eigen::Vector3d& end) const;

  /// Nothing where membership(w) is `out`; time 0 where they touch or overlap now.
  [[nodiscard]] std::optional<AssemblyContact> first_contact(const Eigen::Vector3d& w,
                                                             Effort* effort = nullptr) const;

  /// For w = 0 the present distance. `tolerance`: most - least, relative to most plus the agent's size.
  [[nodiscard]] AssemblyMiss miss_distance(const Eigen::Vector3d& w, double tolerance = 1e-9,
                                           Effort* effort = nullptr) const;

  /// The half-plane of directions cos(t) axis + sin(t) side, 0 <= t <= pi; axis and side orthonormal.
  /// high - low <= tolerance (radians, 1e-13 to 1) except where pieces graze the half-plane within rounding,
  /// and at the corners of polyhedral agents and pieces below 1e-7. Of bodies that are not disjoint, all of
  /// whose directions collide, it says nothing: some low <= high in [0, pi]. Throws InputError naming
  /// "tolerance".
  [[nodiscard]] ExtremeDirection extreme(const Eigen::Vector3d& axis, const Eigen::Vector3d& side,
                                         double tolerance = 1e-4, Effort* effort = nullptr) const;

  /// The same on half-planes at the azimuths 2 pi i / half_planes about the axis, counter-clockwise from e1
  /// of AxisFrame(axis) (cone_geometry.h): faster together, as neighbours end at the same pieces.
  /// Throws InputError naming "half_planes" (from 1 to 1000000) or "tolerance".
  [[nodiscard]] std::vector<ExtremeDirection> extremes(const Eigen::Vector3d& axis, int half_planes = 64,
                                                       double tolerance = 1e-4,
                                                       Effort* effort = nullptr) const;

  [[nodiscard]] Frontier start() const override;
  Certified classify(const DirectionCell& cell, const Frontier& parent, Frontier& own) const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace vericone
