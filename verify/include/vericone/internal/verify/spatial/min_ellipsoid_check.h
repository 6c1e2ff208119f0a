// SPDX-License-Identifier: GPL-3.0-or-later
//
// The library's minimum-volume body beside CGAL's approximation of it.
#pragma once

#include <vericone/geometry/min_volume_ellipsoid.h>
#include <cstddef>
#include <vector>

namespace vericone::verify {

/// CGAL::Approximate_min_ellipsoid_d alone.
template <int D>
struct CgalMinEllipsoid {
  double volume = 0;  // of the ellipsoid, which contains all points
  /// CGAL's certificate: the volume is at most this times the least one. It is computed exactly from a matrix
  /// that CGAL updates in doubles, so it holds for well-conditioned clouds near the origin.
  double ratio_bound = 0;
  double seconds = 0;  // that the thread ran in CGAL's constructor, its certificate included
};

/// `epsilon` > 0 is what CGAL is asked for. D = 2 or 3; at least D + 2 points, not all in a hyperplane (CGAL
/// takes D + 1 points for degenerate). Throws std::logic_error when CGAL finds no full-dimensional ellipsoid.
/// `plain`: the certificate as well in doubles, against CGAL's documentation: proves nothing, only to time
/// the rest.
template <int D>
[[nodiscard]] CgalMinEllipsoid<D> cgal_min_ellipsoid(const std::vector<Eigen::Matrix<double, D, 1>>& points,
                                                     double epsilon, bool plain = false);

template <int D>
struct MinEllipsoidComparison {
  MinVolumeResult<D> ours;
  /// Volumes: ours, and the ellipsoid of CGAL::Approximate_min_ellipsoid_d, which contains all points.
  double our_volume = 0, cgal_volume = 0;
  double cgal_ratio_bound = 0;  // as CgalMinEllipsoid's
  /// Points outside, in exact arithmetic.
  std::size_t outside_ours = 0, outside_cgal = 0;

  /// Each volume within the other's certificate: neither can be smaller than the least volume, which the
  /// other one exceeds by its bound at most. 1e-12 allows for the rounding of the volumes.
  [[nodiscard]] bool volumes_agree() const {
    return our_volume <= ours.volume_ratio_bound * cgal_volume * (1 + 1e-12) &&
           cgal_volume <= cgal_ratio_bound * our_volume * (1 + 1e-12);
  }
};

/// Runs both on the same points. About 10 ms for 1000 points. Throws what min_volume_ellipsoid and
/// cgal_min_ellipsoid throw.
template <int D>
[[nodiscard]] MinEllipsoidComparison<D> compare_min_ellipsoid(
    const std::vector<Eigen::Matrix<double, D, 1>>& points, double epsilon);

extern template CgalMinEllipsoid<2> cgal_min_ellipsoid<2>(const std::vector<Eigen::Vector2d>&, double, bool);
extern template CgalMinEllipsoid<3> cgal_min_ellipsoid<3>(const std::vector<Eigen::Vector3d>&, double, bool);
extern template MinEllipsoidComparison<2> compare_min_ellipsoid<2>(const std::vector<Eigen::Vector2d>&,
                                                                   double);
extern template MinEllipsoidComparison<3> compare_min_ellipsoid<3>(const std::vector<Eigen::Vector3d>&,
                                                                   double);

}  // namespace vericone::verify
