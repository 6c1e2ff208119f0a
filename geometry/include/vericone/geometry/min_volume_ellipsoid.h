// SPDX-License-Identifier: BSD-3-Clause
//
// The smallest ellipse or ellipsoid that contains given points.
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <Eigen/Core>
#include <vector>

namespace vericone {

struct MinVolumeOptions {
  /// Bound on optimality_gap, relative, at which the iteration may stop; positive and below 1.
  double tolerance = 1e-7;
  /// Bound on the number of updates of the weights.
  int max_iterations = 100'000;
  /// False: the body contains the points to rounding only, and volume_ratio_bound is NaN. The certificate is
  /// most of the time of a few points.
  bool certified = true;
};

enum class MinVolumeStatus {
  converged,        // optimality_gap <= tolerance
  iteration_limit,  // stopped by max_iterations
  rounding_limit,   // no further progress in double precision: the tolerance is too small
};

/// The body is certified whatever the status: it contains every point, and its volume is at most
/// volume_ratio_bound times the least. Only with `converged` is it the minimum-volume body to the tolerance.
template <int D>
struct MinVolumeResult {
  /// Contains every point exactly: as defined by its stored factor (see BasicEllipsoid), in exact arithmetic.
  BasicEllipsoid<D> body;

  MinVolumeStatus status = MinVolumeStatus::iteration_limit;
  [[nodiscard]] bool converged() const { return status == MinVolumeStatus::converged; }

  /// max_i g_i / (D+1) - 1 over all points, where g_i is the gradient of the dual objective (source,
  /// Algorithm 1); 0 at the optimum. Rounded.
  double optimality_gap = 0;

  /// volume(body) / (volume of the minimum-volume body) is at most this. From the weights by weak duality, in
  /// rational arithmetic, rounded upwards: it holds whether or not the iteration converged.
  double volume_ratio_bound = 0;

  /// Updates of the weights made.
  int iterations = 0;

  /// Indices of the points with positive weight, increasing, and their weights, which sum to 1 to rounding.
  /// Where the optimal weights are not unique (the corners of a cube, say) this is one of the optima.
  std::vector<Eigen::Index> support;
  std::vector<double> weights;
};

/// Minimum-volume enclosing ellipse (D = 2) or ellipsoid (D = 3) of `points`, one a column (in Python one a
/// row), in their unit.
///
/// Khachiyan's ascent on the dual (source, Algorithm 1, with the corrections of the errata: D in place of n,
/// the sign of the step) with the away steps of Todd and Yildirim (Discrete Applied Mathematics 155, 2007),
/// started from the core set of Kumar and Yildirim (JOTA 126, 2005), run on a small working set that takes in
/// the most violating points in turn, and with Newton steps on the points of positive weight. Independent of
/// the frame to the tolerance, deterministic, and independent of the order of the points to the tolerance.
///
/// With optimality_gap = e the volume exceeds the least one by at most the factor (1 + (D+1) e / D)^(D/2),
/// plus rounding of the axes of about 1e-16 times the ratio of the longest to the shortest;
/// volume_ratio_bound includes both. A gap e leaves centre and axes uncertain by about sqrt(e) at worst.
///
/// Time O(N) per pass over the points, some 10 to 40 passes.
///
/// Throws InputError naming "points" for fewer than D+1 points and for points that are all equal, on one line
/// or (D = 3) in one plane, to 1e-13 of their extent or to the rounding of their coordinates; "points[i]" for
/// a coordinate that is not finite or is above 1e100 in magnitude; "tolerance" and "max_iterations" for
/// values out of range.
template <int D>
[[nodiscard]] MinVolumeResult<D> min_volume_ellipsoid(
    const Eigen::Ref<const Eigen::Matrix<double, D, Eigen::Dynamic>>& points,
    const MinVolumeOptions& options = {});

/// The same for points in a vector.
template <int D>
[[nodiscard]] MinVolumeResult<D> min_volume_ellipsoid(const std::vector<Eigen::Matrix<double, D, 1>>& points,
                                                      const MinVolumeOptions& options = {}) {
  using Columns = Eigen::Matrix<double, D, Eigen::Dynamic>;
  const double* data = points.empty() ? nullptr : points.front().data();
  return min_volume_ellipsoid<D>(
      Eigen::Ref<const Columns>(Eigen::Map<const Columns>(data, D, Eigen::Index(points.size()))), options);
}

extern template MinVolumeResult<2> min_volume_ellipsoid<2>(const Eigen::Ref<const Eigen::Matrix2Xd>&,
                                                           const MinVolumeOptions&);
extern template MinVolumeResult<3> min_volume_ellipsoid<3>(const Eigen::Ref<const Eigen::Matrix3Xd>&,
                                                           const MinVolumeOptions&);

}  // namespace vericone
