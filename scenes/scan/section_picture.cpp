// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/slices/visible_cone.h>
#include <vericone/geometry/combined.h>
#include <vericone/internal/cones/slices/visible_sector.h>
#include <vericone/internal/geometry/mesh/mesh_section.h>
#include <vericone/internal/scanning/picture.h>
#include <cmath>
#include <limits>
#include <numbers>

#include "scan/study_parts.h"

namespace vericone::scanning {

using Eigen::Vector2d;
using Eigen::Vector3d;

PlaneSectionPicture plane_section_picture(const Setup& setup, double azimuth) {
  const lidar::MeshScene scene(setup.points, setup.triangles);
  const AssemblyOracle whole = oracle_of(setup, Assembly::mesh(setup.points, setup.triangles));
  const Seen seen = look(setup, scene, setup.lidars);
  const Vector3d& center = setup.agent.center();
  std::vector<Vector3d> where_they_are;
  for (const lidar::Scan& scan : seen.scans)
    for (const lidar::Return& r : scan.returns) where_they_are.push_back(r.in_world);
  const AxisFrame frame(center_of(seen.not_fused.empty() ? seen.points : where_they_are) - center);
  const PlaneFrame plane{center, frame.axis, frame.across(azimuth)};

  PlaneSectionPicture picture;
  picture.half_thickness = seen.half_thickness;
  const CombinedEllipse section =
      central_section(CombinedEllipsoid(setup.agent), plane.x_axis, plane.y_axis, Vector2d::Zero());
  constexpr int kOutline = 256;
  for (int i = 0; i < kOutline; ++i) {
    const double t = 2 * std::numbers::pi * i / kOutline;
    picture.agent.emplace_back(section.ellipsoid().factor() * Vector2d(std::cos(t), std::sin(t)));
  }
  for (SectionLine& line : mesh_section(setup.points, setup.triangles, plane)) {
    if (line.closed) line.points.push_back(line.points.front());
    picture.obstacle.push_back(std::move(line.points));
  }
  for (const lidar::Scan& scan : seen.scans)
    picture.sensors.push_back(plane.direction_to_plane(scan.pose.translation() - center));
  const PlanePoints near = points_near_plane(seen.points, seen.half_thickness);
  picture.returns = near(plane);

  const VisibleSector sector = [&] {
    std::vector<Vector2d> chain = picture.returns;
    order_by_bearing(chain);
    return visible_sector(section.ellipsoid(), chain);
  }();
  picture.tried = sector.tried;
  picture.reason = !seen.not_fused.empty() ? seen.not_fused : sector.sector ? "" : to_string(sector.reason);
  if (sector.sector) {
    picture.psi = sector.sector->psi;
    picture.theta_b = sector.sector->theta_b;
    for (const SectorEdge* edge : {&sector.sector->left, &sector.sector->right})
      picture.tangents.push_back({edge->point_on_a, edge->point_on_b});
  }
  const auto edge = [&](double side) {
    const ExtremeDirection e = whole.extreme(plane.x_axis, side * plane.y_axis, 1e-7);
    return e.any ? 0.5 * (e.low + e.high) : std::numeric_limits<double>::quiet_NaN();
  };
  picture.whole_left = edge(1);
  picture.whole_right = edge(-1);
  return picture;
}

}  // namespace vericone::scanning
