// SPDX-License-Identifier: BSD-3-Clause
#include <vericone/cones/slices/visible_cone.h>
#include <vericone/geometry/error.h>
#include <vericone/internal/cones/assembly/assembly_oracle.h>
#include <vericone/internal/cones/cone_size.h>
#include <vericone/internal/cones/slices/visible_sector.h>
#include <vericone/lidar/lidar.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>

#include "input/stopwatch.h"
#include "scan/study_parts.h"

namespace vericone::scanning {
namespace {

using Eigen::Vector3d;
using std::numbers::pi;

constexpr double kAngle = 1e-7;  // rad, to which the true cones are found
constexpr int kMostLevels = 12;

/// Between every two angles `factor` - 1 more at equal steps; after the last one of a full turn, too.
std::vector<double> finer(const std::vector<double>& angles, int factor) {
  std::vector<double> all;
  const std::size_t n = angles.size();
  const bool turn =
      n > 2 && std::abs((angles[n - 1] - angles[0]) * double(n) / double(n - 1) - 2 * pi) < 1e-6;
  for (std::size_t i = 0; i < n; ++i) {
    all.push_back(angles[i]);
    if (i + 1 == n && !turn) break;
    const double next = i + 1 < n ? angles[i + 1] : angles[0] + 2 * pi;
    for (int k = 1; k < factor; ++k) all.push_back(angles[i] + (next - angles[i]) * k / factor);
  }
  return all;
}

void set_solid_angle(HalfPlaneCone& cone, const Vector3d& axis) {
  const AxisFrame frame(axis);
  std::vector<Vector3d> directions;
  const int count = static_cast<int>(cone.edges.size());
  cone.solid_angle = std::numeric_limits<double>::quiet_NaN();
  for (int j = 0; j < count; ++j) {
    const double edge = cone.edges[j], azimuth = 2 * pi * j / count;
    if (!(edge > 0)) return;
    directions.push_back(std::cos(edge) * frame.axis + std::sin(edge) * frame.across(azimuth));
  }
  cone.solid_angle = polygon_solid_angle(axis, directions);
}

HalfPlaneCone half_planes(const VisibleCone& cone) {
  HalfPlaneCone result;
  for (const bool left : {true, false})
    for (const VisiblePlane& plane : cone.planes)
      result.edges.push_back(!plane.slice ? std::numeric_limits<double>::quiet_NaN()
                             : left       ? plane.slice->left
                                          : plane.slice->right);
  set_solid_angle(result, cone.axis);
  return result;
}

HalfPlaneCone true_cone(const AssemblyOracle& oracle, const Vector3d& axis, int planes) {
  const AxisFrame frame(axis);
  HalfPlaneCone result;
  for (int j = 0; j < 2 * planes; ++j) {
    const double azimuth = pi * j / planes;
    const ExtremeDirection edge = oracle.extreme(frame.axis, frame.across(azimuth), kAngle);
    result.edges.push_back(edge.any ? 0.5 * (edge.low + edge.high)
                                    : std::numeric_limits<double>::quiet_NaN());
  }
  set_solid_angle(result, axis);
  return result;
}

void check(const Setup& setup) {
  if (setup.levels < 1 || setup.levels > kMostLevels)
    throw InputError("levels", std::to_string(setup.levels),
                     "a whole number from 1 to " + std::to_string(kMostLevels));
  if (setup.planes < 2 || setup.planes > 10'000)
    throw InputError("planes", std::to_string(setup.planes), "a whole number from 2 to 10000");
  for (const auto& [field, value] :
       {std::pair("position_error", setup.position_error), std::pair("rotation_error", setup.rotation_error)})
    if (!(value >= 0 && std::isfinite(value)))
      throw InputError(field, to_text(value), "a finite number from 0 up (metres, radians)");
  if (setup.lidars.empty()) throw InputError("lidars", "none", "at least one");
}

double area(const Setup& setup) {
  double sum = 0;
  for (const auto& t : setup.triangles) {
    const Vector3d& a = setup.points[t[0]];
    sum += 0.5 * (setup.points[t[1]] - a).cross(setup.points[t[2]] - a).norm();
  }
  return sum;
}

}  // namespace

std::vector<lidar::Lidar> finer(const std::vector<lidar::Lidar>& lidars, int factor) {
  std::vector<lidar::Lidar> all = lidars;
  for (lidar::Lidar& l : all) {
    l.beams.elevations = finer(l.beams.elevations, factor);
    l.beams.azimuths = finer(l.beams.azimuths, factor);
  }
  return all;
}

Seen look(const Setup& setup, const lidar::MeshScene& scene, const std::vector<lidar::Lidar>& lidars) {
  Seen seen;
  for (std::size_t i = 0; i < lidars.size(); ++i) {
    seen.scans.push_back(lidar::scan(scene, lidars[i], setup.agent_pose, setup.seed + i));
    const lidar::Scan& scan = seen.scans.back();
    const std::vector<Vector3d> points = scan.world_points();
    seen.half_thickness = std::max(
        seen.half_thickness, slab_half_thickness(points, scan.pose.translation(), lidars[i].beams.spacing()));
    seen.points.insert(seen.points.end(), points.begin(), points.end());
  }
  if (lidars.size() > 1 && (setup.position_error > 0 || setup.rotation_error > 0)) fuse_scans(setup, seen);
  return seen;
}

Vector3d center_of(const std::vector<Vector3d>& points) {
  if (points.empty()) throw InputError("lidars", "no returns", "lidars that see the obstacle");
  Vector3d center = Vector3d::Zero();
  for (const Vector3d& p : points) center += p / double(points.size());
  return center;
}

AssemblyOracle oracle_of(const Setup& setup, Assembly obstacle) {
  AssemblyOracle oracle(setup.agent, obstacle);
  if (oracle.relation() != Relation::disjoint)
    throw InputError("agent", to_string(oracle.relation()), "apart from the obstacle for it to have a cone");
  return oracle;
}

Study study(const Setup& setup, const std::function<void(const std::string& line)>& told) {
  check(setup);
  Study study;
  const lidar::MeshScene scene(setup.points, setup.triangles);
  const AssemblyOracle whole = oracle_of(setup, Assembly::mesh(setup.points, setup.triangles));

  const std::vector<lidar::Lidar> finest = finer(setup.lidars, 1 << (setup.levels - 1));
  Setup exact = setup;  // the axis and what can be seen do not depend on how well poses are known
  exact.position_error = exact.rotation_error = 0;
  const Seen most = look(exact, scene, finest);
  const Vector3d towards = center_of(most.points);
  study.axis = (towards - setup.agent.center()).normalized();

  for (int k = 0; k < setup.levels; ++k) {
    Level level;
    level.fineness = 1 << k;
    const std::vector<lidar::Lidar> lidars = finer(setup.lidars, level.fineness);
    auto start = Clock::now();
    const Seen seen = look(setup, scene, lidars);
    level.seconds_scan = seconds_since(start);
    level.not_fused = seen.not_fused;
    level.fusion_error = seen.fusion_error;
    for (std::size_t i = 0; i < lidars.size(); ++i) {
      const lidar::Scan& scan = seen.scans[i];
      level.beams += scan.beams.size();
      level.returned += scan.count(lidar::Beam::returned);
      level.missed += scan.count(lidar::Beam::missed);
      level.dropped += scan.count(lidar::Beam::dropped);
      level.too_near += scan.count(lidar::Beam::too_near);
      level.spacing = std::max(level.spacing, lidars[i].beams.spacing());
    }
    const std::vector<double> nothing(2 * setup.planes, std::numeric_limits<double>::quiet_NaN());
    level.sections.edges = level.cone.edges = nothing;
    level.sections.solid_angle = level.cone.solid_angle = nothing[0];
    level.planes_without_answer = setup.planes;
    if (!seen.points.empty()) {
      start = Clock::now();
      const VisibleCone sections = visible_cone(
          setup.agent, points_near_plane(seen.points, seen.half_thickness), towards, setup.planes);
      level.seconds_sections = seconds_since(start);
      level.sections = half_planes(sections);
      level.planes_without_answer = static_cast<int>(sections.planes_without_answer());
      for (const VisiblePlane& plane : sections.planes) level.tried += double(plane.tried) / setup.planes;
      start = Clock::now();
      // Noise may put a point into the agent.
      const AssemblyOracle oracle(setup.agent, Assembly::cloud(seen.points, 0));
      if (oracle.relation() == Relation::disjoint) level.cone = true_cone(oracle, study.axis, setup.planes);
      level.seconds_cone = seconds_since(start);
    }
    if (told) {
      std::ostringstream line;
      line << level.beams << " beams, " << level.returned << " returns, " << level.seconds_scan << " s";
      told(line.str());
    }
    study.levels.push_back(std::move(level));
  }

  double nearest = std::numeric_limits<double>::infinity();
  for (const lidar::Scan& scan : most.scans)
    for (const lidar::Return& r : scan.returns) nearest = std::min(nearest, r.in_sensor.norm());
  const lidar::SurfacePart part =
      lidar::visible_part(scene, setup.points, setup.triangles, finest, setup.agent_pose,
                          0.25 * study.levels.back().spacing * nearest);
  if (part.triangles.empty()) throw InputError("lidars", "nothing seen", "lidars that see the obstacle");
  study.visible_area = part.area;
  study.whole_area = area(setup);
  const VisibleConeOptions directly{.search = {}, .by_search = false};
  study.visible_sections = half_planes(visible_cone(
      setup.agent, mesh_section_points(part.points, part.triangles), towards, setup.planes, directly));
  study.visible_cone =
      true_cone(oracle_of(setup, Assembly::mesh(part.points, part.triangles)), study.axis, setup.planes);
  study.whole_sections = half_planes(visible_cone(
      setup.agent, mesh_section_points(setup.points, setup.triangles), towards, setup.planes, directly));
  study.whole_cone = true_cone(whole, study.axis, setup.planes);
  if (told) told(std::to_string(part.triangles.size()) + " pieces of the surface seen");
  return study;
}

}  // namespace vericone::scanning
