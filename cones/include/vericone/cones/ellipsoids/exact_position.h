// SPDX-License-Identifier: BSD-3-Clause
//
// The last rung of position() for input in rational numbers.
#pragma once

#include <vericone/cones/ellipsoids/position.h>
#include <vericone/geometry/exact/body.h>
#include <vericone/geometry/exact/rational.h>

namespace vericone::exact {

/// Position of two bodies given by centre and shape matrix (symmetric, positive definite; not checked).
/// D = 2 or 3.
template <int D>
[[nodiscard]] Position position(const RationalBody<D>& a, const RationalBody<D>& b);

}  // namespace vericone::exact
