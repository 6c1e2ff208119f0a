// SPDX-License-Identifier: BSD-3-Clause
//
// How two ellipses or two ellipsoids lie, nesting included: exact, by the ladder of predicates.h. The
// mathematics is in docs/explanation/predicates/position.md.
//
// Laws, for all bodies A, B (tests/cones/ellipsoids/position_test.cpp):
//   (1) position(B, A) == swapped(position(A, B))
//   (2) relation_of(position(A, B)) == relation(A, B)
//   (3) a rung that answers agrees with every later rung
//   (4) the answer is unchanged by scaling both bodies by a power of two, by moving them together as long as
//       the numbers remain exact, and by the reflection through the origin
//   (5) A in B and B in C give A in C
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/ellipsoid.h>
#include <vericone/geometry/sign.h>
#include <cstdint>
#include <optional>

namespace vericone {

/// How two solid bodies lie. Exactly one of these is true.
enum class Position : std::uint8_t {
  disjoint,             // no common point
  touching,             // common boundary points only: from outside
  crossing,             // common interior, and each has points outside the other
  a_inside_b,           // A lies in the interior of B
  a_inside_b_touching,  // A is a proper part of B with a common boundary point: touching from inside
  b_inside_a,
  b_inside_a_touching,
  equal,  // the same body
};

[[nodiscard]] const char* to_string(Position position);

/// With A and B exchanged.
[[nodiscard]] Position swapped(Position position);

/// What relation() says of it: crossing, equal and every kind of nesting are `overlapping`.
[[nodiscard]] Relation relation_of(Position position);

/// Exact position of two bodies. `rung`: where to write the rung that decided. D = 2 or 3.
///
/// Cost: see docs/explanation/predicates/position.md.
template <int D>
[[nodiscard]] Position position(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b, Rung* rung = nullptr);

/// First rung: a certificate searched for in plain doubles, its polynomials evaluated with a bound fixed by
/// their formulas. Nothing when rounding could matter. Never answers `touching`, `equal` or `..._touching`.
/// No allocation, no throw.
template <int D>
[[nodiscard]] std::optional<Position> triage_position(const BasicEllipsoid<D>& a,
                                                      const BasicEllipsoid<D>& b) noexcept;

/// Second rung: the same certificate in intervals. Never answers a degenerate position either. No allocation,
/// no throw.
template <int D>
[[nodiscard]] std::optional<Position> interval_position(const BasicEllipsoid<D>& a,
                                                        const BasicEllipsoid<D>& b) noexcept;

/// Last rung, in integers: always an answer. For rational input see exact_position.h.
template <int D>
[[nodiscard]] Position exact_position(const BasicEllipsoid<D>& a, const BasicEllipsoid<D>& b);

/// Tag of position<D> for rung_counts().
template <int D>
struct PositionOf;

}  // namespace vericone
