// SPDX-License-Identifier: BSD-3-Clause
#include "fit/write_fit.h"
#include <vericone/internal/fits/body_text.h>

#include "fit/fit_body.h"
#include "fit/fit_json.h"
#include "json/json_value.h"
#include "output/output_file.h"

namespace vericone {
namespace fit {

std::vector<Json> bodies_of(const fitting::FitResult& result, const fitting::Sample& sample) {
  return enclosing_body_fields(result.pieces, result.certified ? points_inside(result.pieces, sample)
                                                               : std::vector<Eigen::Vector3d>());
}

std::string title_of(const fits::Scan& scan, const fitting::FitResult& result) {
  std::string text = std::filesystem::path(scan.file).filename().string() + ": " + to_string(result.mode) +
                     ", " + fitting::to_string(result.shape);
  if (result.pieces.size() > 1) text += ", " + std::to_string(result.pieces.size()) + " pieces";
  return text;
}

void write_files(const Json& json, const std::vector<Json>& bodies, const std::string& title,
                 const std::vector<CombinedSurface>& surfaces, const std::filesystem::path& folder) {
  write_whole(folder / "fit.json", json_text(json) + "\n");
  // The path is in provenance.json.
  write_whole(folder / "body.yaml", body_yaml(bodies, "Fitted to " + title));
  write_whole(folder / "hull.obj", hull_obj(surfaces));
  write_whole(folder / "hull.ply", hull_ply(surfaces));
}

}  // namespace fit

namespace fits {

std::string body_text(const fitting::FitResult& result, const fitting::Sample& sample,
                      const std::string& comment) {
  return fit::body_yaml(fit::bodies_of(result, sample), comment);
}

void write_fit(const Scan& scan, const fitting::FitOptions& options, const fitting::FitResult& result,
               double seconds, const std::filesystem::path& folder) {
  const std::vector<Json> bodies = fit::bodies_of(result, scan.sample);
  Json json = fit::fit_json(scan, options, result, bodies);
  json["seconds_read"] = scan.seconds;
  json["seconds"] = seconds;
  fit::write_files(json, bodies, fit::title_of(scan, result), fit::hull_surfaces(result.pieces), folder);
}

}  // namespace fits
}  // namespace vericone
