// SPDX-License-Identifier: BSD-3-Clause
//
// Exact answers about two convex bodies of flat, round and straight parts (convex.h): cylinders, capsules,
// boxes, cones, bodies with margins, ellipsoids, hulls. The names, the ladder of rungs and the laws are those
// of predicates.h.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/convex.h>
#include <vericone/geometry/interval.h>
#include <array>
#include <memory>
#include <optional>

namespace vericone {

struct RoundScene;

/// Two convex bodies prepared for many velocities. Immutable; copies share what was prepared; may be used by
/// several threads at once. K = obstacle + (-agent), Minkowski sum; relation() and membership() mean what
/// they mean of hulls (hull_oracle.h).
///
/// Method: docs/explanation/shapes.md. A search in doubles proposes a plane that contains the line of w and
/// misses K, or three points of K around that line; each rung proves it in its own arithmetic. The last rung
/// asks whether a function of one variable, a linear term and at most three square roots, is negative
/// anywhere.
class RoundOracle {
 public:
  /// `..._at`: where the bodies' own origins stand, metres; the sums with their centres are not rounded.
  RoundOracle(Convex agent, Convex obstacle, const Eigen::Vector3d& agent_at = Eigen::Vector3d::Zero(),
              const Eigen::Vector3d& obstacle_at = Eigen::Vector3d::Zero());

  /// Exact where it is there; nothing where two bodies are so near to touching that no rung tells.
  [[nodiscard]] std::optional<Relation> relation() const { return relation_; }
  /// The rung that decided it.
  [[nodiscard]] Rung relation_rung() const { return relation_rung_; }

  /// Exact. `w` = v_agent - v_obstacle. For bodies that are not disjoint every w != 0 is `in`; see verdict().
  /// Throws InputError naming "agent_velocity[i]" where w is not finite. `rung`: where to write the rung that
  /// decided.
  [[nodiscard]] Membership membership(const Eigen::Vector3d& w, Rung* rung = nullptr) const;
  /// The same for w = v_a - v_b, the difference taken without rounding. Throws InputError naming
  /// "agent_velocity[i]" or "obstacle_velocity[i]".
  [[nodiscard]] Membership membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                      Rung* rung = nullptr) const;

  /// First rung: one bound a pair. Never answers `on`. No allocation, no throw.
  [[nodiscard]] std::optional<Membership> triage_membership(const Eigen::Vector3d& w) const noexcept;
  /// Second rung: the same search, what it finds is proved in intervals. Never answers `on`. No allocation,
  /// no throw.
  [[nodiscard]] std::optional<Membership> interval_membership(const Eigen::Vector3d& v_a,
                                                              const Eigen::Vector3d& v_b) const noexcept;
  /// Last rung, in integers.
  [[nodiscard]] Membership exact_membership(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b) const;
  /// Relation by the last rung alone.
  [[nodiscard]] std::optional<Relation> exact_relation() const;

  /// Relation and membership in one; `undecided` only where the relation is.
  [[nodiscard]] Verdict verdict(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                Rung* rung = nullptr) const;

  /// Whether disjoint bodies do not meet within a horizon: true is certain, false says nothing.
  [[nodiscard]] bool surely_out(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                const Horizon& horizon) const noexcept;
  /// First rung within a horizon, for v_a != v_b, however they lie now. Never answers `on`. No allocation, no
  /// throw.
  [[nodiscard]] std::optional<Membership> triage_within(const Eigen::Vector3d& v_a,
                                                        const Eigen::Vector3d& v_b,
                                                        const Horizon& horizon) const noexcept;
  /// While the agent goes straight from one displacement to another, metres, each off by two roundings at
  /// most: whether they surely overlap on the way, or surely do not meet. Nothing where doubles do not say.
  struct Meeting {
    bool inside;
    Eigen::Vector3d normal;  // of a plane that parts them all the way, from the agent towards the obstacle
    double part;             // of the way, about where it comes to touch both
    bool touching;           // it nearly does
  };
  [[nodiscard]] std::optional<Meeting> meeting(const Eigen::Vector3d& first,
                                               const Eigen::Vector3d& last) const noexcept;
  /// Of two upright cylinders: the plane in closed form that touches the cone of a horizon beside w, largest
  /// entry of its normal 1 or nearly; zero where w is in the cone, to rounding. Nothing of others.
  [[nodiscard]] std::optional<Eigen::Vector3d> touching_plane(const Eigen::Vector3d& w,
                                                              const Horizon& horizon) const noexcept;
  /// Within a horizon, for v_a != v_b, however they lie now, by the last rung; nothing where it is undecided.
  [[nodiscard]] std::optional<Membership> exact_within(const Eigen::Vector3d& v_a, const Eigen::Vector3d& v_b,
                                                       const Horizon& horizon) const;

  /// First contact along w = v_agent - v_obstacle, of disjoint bodies that surely overlap then. Nothing where
  /// doubles do not say quickly.
  struct FirstContact {
    double earliest, latest;  // s, proved: nothing is touched before, they touch or overlap at
    Eigen::Vector3d point;    // m, of the obstacle as it stands now; rounded
    Eigen::Vector3d normal;   // unit, from the agent towards the obstacle; rounded
  };
  [[nodiscard]] std::optional<FirstContact> first_contact(const Eigen::Vector3d& w) const noexcept;

  /// Whether one of the bodies lies in a plane, as far as its numbers show at once.
  [[nodiscard]] bool is_flat() const;

  /// At most the least n.x over K, metres.
  [[nodiscard]] double gap(const Eigen::Vector3d& n) const noexcept;

  /// For disjoint bodies a normal n with n.x > 0 on all of K, proved; largest entry 1. Zero for others, and
  /// where doubles find none.
  [[nodiscard]] const Eigen::Vector3d& separating_normal() const { return normal_; }

 private:
  /// Of two upright cylinders, by their closed form; nothing of others and where doubles do not tell.
  [[nodiscard]] std::optional<Membership> upright_within(const Eigen::Vector3d& w,
                                                         const Horizon& horizon) const noexcept;

  std::shared_ptr<const RoundScene> scene_;
  std::optional<Relation> relation_;
  Rung relation_rung_ = Rung::exact;
  Eigen::Vector3d normal_ = Eigen::Vector3d::Zero();
  bool normal_certified_ = false;
  bool hulls_ = false;  // both are of points alone
  double room_ = 0;     // n.x >= room_ on all of K, metres
};

/// Tag of RoundOracle::membership for rung_counts().
struct RoundMembership;

}  // namespace vericone
