// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/cones/answers.h>
#include <vericone/geometry/ellipsoid.h>

namespace vericone {

struct Stretch;

namespace exact {

/// Whether two ellipsoids overlap on a stretch (`in`), only touch, or stay apart; however they lie now.
Membership within(const Ellipsoid& a, const Ellipsoid& b, const Stretch& stretch);

}  // namespace exact
}  // namespace vericone
