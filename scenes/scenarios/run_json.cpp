// SPDX-License-Identifier: BSD-3-Clause
#include "scenarios/run_json.h"
#include <vericone/internal/scenarios/words.h>

#include "json/json_value.h"
#include "pieces/decimate.h"

namespace vericone::scenario {
namespace {

using namespace simulation;

Json k_json(const Oscillation& k) {
  if (k.amplitude == 0) return k.absolute ? std::abs(k.offset) : k.offset;
  return {{"offset", k.offset},
          {"amplitude", k.amplitude},
          {"rate", k.rate},
          {"phase", k.phase},
          {"absolute", k.absolute}};
}

/// Semi-axes in the order of the factor's columns, which a scenario writes along x, y, z.
template <int D>
Json combined_json(const BasicCombined<D>& body, const char* ellipsoid, const char* delimited) {
  Json json{{"kind", body.is_ellipsoid() ? ellipsoid : delimited}};
  const auto& factor = body.ellipsoid().factor();
  Json axes = Json::array();
  for (int i = 0; i < D; ++i) axes.push_back(factor.col(i).norm());
  json["semi_axes"] = axes;
  json["factor"] = matrix_json(factor);
  if (body.is_ellipsoid()) return json;
  json["delimiters"] = Json::array();
  for (const Delimiter<D>& d : body.delimiters())
    json["delimiters"].push_back({{"matrix", matrix_json(d.matrix)}, {"level", d.level}});
  return json;
}

/// With what a picture shows of it: a mesh, a cloud or a map thinned, each piece of a union as it is.
Json placed_json(const Placed& placed) {
  Json json{{"kind", to_string(placed.body.kind())}};
  if (const auto* pieces = placed.body.quadrics()) {
    json["pieces"] = Json::array();
    for (const CombinedEllipsoid& piece : *pieces) {
      const CombinedEllipsoid own = in_world(piece, placed.pose);
      Json entry = combined_json<3>(own, "ellipsoid", "combined");
      entry["center"] = vector_json(own.center());
      json["pieces"].push_back(entry);
    }
  } else if (const auto* assembly = placed.body.assembly()) {
    json["size"] = assembly->size();
    if (assembly->kind() == PieceKind::hull) {
      json["pieces"] = Json::array();
      for (std::size_t i = 0; i < assembly->size(); ++i) {
        Json points = Json::array();
        const HullBody piece = assembly->piece(i);
        for (const Eigen::Vector3d& x : piece.points())
          points.push_back(vector_json(placed.pose.to_world(x)));
        json["pieces"].push_back({{"kind", "hull"}, {"points", points}});
      }
    } else {
      json.update(shown_pieces(*assembly, placed.pose));
    }
  } else if (const Convex* convex = placed.body.convex()) {
    json["word"] = convex->word();
    json.update(shown_convex(*convex, placed.pose));
  }
  return json;
}

Json body_json(const WorldBody& body) {
  if (body.flat()) return combined_json<2>(*body.flat(), "ellipse", "combined");
  if (body.quadric()) return combined_json<3>(*body.quadric(), "ellipsoid", "combined");
  if (body.placed()) return placed_json(*body.placed());
  Json points = Json::array();
  for (const Eigen::Vector3d& x : body.hull()->points()) points.push_back(vector_json(x));
  return {{"kind", "hull"}, {"points", points}};
}

Json shape_json(const ShapeInTime& shape) {
  if (shape.rigid()) return body_json(*shape.rigid());
  const Eigen::Vector3d& axes = shape.semi_axes();
  if (planar(shape))
    return {{"kind", "dented_conic"}, {"a_c", axes.x()}, {"b_c", axes.y()}, {"k", k_json(*shape.k())}};
  return {{"kind", "dented_quadric"}, {"dented", vector_json(axes)}, {"k", k_json(*shape.k())}};
}

Json passages_json(const Scenario& scenario, const Run& run) {
  Json list = Json::array();
  for (const PassageOutcome& passage : run.passages) {
    const PassageProof& proof = passage.proof;
    const bool apart = proof.verdict == PassageVerdict::passed || proof.verdict == PassageVerdict::missed;
    list.push_back({{"agent", scenario.bodies[passage.agent].name},
                    {"orifice", scenario.orifices[passage.orifice].name},
                    {"ordered", passage.ordered},
                    {"verdict", to_string(proof.verdict)},
                    {"time", proof.verdict == PassageVerdict::passed ? Json(proof.time) : Json(nullptr)},
                    {"from", proof.from},
                    {"to", proof.to},
                    {"least_distance", apart ? Json(proof.least_distance) : Json(nullptr)},
                    {"place", vector_json(proof.place)},
                    {"pieces", proof.pieces}});
  }
  return list;
}

}  // namespace

Json proof_json(const Scenario& scenario, const Run& run) {
  Json pairs = Json::array();
  for (const PairOutcome& pair : run.proofs) {
    const PairProof& proof = pair.proof;
    Json entry{{"a", scenario.bodies[pair.a].name},
               {"b", scenario.bodies[pair.b].name},
               {"verdict", to_string(proof.verdict)},
               {"from", proof.from},
               {"to", proof.to},
               {"place", nullptr},
               {"least_distance", nullptr},
               {"least_time", nullptr},
               {"pieces", proof.pieces}};
    if (pair.required > 0) {
      entry["required"] = pair.required;
      entry["kept"] = pair.kept();
    }
    if (proof.verdict == ProofVerdict::avoided) {
      entry["least_distance"] = proof.least_distance;
      entry["least_time"] = proof.least_time;
    } else {
      entry["place"] = vector_json(proof.place);
    }
    pairs.push_back(entry);
  }
  Json not_checked = Json::array();
  for (const NotChecked& pair : run.not_checked)
    not_checked.push_back(
        {{"a", scenario.bodies[pair.a].name}, {"b", scenario.bodies[pair.b].name}, {"why", "together"}});
  Json json{{"verdict", run_verdict(run)}, {"pairs", pairs}, {"not_checked", not_checked}};
  if (!scenario.orifices.empty()) json["passages"] = passages_json(scenario, run);
  return json;
}

std::string run_verdict(const Run& run) {
  const ProofVerdict worst = run.verdict();
  if (worst != ProofVerdict::avoided) return to_string(worst);
  bool ordered = false;
  for (const PassageOutcome& passage : run.passages) {
    if (passage.ordered && passage.proof.verdict == PassageVerdict::missed)
      return to_string(PassageVerdict::missed);
    ordered |= passage.ordered;
  }
  if (ordered) return to_string(PassageVerdict::passed);
  return run.proofs.empty() ? "none" : to_string(worst);
}

Json orifices_json(const Scenario& scenario) {
  Json list = Json::array();
  for (const MovingOrifice& orifice : scenario.orifices) {
    Json outline;
    if (orifice.window) {
      outline = {{"rim", Json::array()}};
      for (const Eigen::Vector3d& x : orifice.window->rim()) outline["rim"].push_back(vector_json(x));
      outline["mesh"] = shown_pieces(*orifice.window->mesh().body.assembly(), {});
    } else if (orifice.opening.polygonal()) {
      outline = {{"polygon", Json::array()}};
      for (const Eigen::Vector2d& x : orifice.opening.vertices())
        outline["polygon"].push_back(vector_json(x));
    } else {
      outline = {{"semi_axes", vector_json(orifice.opening.semi_axes())}};
    }
    list.push_back({{"name", orifice.name},
                    {"opening", outline},
                    {"position", vector_json(orifice.position)},
                    {"velocity", vector_json(orifice.velocity)},
                    {"rotation", matrix_json(orifice.rotation)},
                    {"spin", vector_json(orifice.spin)},
                    {"appears", orifice.appears},
                    {"wall", orifice.wall}});
  }
  return list;
}

Json shapes_json(const Scenario& scenario) {
  Json list = Json::array();
  for (const simulation::Body& body : scenario.bodies) {
    Json entry{{"name", body.name}};
    const Json shape = shape_json(body.shape);
    for (const auto& [key, value] : shape.items()) entry[key] = value;
    list.push_back(entry);
  }
  return list;
}

}  // namespace vericone::scenario
