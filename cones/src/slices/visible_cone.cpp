// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/slices/visible_cone.h>
#include <vericone/geometry/combined.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/slices/visible_sector.h>
#include <vericone/internal/geometry/mesh/mesh_section.h>
#include <algorithm>
#include <cmath>
#include <limits>

#include "slices/on_planes.h"

namespace vericone {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

/// `sector_on(frame, chain)`: the sector of the agent's section, about the plane's origin, and the chain.
template <typename SectorOn>
VisibleCone cone(const Vector3d& center, const PlanePoints& obstacle, const Vector3d& towards, int planes,
                 const SectorOn& sector_on) {
  require_planes(planes);
  const Vector3d sight = towards - center;
  if (!sight.allFinite() || !(sight.norm() > 0))
    throw InputError("towards", "the agent's centre or no finite point", "another point");
  VisibleCone cone;
  const AxisFrame frame(sight);
  cone.axis = frame.axis;
  on_planes(frame, planes, [&](double azimuth, const Vector3d& across) {
    const PlaneFrame where{center, frame.axis, across};
    std::vector<Vector2d> chain = obstacle(where);
    order_by_bearing(chain);
    const VisibleSector result = sector_on(where, chain);
    VisiblePlane plane{azimuth, std::nullopt, result.reason, chain.size(), result.tried};
    if (result.sector) plane.slice = slice_of(azimuth, *result.sector);
    cone.planes.push_back(plane);
    return true;
  });
  return cone;
}

}  // namespace

void order_by_bearing(std::vector<Vector2d>& points) {
  std::vector<std::pair<double, Vector2d>> keyed;
  keyed.reserve(points.size());
  for (const Vector2d& p : points) keyed.emplace_back(std::atan2(p.y(), p.x()), p);
  std::sort(keyed.begin(), keyed.end(), [](const auto& x, const auto& y) {
    return x.first != y.first ? x.first < y.first : x.second.squaredNorm() < y.second.squaredNorm();
  });
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = keyed[i].second;
}

PlanePoints points_near_plane(std::vector<Vector3d> cloud, double half_thickness) {
  if (!(half_thickness >= 0))
    throw InputError("half_thickness", to_text(half_thickness), "a number from 0 up (metres)");
  return [cloud = std::move(cloud), half_thickness](const PlaneFrame& plane) {
    const Vector3d normal = plane.normal();
    std::vector<Vector2d> near;
    for (const Vector3d& p : cloud)
      if (std::abs(normal.dot(p - plane.origin)) <= half_thickness)
        near.push_back(plane.direction_to_plane(p - plane.origin));
    return near;
  };
}

double slab_half_thickness(std::span<const Vector3d> cloud, const Vector3d& sensor, double spacing) {
  double farthest = 0;
  for (const Vector3d& p : cloud) farthest = std::max(farthest, (p - sensor).norm());
  return 0.5 * spacing * farthest;
}

PlanePoints mesh_section_points(std::vector<Vector3d> points,
                                std::vector<std::array<std::uint32_t, 3>> triangles) {
  return [points = std::move(points), triangles = std::move(triangles)](const PlaneFrame& plane) {
    std::vector<Vector2d> all;
    for (const SectionLine& line : mesh_section(points, triangles, plane))
      all.insert(all.end(), line.points.begin(), line.points.end());
    return all;
  };
}

std::size_t VisibleCone::planes_without_answer() const {
  return static_cast<std::size_t>(
      std::count_if(planes.begin(), planes.end(), [](const VisiblePlane& p) { return !p.slice; }));
}

PolyhedralCone VisibleCone::polyhedral() const {
  SliceCone slices{Relation::disjoint, axis, {}};
  for (const VisiblePlane& plane : planes)
    if (plane.slice && plane.slice->left > 0 && plane.slice->right > 0) slices.slices.push_back(*plane.slice);
  if (slices.slices.size() >= 2) return slices.polyhedral();
  PolyhedralCone unknown;
  unknown.solid_angle = unknown.cross_section_area = std::numeric_limits<double>::quiet_NaN();
  return unknown;
}

VisibleCone visible_cone(const Ellipsoid& agent, const PlanePoints& obstacle, const Vector3d& towards,
                         int planes, const VisibleConeOptions& options) {
  const CombinedEllipsoid body(agent);
  return cone(agent.center(), obstacle, towards, planes,
              [&](const PlaneFrame& plane, const std::vector<Vector2d>& chain) {
                const CombinedEllipse section =
                    central_section(body, plane.x_axis, plane.y_axis, Vector2d::Zero());
                return options.by_search ? visible_sector(section.ellipsoid(), chain, options.search)
                                         : sector_of_points(section.ellipsoid(), chain);
              });
}

VisibleCone visible_cone(const Vector3d& center, const PlanePoints& agent, const PlanePoints& obstacle,
                         const Vector3d& towards, int planes, const VisibleConeOptions& options) {
  return cone(center, obstacle, towards, planes,
              [&](const PlaneFrame& plane, const std::vector<Vector2d>& chain) {
                const std::vector<Vector2d> section = agent(plane);
                return options.by_search ? visible_sector(section, chain, options.search)
                                         : sector_of_points(section, chain);
              });
}

}  // namespace vericone
