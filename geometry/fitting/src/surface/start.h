// SPDX-License-Identifier: BSD-3-Clause
//
// Where the search for a surface begins.
#pragma once

#include <cstdint>
#include <optional>

#include "surface/solver.h"

namespace vericone::fitting {

/// The ellipsoid (ellipse) of least algebraic distance under k J - I^2 = 1, I and J the first invariants of
/// its matrix (plane: a c - h^2 = 1, always an ellipse). k = 4 gives an ellipsoid always, though one whose
/// axes in the frame where the points have unit covariance are within a factor of two or so; larger k leaves
/// more freedom, and may give another quadric: nothing then.
std::optional<Parameters> algebraic_ellipsoid(const Cloud& cloud, bool planar, double k);

/// Algebraic fits, principal axes and the algebraic sphere.
std::vector<Parameters> ellipsoid_starts(const Cloud& cloud, bool planar);

/// For points many of which may be far from the surface: algebraic fits of small random samples, the ones
/// with the least median distance improved by fits to the points near them. Best first, at most `most`.
std::vector<Parameters> trial_starts(const Cloud& cloud, bool planar, std::uint64_t seed, std::size_t most);

/// The share of the points that lies most densely about one centre, by steps that each take those nearest in
/// the covariance of the last: gross points all around are left out, whatever the shape.
Cloud concentrated(const Cloud& cloud, double share);

struct SurfaceStart {
  SurfaceModel model;
  Parameters parameters;
};

/// One more delimiter of this kind, of two depths, along the axes of the ellipsoid and of the points `near`
/// the surface, and towards `deepest` where it is not zero. The first one comes with an ellipsoid as large as
/// the points reach.
std::vector<SurfaceStart> delimited_starts(const SurfaceModel& model, const Parameters& parameters,
                                           int sheets, const Cloud& near, const Eigen::Vector3d& deepest);

/// Direction from the centre to the point that is farthest from the boundary of the convex hull; zero where
/// there is no hull.
Eigen::Vector3d deepest_direction(const Cloud& cloud, const Eigen::Vector3d& center);

}  // namespace vericone::fitting
