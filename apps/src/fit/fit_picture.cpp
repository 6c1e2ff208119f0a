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

}  // namespace

Json fit_picture(const fits::Scan& scan, const fitting::FitResult& result,
                 const std::vector<CombinedSurface>& surfaces, const std::string& title) {
  const fitting::Sample& sample = scan.sample;
  const Assembly pieces =
      sample.is_mesh() ? Assembly::mesh(sample.points, sample.triangles) : Assembly::cloud(sample.points, 0);
  Json data{{"title", title}, {"scan", shown_pieces(pieces, {})}};
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

}  // namespace vericone::fit
