// SPDX-License-Identifier: BSD-3-Clause
//
// Quadric surfaces near points: least squares of geometric distances, and the same with robust losses.
// Neither contains the points: that is another question (containing.h).
#pragma once

#include <vericone/fitting/hull.h>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace vericone::fitting {

struct SurfaceFitOptions {
  bool robust = false;       // else least squares
  std::uint64_t seed = 1;    // of the trial samples of the robust start
  int max_iterations = 200;  // of each refinement
};

/// A direction or length that the sample leaves open, in the world.
struct Unknown {
  std::string what;             // "center along (0.1, 0.2, 0.97)", "semi-axis 2", ...
  double value = 0, error = 0;  // metres, the centre's from the sample's mean; error: one standard deviation
};

/// A body that goes on far beyond the points: how far from its centre along one of its axes, and how wide the
/// points are along that, metres.
struct Overreach {
  double reach = 0, width = 0;
};

struct SurfaceFit {
  /// Quadrics not set. In the frame of the sample; the shape `ellipse`: footprint, low, high and all lengths
  /// here in the world, since the frame is turned and the vertical is the world's.
  Piece piece;
  bool converged = false;  // false: the solver's last iterate, no fit
  double noise = 0;    // estimated standard deviation of the distances of inliers, same unit as the points
  double inliers = 1;  // share of the weights within 3 * noise (robust) or 1
  /// One standard deviation of centre (3) and of the ellipsoid's semi-axes (3, decreasing), from the
  /// curvature of the cost at the solution, for independent noise.
  Eigen::Vector3d center_error = Eigen::Vector3d::Zero(), axes_error = Eigen::Vector3d::Zero();
  /// Of the centre, unit of the sample squared, so that its error along any direction can be told.
  Eigen::Matrix3d center_covariance = Eigen::Matrix3d::Zero();
  /// Share of the ellipsoid's area that has points near it (within 3 * noise, and within a cell of a grid of
  /// up to 400 directions, as seen from the centre where the ellipsoid is the unit ball).
  double seen = 1;
  /// What the points do not determine: standard deviation above a twentieth of the value.
  std::vector<Unknown> unknown;
  /// There where a reach is above 1.5 times the width, or 1.25 times where the semi-axis is unknown: most of
  /// the body is the model's, not the points'. The half of an ellipsoid shows each of its semi-axes in full.
  std::optional<Overreach> overreach;
  int iterations = 0;
};

/// Points and weights of the sample. The residual of a point is its signed distance to the ellipsoid, for
/// combined shapes the largest of the signed distances to the surfaces (the distance to the body, except
/// outside near rims). Started from an algebraic fit, or the best of trial samples (robust), and from
/// principal axes; for dents and waists from where the convex hull is farthest from the points. Robust:
/// redescending loss with the scale re-estimated from the residuals.
/// Throws InputError naming "points" where there are fewer than parameters or where no such surface is near
/// the points (a plane, a paraboloid: what was found is said). Time linear in the points, some tens of
/// passes.
[[nodiscard]] SurfaceFit fit_surface(const CanonicalSample& sample, Shape shape,
                                     const SurfaceFitOptions& options = {});

}  // namespace vericone::fitting
