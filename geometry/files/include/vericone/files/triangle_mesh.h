// SPDX-License-Identifier: BSD-3-Clause
//
// A mesh of triangles from what was read, and what is to be known of it.
#pragma once

#include <vericone/files/read_points.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace vericone::files {

struct MeshOptions {
  /// Equal points become one (-0 is 0), so that triangles meet that were written with points of their own.
  bool merge_equal_points = false;

  /// Triangles without area are left out. They add nothing to the union of the triangles but points and
  /// segments of its own, so keeping them is harmless.
  bool drop_degenerate = false;

  /// Of triangles with the same three corners, in any order, the first one stays.
  bool drop_duplicates = false;
};

/// Edges are pairs of different corners, named by index; a triangle with an index twice has none.
struct MeshReport {
  /// Faces of more than three corners, which were cut into fans about their first corner: right where they
  /// are convex.
  std::size_t polygons = 0;

  /// Without area: three points on a line, equal points, or an index twice. Decided exactly for the
  /// coordinates as they are. Counted before they are left out, if they are.
  std::size_t degenerate_triangles = 0;

  /// With the same three corners as another before it, in any order. Counted before they are left out, if
  /// they are.
  std::size_t duplicate_triangles = 0;

  /// Points that no triangle uses.
  std::size_t unreferenced_points = 0;

  std::size_t edges = 0;
  std::size_t boundary_edges = 0;     // of one triangle
  std::size_t nonmanifold_edges = 0;  // of three or more
  std::size_t odd_edges = 0;          // of an odd number, boundary edges among them
  std::size_t misoriented_edges = 0;  // run through one way at least twice more often than the other way

  /// Every edge is of an even number of triangles: almost every ray from a point crosses the mesh an even
  /// number of times, or almost every one an odd number, so there is an inside.
  [[nodiscard]] bool is_closed() const { return edges > 0 && odd_edges == 0; }

  /// Neighbours run through their common edge in opposite ways: all see the same side.
  [[nodiscard]] bool is_oriented() const { return misoriented_edges == 0; }
};

struct TriangleMesh {
  std::vector<Eigen::Vector3d> points;  // in the unit of the file
  /// Indices into `points`.
  std::vector<std::array<std::uint32_t, 3>> triangles;
  MeshReport report;
};

/// The mesh of a file. All points are kept, also those that no triangle uses. Throws InputError where the
/// file has no face, or naming "faces[i]" or "points[i]" (finite). Time and memory are linear in the numbers
/// of points and corners; 10 million triangles take seconds (docs/reference/files.md).
[[nodiscard]] TriangleMesh triangle_mesh(PointFile file, const MeshOptions& options = {});

/// Whether three points are on a line; exact.
[[nodiscard]] bool are_collinear(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                 const Eigen::Vector3d& c);

}  // namespace vericone::files
