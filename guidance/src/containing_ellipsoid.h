// SPDX-License-Identifier: BSD-3-Clause
//
// The ellipses and ellipsoids that stand for bodies where only those will do. They contain the bodies.
#pragma once

#include <vericone/guidance/body_state.h>

namespace vericone::guidance {

/// Requires a planar body.
Ellipse containing_ellipse(const BodyState& body);

/// Requires a spatial body. An ellipsoid is itself; a combined body's is its bounding_ellipsoid(); a hull's
/// is about the mean of its points, of their covariance, widened until it holds them all: linear in their
/// number, not least. Of a placed body: Placed::containing_ellipsoid(), found once a body.
Ellipsoid containing_ellipsoid(const BodyState& body);

}  // namespace vericone::guidance
