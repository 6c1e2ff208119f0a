// SPDX-License-Identifier: BSD-3-Clause
//
// What every family of pairs is: two bodies prepared, and a verdict for every relative velocity. Whoever adds
// a family satisfies VelocityPredicate, and has its laws tested in three lines (vericone/testing/laws.h).
#pragma once

#include <vericone/cones/answers.h>
#include <Eigen/Core>
#include <concepts>
#include <optional>

namespace vericone {

/// `Velocity`: Eigen::Vector2d for bodies in the plane, Eigen::Vector3d in space; m/s, w = v_a - v_b without
/// rounding.
///   relation()             Relation, or nothing where a certified family could not decide
///   membership(v_a, v_b)   Membership, or of certified families Certified or an optional Membership
///   verdict(v_a, v_b)      both in one; `undecided` of certified families alone
template <typename Predicate, typename Velocity>
concept VelocityPredicate = requires(const Predicate& pair, const Velocity& v) {
  { pair.relation() } -> std::convertible_to<std::optional<Relation>>;
  pair.membership(v, v);
  { pair.verdict(v, v) } -> std::same_as<Verdict>;
};

/// A family whose verdicts climb the ladder: each rung can be asked alone.
template <typename Predicate, typename Velocity>
concept LadderPredicate = VelocityPredicate<Predicate, Velocity> &&
    requires(const Predicate& pair, const Velocity& v) {
  { pair.triage_membership(v) }
  noexcept->std::same_as<std::optional<Membership>>;
  { pair.interval_membership(v, v) }
  noexcept->std::same_as<std::optional<Membership>>;
  { pair.exact_membership(v, v) } -> std::same_as<Membership>;
};

}  // namespace vericone
