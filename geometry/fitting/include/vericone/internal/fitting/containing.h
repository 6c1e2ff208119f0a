// SPDX-License-Identifier: BSD-3-Clause
//
// Containing bodies of least volume: ellipsoids, and ellipsoids with dents and waists.
#pragma once

#include <vericone/fitting/hull.h>
#include <vericone/internal/fitting/canonical.h>

namespace vericone::fitting {

struct ContainingOptions {
  double margin = 0;  // radius of balls about the points that are to be inside, unit of the sample
  int starts = 6;     // of the search for dents and waists
  /// What dents or a waist must take away from log volume, by a first search to about 1e-2, for them to be
  /// followed to a minimum. Below it what was found first is the answer, not converged.
  double promise = 0;
};

struct ContainingFit {
  Piece piece;             // in the frame of the points given; tight to rounding, not yet proved
  double volume = 0;       // of the body (footprints: area), unit of the sample, cubed
  bool converged = false;  // first-order conditions hold to `stationarity`
  /// Largest relative violation of the first-order conditions of a local minimum of log volume.
  double stationarity = 0;
  /// Ellipses and ellipsoids: ratio of volume to least volume, at most, proved (min_volume_ellipsoid.h).
  double volume_ratio_bound = 0;
  int starts = 0, iterations = 0;
};

/// Of least volume among the bodies of this shape that contain the points, and for shapes with dents and
/// waists the triangles of a mesh. For ellipse and ellipsoid the least; for the others a local minimum, the
/// best of several starts. Never larger than the ellipsoid.
/// Throws InputError naming "points" where they lie in one plane (on one line).
[[nodiscard]] ContainingFit containing_fit(const CanonicalSample& sample, Shape shape,
                                           const ContainingOptions& options = {});

}  // namespace vericone::fitting
