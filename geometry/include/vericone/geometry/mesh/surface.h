// SPDX-License-Identifier: BSD-3-Clause
//
// Surfaces of combined quadrics (combined.h) as triangles and polylines: for pictures and files. No predicate
// and no cone uses them.
#pragma once

#include <vericone/geometry/combined.h>
#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace vericone {

/// A triangulated surface. All vertices are on the body's surface to rounding; those of edges where two
/// quadrics meet (the rims) are on both, so that rims are as sharp as they are.
struct CombinedSurface {
  struct Triangle {
    std::array<int, 3> vertices{};  // counter-clockwise seen from outside
    int quadric = 0;                // it lies on: 0 the ellipsoid, i + 1 the delimiter i
  };
  std::vector<Eigen::Vector3d> vertices;  // metres
  std::vector<Triangle> triangles;
};

/// The closed surface. `resolution` (0.005 to 1): length of the edges in parts of the ellipsoid's semi-axes;
/// small dents and waists get shorter ones. Every edge belongs to two triangles, in opposite directions; the
/// Euler characteristic is 2. A body pinched to a point at its centre (level 0) has one vertex there, shared
/// by all parts that meet in it. Throws InputError naming "resolution".
[[nodiscard]] CombinedSurface surface(const CombinedEllipsoid& body, double resolution = 0.1);

enum class SurfacePart {
  ellipsoid,   // the source's ellipsoid delimited by hyperboloid (EDH, (6.6))
  delimiters,  // its hyperboloid delimited by ellipsoid (HDE, (6.7)); both together: (6.8), (6.9)
};

/// The triangles on the ellipsoid, or those on the delimiters, with the vertices they need. This and what
/// follows throw InputError naming "triangles[i].vertices[k]" where that is no vertex of the surface.
[[nodiscard]] CombinedSurface part(const CombinedSurface& surface, SurfacePart which);

/// The edges between triangles on different quadrics, each once.
[[nodiscard]] std::vector<std::array<int, 2>> rims(const CombinedSurface& surface);

/// Volume inside a closed surface, m^3, by the divergence theorem.
[[nodiscard]] double enclosed_volume(const CombinedSurface& surface);

/// Wavefront OBJ (a group "quadric_i" for each quadric) and PLY (text, with the property "quadric" of faces).
[[nodiscard]] std::string to_obj(const CombinedSurface& surface);
[[nodiscard]] std::string to_ply(const CombinedSurface& surface);

/// Part of a planar body's boundary on one conic, from corner to corner counter-clockwise; a single arc that
/// returns to its beginning where there are no corners.
struct BoundaryArc {
  int conic = 0;  // 0 the ellipse, i + 1 the delimiter i
  std::vector<Eigen::Vector2d> points;
};

/// The boundary, counter-clockwise; `resolution` as above, in radians about the centre where the ellipse is a
/// unit circle. Throws InputError naming "resolution".
[[nodiscard]] std::vector<BoundaryArc> outline(const CombinedEllipse& body, double resolution = 0.02);

// Volume and area of combined quadrics (combined.h).

struct VolumeEstimate {
  double value = 0;  // m^3
  /// Estimate of the error (m^3) from two quadrature rules, and of rounding; not a proved bound.
  double error = 0;
};

/// Closed form on every half-plane through an axis of the body, adaptive quadrature over the half-planes.
/// With one delimiter the integrand is analytic; the error is then one of rounding.
[[nodiscard]] VolumeEstimate volume(const CombinedEllipsoid& body);

/// Area of a planar body, m^2, in closed form: right to rounding.
[[nodiscard]] double area(const CombinedEllipse& body);

// The rims of an open mesh of triangles: its outer edge, and the windows in it.

/// The edges of one triangle alone, joined to closed loops of indices into `points`; each loop goes through a
/// point once, the last back to the first. Where loops touch in a point they are parted there. The longest
/// (metres) comes first: of a wall with windows that is its outer edge. A loop runs as its first edge does in
/// its triangle, so of a mesh whose triangles agree the surface is to its left, seen from where they turn
/// counterclockwise. Points are the same by index, not by place: merge equal ones first
/// (files::MeshOptions::merge_equal_points). Empty for a closed mesh. n log n in the triangles.
///
/// Throws InputError naming "triangles[i][k]" for an index without a point.
[[nodiscard]] std::vector<std::vector<std::uint32_t>> boundary_loops(
    const std::vector<Eigen::Vector3d>& points, const std::vector<std::array<std::uint32_t, 3>>& triangles);

}  // namespace vericone
