// SPDX-License-Identifier: GPL-3.0-or-later
//
// The collision cone of two ellipsoids between two cones over polyhedra, by the definition: the directions in
// which a ray from the origin meets the Minkowski sum K = B + (-A).
#pragma once

#include <vericone/geometry/ellipsoid.h>
#include <cstddef>
#include <memory>
#include <vector>

namespace vericone::verify {

/// A triangulated unit sphere.
struct GeodesicSphere {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Eigen::Vector3i> facets;  // counter-clockwise from outside

  /// The icosahedron with every triangle cut in four `level` times: 10 * 4^level + 2 vertices. Level 0 to 5.
  explicit GeodesicSphere(int level);
};

/// The vertices of the convex hull of all sums x + y, x from `first`, y from `second`. Exact as long as the
/// sums are (coordinates on a common grid, for example). About 2 ms for 42 by 42 points.
[[nodiscard]] std::vector<Eigen::Vector3d> minkowski_sum_vertices(const std::vector<Eigen::Vector3d>& first,
                                                                  const std::vector<Eigen::Vector3d>& second);

/// The cone with the apex at the origin over a convex polyhedron that is known exactly.
class PolyhedronCone {
 public:
  struct Exact;
  explicit PolyhedronCone(std::shared_ptr<const Exact> exact);

  /// The origin is in the polyhedron: the cone is all of space.
  [[nodiscard]] bool everything() const;

  /// Whether the ray from the origin along w meets the closed polyhedron. Exact, w taken as it is; false for
  /// w = 0 unless everything(). About 3 us.
  [[nodiscard]] bool contains(const Eigen::Vector3d& w) const;

  /// Steradian, to about 1e-9 relative for cones wider than 1e-6 radians; 4 pi when everything().
  [[nodiscard]] double solid_angle() const;

  /// Edges, unit vectors, rounded; empty when everything().
  [[nodiscard]] const std::vector<Eigen::Vector3d>& edges() const;

 private:
  std::shared_ptr<const Exact> exact_;
};

struct MinkowskiBounds {
  PolyhedronCone inner, outer;
  double scale;              // of the outer polyhedron against the inner one
  std::size_t sum_vertices;  // of the inner polyhedron
};

/// inner <= collision cone <= outer.
///
/// Both bodies are replaced by convex polyhedra: the image of a geodesic sphere, shrunk a little; every
/// vertex is certified in exact arithmetic to lie in the body. The same polyhedra enlarged about their
/// centres by `scale` contain the bodies; every facet plane is certified for that. The inner cone is that
/// over the Minkowski sum of the inscribed polyhedra, the outer one over that of the enlarged ones.
///
/// `level` is that of the geodesic spheres; scale is about 1.26, 1.071, 1.018, 1.0046 for the levels 0 to 3.
/// Requires ratios of the semi-axes below 1e4, and bodies whose sizes differ by less than 1e4; throws
/// std::logic_error where a certificate fails. About 3 ms for level 1, 20 ms for level 2.
[[nodiscard]] MinkowskiBounds minkowski_bounds(const Ellipsoid& a, const Ellipsoid& b, int level);

}  // namespace vericone::verify
