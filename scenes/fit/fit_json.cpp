// SPDX-License-Identifier: BSD-3-Clause
#include "fit/fit_json.h"

#include <vericone/geometry/error.h>
#include <cmath>

#include "json/json_value.h"

namespace vericone::fit {
namespace {

using fitting::Mode;

/// Where 0 stands for "does not apply".
Json positive(double x) { return x > 0 ? number_or_null(x) : Json(nullptr); }

Json vector(const Eigen::Vector3d& v) {
  return {number_or_null(v.x()), number_or_null(v.y()), number_or_null(v.z())};
}

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
    list.push_back(
        {{"what", u.what}, {"value", number_or_null(u.value)}, {"error", number_or_null(u.error)}});
  return list;
}

/// What only surfaces near points have.
Json surface_json(const fitting::SurfaceFit& fit) {
  return {{"converged", fit.converged},
          {"noise", number_or_null(fit.noise)},
          {"inliers", number_or_null(fit.inliers)},
          {"seen", number_or_null(fit.seen)},
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
                    {"volume", number_or_null(c.volume)},
                    {"noise", mode == Mode::containing ? Json(nullptr) : number_or_null(c.noise)},
                    {"parameters", c.parameters},
                    {"score", number_or_null(c.score)}});
  return list;
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

std::string of_all(std::size_t part, std::size_t all, const std::string& what) {
  return (part == all ? "all " : std::to_string(part) + " of ") + std::to_string(all) + " " + what;
}

Json certificate_json(const fitting::Certificate& c, bool mesh, const std::string& statement) {
  return {{"points", c.points},
          {"points_inside", c.points_inside},
          {"triangles", mesh ? Json(c.triangles) : Json(nullptr)},
          {"triangles_inside", mesh ? Json(c.triangles_inside) : Json(nullptr)},
          {"margin", c.margin},
          {"margins_inside", c.margins_inside},
          {"by_exact", c.by_exact},
          {"touching", c.touching},
          {"statement", statement}};
}

Json distance_json(const std::optional<fitting::DistanceStatistics>& d) {
  if (!d) return nullptr;
  return {
      {"mean", number_or_null(d->mean)}, {"rms", number_or_null(d->rms)}, {"max", number_or_null(d->max)}};
}

std::string statement(const fitting::FitResult& result, const fits::Scan& scan) {
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

Json fit_json(const fits::Scan& scan, const fitting::FitOptions& options, const fitting::FitResult& result,
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
  json["volume"] = result.volume ? number_or_null(result.volume->value) : Json(nullptr);
  json["volume_error"] = result.volume ? number_or_null(result.volume->error) : Json(nullptr);
  json["area"] = number_or_null(result.area);
  json["scan_volume"] = number_or_null(result.scan_volume);
  json["convex_hull_volume"] = number_or_null(result.convex_hull_volume);
  json["ellipsoid_volume"] = number_or_null(result.ellipsoid_volume);
  json["volume_ratio_bound"] = positive(result.volume_ratio_bound);
  json["stationarity"] = containing ? number_or_null(result.stationarity) : Json(nullptr);
  json["certified"] = result.certified;
  json["certificate"] = certificate_json(result.certificate, scan.sample.is_mesh(), statement(result, scan));
  json["inflation"] = number_or_null(result.inflation);
  json["mean_distance"] = number_or_null(result.scan_to_hull.mean);
  json["rms_distance"] = number_or_null(result.scan_to_hull.rms);
  json["max_distance"] = number_or_null(result.scan_to_hull.max);
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
