// SPDX-License-Identifier: BSD-3-Clause
#include "cone/quadric_cone.h"

#include <vericone/cones/ellipsoids/true_cone.h>
#include <vericone/cones/slices/slice_cone.h>
#include <vericone/internal/cones/combined/cone.h>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>
#include <utility>
#include <vector>

#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/number_text.h"
#include "output/slice_json.h"

namespace vericone {
namespace {

const char* name_of(const std::optional<Relation>& relation) {
  return relation ? to_string(*relation) : "undecided";
}

Json exact_json(const TrueCone& cone, const std::optional<ConeBounds>& found, int samples) {
  Json result{{"method", "exact"},
              {"samples", samples},
              {"relation", to_string(cone.relation)},
              {"axis", vector_json(cone.axis)}};
  Json directions = Json::array();
  for (const auto& s : cone.boundary) directions.push_back(vector_json(s.direction));
  result["directions"] = directions;
  if (found) {
    const ConeBounds& bounds = *found;
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
  return result;
}

Json certified_json(const CombinedCone& cone, double tolerance) {
  const bool known = cone.relation.has_value();
  Json result{{"method", "certified"},
              {"tolerance", tolerance},
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
  return result;
}

/// By slices, of either kind.
struct Slices {
  int planes = 0;
  SliceSector sectors = SliceSector::all_candidates;
  std::optional<Relation> relation;
  Eigen::Vector3d axis;
  std::vector<Slice> slices;
  PolyhedralCone polyhedral;
  std::optional<CombinedSliceCone> combined;  // what it says besides, where it was asked
};

Json sliced_json(const Slices& cone, const scenes::Scene& scene) {
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

void print_sliced(const Slices& cone, const scenes::Scene& scene, std::ostream& out) {
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

QuadricCone told(const std::optional<Relation>& relation, Json json, const std::ostringstream& text,
                 double seconds) {
  json["seconds"] = seconds;
  return {relation, std::move(json), text.str(), seconds};
}

}  // namespace

bool ellipsoids(const scenes::Scene& scene) { return scene.agent.ellipsoid() && scene.obstacle.ellipsoid(); }

QuadricCone exact_cone(const Ellipsoid& a, const Ellipsoid& b, int samples) {
  const auto start = Clock::now();
  const TrueCone cone = true_cone(a, b, samples);
  std::optional<ConeBounds> bounds;
  if (cone.relation == Relation::disjoint) bounds = cone_bounds(cone, a, b);
  const double seconds = seconds_since(start);
  std::ostringstream text;
  print_method("exact", std::to_string(samples) + " samples", cone.relation, text);
  if (bounds)
    print_bounded(*bounds, text);
  else
    text << "solid angle         " << number_text(cone.solid_angle) << " sr\n";
  return told(cone.relation, exact_json(cone, bounds, samples), text, seconds);
}

QuadricCone certified_cone(const CombinedEllipsoid& a, const CombinedEllipsoid& b, double tolerance) {
  const auto start = Clock::now();
  const CombinedCone cone = combined_cone(a, b, tolerance);
  const double seconds = seconds_since(start);
  std::ostringstream text;
  print_method("certified", "tolerance " + number_text(tolerance), cone.relation, text);
  if (cone.relation) print_bounded(cone, text);
  return told(cone.relation, certified_json(cone, tolerance), text, seconds);
}

QuadricCone sliced_cone(const scenes::Scene& scene, int planes, SliceSector sectors) {
  const auto start = Clock::now();
  Slices found{planes, sectors, {}, {}, {}, {}, {}};
  const auto take = [&](const auto& cone) {
    found.relation = cone.relation;
    found.axis = cone.axis;
    found.slices = cone.slices;
    found.polyhedral = cone.polyhedral();
  };
  if (ellipsoids(scene) && sectors == SliceSector::all_candidates) {
    take(slice_cone(*scene.agent.ellipsoid(), *scene.obstacle.ellipsoid(), planes));
  } else {
    found.combined = combined_slice_cone(*scene.agent.quadric(), *scene.obstacle.quadric(), planes, sectors);
    take(*found.combined);
  }
  const double seconds = seconds_since(start);
  std::ostringstream text;
  print_sliced(found, scene, text);
  return told(found.relation, sliced_json(found, scene), text, seconds);
}

}  // namespace vericone
