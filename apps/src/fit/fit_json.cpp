// SPDX-License-Identifier: BSD-3-Clause
#include "fit/fit_json.h"

#include <vericone/geometry/error.h>
#include <cmath>

#include "shape_json.h"

namespace vericone::fit {
namespace {

using Json = nlohmann::ordered_json;
using fitting::Mode;

Json number(double x) { return std::isfinite(x) ? Json(x) : Json(nullptr); }

Json number(const std::optional<double>& x) { return x ? number(*x) : Json(nullptr); }

/// Where 0 stands for "does not apply".
Json positive(double x) { return x > 0 ? number(x) : Json(nullptr); }

Json vector(const Eigen::Vector3d& v) { return {number(v.x()), number(v.y()), number(v.z())}; }

Json quadrics_json(const std::vector<Quadric>& quadrics) {
  Json list = Json::array();
  for (const Quadric& q : quadrics) {
    Json rows = Json::array();
    for (int i = 0; i < 4; ++i) {
      Json row = Json::array();
      for (int j = 0; j < 4; ++j) row.push_back(q.matrix()(i, j));
      rows.push_back(row);
    }
    list.push_back(rows);
  }
  return list;
}

Json unknown_json(const std::vector<fitting::Unknown>& unknown) {
  Json list = Json::array();
  for (const fitting::Unknown& u : unknown)
    list.push_back({{"what", u.what}, {"value", number(u.value)}, {"error", number(u.error)}});
  return list;
}

/// What only surfaces near points have.
Json surface_json(const fitting::SurfaceFit& fit) {
  return {{"converged", fit.converged},
          {"noise", number(fit.noise)},
          {"inliers", number(fit.inliers)},
          {"seen", number(fit.seen)},
          {"center_error", vector(fit.center_error)},
          {"axes_error", vector(fit.axes_error)},
          {"unknown", unknown_json(fit.unknown)}};
}

Json no_surface() {
  Json fields;
  for (const char* field : {"converged", "noise", "inliers", "seen", "center_error", "axes_error", "unknown"})
    fields[field] = nullptr;
  return fields;
}

Json pieces_json(const fitting::FitResult& result, const std::vector<Json>& bodies) {
  Json list = Json::array();
  for (std::size_t i = 0; i < result.pieces.size(); ++i) {
    const fitting::Piece& piece = result.pieces[i];
    Json one{{"quadrics", quadrics_json(piece.quadrics)}, {"body", bodies[i]}};
    one["heights"] = piece.footprint ? Json{piece.low, piece.high} : Json(nullptr);
    one.update(i < result.surfaces.size() ? surface_json(result.surfaces[i]) : no_surface());
    list.push_back(one);
  }
  return list;
}

Json candidates_json(const std::vector<fitting::Candidate>& candidates, Mode mode) {
  if (candidates.empty()) return nullptr;
  Json list = Json::array();
  for (const fitting::Candidate& c : candidates)
    list.push_back({{"shape", fitting::to_string(c.shape)},
                    {"converged", c.converged},
                    {"volume", number(c.volume)},
                    {"noise", mode == Mode::containing ? Json(nullptr) : number(c.noise)},
                    {"parameters", c.parameters},
                    {"score", number(c.score)}});
  return list;
}

Json certificate_json(const fitting::FitResult& result, const Scan& scan) {
  const fitting::Certificate& c = result.certificate;
  const bool mesh = scan.sample.is_mesh();
  return {{"points", c.points},
          {"points_inside", c.points_inside},
          {"triangles", mesh ? Json(c.triangles) : Json(nullptr)},
          {"triangles_inside", mesh ? Json(c.triangles_inside) : Json(nullptr)},
          {"margin", c.margin},
          {"margins_inside", c.margins_inside},
          {"by_exact", c.by_exact},
          {"touching", c.touching},
          {"statement", statement(result, scan)}};
}

Json distance_json(const std::optional<fitting::DistanceStatistics>& d) {
  if (!d) return nullptr;
  return {{"mean", number(d->mean)}, {"rms", number(d->rms)}, {"max", number(d->max)}};
}

std::string of_all(std::size_t part, std::size_t all, const std::string& what) {
  if (part == all) return "all " + std::to_string(all) + " " + what;
  return std::to_string(part) + " of " + std::to_string(all) + " " + what;
}

}  // namespace

std::string to_string(Mode mode) {
  switch (mode) {
    case Mode::least_squares:
      return "least-squares";
    case Mode::robust:
      return "robust";
    case Mode::containing:
      return "containing";
  }
  return "";
}

std::string statement(const fitting::FitResult& result, const Scan& scan) {
  const fitting::Certificate& c = result.certificate;
  if (!result.certified)
    return "nothing is proved; by exact arithmetic " + of_all(c.points_inside, c.points, "points") +
           " are inside";
  std::string text = of_all(c.points_inside, c.points, "points");
  if (scan.sample.is_mesh()) text += " and " + of_all(c.triangles_inside, c.triangles, "triangles");
  text += result.pieces.size() == 1 ? " are inside" : " are inside, each in one of the pieces";
  if (c.margin > 0)
    text += ", " + of_all(c.margins_inside, c.points, "points") + " with a ball of " + to_text(c.margin) +
            " m about them";
  return text + ": proved in exact arithmetic of the numbers in quadrics";
}

Json fit_json(const Scan& scan, const fitting::FitOptions& options, const fitting::FitResult& result,
              const std::vector<Json>& bodies) {
  Json json{{"file", scan.file},
            {"format", scan.format},
            {"mode", to_string(result.mode)},
            {"shape", fitting::to_string(result.shape)}};
  const bool containing = result.mode == Mode::containing;
  json["coverage"] = options.coverage ? Json(*options.coverage) : containing ? Json(1.0) : Json(nullptr);
  json["margin"] = options.margin;
  json["seed"] = options.seed;
  json["pieces"] = pieces_json(result, bodies);
  json["volume"] = result.volume ? number(result.volume->value) : Json(nullptr);
  json["volume_error"] = result.volume ? number(result.volume->error) : Json(nullptr);
  json["area"] = number(result.area);
  json["scan_volume"] = number(result.scan_volume);
  json["convex_hull_volume"] = number(result.convex_hull_volume);
  json["ellipsoid_volume"] = number(result.ellipsoid_volume);
  json["volume_ratio_bound"] = positive(result.volume_ratio_bound);
  json["stationarity"] = containing ? number(result.stationarity) : Json(nullptr);
  json["certified"] = result.certified;
  json["certificate"] = certificate_json(result, scan);
  json["inflation"] = number(result.inflation);
  json["mean_distance"] = number(result.scan_to_hull.mean);
  json["rms_distance"] = number(result.scan_to_hull.rms);
  json["max_distance"] = number(result.scan_to_hull.max);
  json["hull_distance"] = distance_json(result.hull_to_scan);
  json["why"] = result.why.empty() ? Json(nullptr) : Json(result.why);
  json["candidates"] = candidates_json(result.candidates, result.mode);
  Json notes = Json::array();
  for (const auto* list : {&scan.notes, &result.notes})
    for (const std::string& note : *list) notes.push_back(note);
  json["notes"] = notes;
  json["cones"] = nullptr;
  return json;
}

}  // namespace vericone::fit
