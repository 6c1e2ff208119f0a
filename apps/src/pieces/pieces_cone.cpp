// SPDX-License-Identifier: BSD-3-Clause
#include "pieces/pieces_cone.h"

#include <vericone/geometry/error.h>
#include <filesystem>
#include <ostream>

#include "answer.h"
#include "figures.h"
#include "pieces/assembly_cone.h"
#include "pieces/pieces_picture.h"
#include "provenance.h"

namespace vericone {
namespace {

using Json = nlohmann::ordered_json;

void refuse_options(const ConeOptions& options) {
  if (options.samples)
    throw InputError("--samples", std::to_string(*options.samples), "left out for a body of pieces");
  if (options.tangents != "all")
    throw InputError("--tangents", options.tangents, "left out for a body of pieces");
}

void print_verdict(const input::AssemblyEngagement& e, std::ostream& out) {
  const Json verdict = answer(e, false);
  out << "verdict             " << verdict["verdict"].get<std::string>()
      << " (of the scene's velocities, exact)\n";
  if (verdict["contact_point"].is_array())
    out << "first contact       after " << verdict["time_to_contact"].dump() << " s at "
        << verdict["contact_point"].dump() << '\n';
  if (verdict["clearance"].is_number() && verdict["verdict"] == "out")
    out << "passes at           " << verdict["clearance"].dump() << " m\n";
}

}  // namespace

void run_pieces_cone(const ConeOptions& options, const input::AssemblyEngagement& e, std::ostream& out) {
  refuse_options(options);
  const AssemblyCone cone = assembly_cone(e, options.planes.value_or(kDefaultHalfPlanes),
                                          options.tolerance.value_or(kDefaultAngle));
  const bool drawn = !options.picture_folder.empty();
  if (drawn && cone.relation != Relation::disjoint)
    throw InputError("--picture", options.picture_folder, "asked for disjoint bodies only");
  MapAnswer map;
  if (options.map) map = map_answer(cone.oracle, *options.map, cone.frame.axis, describe(e.obstacle));
  if (options.json) {
    Json result = to_json(cone, e);
    result["map"] = options.map ? map.summary : Json(nullptr);
    out << result.dump(1) << '\n';
  } else {
    print_text(cone, e, out);
    if (options.map) print_map(map.summary, out);
    print_verdict(e, out);
    out << "time                " << to_text(cone.seconds) << " s, after " << to_text(cone.seconds_prepared)
        << " s to prepare\n";
  }
  if (!drawn) return;
  const std::filesystem::path folder = options.picture_folder;
  std::filesystem::create_directories(folder);
  auto files = draw_pieces(cone, e, folder);
  if (options.map) {
    write_whole(folder / "cone_map.json", map.picture.dump() + "\n");
    const auto more = draw_figures("cone_map.py", folder);
    files.insert(files.end(), more.begin(), more.end());
  }
  if (!options.json)
    for (const auto& file : files) out << "picture             " << file.string() << '\n';
}

}  // namespace vericone
