// SPDX-License-Identifier: BSD-3-Clause
#include "cone/map_answer.h"

#include <vericone/cones/map/classifiers.h>
#include <vericone/cones/map/regions.h>
#include <vericone/geometry/error.h>
#include <algorithm>
#include <ostream>

#include "input/stopwatch.h"
#include "json/json_value.h"
#include "picture/cone_map_json.h"

namespace vericone {
namespace {

constexpr std::size_t kShownRegions = 20;

const char* name_of(Certified label) { return label == Certified::in ? "colliding" : "safe"; }

/// `all`: the map's.
Json region_json(const ConeMapRegion& region, const std::vector<ConeMapRegion>& all) {
  double others = 0;
  for (const ConeMapRegion& other : all)
    if (other.label == region.label && other.possible == region.possible) others += other.solid_angle;
  others = region.surely_separate ? 0 : others - region.solid_angle;
  return {{"label", name_of(region.label)},
          {"solid_angle", region.solid_angle},
          {"most_solid_angle", region.most_solid_angle},
          {"surely_separate", region.surely_separate},
          {"others_possibly_connected", std::max(0.0, others)},
          {"holes", region.boundary.empty() ? 0 : region.boundary.size() - 1}};
}

}  // namespace

MapAnswer map_answer(const DirectionClassifier& classifier, const MapRequest& request,
                     const Eigen::Vector3d& middle, const std::string& title) {
  if (!(request.resolution >= 1e-4 && request.resolution <= 1))
    throw InputError("--map", to_text(request.resolution), "between 0.0001 and 1 radians");
  if (request.around && !(request.around->norm() > 0))
    throw InputError("--around", "0,0,0", "a direction x,y,z");
  const auto start = Clock::now();
  ConeMapOptions options;
  options.resolution = request.resolution;
  options.threads = request.threads;
  const ConeMap map = cone_map(classifier, options);
  const double seconds = seconds_since(start);
  Json list = Json::array();
  const auto all = regions(map);
  for (std::size_t i = 0; i < std::min(all.size(), kShownRegions); ++i)
    list.push_back(region_json(all[i], all));
  Json around = nullptr;
  if (request.around)
    if (const auto region = region_around(map, *request.around)) around = region_json(*region, all);
  Json summary{{"resolution", request.resolution},
               {"colliding", map.colliding},
               {"safe", map.safe},
               {"undecided", map.undecided},
               {"cells", map.cells.size()},
               {"asked", map.asked},
               {"complete", map.complete},
               {"regions_in_all", all.size()},
               {"regions", list},
               {"around", request.around ? around : Json(nullptr)},
               {"seconds", seconds}};
  if (request.around)
    summary["asked_around"] = {request.around->x(), request.around->y(), request.around->z()};
  return {summary, cone_map_json(map, request.around.value_or(middle), request.resolution, title)};
}

MapAnswer map_answer(const scenes::Scene& scene, const MapRequest& request, double tolerance,
                     const std::string& title) {
  const CombinedEllipsoid &a = *scene.agent.quadric(), &b = *scene.obstacle.quadric();
  const Eigen::Vector3d between = b.center() - a.center();
  const Eigen::Vector3d middle = between.norm() > 0 ? between : Eigen::Vector3d(1, 0, 0);
  if (a.is_ellipsoid() && b.is_ellipsoid())
    return map_answer(EllipsoidClassifier(a.ellipsoid(), b.ellipsoid()), request, middle, title);
  return map_answer(CombinedClassifier(combined_cone(a, b, tolerance)), request, middle, title);
}

void print_map(const Json& map, std::ostream& out) {
  out << "cone map            colliding " << map["colliding"].dump() << " sr, safe " << map["safe"].dump()
      << " sr, undecided " << map["undecided"].dump() << " sr, at " << map["resolution"].dump() << " rad\n";
  int safe = 0, colliding = 0;
  for (const Json& region : map["regions"]) ++(region["label"] == "safe" ? safe : colliding);
  if (map["regions_in_all"] == map["regions"].size())
    out << "regions             " << colliding << " colliding, " << safe << " safe\n";
  if (map.contains("asked_around")) {
    const Json& around = map["around"];
    out << "around " << map["asked_around"].dump();
    if (around.is_null()) {
      out << "  undecided\n";
    } else {
      out << "  " << around["label"].get<std::string>() << ", a region of " << around["solid_angle"].dump()
          << " to " << around["most_solid_angle"].dump() << " sr"
          << (around["surely_separate"] == true ? ", surely apart from all others of its kind\n"
                                                : ", may be connected with others of " +
                                                      around["others_possibly_connected"].dump() + " sr\n");
    }
  }
  out << "map time            " << map["seconds"].dump() << " s\n";
}

}  // namespace vericone
