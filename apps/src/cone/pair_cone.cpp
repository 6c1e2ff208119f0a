// SPDX-License-Identifier: BSD-3-Clause
#include "cone/pair_cone.h"

#include <vericone/cones/cone.h>
#include <vericone/geometry/error.h>
#include <vericone/work/staged_folder.h>
#include <filesystem>
#include <ostream>

#include "cone/answer.h"
#include "cone/verdict_text.h"
#include "input/stopwatch.h"
#include "json/json_value.h"
#include "output/number_text.h"
#include "work/provenance.h"

namespace vericone {
namespace {

void refuse_options_but_map(const ConeCommand& options) {
  const auto refuse = [](const char* option, const std::string& value, const char* why) {
    throw InputError(option, value, std::string("left out for these bodies") + why);
  };
  if (options.method != "exact") refuse("--method", options.method, ": there are no slices of them");
  if (options.planes) refuse("--planes", std::to_string(*options.planes), "");
  if (options.samples) refuse("--samples", std::to_string(*options.samples), "");
  if (options.tolerance)
    refuse("--tolerance", to_text(*options.tolerance), ": their cone is a map, --map RADIANS");
  if (options.tangents != "all") refuse("--tangents", options.tangents, "");
  if (!options.picture_folder.empty() && !options.map)
    throw InputError("--out", options.picture_folder,
                     "given with --map: the picture of these bodies' cone is its map");
}

/// What course_json() of course.h has, as far as a map shows it; null where the velocities are equal.
Json course_of(const scenes::Scene& scene, const Pair& pair, const Json& answer) {
  if (scene.agent.velocity == scene.obstacle.velocity) return nullptr;
  Json course{{"velocity", vector_json(scene.agent.velocity - scene.obstacle.velocity)},
              {"verdict", answer["verdict"]}};
  if (answer["time_to_contact"].is_number()) course["contact_time"] = answer["time_to_contact"];
  if (answer["verdict"] == "out" && answer["clearance"].is_number()) {
    course["miss_distance"] = answer["clearance"];
    course["nearest_time"] = pair.miss(scene.agent.velocity, scene.obstacle.velocity).time;
  }
  return course;
}

}  // namespace

void run_pair_cone(const ConeCommand& options, const scenes::Scene& scene, std::ostream& out) {
  refuse_options_but_map(options);
  std::optional<work::StagedFolder> folder;
  if (!options.picture_folder.empty()) folder.emplace(options.picture_folder, "--out");
  const auto start = Clock::now();
  const Pair pair = scene.pair();
  const double seconds = seconds_since(start);
  const auto relation = pair.relation();
  const Guarantee guarantee = pair.guarantee();
  Json cone{{"method", guarantee.exact ? "exact" : "certified"},
            {"tolerance", guarantee.exact ? Json(nullptr) : Json(guarantee.tolerance)},
            {"relation", relation ? to_string(*relation) : "undecided"},
            {"agent", scene.agent.name},
            {"obstacle", scene.obstacle.name},
            {"answer", answer(scene, false)},
            {"map", nullptr},
            {"seconds", seconds}};
  MapAnswer map;
  if (options.map) {
    const auto& [from, to] = std::pair(pair.agent().containing_ellipsoid().center(),
                                       pair.obstacle().containing_ellipsoid().center());
    map = map_answer(*pair.directions(), *options.map, to - from, scene.obstacle.name);
    map.picture["course"] = course_of(scene, pair, cone["answer"]);
    cone["map"] = to_json(map);
  }
  if (options.json) {
    out << cone.dump(1) << '\n';
  } else {
    print_verdict(scene, out);
    out << "agent               " << scene.agent.name << '\n'
        << "obstacle            " << scene.obstacle.name << '\n'
        << "bodies              " << (relation ? to_string(*relation) : "undecided") << '\n';
    if (options.map)
      print_map(map, out);
    else
      out << "note                --map draws all directions that collide\n";
    out << "time                " << number_text(seconds, 2) << " s to prepare\n";
  }
  if (folder) publish_cone(options, *folder, map.picture, "", "cone_map", out);
}

}  // namespace vericone
