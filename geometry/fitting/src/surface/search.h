// SPDX-License-Identifier: BSD-3-Clause
//
// The best surface of a shape from all starts.
#pragma once

#include <vericone/fitting/fit.h>
#include <vericone/internal/fitting/fit_surface.h>

#include "surface/report.h"
#include "surface/start.h"

namespace vericone::fitting {

/// A semi-axis so long beside the points (in the unit ball) that an open surface is meant.
bool is_open(const FittedSurface& fit);

/// What separates the two sides of the surface is not seen through the noise.
bool is_flat(const FittedSurface& fit, const Cloud& cloud);

/// Mean squares about the mean along the principal axes, increasing.
Eigen::VectorXd spread(const Cloud& cloud, bool planar);

/// An ellipsoid; planar: an ellipse.
FittedSurface fit_ellipsoid(const Cloud& cloud, bool planar, const SurfaceFitOptions& options);

/// The ellipsoid that delimiters are added to. Waists make the nearest surface a long cylinder; then one from
/// the moments of the points, or the best of the trial samples.
FittedSurface base_ellipsoid(const Cloud& cloud, const SurfaceFitOptions& options);

/// `from` with one more delimiter of this kind, refined: the best of all starts.
FittedSurface add_delimiter(const FittedSurface& from, const Cloud& cloud, int sheets,
                            const SurfaceFitOptions& options);

/// An ellipsoid and at most three delimiters of either kind, as many as pay.
FittedSurface fit_star(const FittedSurface& ellipsoid, const Cloud& cloud, const SurfaceFitOptions& options);

}  // namespace vericone::fitting
