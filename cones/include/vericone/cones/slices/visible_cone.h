// SPDX-License-Identifier: BSD-3-Clause
//
// The source's 3-D cone against an obstacle of which a cloud of points or a mesh is known (source, 6.3.3 and
// 6.3.4): planar sectors on planes through the line of sight.
#pragma once

#include <vericone/cones/slices/slice_cone.h>
#include <vericone/cones/slices/visible_sector.h>
#include <vericone/geometry/quadric.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace vericone {

/// Points of a body's section by a plane, in the plane's coordinates.
using PlanePoints = std::function<std::vector<Eigen::Vector2d>(const PlaneFrame&)>;

/// The points of a cloud within `half_thickness` of the plane, projected onto it. A point off the plane
/// stands for one in it, so what comes out is off by up to half_thickness times the slope of the surface, to
/// either side. Keeps the cloud.
[[nodiscard]] PlanePoints points_near_plane(std::vector<Eigen::Vector3d> cloud, double half_thickness);

/// Half of the distance between neighbouring beams at the farthest point: the thinnest slab that every plane
/// through a cloud of beams `spacing` radians apart meets about once a beam. Metres.
[[nodiscard]] double slab_half_thickness(std::span<const Eigen::Vector3d> cloud,
                                         const Eigen::Vector3d& sensor, double spacing);

/// The corners of the section of a mesh (mesh_section.h), or of the part of one that is given by some of its
/// triangles. Keeps both.
[[nodiscard]] PlanePoints mesh_section_points(std::vector<Eigen::Vector3d> points,
                                              std::vector<std::array<std::uint32_t, 3>> triangles);

/// Points (m) of a plane in the order of their bearing from its origin, the nearer first: from one extreme
/// end to the other for points on the side of its x axis.
void order_by_bearing(std::vector<Eigen::Vector2d>& points);

struct VisiblePlane {
  double azimuth = 0;          // rad, as in Slice
  std::optional<Slice> slice;  // edges need not be positive: the axis may be outside of the sector
  NoSector reason = NoSector::none;
  std::size_t points = 0;  // of the obstacle on this plane
  int tried = 0;           // of them, by the search
};

/// The union of planar sectors. Like SliceCone it is not the collision cone, and an obstacle of any shape may
/// have more between two planes or less. Points near a plane are not in it, so it need not even be inside.
struct VisibleCone {
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();  // unit, from the agent's centre to `towards`
  std::vector<VisiblePlane> planes;

  [[nodiscard]] std::size_t planes_without_answer() const;
  /// The polygon of the edges of the planes that have an answer with the axis inside; without directions,
  /// and NaN, where those are fewer than two.
  [[nodiscard]] PolyhedralCone polyhedral() const;
};

struct VisibleConeOptions {
  SearchOptions search;
  bool by_search = true;  // visible_sector(); else sector_of_points()
};

/// `planes` >= 1 planes at equal angles through the line from the agent's centre to `towards`, for which the
/// source has the centre of the points seen. On each, `obstacle`'s points in the order of their bearing from
/// the agent's centre. Throws InputError naming "planes" or "towards".
[[nodiscard]] VisibleCone visible_cone(const Ellipsoid& agent, const PlanePoints& obstacle,
                                       const Eigen::Vector3d& towards, int planes,
                                       const VisibleConeOptions& options = {});

/// For an agent of any shape (6.3.4) about `center`.
[[nodiscard]] VisibleCone visible_cone(const Eigen::Vector3d& center, const PlanePoints& agent,
                                       const PlanePoints& obstacle, const Eigen::Vector3d& towards,
                                       int planes, const VisibleConeOptions& options = {});

}  // namespace vericone
