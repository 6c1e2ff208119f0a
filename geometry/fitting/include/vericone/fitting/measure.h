// SPDX-License-Identifier: BSD-3-Clause
//
// How far hull and sample are from each other, and volumes.
#pragma once

#include <vericone/fitting/hull.h>
#include <vericone/geometry/combined_volume.h>
#include <optional>
#include <vector>

namespace vericone::fitting {

/// Distance from a point to the boundary of a body, metres: negative inside. Relative error 1e-10 or so.
/// Inside it is the least of the distances to the surfaces; outside the distance to the nearest point of the
/// body, on a surface or on a rim.
[[nodiscard]] double signed_distance(const CombinedEllipsoid& body, const Eigen::Vector3d& point);

/// The same to an ellipse, in the plane, unit of the body.
[[nodiscard]] double signed_distance(const Ellipse& body, const Eigen::Vector2d& point);

/// To a union, unit of the body: the least over the pieces; inside a lower bound of the depth where pieces
/// overlap. For footprints the horizontal distance.
[[nodiscard]] double signed_distance(const std::vector<Piece>& pieces, const Eigen::Vector3d& point);

struct DistanceStatistics {
  double mean = 0, rms = 0, max = 0;  // metres
};

/// Of the sample's points from the hull's boundary, unsigned; every point counts once (a mesh's that
/// triangles use).
[[nodiscard]] DistanceStatistics scan_to_hull(const std::vector<Piece>& pieces, const Sample& sample);

/// Of points on the hull's boundary (even over its area, some thousand) from the sample: from the triangles
/// of a mesh, from the points of a cloud. Nothing for footprints. `samples`: how many about.
[[nodiscard]] std::optional<DistanceStatistics> hull_to_scan(const std::vector<Piece>& pieces,
                                                             const Sample& sample, int samples = 4000);

/// Volume of the union; nothing for planar footprints (low = high).
[[nodiscard]] std::optional<VolumeEstimate> volume(const std::vector<Piece>& pieces);

/// Volume inside a closed mesh, m^3: by the divergence theorem, accurate to rounding wherever it lies.
/// Nothing where it is not closed and oriented, or has no inside (a sheet and its back).
[[nodiscard]] std::optional<double> enclosed_volume(const Sample& mesh);

}  // namespace vericone::fitting
