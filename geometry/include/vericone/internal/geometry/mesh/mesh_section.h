// SPDX-License-Identifier: BSD-3-Clause
//
// Sections of triangle meshes by planes.
#pragma once

#include <vericone/geometry/quadric.h>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace vericone {

/// One connected piece of a section.
struct SectionLine {
  /// In the plane's coordinates, metres. No two neighbours are equal. A piece may be a single point.
  std::vector<Eigen::Vector2d> points;
  /// triangles[i] is cut from points[i] to the next point; as many as points where closed, else one fewer.
  std::vector<std::uint32_t> triangles;
  /// The last point is joined to the first.
  bool closed = false;
};

/// All of the section of a mesh. The plane is { x : n.(x - origin) = 0 } with n = plane.normal() as rounded;
/// on which side of it a corner lies is decided exactly, and *corners in the plane count as above it*: what
/// comes out is the limit of the sections by planes that come from below. So every cut triangle is cut along
/// two of its edges, pieces of a closed mesh are closed whatever lies in the plane, a triangle in the plane
/// gives nothing itself, and where the mesh below it begins, its border.
///
/// Pieces are joined over common edges (equal indices; equal points with other indices are other corners) and
/// run counter-clockwise about the inside, seen from where n points, where triangles are counter-clockwise
/// from outside. Triangles turned otherwise, and edges of three or more, are joined as well, in some order.
/// Time O(triangles + k log k) for k cut ones. Requires indices in range and finite points.
[[nodiscard]] std::vector<SectionLine> mesh_section(std::span<const Eigen::Vector3d> points,
                                                    std::span<const std::array<std::uint32_t, 3>> triangles,
                                                    const PlaneFrame& plane);

/// Signed area of a closed piece, positive counter-clockwise; m^2. A section's area is the sum over its
/// pieces.
[[nodiscard]] double signed_area(const SectionLine& line);

}  // namespace vericone
