// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vericone/scenes/scene.h>
#include <iosfwd>
#include <optional>
#include <string>

#include "cone/map_answer.h"
#include "json/json_forward.h"

namespace vericone {

namespace work {
class StagedFolder;
}

inline constexpr int kDefaultSamples = 96;
inline constexpr double kDefaultTolerance = 0.01;
inline constexpr int kDefaultPlanes = 36;

struct ConeCommand {
  std::string scene;
  bool cases = false;               // a scene on every line, as JSON
  std::string method = "exact";     // or "slice"
  std::optional<int> planes;        // slice; half-planes of a body of pieces
  std::string tangents = "all";     // slice: or the source's choices, "by-sides", "printed"
  std::optional<int> samples;       // exact, two ellipsoids; kDefaultSamples
  std::optional<double> tolerance;  // exact, certified to it; kDefaultTolerance for combined quadrics; pieces
  std::optional<MapRequest> map;
  bool json = false;
  bool certificate = false;    // of the verdict, in the JSON
  std::string glb;             // file for bodies and cone as GLB; empty: none
  std::string picture_folder;  // empty: no picture
  bool figures = true;         // false: only what a picture is drawn from
  int threads = 0;             // of map and picture; 0: one per processor
};

/// `vericone cone`: the cone of one scene, as text or JSON (docs/reference/formats.md), with a picture if
/// asked for; or of the scenes of a file of cases, one line of JSON each. Returns the exit status: 0, or 2 if
/// a line was bad.
int run_cone(const ConeCommand& options, std::ostream& out);

/// Why there is no picture of a cone of bodies in that relation; null where there is one.
const char* why_no_picture(const std::optional<Relation>& relation);
void print_no_picture(const char* why, std::ostream& out);

/// The end of a picture: the map's data, both drawn by their scripts, all of it published and told.
/// `picture`: the name of what `script` draws; without a script the map is all.
void publish_cone(const ConeCommand& options, work::StagedFolder& folder, const Json& map,
                  const std::string& script, const std::string& picture, std::ostream& out);

}  // namespace vericone
