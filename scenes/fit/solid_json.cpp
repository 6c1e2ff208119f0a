// SPDX-License-Identifier: BSD-3-Clause
#include "fit/solid_json.h"

#include <vericone/geometry/error.h>
#include <algorithm>

#include "fit/fit_json.h"
#include "input/fields.h"
#include "json/json_value.h"

namespace vericone::fit {
namespace {

using fitting::Solid, fitting::SolidKind;

double size_field(const Json& sizes, const std::string& path, const char* field) {
  const std::string name = input::join(path, field);
  const double x =
      input::read_number(input::require_field(sizes, path, field, "metres, 0 or more"), name, " (metres)");
  if (!(x >= 0)) throw InputError(name, to_text(x), "0 or more (metres)");
  return x;
}

Json solid_pieces_json(const fitting::SolidFit& result) {
  Json list = Json::array();
  for (const Solid& solid : result.pieces) {
    Json one{{"kind", fitting::to_string(solid.kind)}, {"quadrics", nullptr}, {"body", solid_fields(solid)}};
    for (const char* field :
         {"heights", "converged", "noise", "inliers", "seen", "center_error", "axes_error", "unknown"})
      one[field] = nullptr;
    list.push_back(one);
  }
  return list;
}

/// What a user should know beside what reading found.
std::vector<std::string> solid_notes(const fitting::SolidOptions& options, const fitting::SolidFit& result) {
  std::vector<std::string> notes;
  if (result.pieces.size() < std::size_t(options.pieces))
    notes.push_back(std::to_string(result.pieces.size()) + " of " + std::to_string(options.pieces) +
                    " pieces: no further cut made their volumes smaller");
  if (result.scan_volume && result.volume.value < *result.scan_volume)
    notes.emplace_back(
        "the union is smaller than what the mesh encloses: it contains all of the surface, and not all "
        "of the inside");
  return notes;
}

}  // namespace

Json solid_fields(const Solid& solid) {
  Json fields{{"center", vector_json(solid.center)}, {"rotation", matrix_json(solid.rotation)}};
  const Eigen::Vector3d& s = solid.sizes;
  switch (solid.kind) {
    case SolidKind::sphere:
      fields["semi_axes"] = {s(0), s(0), s(0)};
      break;
    case SolidKind::capsule:
      fields["capsule"] = {{"radius", s(0)}, {"length", s(1)}};
      break;
    case SolidKind::cylinder:
      fields["cylinder"] = {{"radius", s(0)}, {"height", s(1)}};
      break;
    case SolidKind::box:
      fields["box"] = {{"half_widths", vector_json(s)}};
      break;
    case SolidKind::ellipsoid:
      fields["semi_axes"] = vector_json(s);
  }
  return fields;
}

Solid solid_of(const Json& fields, const std::string& path) {
  input::require_object(fields, path);
  Solid solid;
  const auto field = [&](const char* name, const char* what) -> const Json& {
    return input::require_field(fields, path, name, what);
  };
  solid.center = input::read_vector<3>(field("center", "[x, y, z] in metres"), path + ".center", " (metres)");
  solid.rotation =
      input::read_matrix<3>(field("rotation", "three rows of a rotation"), path + ".rotation", "");
  const auto sizes = [&](const char* word) -> const Json& {
    input::require_object(fields[word], input::join(path, word));
    return fields[word];
  };
  const auto size = [&](const char* word, const char* name) {
    return size_field(sizes(word), input::join(path, word), name);
  };
  if (fields.contains("capsule")) {
    solid.kind = SolidKind::capsule;
    solid.sizes = {size("capsule", "radius"), size("capsule", "length"), 0};
  } else if (fields.contains("cylinder")) {
    solid.kind = SolidKind::cylinder;
    solid.sizes = {size("cylinder", "radius"), size("cylinder", "height"), 0};
  } else if (fields.contains("box")) {
    solid.kind = SolidKind::box;
    solid.sizes = input::read_vector<3>(input::require_field(sizes("box"), path + ".box", "half_widths",
                                                             "[x, y, z] in metres, half of its edges"),
                                        path + ".box.half_widths", " (metres)");
  } else {
    solid.kind = SolidKind::ellipsoid;
    solid.sizes =
        input::read_vector<3>(field("semi_axes", "or capsule, cylinder or box, beside quadrics: null"),
                              path + ".semi_axes", " (metres)");
    if (solid.sizes.minCoeff() == solid.sizes.maxCoeff()) {
      solid.kind = SolidKind::sphere;
      solid.sizes = {solid.sizes(0), 0, 0};
    }
  }
  return solid;
}

std::string solid_statement(const fitting::SolidFit& result, const fits::Scan& scan) {
  const fitting::Certificate& c = result.certificate;
  std::string text = of_all(c.points_inside, c.points, "points");
  if (scan.sample.is_mesh()) text += " and " + of_all(c.triangles_inside, c.triangles, "triangles");
  text += result.pieces.size() == 1 ? " are inside" : " are inside, each in one of the pieces";
  if (c.margin > 0) text += ", the points with a ball of " + to_text(c.margin) + " m about them";
  if (!result.certified) return "nothing is proved; by exact arithmetic " + text;
  return text + ": proved in exact arithmetic of the numbers in body";
}

std::string counts_of(const std::vector<Solid>& solids) {
  std::string text;
  for (const SolidKind kind : fitting::kSolidKinds) {
    const auto count =
        std::count_if(solids.begin(), solids.end(), [&](const Solid& s) { return s.kind == kind; });
    if (count == 0) continue;
    const std::string name = fitting::to_string(kind);
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + name;
    if (count > 1) text += kind == SolidKind::box ? "es" : "s";
  }
  return text;
}

Json solid_fit_json(const fits::Scan& scan, const fitting::SolidOptions& options, const std::string& shape,
                    const fitting::SolidFit& result) {
  Json json{{"file", scan.file}, {"format", scan.format}, {"mode", "containing"}, {"shape", shape}};
  json["coverage"] = 1.0;
  json["margin"] = options.margin;
  json["seed"] = nullptr;
  json["pieces"] = solid_pieces_json(result);
  json["volume"] = number_or_null(result.volume.value);
  json["volume_error"] = number_or_null(result.volume.error);
  json["area"] = nullptr;
  json["scan_volume"] = number_or_null(result.scan_volume);
  json["convex_hull_volume"] = number_or_null(result.convex_hull_volume);
  json["ellipsoid_volume"] = number_or_null(result.ellipsoid_volume);
  for (const char* field : {"volume_ratio_bound", "stationarity"}) json[field] = nullptr;
  json["certified"] = result.certified;
  json["certificate"] =
      certificate_json(result.certificate, scan.sample.is_mesh(), solid_statement(result, scan));
  json["inflation"] = nullptr;
  json["mean_distance"] = number_or_null(result.scan_to_hull.mean);
  json["rms_distance"] = number_or_null(result.scan_to_hull.rms);
  json["max_distance"] = number_or_null(result.scan_to_hull.max);
  json["hull_distance"] = distance_json(result.protrusion);
  for (const char* field : {"why", "candidates"}) json[field] = nullptr;
  Json notes = Json::array();
  for (const auto& list : {scan.notes, solid_notes(options, result)})
    for (const std::string& note : list) notes.push_back(note);
  json["notes"] = notes;
  json["cones"] = nullptr;
  return json;
}

}  // namespace vericone::fit
