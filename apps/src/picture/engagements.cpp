// SPDX-License-Identifier: BSD-3-Clause
#include "picture/engagements.h"

#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/geometry/mesh/surface.h>
#include <vericone/internal/cones/combined/cone.h>
#include <vericone/internal/cones/combined/sector.h>
#include <vericone/internal/cones/ellipsoids/plane_sector.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "json/json_value.h"
#include "output/number_text.h"
#include "output/slice_json.h"
#include "picture/course.h"
#include "picture/shape_json.h"

namespace vericone {
namespace {

using Eigen::Matrix3d, Eigen::Vector2d, Eigen::Vector3d;

constexpr double kTolerance = 0.003;  // of the cones, in parts of their solid angle
constexpr int kPlanes = 36;
constexpr double kResolution = 0.09;  // of surfaces

CombinedEllipsoid placed(const CombinedEllipsoid& body, const Vector3d& center, const Matrix3d& r) {
  const Ellipsoid& e = body.ellipsoid();
  std::vector<Delimiter<3>> delimiters;
  for (const auto& d : body.delimiters()) {
    const Matrix3d m = r * d.matrix * r.transpose();
    delimiters.push_back({0.5 * (m + m.transpose()), d.level});
  }
  return {Ellipsoid::from_axes(center, e.semi_axes(), r * e.axis_directions()), delimiters};
}

Json directions_json(const std::vector<Vector3d>& directions) {
  Json all = Json::array();
  for (const Vector3d& d : directions) all.push_back(vector_json(d));
  return all;
}

Json engagement_json(const CombinedEllipsoid& a, const CombinedEllipsoid& b, const CombinedCone& cone,
                     double resolution, int planes) {
  if (cone.relation != Relation::disjoint)
    throw std::runtime_error("the bodies of a figure are not disjoint");
  const CombinedSliceCone slices = combined_slice_cone(a, b, planes);
  return {{"a", solid_json(a, surface(a, resolution))},
          {"b", solid_json(b, surface(b, resolution))},
          {"axis", vector_json(cone.axis)},
          {"inner", directions_json(cone.inner.directions)},
          {"outer", directions_json(cone.outer.directions)},
          {"slices", directions_json(slices.polyhedral().directions)},
          {"planes", planes},
          {"solid_angle", cone.solid_angle},
          {"solid_angle_error", cone.solid_angle_error},
          {"slice_solid_angle", slices.polyhedral().solid_angle}};
}

Json contact_json(const SectorEdge& edge, const Touch& on_a, const Touch& on_b) {
  return {{"on_a", vector_json(edge.point_on_a)},
          {"on_b", vector_json(edge.point_on_b)},
          {"direction", vector_json(edge.direction)},
          {"corner_a", on_a.corner},
          {"corner_b", on_b.corner}};
}

}  // namespace

Json scene_figure(const scenes::Scene& scene, double tolerance, int planes) {
  const CombinedEllipsoid &a = *scene.agent.quadric(), &b = *scene.obstacle.quadric();
  const CombinedCone cone = combined_cone(a, b, tolerance);
  const auto ahead = [&](const Vector3d& d) { return d.dot(b.center() - a.center()) > 0; };
  if (!std::all_of(cone.outer.directions.begin(), cone.outer.directions.end(), ahead)) return nullptr;
  Json json = engagement_json(a, b, cone, kResolution, planes);
  if (scene.agent.velocity != scene.obstacle.velocity) json["course"] = course_json(scene);
  return json;
}

Json section_figure(const CombinedEllipsoid& dented, double resolution) {
  const CombinedEllipsoid a =
      Ellipsoid::from_axes({0, 0, 0}, {1.6, 1.0, 0.8}, rotation_from_heading(0.6, 0.3));
  const Vector3d center(8.5, 1.5, 1);
  const CombinedEllipsoid b = placed(dented, center, rotation_from_heading(1.3, 0.1));
  // The plane that holds the line of centres and comes nearest to the axis of the dents.
  const Vector3d along = center.normalized();
  const Vector3d axis = rotation_from_heading(1.3, 0.1).col(0);
  const Vector3d across = (axis - axis.dot(along) * along).normalized();
  const CombinedEllipse section_a = central_section(a, along, across, Vector2d::Zero()),
                        section_b = central_section(b, along, across, Vector2d(center.norm(), 0));
  const CombinedSector sector = combined_sector(section_a, section_b);
  if (sector.sector.relation != Relation::disjoint)
    throw std::runtime_error("the sections of a figure are not disjoint");
  Json json = engagement_json(a, b, combined_cone(a, b, kTolerance), resolution, kPlanes);
  json["plane"] = {{"x_axis", vector_json(along)}, {"y_axis", vector_json(across)}};
  json["section_a"] = outline_json(section_a);
  json["section_b"] = outline_json(section_b);
  json["tangents"] = {contact_json(sector.sector.left, sector.left_a, sector.left_b),
                      contact_json(sector.sector.right, sector.right_a, sector.right_b)};
  json["psi"] = sector.sector.psi;
  json["theta_b"] = sector.sector.theta_b;
  return json;
}

Json notch_figure(const CombinedEllipsoid& waisted, double resolution) {
  const CombinedEllipsoid a = Ellipsoid::from_axes({0, 0, 0}, {0.4, 0.4, 0.4});
  // Its long axis upright, 10 m before the ball.
  Matrix3d upright;
  upright << 0, 0, -1, 0, 1, 0, 1, 0, 0;
  const CombinedEllipsoid b = placed(waisted, {10, 0, 0}, upright);
  const Vector3d w(10, 1.55, 0);
  const CombinedOracle oracle(a, b);
  // In the cone of the hulls: a mean of two velocities that collide.
  const Vector3d above = w + Vector3d(0, 0, 2.6), below = w - Vector3d(0, 0, 2.6);
  Json json = engagement_json(a, b, combined_cone(a, b, kTolerance), resolution, kPlanes);
  json["course"] = course_json({{Body(a), "", w}, {Body(b)}});
  json["notch"] = {{"above", vector_json(above)},
                   {"above_verdict", to_string(oracle.membership(above))},
                   {"below", vector_json(below)},
                   {"below_verdict", to_string(oracle.membership(below))}};
  return json;
}

Json engagement_picture(const scenes::Scene& scene, int planes, int samples) {
  const Ellipsoid &a = *scene.agent.ellipsoid(), &b = *scene.obstacle.ellipsoid();
  const auto body = [](const Ellipsoid& x) {
    return Json{{"center", vector_json(x.center())}, {"factor", matrix_json(x.factor())}};
  };
  const SliceCone slices = slice_cone(a, b, planes);
  const TrueCone exact = true_cone(a, b, samples);
  const PolyhedralCone polygon = slices.polyhedral();
  Json result{{"agent", body(a)},
              {"obstacle", body(b)},
              {"planes", planes},
              {"samples", samples},
              {"slice_directions", polyhedral_json(polygon)["directions"]},
              {"slice_area", number_or_null(polygon.cross_section_area)},
              {"exact_area", number_or_null(exact.cross_section_area)}};
  Json directions = Json::array();
  for (const auto& s : exact.boundary) directions.push_back(vector_json(s.direction));
  result["exact_directions"] = directions;

  // The velocity in the gap: half-way between both edges on the plane where they are farthest apart.
  const AxisFrame frame(slices.axis);
  double widest = -1;
  Eigen::Vector3d w = slices.axis;
  for (const Slice& s : slices.slices) {
    const Eigen::Vector3d across = frame.across(s.azimuth);
    const PlaneSector sector = true_sector(a, b, across);
    for (const double side : {1.0, -1.0}) {
      const double inner = side > 0 ? s.left : s.right,
                   outer = side > 0 ? sector.left.angle : sector.right.angle;
      if (outer - inner <= widest) continue;
      widest = outer - inner;
      const double middle = 0.5 * (inner + outer);
      w = std::cos(middle) * sector.line_of_sight + side * std::sin(middle) * sector.across;
      result["gap_degrees"] = degrees(widest);
      result["gap_angles_degrees"] = {degrees(inner), degrees(middle), degrees(outer)};
    }
  }
  const Json gap = course_json({{Body(a), "", w}, {Body(b)}});
  for (const auto& [name, value] : gap.items()) result["gap_" + name] = value;
  if (scene.agent.velocity != scene.obstacle.velocity) result["course"] = course_json(scene);
  return result;
}

}  // namespace vericone
