// SPDX-License-Identifier: GPL-3.0-or-later
//
// The true cone of two combined quadrics between two cones over polyhedra, in integers only: every answer
// but `unknown` is proved.
#pragma once

#include <vericone/cones/ellipsoids/predicates.h>
#include <vericone/geometry/combined.h>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace vericone::verify {

/// Coordinates, or a direction, in whole units.
using GridVector = std::array<std::int64_t, 3>;

/// A surface of triangles about a centre, each seen counter-clockwise from outside; the tetrahedra over its
/// facets with the centre as fourth vertex fill the body.
struct StarPolyhedron {
  GridVector center{};
  std::vector<GridVector> vertices;  // in space, not about the centre
  std::vector<std::array<int, 3>> facets;
};

/// Two polyhedra with vertices near the boundary of a body.
struct PolyhedralBounds {
  /// Every facet's tetrahedron is in the body. Facets for which that could not be shown are left out, so the
  /// surface may have holes.
  StarPolyhedron inner;
  /// Contains the body; closed. Nothing where it could not be shown.
  std::optional<StarPolyhedron> outer;
};

/// Lengths in units of 2^unit metres; the centre of the body and its place `at` in units. The vertices are
/// images of those of a geodesic sphere of this level (minkowski_bounds.h), moved along their rays until all
/// Bernstein coefficients of the quadrics on each facet, or on its parts, prove it inside or outside. About 2
/// ms for level 2.
[[nodiscard]] PolyhedralBounds polyhedral_bounds(const CombinedEllipsoid& body, int level, int unit,
                                                 const GridVector& at);

/// Whether `moving`, moved along w by any t >= 0, meets `other`: a pair of points that do, strictly inside of
/// facets or edges. Nothing said by false.
[[nodiscard]] bool surely_meets(const StarPolyhedron& moving, const StarPolyhedron& other,
                                const GridVector& w);

/// Whether `moving`, moved along w by any t >= 0, never meets `other`. Requires two closed surfaces that are
/// apart. Nothing said by false.
[[nodiscard]] bool surely_misses(const StarPolyhedron& moving, const StarPolyhedron& other,
                                 const GridVector& w);

/// Whether two closed polyhedra, each full, have no point in common. Nothing said by false.
[[nodiscard]] bool surely_apart(const StarPolyhedron& p, const StarPolyhedron& q);

enum class Truth : std::uint8_t { in, out, unknown };

/// The greatest coordinate of a direction.
inline constexpr std::int64_t kGreatestDirection = std::int64_t{1} << 20;

/// Both bodies between polyhedra.
class CombinedTruth {
 public:
  /// Requires that the centres' difference is a multiple of 2^-23 of the longest semi-axis (rounded down to a
  /// power of two) and within 2^12 of it; throws std::logic_error otherwise.
  CombinedTruth(const CombinedEllipsoid& a, const CombinedEllipsoid& b, int level);

  /// Disjoint where the outer polyhedra are; overlapping where the centre of one body, or a vertex of an
  /// inner polyhedron, is strictly inside the other's inner polyhedron.
  [[nodiscard]] std::optional<Relation> relation() const { return relation_; }

  /// Where w lies; coordinates up to kGreatestDirection, not all zero. For bodies that are disjoint. About 1
  /// ms for level 2.
  [[nodiscard]] Truth direction(const GridVector& w) const;

  [[nodiscard]] const PolyhedralBounds& a() const { return a_; }
  [[nodiscard]] const PolyhedralBounds& b() const { return b_; }

 private:
  PolyhedralBounds a_, b_;
  std::optional<Relation> relation_;
};

/// Whether the point x, taken as it is, and the point x + t w, computed without rounding, are in A and in B:
/// then t w, t >= 0, brings the two together. In rational arithmetic.
[[nodiscard]] bool exactly_meets(const CombinedEllipsoid& a, const CombinedEllipsoid& b,
                                 const Eigen::Vector3d& x, const Eigen::Vector3d& w, double t);

}  // namespace vericone::verify
