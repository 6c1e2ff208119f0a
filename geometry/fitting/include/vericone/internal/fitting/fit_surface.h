// SPDX-License-Identifier: BSD-3-Clause
//
// The fit of one surface to a sample in its own frame.
#pragma once

#include <vericone/fitting/fit.h>
#include <vericone/internal/fitting/canonical.h>
#include <cstdint>

namespace vericone::fitting {

struct SurfaceFitOptions {
  bool robust = false;       // else least squares
  std::uint64_t seed = 1;    // of the trial samples of the robust start
  int max_iterations = 200;  // of each refinement
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
