// SPDX-License-Identifier: BSD-3-Clause
#include "picture/shape_json.h"

#include "json/json_value.h"

namespace vericone {
namespace {

template <int D>
Json combined_json(const BasicCombined<D>& body) {
  Json delimiters = Json::array();
  for (const auto& d : body.delimiters())
    delimiters.push_back({{"matrix", matrix_json(d.matrix)}, {"level", d.level}});
  return {{"center", vector_json(body.center())},
          {"factor", matrix_json(body.ellipsoid().factor())},
          {"delimiters", delimiters}};
}

}  // namespace

Json body_json(const CombinedEllipse& body) { return combined_json<2>(body); }
Json body_json(const CombinedEllipsoid& body) { return combined_json<3>(body); }

Json mesh_json(const CombinedSurface& surface) {
  Json vertices = Json::array(), triangles = Json::array(), quadrics = Json::array();
  for (const auto& v : surface.vertices) vertices.push_back(vector_json(v));
  for (const auto& t : surface.triangles) {
    triangles.push_back(t.vertices);
    quadrics.push_back(t.quadric);
  }
  return {{"vertices", vertices}, {"triangles", triangles}, {"quadrics", quadrics}};
}

Json solid_json(const CombinedEllipsoid& body, const CombinedSurface& whole, const std::string& part) {
  const CombinedSurface shown = part == "ellipsoid"    ? vericone::part(whole, SurfacePart::ellipsoid)
                                : part == "delimiters" ? vericone::part(whole, SurfacePart::delimiters)
                                                       : whole;
  return {{"body", body_json(body)}, {"part", part}, {"mesh", mesh_json(shown)}};
}

Json outline_json(const CombinedEllipse& body) {
  Json arcs = Json::array(), all = Json::array();
  for (const BoundaryArc& arc : outline(body)) {
    Json points = Json::array();
    for (const auto& p : arc.points) points.push_back(vector_json(p));
    arcs.push_back({{"conic", arc.conic}, {"points", points}});
  }
  for (const Corner& c : corners(body)) all.push_back(vector_json(c.point));
  Json json = body_json(body);
  json["arcs"] = arcs;
  json["corners"] = all;
  return json;
}

}  // namespace vericone
