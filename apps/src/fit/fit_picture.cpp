// SPDX-License-Identifier: BSD-3-Clause
#include "fit/fit_picture.h"

#include "json/json_value.h"
#include "picture/shape_json.h"
#include "pieces/decimate.h"

namespace vericone::fit {

namespace {

Json footprint_json(const fitting::Piece& piece) {
  const Ellipse& e = *piece.footprint;
  Json rows = Json::array();
  for (int i = 0; i < 2; ++i) rows.push_back(vector_json(Eigen::Vector2d(e.factor().row(i).transpose())));
  return {{"center", vector_json(e.center())}, {"factor", rows}, {"low", piece.low}, {"high", piece.high}};
}

Json scan_picture(const fitting::Sample& sample, const std::string& title) {
  const Assembly pieces =
      sample.is_mesh() ? Assembly::mesh(sample.points, sample.triangles) : Assembly::cloud(sample.points, 0);
  return {{"title", title}, {"scan", shown_pieces(pieces, {})}};
}

}  // namespace

Json fit_picture(const fits::Scan& scan, const fitting::FitResult& result,
                 const std::vector<CombinedSurface>& surfaces, const std::string& title) {
  const fitting::Sample& sample = scan.sample;
  Json data = scan_picture(sample, title);
  Json hull = Json::array(), touching = Json::array();
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const fitting::Piece& piece = result.pieces[i];
    if (piece.footprint) {
      hull.push_back({{"footprint", footprint_json(piece)}, {"mesh", mesh_json(surfaces[i])}});
    } else {
      hull.push_back(solid_json(piece.body, surfaces[i]));
    }
  }
  if (result.mode == fitting::Mode::containing)
    for (const std::size_t i : result.certificate.touching) touching.push_back(vector_json(sample.points[i]));
  data["hull"] = hull;
  data["touching"] = touching;
  return data;
}

Json solid_picture(const fits::Scan& scan, const std::vector<CombinedSurface>& surfaces,
                   const std::vector<Eigen::Vector3d>& touching, const std::string& title) {
  Json data = scan_picture(scan.sample, title);
  data["hull"] = Json::array();
  for (const CombinedSurface& surface : surfaces) data["hull"].push_back({{"mesh", mesh_json(surface)}});
  data["touching"] = Json::array();
  for (const Eigen::Vector3d& x : touching) data["touching"].push_back(vector_json(x));
  return data;
}

}  // namespace vericone::fit
