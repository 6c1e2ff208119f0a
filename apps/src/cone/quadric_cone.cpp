// SPDX-License-Identifier: BSD-3-Clause
#include "cone/quadric_cone.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <ostream>

#include "cone/degrees.h"
#include "cone/verdict_text.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/number_text.h"
#include "output/slice_json.h"

namespace vericone {
namespace {

const char* name_of(const std::optional<Relation>& relation) {
  return relation ? to_string(*relation) : "undecided";
}

Json json_of(const ExactCone& found, const scenes::Scene& /*scene*/) {
  const TrueCone& cone = found.cone;
  Json result{{"method", "exact"},
              {"samples", found.samples},
              {"relation", to_string(cone.relation)},
              {"axis", vector_json(cone.axis)}};
  Json directions = Json::array();
  for (const auto& s : cone.boundary) directions.push_back(vector_json(s.direction));
  result["directions"] = directions;
  if (found.bounds) {
    const ConeBounds& bounds = *found.bounds;
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
  result["seconds"] = found.seconds;
  return result;
}

Json json_of(const CertifiedCone& found, const scenes::Scene& /*scene*/) {
  const CombinedCone& cone = found.cone;
  const bool known = cone.relation.has_value();
  Json result{{"method", "certified"},
              {"tolerance", found.tolerance},
              {"relation", name_of(cone.relation)},
              {"axis", vector_json(cone.axis)},
              {"directions", nullptr}};  // the boundary is somewhere between inner and outer
  result["solid_angle"] = known ? number_or_null(cone.solid_angle) : Json(nullptr);
  result["cross_section_area"] = known ? number_or_null(cone.cross_section_area) : Json(nullptr);
  result["inner"] = known ? polyhedral_json(cone.inner) : Json(nullptr);
  result["outer"] = known ? polyhedral_json(cone.outer) : Json(nullptr);
  result["error_bound"] = known ? number_or_null(cone.solid_angle_error) : Json(nullptr);
  result["cross_section_area_error_bound"] =
      known ? number_or_null(cone.cross_section_area_error) : Json(nullptr);
  result["seconds"] = found.seconds;
  return result;
}

Json json_of(const SlicedCone& cone, const scenes::Scene& scene) {
  Json result{{"method", "slice"},
              {"planes", cone.planes},
              {"relation", name_of(cone.relation)},
              {"axis", vector_json(cone.axis)}};
  result.update(polyhedral_json(cone.polyhedral));
  if (!cone.relation) result["solid_angle"] = nullptr;
  if (cone.combined) result["planes_with_overlapping_hulls"] = cone.combined->hulls_overlap;
  if (cone.sectors != SliceSector::all_candidates) {
    result["planes_without_tangents"] = cone.combined->source_failures;
    result["planes_with_wrong_tangents"] = cone.combined->source_differences;
  }
  Json sectors = Json::array();
  for (const Slice& s : cone.slices)
    sectors.push_back(sector_json(s, cone.axis, scene.agent.velocity, scene.obstacle.velocity));
  result["sectors"] = sectors;
  // Slices miss part of the cone and cannot tell how much: no bound, no outer cone.
  result["inner"] = nullptr;
  result["outer"] = nullptr;
  result["error_bound"] = nullptr;
  result["seconds"] = cone.seconds;
  return result;
}

void print_method(const char* method, const std::string& setting, const std::optional<Relation>& relation,
                  std::ostream& out) {
  out << "method              " << method << ", " << setting << '\n'
      << "bodies              " << name_of(relation) << '\n';
}

void print_area(double area, double error, std::ostream& out) {
  out << "cross-section area  ";
  if (std::isfinite(area))
    out << number_within(area, error) << " (at distance 1)\n";
  else
    out << "unbounded (the cone reaches 90 degrees from its axis)\n";
}

/// `found`: ConeBounds or CombinedCone.
template <typename Bounded>
void print_bounded(const Bounded& found, std::ostream& out) {
  out << "solid angle         " << number_within(found.solid_angle, found.solid_angle_error)
      << " sr, proved between " << bounds_text(found.inner.solid_angle, found.outer.solid_angle) << " sr\n";
  print_area(found.cross_section_area, found.cross_section_area_error, out);
}

void print(const ExactCone& found, const scenes::Scene& /*scene*/, std::ostream& out) {
  print_method("exact", std::to_string(found.samples) + " samples", found.cone.relation, out);
  if (found.bounds)
    print_bounded(*found.bounds, out);
  else
    out << "solid angle         " << number_text(found.cone.solid_angle) << " sr\n";
}

void print(const CertifiedCone& found, const scenes::Scene& /*scene*/, std::ostream& out) {
  print_method("certified", "tolerance " + number_text(found.tolerance), found.cone.relation, out);
  if (found.cone.relation) print_bounded(found.cone, out);
}

void print(const SlicedCone& cone, const scenes::Scene& scene, std::ostream& out) {
  print_method("slice", std::to_string(cone.planes) + " planes", cone.relation, out);
  if (cone.relation) {
    out << "solid angle         " << number_text(cone.polyhedral.solid_angle) << " sr\n";
    print_area(cone.polyhedral.cross_section_area, 0, out);
  }
  if (!cone.slices.empty()) {
    const Slice& widest = *std::max_element(cone.slices.begin(), cone.slices.end(),
                                            [](const Slice& x, const Slice& y) { return x.psi() < y.psi(); });
    const ConeFunction f = plane_function(widest, cone.axis, scene.agent.velocity, scene.obstacle.velocity);
    out << "widest plane        " << number_text(degrees(widest.psi())) << " degrees, the source's y "
        << (widest.psi() <= std::numbers::pi ? number_text(f.y) : "not defined") << '\n';
  }
  if (cone.sectors != SliceSector::all_candidates)
    out << "source's tangents   none on " << cone.combined->source_failures << " planes, wrong on "
        << cone.combined->source_differences << '\n';
  out << "note                slices see only contacts within their planes: "
      << (ellipsoids(scene) ? "the true cone is larger\n"
                            : "they are in the true cone, what lies between them need not be\n");
}

}  // namespace

bool ellipsoids(const scenes::Scene& scene) { return scene.agent.ellipsoid() && scene.obstacle.ellipsoid(); }

ExactCone exact_cone(const Ellipsoid& a, const Ellipsoid& b, int samples) {
  const auto start = Clock::now();
  ExactCone result{samples, true_cone(a, b, samples), {}};
  if (result.cone.relation == Relation::disjoint) result.bounds = cone_bounds(result.cone, a, b);
  result.seconds = seconds_since(start);
  return result;
}

CertifiedCone certified_cone(const CombinedEllipsoid& a, const CombinedEllipsoid& b, double tolerance) {
  const auto start = Clock::now();
  CertifiedCone result{tolerance, combined_cone(a, b, tolerance)};
  result.seconds = seconds_since(start);
  return result;
}

SlicedCone sliced_cone(const scenes::Scene& scene, int planes, SliceSector sectors) {
  const auto start = Clock::now();
  SlicedCone result{planes, sectors, {}, {}, {}, {}, {}};
  const auto take = [&](const auto& cone) {
    result.relation = cone.relation;
    result.axis = cone.axis;
    result.slices = cone.slices;
    result.polyhedral = cone.polyhedral();
  };
  if (ellipsoids(scene) && sectors == SliceSector::all_candidates) {
    take(slice_cone(*scene.agent.ellipsoid(), *scene.obstacle.ellipsoid(), planes));
  } else {
    result.combined = combined_slice_cone(*scene.agent.quadric(), *scene.obstacle.quadric(), planes, sectors);
    take(*result.combined);
  }
  result.seconds = seconds_since(start);
  return result;
}

std::optional<Relation> relation_of(const QuadricCone& cone) {
  struct {
    std::optional<Relation> operator()(const ExactCone& found) const { return found.cone.relation; }
    std::optional<Relation> operator()(const CertifiedCone& found) const { return found.cone.relation; }
    std::optional<Relation> operator()(const SlicedCone& found) const { return found.relation; }
  } relation;
  return cone.ask(relation);
}

Json to_json(const QuadricCone& cone, const scenes::Scene& scene) {
  return cone.ask([&](const auto& found) { return json_of(found, scene); });
}

void print_text(const QuadricCone& cone, const scenes::Scene& scene, std::ostream& out) {
  print_verdict(scene, out);
  cone.ask([&](const auto& found) { print(found, scene, out); });
}

void print_time(const QuadricCone& cone, std::ostream& out) {
  const double seconds = cone.ask([](const auto& found) { return found.seconds; });
  out << "time                " << number_text(seconds, 2) << " s\n";
}

}  // namespace vericone
