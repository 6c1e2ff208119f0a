// SPDX-License-Identifier: BSD-3-Clause
//
// Any two bodies: whether they will meet, when and where, and by how much they miss. The front door; the
// families behind it (ellipsoids/, combined/, hulls/, round/, assembly/, composite/) are for those who want
// their rungs.
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/cones/penetration.h>
#include <vericone/cones/plane_sector.h>
#include <vericone/geometry/body.h>
#include <vericone/geometry/world_body.h>
#include <vericone/internal/cones/direction_cell.h>
#include <limits>
#include <memory>
#include <optional>
#include <string>

namespace vericone {

struct Certificate;
struct Cone;
struct ConeOptions;
struct RelativeErrors;
namespace pairs {
class Family;
}

struct PairOptions {
  /// Of pairs that are certified and not exact: features below this part of a body's size may stay undecided.
  /// Left out: 1e-6 for two combined quadrics, 1e-3 for others.
  std::optional<double> tolerance;
};

/// What can be relied on.
struct Guarantee {
  /// True: every verdict is right and none is `undecided`. False: verdicts are right or `undecided`.
  bool exact = true;
  double tolerance = 0;  // relative; where not exact: see PairOptions
  const char* family =
      "";  // who answers: "ellipsoids", "combined", "hulls", "convex", "assembly", "composite", "union"
};

/// The first contact.
struct Contact {
  /// Seconds from now. Nothing is touched before `earliest`; where verdict() is not `undecided` they have
  /// touched by `latest` (bodies without thickness may be past each other then). Both are proved.
  /// `latest` is infinite where no double is late enough, or none is known.
  double earliest = 0, latest = std::numeric_limits<double>::infinity();
  double time = 0;  // s, the best estimate; NaN where there is none
  /// Rounded, at that time, in the world: the point of the obstacle, and the unit normal from the agent
  /// towards it. Nothing where the pair does not say (two combined quadrics; bodies that overlap now).
  std::optional<Eigen::Vector3d> point, normal;
};

/// How near they come from now on.
struct Miss {
  /// Metres; the least distance lies between, proved. Both 0 where verdict() is not `out` or `undecided`.
  double least = 0, most = 0;
  /// Where they meet: how far along -normal the agent must be shifted, at least, to avoid it (metres; of
  /// bodies that are not ellipsoids: of ellipsoids that contain them, so it is enough and may be more than is
  /// needed). 0 where they miss. NaN where doubles do not tell.
  double depth = 0;
  /// Unit, from the agent towards the obstacle where they are nearest: the gradient of the distance (and of
  /// -depth) to the obstacle's position. Zero where there is none.
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double time = 0;  // seconds >= 0, when they are nearest
  /// Metres, the best estimate: the distance where they miss (not outside the bracket), -depth where they
  /// meet.
  double distance = 0;

  /// Its derivative to w = v_agent - v_obstacle, s.
  [[nodiscard]] Eigen::Vector3d gradient_velocity() const { return -time * normal; }
};

/// Relative velocities w = v_agent - v_obstacle that are proved safe: those with t normal.w < room at both
/// ends t of a horizon lead to no contact within it. Two square roots check it.
struct SafeHalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();  // from the agent towards the obstacle; any length
  double room = 0;  // m: normal.x >= room for x any point of the obstacle less one of the agent

  /// The most of normal.w that is safe, m/s.
  [[nodiscard]] double most(const Horizon& horizon) const {
    if (room > 0) return room / horizon.until;
    return horizon.from > 0 ? room / horizon.from : -std::numeric_limits<double>::infinity();
  }
};

/// Two placed bodies of any kinds, prepared for many velocities. Immutable; a copy shares what was prepared;
/// may be used by several threads at once. Velocities are m/s in the world; w = v_agent - v_obstacle, and
/// nothing turns.
///
/// Positions are not rounded on the way to a verdict, a relation or a bound: those of bodies that are not
/// turned hold for the numbers as given. (Where an ellipsoid or a combined quadric has a centre and a
/// position, the difference of the centres counts to 106 bits.) A rotation rounds a body's own numbers once,
/// about its own origin, and answers hold for that body. A turned assembly stays as it is, unless it holds
/// one hull alone, and the other body, its position too, is rounded into its frame; of two assemblies that
/// with fewer pieces, whichever is the agent.
///
/// Laws, for every pair of kinds (tests/cones/pairs/pair_test.cpp):
///   (1) Pair(a, b).verdict(v, u) == Pair(b, a).verdict(u, v)
///   (2) verdicts depend on v_a - v_b and its direction only
///   (3) contact() is there iff verdict is not `out`; miss().most == 0 iff they surely meet
class Pair {
 public:
  /// Throws InputError naming "agent", "obstacle", "pose" or "tolerance". Cost: docs/reference/pairs.md.
  Pair(Placed agent, Placed obstacle, PairOptions options = {});

  /// Bodies in the plane z = 0, raised so far that all answers are those of the planar bodies (raised() in
  /// body.h).
  Pair(const CombinedEllipse& agent, const CombinedEllipse& obstacle, PairOptions options = {});

  [[nodiscard]] const Placed& agent() const { return *agent_; }
  [[nodiscard]] const Placed& obstacle() const { return *obstacle_; }
  [[nodiscard]] Guarantee guarantee() const;

  /// Now. Nothing where it could not be decided.
  [[nodiscard]] std::optional<Relation> relation() const;

  /// The whole answer. Bodies that overlap or touch now are that, whatever their velocities. Throws
  /// InputError naming "agent_velocity[i]" or "obstacle_velocity[i]" where they are not finite.
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const {
    return ellipsoids_ ? ellipsoids_->verdict(v_a, v_b) : other_verdict(v_a, v_b);
  }

  /// Whether they meet within the horizon. From now on: as verdict(), but `in` where they overlap by its end,
  /// and `on` where they only touch by then, at the very end too; else `out`. From a later time: `in` where
  /// they overlap at some time of it, `on` where they only touch, however they lie now. v_a - v_b and its
  /// products with the times are not rounded (of a turned assembly, the difference is). Of two combined
  /// quadrics of which one is delimited, from a later time, only the first contact is known. Throws
  /// InputError naming "horizon", or a velocity. Cost: that of verdict() for most velocities, else
  /// docs/reference/pairs.md.
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                const Horizon& horizon) const;

  /// At most the least n.x over the obstacle's points less the agent's, metres, proved: positive where the
  /// plane with that normal separates them. To a few roundings of the least, of bodies with delimiters or
  /// pieces of their ellipsoids, or hull. No allocation. Cost: two ellipsoids 30 ns.
  [[nodiscard]] double gap(const Eigen::Vector3d& n) const;

  /// The normal, from the agent towards the obstacle, along which they stay farthest apart while the agent,
  /// seen from the obstacle, goes straight from one displacement to another (metres), as a search in doubles
  /// finds it; largest entry 1. Nothing where they meet, or are not two convex bodies.
  [[nodiscard]] std::optional<Eigen::Vector3d> normal_along(const Eigen::Vector3d& start,
                                                            const Eigen::Vector3d& end) const;

  /// A half-space of velocities, with this one in it, that are safe within a horizon, as far towards the cone
  /// as one plane goes. Nothing where none was found: they meet within it, or are not two convex bodies.
  /// `warm`: the normal of a moment before, or of a velocity nearby, tried first. Throws InputError naming
  /// "horizon" or a velocity. Cost: two ellipsoids 0.5 us, with a warm normal that still holds 40 ns.
  [[nodiscard]] std::optional<SafeHalfSpace> safe_half_space(
      const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b, const Horizon& horizon,
      const std::optional<Eigen::Vector3d>& warm = {}) const;

  /// The rung of the ladder that decided verdict(); nothing of certified pairs. For measurements.
  [[nodiscard]] std::optional<Rung> rung(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;

  /// With the past told from never; nothing where a verdict is undecided. Of bodies that are not apart now:
  /// `ahead` for every w != 0.
  [[nodiscard]] std::optional<Passage> passage(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;

  /// Nothing where verdict() is `out`. Times and lengths, here and in miss(), are those of v_a - v_b rounded
  /// to doubles; whether there is a contact is decided without rounding.
  [[nodiscard]] std::optional<Contact> contact(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;

  [[nodiscard]] Miss miss(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;

  /// Metres between the bodies as they stand, the best estimate: miss() without velocities, which has bounds.
  /// 0 where they touch or overlap; how deep they do penetration() says, along a velocity Miss::depth.
  [[nodiscard]] double distance() const {
    return miss(Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()).distance;
  }

  /// How deep they overlap as they stand: penetration() of penetration.h, of convex bodies without
  /// delimiters. Nothing of others, and where relation() is not `overlapping`; nor of sizes and distances
  /// outside 1e-120 m to 1e120 m.
  [[nodiscard]] std::optional<Penetration> penetration() const;

  /// What proves verdict() within a horizon, for programs that know nothing of this library (certificate.h).
  /// It was checked in exact arithmetic before it is returned: there is a right one, or none. Bodies stand in
  /// it as the verdict takes them; those of a turned assembly have each coordinate rounded once. `id`: JSON,
  /// a text in quotes or a number, that stands in the claim; empty: none. There is none where the verdict is
  /// `undecided`, where dents are so near to what is in them that multipliers in some hundred parts of time
  /// and space do not do, where bodies of flat, round and straight parts meet one with dents or touch along a
  /// normal that is not rational, or where pieces collide only together. Throws InputError like verdict().
  /// Cost: two ellipsoids 10 us, such bodies 1 ms, dents 2 ms, a mesh of 5,000 triangles 3 ms.
  [[nodiscard]] Certificate certificate(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                        const Horizon& horizon = {}, const std::string& id = {}) const;

  /// Of what robust_verdict() says of all errors: `out`, `in`, or `depends` with an error of each kind.
  /// Without any error it is that of the verdict within the errors' horizon. There is none of errors of
  /// attitude, size or acceleration, of sums of sets, and of grazes that take more than some thousand parts
  /// of the sphere of normals. Throws InputError like robust_verdict(). Cost beyond that: `out` and `depends`
  /// 0.1 ms, `in` 0.3 ms, near grazes 100 times as much.
  [[nodiscard]] Certificate certificate(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                        const RelativeErrors& errors, const std::string& id = {}) const;

  /// The cone by the sharpest method there is for these kinds (cone.h). Throws InputError naming "tolerance",
  /// "resolution" or "threads". Cost: two ellipsoids 40 us; combined quadrics milliseconds
  /// (docs/measured/benchmarks.md); hulls 1 ms; others are drawn as a map, seconds.
  [[nodiscard]] Cone cone() const;
  [[nodiscard]] Cone cone(const ConeOptions& options) const;

  /// The least sector that holds the cone's directions on a plane: that through the line of sight, from a
  /// point `from` of the agent to a point `to` of the obstacle (metres, world), and `across` (any vector not
  /// along it). sector_rates() of plane_sector.h has its rates. Edges of exact pairs are right to 1e-9 rad,
  /// those of two ellipsoids about their centres to rounding; GrazingEdge::error says what is proved. Two
  /// stars or dents know their contacts about their centres only; a delimited body and an assembly none.
  /// Nothing where the bodies are not apart (or not known to be), or no direction of the plane
  /// collides, proved. Throws InputError naming "across" or "to". Cost: two ellipsoids 1 us, a hull 2 us,
  /// others: docs/reference/pairs.md.
  [[nodiscard]] std::optional<PlaneSector> sector(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
                                                  const Eigen::Vector3d& across) const;
  /// From the middle of the agent to that of the obstacle.
  [[nodiscard]] std::optional<PlaneSector> sector(const Eigen::Vector3d& across) const;

  /// Whole triangles of directions of w, for cone_map(); lives as long as someone holds it. Prepared on the
  /// first call.
  [[nodiscard]] std::shared_ptr<const DirectionClassifier> directions() const;

 private:
  [[nodiscard]] Verdict other_verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;

  std::shared_ptr<const Placed> agent_, obstacle_;
  std::shared_ptr<const pairs::Family> family_;
  const ConeOracle* ellipsoids_ = nullptr;  // of two ellipsoids: no call goes through the family
};

/// Of bodies as they stand. Throws InputError like Pair, and naming "bodies" for one of the plane and one of
/// space.
[[nodiscard]] Pair pair_of(const WorldBody& agent, const WorldBody& obstacle,
                           const PairOptions& options = {});

/// One question about two bodies, asked without preparing the others: pair_of(a, b, {tolerance}).relation()
/// at less cost. Two planar bodies that are delimited: proved apart, or rounded, or nothing where the two
/// disagree. Throws like pair_of().
[[nodiscard]] std::optional<Relation> relation_of(const WorldBody& a, const WorldBody& b, double tolerance);

}  // namespace vericone
