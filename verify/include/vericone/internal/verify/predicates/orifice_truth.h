// SPDX-License-Identifier: GPL-3.0-or-later
//
// Exact answers about an ellipsoid and an opening; see predicate_truth.h for what an oracle promises.
#pragma once

#include <vericone/cones/opening/orifice.h>
#include <vericone/geometry/ellipsoid.h>

namespace vericone::verify {

/// Whether the agent passes an opening of radius `radius` about `center` in the plane with the normal
/// `normal`, moving along w; the conventions are those of OrificeOracle.
///
/// The swept agent cuts the plane in an ellipse. With n running over the directions of the plane, q_D and q_E
/// the squared half widths of disc and ellipse and d the vector between their centres, the ellipse is inside
/// iff sqrt(q_D) >= sqrt(q_E) + |n.d| for all n, that is H = q_D - q_E - (n.d)^2 >= 0 and
/// H^2 - 4 q_E (n.d)^2 >= 0: decided at the roots of this binary quartic and between them. About 0.15 ms.
[[nodiscard]] Transit orifice_truth(const Ellipsoid& agent, const Eigen::Vector3d& center,
                                    const Eigen::Vector3d& normal, double radius, const Eigen::Vector3d& w);

/// The same of an opening of any outline. In the opening's own coordinates the swept agent is an ellipse
/// again; that of a circle or an ellipse is nested by the quartic above, of a polygon the quadratic of each
/// edge says whether it is negative between its ends, and a ray from the ellipse's centre how often it
/// crosses the rim.
[[nodiscard]] Transit orifice_truth(const Ellipsoid& agent, const PlacedOpening& opening,
                                    const Eigen::Vector3d& w);

}  // namespace vericone::verify
