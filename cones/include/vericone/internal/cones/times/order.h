// SPDX-License-Identifier: BSD-3-Clause
//
// Exact order of two tangent directions, and of two times to contact: numbers that are roots of polynomials,
// compared without computing them (docs/explanation/predicates/order.md). Ladder as in predicates.h.
//
// Laws, for all arguments (tests/cones/times/order_turn_test.cpp, order_earlier_test.cpp):
//   (1) turn(q, p) == -turn(p, q), earlier(q, p) == -earlier(p, q); both are zero for p = q
//   (2) exchanging the bodies of p turns its direction about: turn(p', q) == -turn(p, q)
//   (3) turn is unchanged by translations and scalings of either pair, and by a linear map of both with a
//       positive determinant
//   (4) earlier is unchanged by exchanging the bodies and negating w, by translations of a pair, by scaling
//       its lengths and velocity together, and by a linear map of both encounters
//   (5) earlier is transitive, ties included
//   (6) a rung that answers agrees with every later rung
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <optional>

namespace vericone {

/// The direction of an inner common tangent of two ellipses that are not overlapping, along the tangent from
/// A towards B: SectorEdge::direction, exactly.
struct TangentRef {
  Ellipse a, b;
  bool left = true;  // the counter-clockwise edge of the sector; of touching bodies too, see Sector
};

/// Sign of the cross product of the two directions: positive when that of q lies counter-clockwise from that
/// of p by less than half a turn, negative when clockwise, zero when they are parallel, in the same or in
/// opposite directions (see opposed()). Throws InputError naming "p" or "q" when its bodies overlap or are
/// not finite. Cost: 2 us where the first rung decides, hardly more the second, about 0.2 ms the last.
[[nodiscard]] Sign turn(const TangentRef& p, const TangentRef& q, Rung* rung = nullptr);

/// First rung: both directions between two that are certified, some 1e-9 apart. Never answers zero.
[[nodiscard]] std::optional<Sign> triage_turn(const TangentRef& p, const TangentRef& q);
/// Second rung: the same as narrow as intervals allow. Never answers zero.
[[nodiscard]] std::optional<Sign> interval_turn(const TangentRef& p, const TangentRef& q);
/// Last rung: roots of quartics with integer coefficients.
[[nodiscard]] Sign exact_turn(const TangentRef& p, const TangentRef& q);

/// Whether the directions are exactly opposite; turn() is zero then. Decided by the last rung when turn() is.
[[nodiscard]] bool opposed(const TangentRef& p, const TangentRef& q);

/// A moves with the velocity w relative to B, from now on.
struct Encounter {
  Ellipsoid a, b;
  Eigen::Vector3d w = Eigen::Vector3d::Zero();  // v_A - v_B
};

/// Which of two times to contact is earlier: negative when that of p is, zero when they are the same,
/// exactly. The time is 0 for bodies that touch or overlap now, and later than any other for bodies that
/// never touch; two encounters without a contact compare as the same. Throws InputError naming "p.w" or "q.w"
/// when it is not finite. Cost: 8 us where the first rung decides, about 70 us more the last, 2 ms for ties
/// of unrelated bodies.
[[nodiscard]] Sign earlier(const Encounter& p, const Encounter& q, Rung* rung = nullptr);

/// First rung: certified bounds of both times, some 1e-6 of them apart. Zero only for times that need no
/// comparison: both now, or both never.
[[nodiscard]] std::optional<Sign> triage_earlier(const Encounter& p, const Encounter& q) noexcept;
/// Second rung: the same as narrow as intervals allow.
[[nodiscard]] std::optional<Sign> interval_earlier(const Encounter& p, const Encounter& q) noexcept;
/// Last rung: bounds of both times in integers, as narrow as needed; ties as equal contact polynomials or
/// common roots of discriminants, of degree 12 in the time.
[[nodiscard]] Sign exact_earlier(const Encounter& p, const Encounter& q);

/// Tags of turn() and earlier() for rung_counts().
struct TurnOfTangents;
struct EarlierContact;

}  // namespace vericone
