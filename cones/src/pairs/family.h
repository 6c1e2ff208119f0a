// SPDX-License-Identifier: BSD-3-Clause
//
// What each family of pairs does behind Pair, and who serves which kinds.
#pragma once

#include <vericone/cones/pair.h>
#include <memory>
#include <vector>

#include "answers/stretch.h"
#include "pairs/sectors.h"

namespace vericone::pairs {

class Family {
 public:
  virtual ~Family() = default;

  virtual Guarantee guarantee() const = 0;
  virtual std::optional<Relation> relation() const = 0;
  virtual Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const = 0;
  virtual Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                          const Horizon& horizon) const = 0;
  /// At most the least n.x over the obstacle's points less the agent's, metres, proved; NaN where a family
  /// knows no better than the supports of both.
  virtual double gap(const Eigen::Vector3d&) const { return std::numeric_limits<double>::quiet_NaN(); }
  /// Where two convex bodies are nearest while the agent goes straight from one displacement to another,
  /// metres; nothing where they meet. A search: nothing is proved of it.
  virtual std::optional<NearestPlane> nearest_plane(const Eigen::Vector3d& start,
                                                    const Eigen::Vector3d& end) const {
    static_cast<void>(start), static_cast<void>(end);
    return std::nullopt;
  }
  /// Of pairs that have it in closed form: the normal of a plane that touches the cone of a horizon beside w,
  /// zero where w is in that, to rounding. Nothing is proved of it. Nothing of other pairs.
  virtual std::optional<Eigen::Vector3d> touching_plane(const Eigen::Vector3d& w,
                                                        const Horizon& horizon) const {
    static_cast<void>(w), static_cast<void>(horizon);
    return std::nullopt;
  }
  virtual std::optional<Rung> rung(const Eigen::Vector3d&, const Eigen::Vector3d&) const {
    return std::nullopt;
  }
  /// Of a pair whose verdict is not `out`.
  virtual Contact contact(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const = 0;
  /// Without the depth, which Pair adds where a family leaves it NaN.
  virtual Miss miss(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const = 0;
  virtual std::shared_ptr<const DirectionClassifier> directions() const = 0;
  virtual Cone cone(const ConeOptions& options) const = 0;
  /// From the middle of the agent to that of the obstacle.
  virtual Eigen::Vector3d axis() const = 0;
  /// On the plane of a line of sight and e, a unit vector perpendicular to it. Of bodies that are apart.
  virtual std::optional<PlaneSector> sector(const SightLine& line, const Eigen::Vector3d& e) const {
    return sector_by_arcs(*this, line, e);
  }
  /// Where they are nearest on the way, for a w that just misses; nothing where it is not known well enough.
  virtual std::optional<Passing> passing(const Eigen::Vector3d& w) const = 0;

  /// The prepared pair of two ellipsoids; none of others.
  virtual const ConeOracle* ellipsoids() const { return nullptr; }
};

using FamilyPointer = std::shared_ptr<const Family>;

/// A body that is turned as in the world: x_W = at + x, a sum that is not rounded on the way to a verdict.
template <typename Body>
struct Standing {
  Body body;
  Eigen::Vector3d at;

  Body in_world() const { return vericone::in_world(body, {at, Eigen::Matrix3d::Identity()}); }  // rounded
};

FamilyPointer ellipsoid_family(const Ellipsoid& agent, const Ellipsoid& obstacle);
FamilyPointer combined_family(const CombinedEllipsoid& agent, const CombinedEllipsoid& obstacle,
                              double tolerance);
/// At least one is a hull.
FamilyPointer hull_family(const Standing<Ellipsoid>& agent, const Standing<HullBody>& obstacle);
FamilyPointer hull_family(const Standing<HullBody>& agent, const Standing<HullBody>& obstacle);
FamilyPointer assembly_family(const Standing<Ellipsoid>& agent, const Assembly& obstacle, const Pose& pose);
FamilyPointer assembly_family(const Standing<HullBody>& agent, const Assembly& obstacle, const Pose& pose);
FamilyPointer assembly_family(const Standing<Convex>& agent, const Assembly& obstacle, const Pose& pose);
/// Of bodies that are neither two ellipsoids nor hulls.
FamilyPointer convex_family(const Standing<Convex>& agent, const Standing<Convex>& obstacle);
FamilyPointer composite_family(const Standing<CombinedEllipsoid>& agent, const Assembly& obstacle,
                               const Pose& pose, double tolerance);
FamilyPointer composite_family(const Assembly& agent, const Pose& agent_pose, const Assembly& obstacle,
                               const Pose& pose);

/// The pair of bodies about a and b, for bodies about `world_a` and `world_b` that are as far apart: what it
/// says of places is said in the world.
FamilyPointer moved(FamilyPointer pair, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                    const Eigen::Vector3d& world_a, const Eigen::Vector3d& world_b);
/// Agent and obstacle exchanged.
FamilyPointer mirrored(FamilyPointer exchanged);
/// The union of the pairs: of a body of several parts.
FamilyPointer any_of(std::vector<FamilyPointer> all);

/// Who serves two bodies: the one place that asks for their kinds.
FamilyPointer family_of(const Placed& agent, const Placed& obstacle, const PairOptions& options);

/// v_a - v_b; throws InputError naming the velocity that is not finite, or whose difference is not.
Eigen::Vector3d relative_velocity(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b);

/// A contact of an agent that moves by w, seen where the obstacle moves by v_b.
inline Eigen::Vector3d in_world_at(const Eigen::Vector3d& point, double time, const Eigen::Vector3d& v_b) {
  return point + time * v_b;
}

}  // namespace vericone::pairs
