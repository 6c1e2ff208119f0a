// SPDX-License-Identifier: BSD-3-Clause
//
// Collision cones in the plane against an obstacle of which points are known: what sensors see of it (source,
// 6.3.3), for an elliptic agent and for one of any shape (6.3.4).
#pragma once

#include <vericone/cones/planar/sector.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/geometry/quadric.h>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace vericone {

/// Why there is no sector.
enum class NoSector : std::uint8_t {
  none,          // there is one
  no_points,     // nothing is seen of the obstacle
  inside_agent,  // a point is inside the elliptic agent, or on it
  no_tangents,   // the agent reaches among the points: no line separates it from them
};
[[nodiscard]] const char* to_string(NoSector reason);

/// The sector between the inner common tangents of the agent's section and the points.
struct VisibleSector {
  std::optional<Sector> sector;  // its relation is `disjoint`
  NoSector reason = NoSector::none;
  std::size_t left_point = 0, right_point = 0;  // indices of the obstacle's points that the edges touch
  int tried = 0;                                // points from which tangents were drawn
};

struct SearchOptions {
  /// Every `keep_every`-th point of the obstacle is kept, and the last one: the source's down-sampling. The
  /// sector is that of the points kept, within the sector of all.
  int keep_every = 1;
};

// The source's 3-D cone against an obstacle of which a cloud of points or a mesh is known (source, 6.3.3 and
// 6.3.4): planar sectors on planes through the line of sight.

/// Points of a body's section by a plane, in the plane's coordinates.
using PlanePoints = std::function<std::vector<Eigen::Vector2d>(const PlaneFrame&)>;

/// The points of a cloud within `half_thickness` of the plane, projected onto it. A point off the plane
/// stands for one in it, so what comes out is off by up to half_thickness times the slope of the surface, to
/// either side. Keeps the cloud.
[[nodiscard]] PlanePoints points_near_plane(std::vector<Eigen::Vector3d> cloud, double half_thickness);

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
