// SPDX-License-Identifier: BSD-3-Clause
//
// How well the points determine a fitted surface.
#pragma once

#include <vericone/fitting/fit.h>

#include "surface/solver.h"

namespace vericone::fitting {

/// A fit in the coordinates of the solver, and what these are in the world.
struct FittedSurface {
  SurfaceModel model;
  Solution solution;
  double cutoff = 0;  // of the loss; 0: least squares
  double noise = 0;
};

/// Even over the sphere: a spiral of equal turns. Planar: over the circle.
std::vector<Eigen::Vector3d> directions(int count, bool planar);

/// Number of equally weighted points that tell as much.
double effective_points(const Cloud& cloud);

/// Root mean square residual, corrected for the parameters that were fitted.
double least_squares_noise(const SurfaceModel& model, const Parameters& parameters, const Cloud& cloud);

/// Covariance of the parameters for independent errors of the points: H^-1 B H^-1 with the curvature H of the
/// cost and B the covariance of its gradient. Robust: B from the residuals themselves, over 1 - leverage.
Eigen::MatrixXd covariance(const FittedSurface& fit, const Cloud& cloud);

/// Share of the ellipsoid's area that has points within 3 * noise near it.
double seen_share(const FittedSurface& fit, const Cloud& cloud);

/// Everything but the piece, in the solver's unit of length. `axes`: of the solver's coordinates in the
/// world, `scale`: their unit in metres; for the words of `unknown`.
void report(const FittedSurface& fit, const Cloud& cloud, const Eigen::Matrix3d& axes, double scale,
            SurfaceFit& result);

}  // namespace vericone::fitting
