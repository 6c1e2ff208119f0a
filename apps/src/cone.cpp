// SPDX-License-Identifier: BSD-3-Clause
#include "cone.h"

#include <vericone/cones/clearance.h>
#include <vericone/cones/exact_cone.h>
#include <vericone/cones/plane_sector.h>
#include <vericone/cones/sector.h>
#include <vericone/cones/slice_cone.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <ostream>

#include "figures.h"
#include "input/scene.h"
#include "provenance.h"

namespace vericone {
namespace {

using Json = nlohmann::ordered_json;

Json vector_json(const Eigen::Vector3d& v) { return {v.x(), v.y(), v.z()}; }

Json number_or_null(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json polyhedral_json(const PolyhedralCone& cone) {
  Json directions = Json::array();
  for (const auto& d : cone.directions) directions.push_back(vector_json(d));
  return {{"directions", directions},
          {"solid_angle", cone.solid_angle},
          {"cross_section_area", number_or_null(cone.cross_section_area)}};
}

Json exact_json(const Ellipsoid& a, const Ellipsoid& b, int samples) {
  const auto start = std::chrono::steady_clock::now();
  const ExactCone cone = exact_cone(a, b, samples);
  Json result{{"method", "exact"},
              {"samples", samples},
              {"relation", to_string(cone.relation)},
              {"axis", vector_json(cone.axis)}};
  Json directions = Json::array();
  for (const auto& s : cone.boundary) directions.push_back(vector_json(s.direction));
  result["directions"] = directions;
  if (cone.relation == Relation::disjoint) {
    const ConeBounds bounds = cone_bounds(cone, a, b);
    result["solid_angle"] = bounds.solid_angle;
    result["cross_section_area"] = number_or_null(bounds.cross_section_area);
    result["inner"] = polyhedral_json(bounds.inner);
    result["outer"] = polyhedral_json(bounds.outer);
    result["error_bound"] = bounds.solid_angle_error;
    result["cross_section_area_error_bound"] = number_or_null(bounds.cross_section_area_error);
  } else {
    // Half-space and full space are known exactly; they have no edges.
    result["solid_angle"] = cone.solid_angle;
    result["cross_section_area"] = nullptr;
    for (const char* side : {"inner", "outer"})
      result[side] = {
          {"directions", Json::array()}, {"solid_angle", cone.solid_angle}, {"cross_section_area", nullptr}};
    result["error_bound"] = 0.0;
    result["cross_section_area_error_bound"] = nullptr;
  }
  result["seconds"] = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return result;
}

Json slice_json(const input::Engagement& e, int planes) {
  const Ellipsoid &a = e.agent, &b = e.obstacle;
  const auto start = std::chrono::steady_clock::now();
  const SliceCone cone = slice_cone(a, b, planes);
  const PolyhedralCone polyhedral = cone.polyhedral();
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  Json result{{"method", "slice"},
              {"planes", planes},
              {"relation", to_string(cone.relation)},
              {"axis", vector_json(cone.axis)}};
  result.update(polyhedral_json(polyhedral));
  // The source's y on each plane (6.14), with the velocities projected on the line of sight and across it.
  Json sectors = Json::array();
  for (const Slice& s : cone.slices) {
    const AxisFrame frame(cone.axis);
    const Eigen::Vector3d across = std::cos(s.azimuth) * frame.e1 + std::sin(s.azimuth) * frame.e2;
    const auto in_plane = [&](const Eigen::Vector3d& v) {
      return Eigen::Vector2d(v.dot(cone.axis), v.dot(across));
    };
    const ConeFunction y =
        cone_function(s.psi(), s.theta_b(), in_plane(e.agent_velocity), in_plane(e.obstacle_velocity));
    sectors.push_back({{"azimuth", s.azimuth},
                       {"psi", s.psi()},
                       {"theta_b", s.theta_b()},
                       {"y", y.y},
                       {"v_r_hat", y.v_r_hat},
                       {"v_theta_hat", y.v_theta_hat}});
  }
  result["sectors"] = sectors;
  // Slices miss part of the cone and cannot tell how much: no bound, no outer cone.
  result["inner"] = nullptr;
  result["outer"] = nullptr;
  result["error_bound"] = nullptr;
  result["seconds"] = seconds;
  return result;
}

double degrees(double x) { return x * 180 / std::numbers::pi; }

void print_text(const Json& cone, const input::Engagement& e, std::ostream& out) {
  const auto area = [](const Json& value) {
    return value.is_null() ? std::string("unbounded (the cone reaches 90 degrees from its axis)")
                           : to_text(value.get<double>());
  };
  out << "method              " << cone["method"].get<std::string>() << ", "
      << (cone.contains("planes") ? cone["planes"].dump() + " planes" : cone["samples"].dump() + " samples")
      << '\n'
      << "bodies              " << cone["relation"].get<std::string>() << '\n'
      << "solid angle         " << cone["solid_angle"].dump() << " sr\n"
      << "cross-section area  " << area(cone["cross_section_area"]) << " (at distance 1)\n";
  if (cone["error_bound"].is_number())
    out << "error bound         " << cone["error_bound"].dump() << " sr, certified: inner "
        << cone["inner"]["solid_angle"].dump() << " sr, outer " << cone["outer"]["solid_angle"].dump()
        << " sr\n";
  if (cone["method"] == "slice" && !cone["sectors"].empty()) {
    const auto& sectors = cone["sectors"];
    const auto widest = *std::max_element(sectors.begin(), sectors.end(), [](const Json& x, const Json& y) {
      return x["psi"].get<double>() < y["psi"].get<double>();
    });
    out << "widest plane        psi " << to_text(degrees(widest["psi"].get<double>())) << " degrees, y "
        << to_text(widest["y"].get<double>()) << '\n';
  }
  if (cone["method"] == "slice")
    out << "note                slices see only contacts within their planes: the true cone is larger\n";
  const ConeOracle oracle(e.agent, e.obstacle);
  out << "verdict             " << to_string(oracle.verdict(e.agent_velocity, e.obstacle_velocity))
      << " (of the scene's velocities, exact)\n";
  out << "time                " << cone["seconds"].dump() << " s\n";
}

}  // namespace

Json engagement_picture(const Ellipsoid& a, const Ellipsoid& b, int planes, int samples) {
  const auto body = [](const Ellipsoid& e) {
    Json factor = Json::array();
    for (int i = 0; i < 3; ++i) factor.push_back(vector_json(e.factor().row(i)));
    return Json{{"center", vector_json(e.center())}, {"factor", factor}};
  };
  const SliceCone slices = slice_cone(a, b, planes);
  const ExactCone exact = exact_cone(a, b, samples);
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
    const Eigen::Vector3d across = std::cos(s.azimuth) * frame.e1 + std::sin(s.azimuth) * frame.e2;
    const PlaneSector sector = exact_sector(a, b, across);
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
  result["gap_velocity"] = vector_json(w);
  result["gap_verdict"] = to_string(ConeOracle(a, b).membership(w));
  if (const auto t = time_to_contact(a, b, w)) {
    result["gap_contact_time"] = *t;
    // At contact the supporting point of A towards B is the common one.
    const Ellipsoid moved = a.translated(*t * w);
    const Eigen::Vector3d n = ConeOracle(moved.translated(-1e-9 * *t * w), b).separating_normal();
    result["gap_contact_point"] = vector_json(moved.support_point(n));
  }
  return result;
}

void run_cone(const ConeOptions& options, std::ostream& out) {
  if (options.method != "exact" && options.method != "slice")
    throw InputError("--method", options.method, "slice or exact");
  const input::Engagement e = input::read_scene(options.scene);
  const Json cone = options.method == "exact" ? exact_json(e.agent, e.obstacle, options.samples)
                                              : slice_json(e, options.planes);
  if (options.json) {
    out << cone.dump(1) << '\n';
  } else {
    print_text(cone, e, out);
  }
  if (!options.picture_folder.empty()) {
    if (relation<3>(e.agent, e.obstacle) != Relation::disjoint)
      throw InputError("--picture", options.picture_folder, "asked for disjoint bodies only");
    const std::filesystem::path folder = options.picture_folder;
    std::filesystem::create_directories(folder);
    write_whole(folder / "engagement.json",
                engagement_picture(e.agent, e.obstacle, options.planes, options.samples).dump(1) + "\n");
    for (const auto& picture : draw_figures("engagement.py", folder))
      if (!options.json) out << "picture             " << picture.string() << '\n';
  }
}

}  // namespace vericone
