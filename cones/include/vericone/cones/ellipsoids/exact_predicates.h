// SPDX-License-Identifier: BSD-3-Clause
//
// The last rung for input in rational numbers: data that doubles cannot hold, and truths for tests.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/exact/rational.h>

namespace vericone::exact {

/// Relation of two bodies given by centre and shape matrix (symmetric, positive definite; not checked).
template <int D>
[[nodiscard]] Relation relation(const RationalBody<D>& a, const RationalBody<D>& b);

/// Membership of w = v_A - v_B in the cone of two bodies, which need not be disjoint (ConeOracle).
[[nodiscard]] Membership membership(const RationalBody<3>& a, const RationalBody<3>& b,
                                    const RationalVector<3>& w);

/// In the plane (SectorOracle).
[[nodiscard]] Membership membership(const RationalBody<2>& a, const RationalBody<2>& b,
                                    const RationalVector<2>& w);

// The last rung of position() for input in rational numbers.

/// Position of two bodies given by centre and shape matrix (symmetric, positive definite; not checked).
/// D = 2 or 3.
template <int D>
[[nodiscard]] Position position(const RationalBody<D>& a, const RationalBody<D>& b);

}  // namespace vericone::exact
